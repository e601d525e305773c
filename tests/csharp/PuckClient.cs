// A client of a match in C#: see tests/match/host.cpp for what it reads and writes. Its argument is the scalar.
// SPDX-License-Identifier: MIT
using System;
using System.Collections.Generic;
using System.IO;
using Isostep;

/// The rules, over any scalar: Pucks.cs.in.
internal abstract class Pucks
{
    /// The state beside the world.
    internal readonly NativeBlock Touches = new NativeBlock(4);
    internal abstract WorldBase World { get; }
    internal abstract void Step(SessionInputs inputs);

    internal static Pucks Over(string scalar, int players)
    {
        switch (scalar)
        {
            case "f32": return new PucksF32(players);
            case "f64": return new PucksF64(players);
            case "q16": return new PucksFixed16(players);
            case "q32": return new PucksFixed32(players);
            default: throw new ArgumentException("f32, f64, q16 or q32", "scalar");
        }
    }

    /// What a player does who is asked when `current` is the session's frame.
    internal static sbyte WayOf(int current, int player) => (sbyte)(current / (11 + 6 * player) % 3 - 1);
}

internal static class PuckClient
{
    private static readonly BinaryReader Input = new BinaryReader(Console.OpenStandardInput());
    private static readonly BinaryWriter Output =
        new BinaryWriter(new BufferedStream(Console.OpenStandardOutput(), 1 << 16));
    private static readonly byte[] Buffer = new byte[Limits.ReliableCap];

    private static int Main(string[] words)
    {
        SessionConfig config = SessionConfig.Default;
        config.Mode = SessionMode.Rollback;
        config.Name = "pucks";
        config.InputSchema = Input.ReadUInt64();
        config.Players = (int)Input.ReadUInt32();
        Pucks game = Pucks.Over(words[0], config.Players);
        using (game.World)
        using (game.Touches)
        using (Session session = new Session(config, game.World, game.Touches))
        {
            session.Record(RecordingKind.World, null);
            uint rollbacks = 0;
            for (ulong now = Input.ReadUInt64(); now != ulong.MaxValue; now = Input.ReadUInt64())
            {
                TakeArrivals(session, now);
                List<SessionRequest> finals = Turn(session, game, now, ref rollbacks);
                PutMessages(session, now);
                PutFinals(finals);
                Output.Flush();
                LookAtEvents(session);
            }
            byte[] recording = session.Recorded(RecordingKind.World);
            Output.Write(rollbacks);
            Output.Write(recording.Length);
            Output.Write(recording);
            Output.Flush();
        }
        return 0;
    }

    private static void TakeArrivals(Session session, ulong now)
    {
        for (uint left = Input.ReadUInt32(); left > 0; --left)
        {
            byte kind = Input.ReadByte();
            Channel channel = (Channel)Input.ReadByte();
            byte[] bytes = Input.ReadBytes(Input.ReadInt32());
            if (kind == 0) session.Connected(0, now, false);
            if (kind == 1) session.Disconnected(0, now);
            if (kind == 2) session.Receive(0, channel, bytes, bytes.Length, now);
        }
    }

    /// The frames that are final from now on.
    private static List<SessionRequest> Turn(Session session, Pucks game, ulong now, ref uint rollbacks)
    {
        int player = session.LocalPlayer;
        byte[] input = { unchecked((byte)Pucks.WayOf(session.Current, player)) };
        if (player >= 0) session.AddLocalInput(player, input);
        session.Advance(now);
        List<SessionRequest> finals = new List<SessionRequest>();
        SessionRequest request;
        while (session.Next(out request))
        {
            if (request.Kind == RequestKind.Step) game.Step(session.Inputs);
            if (request.Kind == RequestKind.RolledBack) ++rollbacks;
            if (request.Kind == RequestKind.FrameConfirmed) finals.Add(request);
        }
        return finals;
    }

    private static void PutMessages(Session session, ulong now)
    {
        MemoryStream all = new MemoryStream();
        BinaryWriter writer = new BinaryWriter(all);
        uint count = 0;
        Outgoing next;
        while (session.PollSend(now, Buffer, out next))
        {
            if (next.Length == 0) continue;
            writer.Write((byte)next.Channel);
            writer.Write(next.Length);
            writer.Write(Buffer, 0, (int)next.Length);
            ++count;
        }
        Output.Write(count);
        Output.Write(all.ToArray());
    }

    private static void PutFinals(List<SessionRequest> finals)
    {
        Output.Write((uint)finals.Count);
        foreach (SessionRequest final in finals)
        {
            Output.Write((uint)final.Frame);
            Output.Write(final.Hash);
        }
    }

    /// What no sound match has.
    private static void LookAtEvents(Session session)
    {
        for (;;)
        {
            SessionEvent happened = session.PollEvent();
            if (happened.Kind == SessionEventKind.None) return;
            if (happened.Kind == SessionEventKind.Desync || happened.Kind == SessionEventKind.Refused ||
                happened.Kind == SessionEventKind.LostHost)
                throw new Exception(happened.Kind + " " + happened.Key);
        }
    }
}
