// Two machines and the bad line between them, in one process and in virtual time. Not for Unity.
// SPDX-License-Identifier: MIT
#if !UNITY_5_3_OR_NEWER
using System;

namespace Isostep.Samples
{
    internal static class Program
    {
        private static int Main()
        {
            const int frames = 600;
            int equal = 0;
            ulong[] hashes = new ulong[frames + 1];
            using (SimulatedNetwork network = new SimulatedNetwork(1))
            using (TwoPucks host = new TwoPucks(20))
            using (TwoPucks client = new TwoPucks(0))
            {
                uint line = network.AddClient("latency=80,jitter=20,loss=5");
                network.Connect(line, 0);
                for (ulong now = 0; host.Confirmed < frames || client.Confirmed < frames; now += 1000)
                {
                    if (now > 30 * 1000 * 1000) return 1;
                    network.AdvanceTo(now);
                    Turn(network, 0, host, 0, now);
                    Turn(network, line, client, 1, now);
                    if (host.Confirmed <= frames) hashes[host.Confirmed] = host.LastHash;
                    if (client.Confirmed <= frames && hashes[client.Confirmed] == client.LastHash) ++equal;
                }
                SessionStats stats = client.Session.GetStats();
                Console.WriteLine("{0} touches; {1} frames were stepped again", host.Touches, stats.Steps - frames);
                return equal > frames && stats.Steps > frames + 20 && host.Touches > 2 ? 0 : 1;
            }
        }

        private static void Turn(SimulatedNetwork network, uint endpoint, TwoPucks game, int player, ulong now)
        {
            network.Deliver(endpoint, game.Session, now);
            game.Turn(player, game.Session.Current / (11 + 6 * player) % 3 - 1, now);
            network.Dispatch(endpoint, game.Session, now);
        }
    }
}
#endif
