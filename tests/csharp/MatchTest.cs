// A C# game plays a C++ host across a bad line, in virtual time: every final frame has one hash.
// SPDX-License-Identifier: MIT
using System;
using System.Collections.Generic;
using System.Runtime.InteropServices;
using Isostep;

internal static unsafe class HostLibrary
{
    private const string Name = "match_host";
    [DllImport(Name)] internal static extern ulong match_schema();
    [DllImport(Name)] private static extern IntPtr match_create(int isFixed, byte* profile);
    [DllImport(Name)] internal static extern void match_destroy(IntPtr match);
    [DllImport(Name)] internal static extern void match_turn(IntPtr match, ulong now);
    [DllImport(Name)] internal static extern int match_confirmed(IntPtr match);
    [DllImport(Name)] internal static extern ulong match_hash(IntPtr match, int frame);
    [DllImport(Name)]
    private static extern int match_receive(IntPtr match, uint* peer, uint* channel, byte* bytes, int* size);
    [DllImport(Name)]
    private static extern void match_send(IntPtr match, uint peer, uint channel, byte* bytes, int size);
    [DllImport(Name)] private static extern void match_hang_up(IntPtr match, uint peer);

    internal static IntPtr Create(bool isFixed, string profile)
    {
        fixed (byte* at = System.Text.Encoding.ASCII.GetBytes(profile + "\0")) return match_create(isFixed ? 1 : 0, at);
    }

    /// What has arrived goes into the session.
    internal static void Deliver(IntPtr host, Session session, byte[] buffer, ulong now)
    {
        for (;;)
        {
            uint peer, channel;
            int size, kind;
            fixed (byte* at = buffer) kind = match_receive(host, &peer, &channel, at, &size);
            if (kind == 0) return;
            if (kind == 1) session.Connected(peer, now, false);
            if (kind == 2) session.Disconnected(peer, now);
            if (kind == 3) session.Receive(peer, (Channel)channel, buffer, size, now);
        }
    }

    /// What it has to say goes out.
    internal static void Dispatch(IntPtr host, Session session, byte[] buffer, ulong now)
    {
        Outgoing next;
        while (session.PollSend(now, buffer, out next))
        {
            fixed (byte* at = buffer)
            {
                if (next.Length != 0) match_send(host, next.Peer, (uint)next.Channel, at, (int)next.Length);
            }
            if (next.Close != 0) match_hang_up(host, next.Peer);
        }
    }
}

internal static class MatchTest
{
    private const int Frames = 3600;
    private const string Profile = "latency=150,jitter=40,loss=5";

    private static void Main()
    {
        PeerFixed32 whole = new PeerFixed32();
        Play(true, whole.Turn, whole.Hashes, () => whole.RolledBack);
        whole.End();
        PeerF32 floating = new PeerF32();
        Play(false, floating.Turn, floating.Hashes, () => floating.RolledBack);
        floating.End();
    }

    private static void Play(bool isFixed, Action<IntPtr, ulong> turn, List<ulong> hashes, Func<int> rolledBack)
    {
        IntPtr host = HostLibrary.Create(isFixed, Profile);
        for (ulong now = 0; hashes.Count < Frames || HostLibrary.match_confirmed(host) < Frames; now += 1000)
        {
            if (now > 120 * 1000 * 1000) throw new Exception("in two minutes only " + hashes.Count + " frames");
            HostLibrary.match_turn(host, now);
            turn(host, now);
        }
        HashSet<ulong> different = new HashSet<ulong>();
        for (int i = 0; i < Frames; ++i)
        {
            if (hashes[i] != HostLibrary.match_hash(host, i)) throw new Exception("frame " + i + " has another hash");
            different.Add(hashes[i]);
        }
        HostLibrary.match_destroy(host);
        if (different.Count < Frames / 2 || rolledBack() < 100) throw new Exception("the match did nothing");
        Console.WriteLine("{0} frames equal, {1} rollbacks", Frames, rolledBack());
    }
}
