// Matches through the C# classes: one that stands goes on when the game says so; keys of UDP keep others out.
// SPDX-License-Identifier: MIT
using System;
using Isostep;

/// A machine of a match whose game is a sum of its inputs.
internal sealed class Summer : IDisposable
{
    internal readonly Session Session;
    internal int Finals;
    internal bool IsSilent;
    private readonly NativeBlock sum = new NativeBlock(8);

    internal Summer(SessionConfig config)
    {
        config.Name = "sum";
        config.InputText = "what";
        Session = new Session(config, null, sum);
    }

    internal void Turn(ulong now)
    {
        if (Session.LocalPlayer >= 0)
            Session.AddLocalInput(Session.LocalPlayer, new byte[] { (byte)(Session.Current / 7 % 3) });
        Session.Advance(now);
        SessionRequest request;
        while (Session.Next(out request))
        {
            if (request.Kind == RequestKind.FrameConfirmed) ++Finals;
            if (request.Kind != RequestKind.Step) continue;
            long next = 3 * sum.GetInt64(0) + 1;
            for (int player = 0; player < Session.Inputs.Players; ++player) next += Session.Inputs.Byte(player, 0);
            sum.SetInt64(0, next);
        }
    }

    public void Dispose()
    {
        Session.Dispose();
        sum.Dispose();
    }
}

internal static class SessionsTest
{
    private const ulong Second = 1000000;

    private static void Main(string[] arguments)
    {
        BytesAreWholeOrRefused();
        foreach (SessionMode mode in new[] { SessionMode.Lockstep, SessionMode.Rollback })
        {
            GoesOnWithThoseWhoAreHere(mode, 2, 1);
            GoesOnWithThoseWhoAreHere(mode, 3, 0);
        }
        Console.WriteLine("a match that stands goes on with those who are here");
        if (arguments[0] != "udp") return;
        KeysKeepOthersOut(Key(7), Key(9), null);
        KeysKeepOthersOut(null, Key(9), Key(8));
        Console.WriteLine("a key keeps others out");
    }

    private static void Require(bool holds, string what)
    {
        if (!holds) throw new Exception(what);
    }

    private static void RequireThrows<E>(Action work, string what) where E : Exception
    {
        try
        {
            work();
        }
        catch (E)
        {
            return;
        }
        throw new Exception(what);
    }

    private static byte[] Key(byte last)
    {
        byte[] key = new byte[16];
        key[15] = last;
        return key;
    }

    private static void BytesAreWholeOrRefused()
    {
        UdpSettings settings = new UdpSettings();
        Require(settings.Key.Length == 16, "a key has 16 bytes");
        settings.Key = Key(5);
        Require(settings.Key[15] == 5 && settings.Key[0] == 0, "the key is another");
        foreach (int size in new[] { 0, 15, 17 })
            RequireThrows<ArgumentException>(() => settings.Key = new byte[size], size + " bytes are no key");
        RequireThrows<ArgumentException>(() => settings.Key = null, "null is no key");
        Require(settings.Key[15] == 5, "what is refused changes nothing");

        SessionConfig config = SessionConfig.Default;
        config.Credential = new byte[] { 1, 2, 3 };
        Require(config.CredentialSize == 3 && config.Credential.Length == 3, "a credential of three bytes");
        config.Credential = new byte[] { 4 };
        Require(config.CredentialSize == 1 && config.Credential[0] == 4, "a credential of one byte");
        config.CredentialSize = 3;
        Require(config.Credential[1] == 0 && config.Credential[2] == 0, "what was behind it is gone");
        config.Credential = null;
        Require(config.CredentialSize == 0 && config.Credential.Length == 0, "no credential");
        RequireThrows<ArgumentException>(() => config.Neutral = new byte[Limits.InputCap + 1], "an input is too long");
        config.Neutral = new byte[Limits.InputCap];
        Require(config.NeutralSize == Limits.InputCap, "the longest input");
    }

    /// All but `left` vanish; the match stands, and goes on when its game says so.
    private static void GoesOnWithThoseWhoAreHere(SessionMode mode, int machines, int left)
    {
        string where = mode + " of " + machines + ": ";
        Summer[] all = new Summer[machines];
        using (SimulatedNetwork network = new SimulatedNetwork(5))
        {
            for (int n = 0; n < machines; ++n)
            {
                SessionConfig config = SessionConfig.Default;
                config.Mode = mode;
                config.Host = (byte)(n == 0 ? 1 : 0);
                config.Players = machines;
                config.Seed = (ulong)(3 + n);
                config.Migration = Second;
                config.Address = n.ToString();
                all[n] = new Summer(config);
                if (n > 0) network.Connect(network.AddClient("latency=20"), 0);
            }
            Summer here = all[left];
            ulong now = 0;
            Pass(network, all, ref now, 6 * Second);
            Require(here.Finals > 200, where + here.Finals + " frames");
            RequireRefused(here.Session, now, where + "all are here");
            for (int n = 0; n < machines; ++n)
            {
                if (n == left) continue;
                all[n].IsSilent = true;
                network.SetSilent((uint)n, true);
            }
            Pass(network, all, ref now, 4 * Second);
            int stood = here.Finals;
            Pass(network, all, ref now, 20 * Second);
            Require(here.Finals == stood, where + "the others may play elsewhere");
            here.Session.GoOn(now);
            Pass(network, all, ref now, 5 * Second);
            Require(here.Finals > stood + 200, where + "it does not go on");
            RequireRefused(here.Session, now, where + "it goes on");
        }
        foreach (Summer one in all) one.Dispose();
    }

    private static void RequireRefused(Session session, ulong now, string what)
    {
        try
        {
            session.GoOn(now);
        }
        catch (IsostepException error)
        {
            Require(error.Status == Status.Refused, what + ": " + error.Message);
            return;
        }
        throw new Exception(what);
    }

    private static void Pass(SimulatedNetwork network, Summer[] all, ref ulong now, ulong time)
    {
        for (ulong end = now + time; now < end; now += 2000)
        {
            network.AdvanceTo(now);
            for (uint n = 0; n < all.Length; ++n)
            {
                if (all[n].IsSilent) continue;
                network.Deliver(n, all[n].Session, now);
                all[n].Turn(now);
                network.Dispatch(n, all[n].Session, now);
            }
        }
    }

    /// Sessions' time is virtual: a turn is a millisecond of theirs, however long it takes.
    private static void KeysKeepOthersOut(byte[] key, params byte[][] others)
    {
        UdpTransport[] ports = new UdpTransport[2 + others.Length];
        Summer[] all = new Summer[ports.Length];
        for (int n = 0; n < ports.Length; ++n)
        {
            UdpSettings settings = UdpSettings.Default;
            settings.BindAddress = n == 0 ? "127.0.0.1" : "";
            byte[] its = n < 2 ? key : others[n - 2];
            if (its != null) settings.Key = its;
            ports[n] = n == 0 ? UdpTransport.Listen(0, settings)
                              : UdpTransport.Connect("127.0.0.1", ports[0].Port, settings);
            SessionConfig config = SessionConfig.Default;
            config.Mode = SessionMode.Rollback;
            config.Host = (byte)(n == 0 ? 1 : 0);
            config.Seed = n == 0 ? 3u : 0u;
            all[n] = new Summer(config);
        }
        bool haveAsked = false;
        for (ulong now = 0; all[1].Finals < 60 || !haveAsked; now += 1000)
        {
            Require(now < 600 * Second, "equal keys do not hear each other");
            haveAsked = true;
            for (int n = 0; n < ports.Length; ++n)
            {
                ports[n].Deliver(all[n].Session, now);
                all[n].Turn(now);
                ports[n].Dispatch(all[n].Session, now);
                haveAsked = haveAsked && ports[n].GetStatistics().PacketsSent >= 3;
            }
            ports[1].Wait(1000);
        }
        for (int n = 2; n < ports.Length; ++n)
        {
            Require(all[n].Session.Phase == SessionPhase.Waiting && all[n].Finals == 0, "another key has a seat");
            Require(ports[n].GetStatistics().PacketsReceived == 0, "another key is answered");
        }
        Require(all[0].Session.GetStats().Peers == 1, "another key is a peer");
        for (int n = 0; n < ports.Length; ++n)
        {
            all[n].Dispose();
            ports[n].Dispose();
        }
    }
}
