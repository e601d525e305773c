// The native library: where it is, and what it says of itself.
// SPDX-License-Identifier: MIT
namespace Isostep
{
    /// <summary>The library that all calls go to. Statically linked where the platform has no other way: iOS, Web,
    /// consoles, or everywhere by the define ISOSTEP_STATIC.</summary>
    public static unsafe class Library
    {
#if ISOSTEP_STATIC || ((UNITY_IOS || UNITY_TVOS || UNITY_WEBGL || UNITY_SWITCH) && !UNITY_EDITOR)
        public const string Name = "__Internal";
        public const string UdpName = "__Internal";
#else
        public const string Name = "isostep";
        public const string UdpName = "isostep_udp";
#endif

        /// <summary>The release, "0.1.0".</summary>
        public static string Version => NativeText.Read(Native.iso_version());

        /// <summary>The number in the shared library's name: another one is another interface.</summary>
        public static uint AbiVersion => Native.iso_abi_version();

        /// <summary>The version of the results: two builds with one promise each other's hashes. Lobbies
        /// compare it.</summary>
        public static ulong BehaviourVersion => Native.iso_behaviour_version();

        public static bool Has(Scalar scalar) => Native.iso_has_scalar(scalar) != 0;

        /// <summary>Replays the built-in recordings with every scalar and set of lanes, in half a second. A game
        /// asks at start for Sound.</summary>
        public static SelfcheckResult Selfcheck()
        {
            SelfcheckResult result = SelfcheckResult.Sized();
            IsostepException.Check(Native.iso_selfcheck(&result));
            return result;
        }
    }
}
