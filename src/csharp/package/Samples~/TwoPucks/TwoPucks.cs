// One machine of a game for two: pucks that push each other, with rollback.
// SPDX-License-Identifier: MIT
using System;
using Isostep.Fixed32;

namespace Isostep.Samples
{
    /// <summary>The game's state is a world and four bytes of score; a player's input is one byte: -1, 0 or
    /// 1.</summary>
    public sealed class TwoPucks : IDisposable
    {
        public readonly World World = new World();
        public readonly Session Session;
        public readonly BodyId[] Pucks = new BodyId[2];  // given once and for all: no state

        /// <summary>Of the final frames.</summary>
        public ulong LastHash;
        public int Confirmed;

        private readonly NativeBlock score = new NativeBlock(4);
        private readonly byte[] input = new byte[1];

        /// <summary>`seed`: of a host 64 random bits that no other match has; 0: a client.</summary>
        public TwoPucks(ulong seed)
        {
            ShapeId floor = World.AddBox(Box.Of(20, 1, 20));
            World.CreateBody(BodyDefinition.Of(BodyType.Static, floor, new Vec3(0, -1, 0)));
            ShapeId ball = World.AddSphere(Sphere.Of(Q32.Half));
            for (int n = 0; n < 2; ++n)
            {
                BodyDefinition puck = BodyDefinition.Of(BodyType.Dynamic, ball, new Vec3(4 * n - 2, 1, 0));
                puck.ReportContacts = true;
                Pucks[n] = World.CreateBody(puck);
            }

            SessionConfig config = SessionConfig.Default;
            config.Mode = SessionMode.Rollback;  // Lockstep: nothing else changes
            config.Name = "two pucks";
            config.InputText = "way: int8";
            config.Host = (byte)(seed != 0 ? 1 : 0);
            config.Seed = seed;
            Session = new Session(config, World, score);
        }

        /// <summary>Touches so far; a guess, as all that is not final.</summary>
        public int Touches => score.GetInt32(0);

        /// <summary>A turn between what the transport delivers and what it dispatches.</summary>
        public void Turn(int player, int way, ulong now)
        {
            input[0] = unchecked((byte)(sbyte)way);
            Session.AddLocalInput(player, input);  // false until the match begins
            Session.Advance(now);
            SessionRequest request;
            while (Session.Next(out request))  // saves and loads by itself
            {
                if (request.Kind == RequestKind.Step) Step(Session.Inputs);
                if (request.Kind != RequestKind.FrameConfirmed) continue;
                LastHash = request.Hash;
                Confirmed = request.Frame + 1;
            }
        }

        private void Step(SessionInputs inputs)
        {
            Q32 strength = Q32.Ratio(1, 8);
            for (int n = 0; n < 2; ++n)
            {
                int way = unchecked((sbyte)inputs.Byte(n, 0));
                World.ApplyImpulse(Pucks[n], new Vec3(strength * way, 0, 0));
            }
            World.Step();
            score.SetInt32(0, score.GetInt32(0) + World.ContactBegins.Count);
        }

        public void Dispose()
        {
            Session.Dispose();
            World.Dispose();
            score.Dispose();
        }
    }
}
