// Sessions: which frames a game steps, with whose inputs, and when. Requests are pulled; nothing calls back.
// SPDX-License-Identifier: MIT
using System;

namespace Isostep
{
    /// <summary>A turn of the game's loop:
    /// what the transport has goes in; AddLocalInput(...); Advance(now); then while (session.Next(out request)) step
    /// the game where request.Kind is Step, with session.Inputs; what PollSend gives goes out. A turn that an exception
    /// of the game leaves in its middle ends where the next begins: SessionEventKind.Misuse tells, what was missed is stepped
    /// again from the newest final state, and the match goes on.</summary>
    public sealed unsafe partial class Session : Handle
    {
        // The library names it while the session lives.
        private readonly WorldBase world;
        private readonly NativeBlock block;

        /// <summary>The game is a world, a block of bytes, or both: saved, rolled back and hashed as one. They outlive
        /// the session. `file`: the recording of SessionMode.Replay, or what SaveMatch() gave a host that goes
        /// on.</summary>
        public Session(SessionConfig config, WorldBase world, NativeBlock block = null, byte[] file = null)
        {
            this.world = world;
            this.block = block;
            SessionGame game = SessionGame.Default;
            game.World = world == null ? IntPtr.Zero : world.Pointer;
            if (block != null)
            {
                game.Block = (IntPtr)block.Pointer;
                game.BlockSize = (IntPtr)block.Size;
            }
            IntPtr made;
            fixed (byte* at = file)
                IsostepException.Check(Native.iso_session_create(&config, &game, at, NativeText.Length(file), &made));
            Pointer = made;
            if (block != null) block.Hold();
        }

        public WorldBase World => world;
        public NativeBlock Block => block;

        /// <summary>The next request of the turn; false: the turn is done. A step that is asked for comes before the
        /// next call.</summary>
        public bool Next(out SessionRequest request)
        {
            SessionRequest next = SessionRequest.Sized();
            Check(Native.iso_session_next(Pointer, &next));
            request = next;
            return next.Kind != RequestKind.Nothing;
        }

        /// <summary>The inputs by player of the step that was asked for, until the next call.</summary>
        public SessionInputs Inputs
        {
            get
            {
                uint players;
                SessionInput* first = Native.iso_session_inputs(Pointer, &players);
                return new SessionInputs(this, first, first == null ? 0 : (int)players);
            }
        }

        /// <summary>Gives the next frame's input; until that is stepped a later one replaces it. False: not ours, not
        /// in the match now, or no input.</summary>
        public bool AddLocalInput(int player, byte[] input)
        {
            fixed (byte* at = input) return AddLocalInput(player, at, input.Length);
        }

        public bool AddLocalInput(int player, byte* input, int size)
        {
            Status status = Native.iso_session_add_local_input(Pointer, player, input, (UIntPtr)size);
            if (status == Status.Refused) return false;
            Check(status);
            return true;
        }

        /// <summary>Puts the next message for the transport into `buffer`, which has Limits.ReliableCap bytes; false:
        /// none. Length 0: nothing but to close the connection.</summary>
        public bool PollSend(ulong now, byte[] buffer, out Outgoing outgoing)
        {
            Outgoing next = Outgoing.Sized();
            byte* bytes;
            Check(Native.iso_session_poll_send(Pointer, now, &next, &bytes));
            outgoing = next;
            if (bytes == null) return false;
            if (next.Length > buffer.Length) throw new ArgumentException("room for Limits.ReliableCap bytes", "buffer");
            for (uint i = 0; i < next.Length; ++i) buffer[i] = bytes[i];
            return true;
        }

        /// <summary>Takes bytes from the transport. Malformed ones are counted, and otherwise without effect.</summary>
        public void Receive(uint peer, Channel channel, byte[] bytes, int size, ulong now)
        {
            if (size < 0 || size > bytes.Length) throw new ArgumentOutOfRangeException("size");
            fixed (byte* at = bytes) Check(Native.iso_session_receive(Pointer, peer, channel, at, (UIntPtr)size, now));
        }

        /// <summary>The machine that the transport is to connect to, as SessionConfig.Address of its session says;
        /// null: none.</summary>
        public string PollConnect()
        {
            byte* address;
            Check(Native.iso_session_poll_connect(Pointer, &address));
            return NativeText.Read(address);
        }

        protected override void Destroy(IntPtr handle)
        {
            IsostepException.Check(Native.iso_session_destroy(handle));
            if (block != null) block.LetGo();
        }
    }

    /// <summary>The players' inputs for one frame.</summary>
    public unsafe struct SessionInputs
    {
        private readonly Session owner;
        private readonly SessionInput* first;
        public readonly int Players;

        internal SessionInputs(Session owner, SessionInput* first, int players)
        {
            this.owner = owner;
            this.first = first;
            Players = players;
        }

        /// <summary>The byte `index` of a player's input; 0 behind its end.</summary>
        public byte Byte(int player, int index)
        {
            if ((uint)player >= (uint)Players) throw new ArgumentOutOfRangeException("player");
            if ((uint)index >= Limits.InputCap) throw new ArgumentOutOfRangeException("index");
            return Pointer[player].Bytes[index];
        }

        /// <summary>The player is gone, and its bytes are SessionConfig.Neutral: all that a game may look at beside
        /// them. </summary>
        public bool IsDisconnected(int player)
        {
            if ((uint)player >= (uint)Players) throw new ArgumentOutOfRangeException("player");
            return Pointer[player].Status == (byte)InputStatus.Disconnected;
        }

        /// <summary>The first of Players, for unsafe code.</summary>
        public SessionInput* Pointer
        {
            get
            {
                IsostepException.RequireAlive(owner);
                return first;
            }
        }
    }

    public unsafe partial struct SessionConfig
    {
        /// <summary>Mode, window, delays and deadline for a genre and so many players.</summary>
        public static SessionConfig Preset(Genre genre, int players)
        {
            SessionConfig config = Default;
            IsostepException.Check(Native.iso_session_config_preset(&config, genre, players));
            return config;
        }

        /// <summary>The first rule that it breaks, or null.</summary>
        public string Problem
        {
            get { fixed (SessionConfig* at = &this) return NativeText.Read(Native.iso_session_config_problem(at)); }
        }
    }
}
