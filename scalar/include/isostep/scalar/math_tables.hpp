// Constants of the elementary functions as integers. Each can be recomputed from its comment; the tests do.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

namespace isostep::detail {

inline constexpr std::uint64_t kPiQ62 = 0xc90fdaa22168c235u;      // round(2^62 pi)
inline constexpr std::uint64_t kHalfPiQ62 = 0x6487ed5110b4611au;  // round(2^61 pi)

/// The binary digits of 2/pi after the point, 64 a word, rounded down; two zero words stand before them so that a
/// window may begin up to 128 digits early. The last digit that a double's largest exponent asks for is number 1161.
inline constexpr std::uint64_t kTwoOverPi[21] = {0,
                                                 0,
                                                 0xa2f9836e4e441529u,
                                                 0xfc2757d1f534ddc0u,
                                                 0xdb6295993c439041u,
                                                 0xfe5163abdebbc561u,
                                                 0xb7246e3a424dd2e0u,
                                                 0x06492eea09d1921cu,
                                                 0xfe1deb1cb129a73eu,
                                                 0xe88235f52ebb4484u,
                                                 0xe99c7026b45f7e41u,
                                                 0x3991d639835339f4u,
                                                 0x9c845f8bbdf9283bu,
                                                 0x1ff897ffde05980fu,
                                                 0xef2f118b5a0a6d1fu,
                                                 0x6d367ecf27cb09b7u,
                                                 0x4f463f669e5fea2du,
                                                 0x7527bac7ebe5f17bu,
                                                 0x3d0739f78a5292eau,
                                                 0x6bfb5fb11f8d5d08u,
                                                 0x56033046fc7b6babu};

/// Row 0: sin(pi/2 sqrt(t)) / sqrt(t), row 1: cos(pi/2 sqrt(t)), for 0 <= t <= 1/4, as c0 - c1 t + c2 t^2 ... - c7 t^7.
/// Minimax of degree 7 by the exchange algorithm with 260 bits, then 2^63 c rounded; error 2^-68.2 and 2^-64.8.
inline constexpr std::uint64_t kQuarterWave[2][8] = {
    {0xc90fdaa22168c235u, 0x52aef39896f94aedu, 0x0a335e33bad56c91u, 0x0099696673156120u, 0x000541e0d2173001u,
     0x00001e3074b502deu, 0x0000007a3bb4566cu, 0x000000016c5b9398u},
    {0x8000000000000000u, 0x9de9e64df22ef243u, 0x20783e1036b5586du, 0x02aba78fc7921fa5u, 0x001e1f50683565a9u,
     0x0000d368f63cafd8u, 0x000003f39882a970u, 0x0000000d9326647bu}};

/// round(2^(69 - k) atan(i / 64)), i = 0 .. 64, where 2^k is the leading bit of i: all with 62 digits or more.
inline constexpr std::uint64_t kAtan64ths[65] = {
    0x0000000000000000u, 0x7ffd556eedca6adeu, 0x7ff556eea5d892a1u, 0xbfdc0c2186d14fcfu, 0x7fd56edcb3f7a71bu,
    0x9facf873e2aceb59u, 0xbf70c13017887461u, 0xdf1cf5f3783e1befu, 0x7f56ea6ab0bdb719u, 0x8f0fd7d821b93726u,
    0x9eb77746331362c3u, 0xae4c08f1f6134efbu, 0xbdcbda5e72d81134u, 0xcd35474b643130e8u, 0xdc86ba9493051023u,
    0xebbeaef902b9b38du, 0x7d6dd7e4b203758bu, 0x84ee2cbec31b12c6u, 0x8c5fad185f8bc131u, 0x93c1b902bf7a2df1u,
    0x9b13b9b83f5e5e6au, 0xa25521b615784d45u, 0xa9856cca8e6a4edbu, 0xb0a420184e7f0cb2u, 0xb7b0ca0f26f78474u,
    0xbeab025b1d9fbad4u, 0xc59269ca50d92b6eu, 0xcc66aa2a6b58c33du, 0xd327761e611fe5b6u, 0xd9d488ed32e3635cu,
    0xe06da64a764f7c68u, 0xe6f29a19609a84bau, 0x76b19c1586ed3da3u, 0x79dfadfc5d68d10eu, 0x7d03742d50505f2eu,
    0x801ce39e0d205c9au, 0x832bf4a6d9867e2au, 0x8630a2dada1ed066u, 0x892aecdfde9547b5u, 0x8c1ad445f3e09b8cu,
    0x8f005d5ef7f59f9bu, 0x91db8f1664f350e2u, 0x94ac72c9847186f6u, 0x97731420365e538cu, 0x9a2f80e671bdda20u,
    0x9ce1c8e6a0b8cdbau, 0x9f89fdc4f4b7a1edu, 0xa22832dbcadaae09u, 0xa4bc7d1934f70924u, 0xa746f2ddb7602294u,
    0xa9c7abdc4830f5c9u, 0xac3ec0fb997dd6a2u, 0xaeac4c38b4d8c080u, 0xb110688aebdc6f6au, 0xb36b31c91f043691u,
    0xb5bcc49059ecc4b0u, 0xb8053e2bc2319e74u, 0xba44bc7dd470782fu, 0xbc7b5deae98af281u, 0xbea94144fd049aacu,
    0xc0ce85b8ac526641u, 0xc2eb4abb661628b6u, 0xc4ffaffabf8fbd55u, 0xc70bd54ce602ee14u, 0x6487ed5110b4611au};

}  // namespace isostep::detail
