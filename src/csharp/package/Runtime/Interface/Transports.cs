// Transports of the library: a network in virtual time, and UDP.
// SPDX-License-Identifier: MIT
using System;

namespace Isostep
{
    /// <summary>A network in virtual time, for tests and testbeds: endpoint 0 is the host, clients follow.</summary>
    public sealed unsafe partial class SimulatedNetwork : Handle
    {
        public SimulatedNetwork(ulong seed)
        {
            IntPtr made;
            IsostepException.Check(Native.iso_network_create(seed, &made));
            Pointer = made;
        }

        protected override void Destroy(IntPtr handle) => IsostepException.Check(Native.iso_network_destroy(handle));
    }

    /// <summary>UDP, by ENet, in a library of its own: libisostep_udp. Not secret; UdpSettings.Key keeps out who lacks
    /// it.</summary>
    public sealed unsafe partial class UdpTransport : Handle
    {
        private UdpTransport(IntPtr made) { Pointer = made; }

        /// <summary>Accepts connections; port 0 lets the system choose, see Port.</summary>
        public static UdpTransport Listen(ushort port) => Listen(port, UdpSettings.Default);

        public static UdpTransport Listen(ushort port, UdpSettings settings)
        {
            IntPtr made;
            byte[] problem = new byte[256];
            fixed (byte* at = problem)
                Check(Native.iso_udp_listen(port, &settings, &made, at, NativeText.Length(problem)), problem);
            return new UdpTransport(made);
        }

        /// <summary>Connects to one host. A name is looked up at once, which may block.</summary>
        public static UdpTransport Connect(string address, ushort port) => Connect(address, port, UdpSettings.Default);

        public static UdpTransport Connect(string address, ushort port, UdpSettings settings)
        {
            IntPtr made;
            byte[] problem = new byte[256];
            fixed (byte* at = problem)
            fixed (byte* addressAt = NativeText.Bytes(address))
                Check(Native.iso_udp_connect(addressAt, port, &settings, &made, at, NativeText.Length(problem)),
                    problem);
            return new UdpTransport(made);
        }

        private static void Check(Status status, byte[] problem)
        {
            if (status == Status.Ok) return;
            string words;
            fixed (byte* at = problem) words = NativeText.Read(at, problem.Length);
            throw IsostepException.Of(status, words.Length == 0 ? null : words);
        }

        protected override void Destroy(IntPtr handle) => IsostepException.Check(Native.iso_udp_destroy(handle));
    }
}
