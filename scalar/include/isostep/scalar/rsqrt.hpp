// 1/sqrt of a 64-bit integer by seed table and one third-order step: the core of sqrt, rsqrt and every normalisation.
// SPDX-License-Identifier: MIT
#pragma once

#include <bit>
#include <cstdint>

#include "isostep/scalar/wide_int.hpp"

namespace isostep::detail {

ISO_INLINE constexpr std::uint64_t multiply_high(std::uint64_t a, std::uint64_t b) { return multiply(a, b).high; }

ISO_INLINE constexpr UInt128Parts add(UInt128Parts a, UInt128Parts b) {
  const std::uint64_t low = a.low + b.low;
  return {a.high + b.high + (low < a.low ? 1u : 0u), low};
}
ISO_INLINE constexpr UInt128Parts subtract(UInt128Parts a, UInt128Parts b) {
  return {a.high - b.high - (a.low < b.low ? 1u : 0u), a.low - b.low};
}
/// Shifts by n, for 0 <= n < 128.
ISO_INLINE constexpr UInt128Parts shift_left(UInt128Parts a, int n) {
  if (n >= 64) return {a.low << (n - 64), 0};
  return {(a.high << n) | ((a.low >> 1) >> (63 - n)), a.low << n};
}
ISO_INLINE constexpr UInt128Parts shift_right(UInt128Parts a, int n) {
  if (n >= 64) return {0, a.high >> (n - 64)};
  return {a.high >> n, (a.low >> n) | ((a.high << 1) << (63 - n))};
}
/// Counts the leading zeros of a, which is not 0. BSR leaves its target unchanged for zero, so AMD processors wait for
/// the target's old value: up to 10 ns here, whenever the compiler picks a register that the previous call still
/// computes. Source as target ends the wait.
ISO_INLINE constexpr int leading_zeros(std::uint64_t a) {
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__LZCNT__)
  if (!__builtin_is_constant_evaluated()) {
    std::uint64_t index = a;
    __asm__("bsrq %0, %0" : "+r"(index) : : "cc");
    return static_cast<int>(index) ^ 63;
  }
#endif
#if defined(__GNUC__)
  return __builtin_clzll(a);  // std::countl_zero would be a weak symbol at -O0
#else
  return std::countl_zero(a);
#endif
}
ISO_INLINE constexpr int leading_zeros(UInt128Parts a) {
  return a.high != 0 ? leading_zeros(a.high) : 64 + leading_zeros(a.low);
}
/// a / 2^n to nearest, ties up, for n >= 0.
ISO_INLINE constexpr std::uint64_t shift_right_rounded(std::uint64_t a, int n) {
  if (n == 0) return a;
  if (n > 64) return 0;
  const std::uint64_t twice = a >> (n - 1);
  return (twice >> 1) + (twice & 1);
}

/// Tangents of 1/sqrt at the middle of each 64th of [1, 4): 2^32 value at the cell's left end, less 2^10, rounded down;
/// 2^16 slope, rounded up. Both roundings and the 2^10 keep the seed below the curve, by 2^-22.8 to 2^-15.4 of itself.
struct RsqrtSeed {
  std::uint32_t value;
  std::uint32_t slope;
};
inline constexpr RsqrtSeed kRsqrtSeed[192] = {
    {0xfffe80f2u, 0x7e84u}, {0xfe047b8eu, 0x7ba1u}, {0xfc160122u, 0x78dau}, {0xfa32a305u, 0x762du},
    {0xf859f848u, 0x7399u}, {0xf68b9d52u, 0x711du}, {0xf4c73387u, 0x6eb7u}, {0xf30c60fdu, 0x6c66u},
    {0xf15ad029u, 0x6a2au}, {0xefb22fa0u, 0x6801u}, {0xee1231d2u, 0x65ebu}, {0xec7a8cd2u, 0x63e7u},
    {0xeaeafa1cu, 0x61f3u}, {0xe9633665u, 0x600fu}, {0xe7e30167u, 0x5e3bu}, {0xe66a1db8u, 0x5c75u},
    {0xe4f850a2u, 0x5abdu}, {0xe38d61f8u, 0x5913u}, {0xe2291bf5u, 0x5776u}, {0xe0cb4b1au, 0x55e5u},
    {0xdf73be0fu, 0x5460u}, {0xde224587u, 0x52e6u}, {0xdcd6b421u, 0x5177u}, {0xdb90de52u, 0x5012u},
    {0xda509a4bu, 0x4eb8u}, {0xd915bfe4u, 0x4d67u}, {0xd7e02884u, 0x4c20u}, {0xd6afaf12u, 0x4ae1u},
    {0xd5842fdbu, 0x49abu}, {0xd45d8888u, 0x487du}, {0xd33b980au, 0x4758u}, {0xd21e3e8au, 0x4639u},
    {0xd1055d5au, 0x4523u}, {0xcff0d6eau, 0x4413u}, {0xcee08eb7u, 0x430au}, {0xcdd46942u, 0x4208u},
    {0xcccc4c03u, 0x410du}, {0xcbc81d5cu, 0x4017u}, {0xcac7c494u, 0x3f28u}, {0xc9cb29c7u, 0x3e3eu},
    {0xc8d235dfu, 0x3d5au}, {0xc7dcd28du, 0x3c7bu}, {0xc6eaea3fu, 0x3ba1u}, {0xc5fc6816u, 0x3acdu},
    {0xc51137e3u, 0x39fdu}, {0xc429461cu, 0x3932u}, {0xc3447fd7u, 0x386cu}, {0xc262d2c2u, 0x37aau},
    {0xc1842d1fu, 0x36edu}, {0xc0a87dbeu, 0x3633u}, {0xbfcfb3f2u, 0x357eu}, {0xbef9bf96u, 0x34ccu},
    {0xbe2690fdu, 0x341fu}, {0xbd5618f7u, 0x3375u}, {0xbc8848c2u, 0x32ceu}, {0xbbbd1210u, 0x322cu},
    {0xbaf466fdu, 0x318cu}, {0xba2e3a0au, 0x30f0u}, {0xb96a7e1eu, 0x3057u}, {0xb8a9267du, 0x2fc1u},
    {0xb7ea26c9u, 0x2f2eu}, {0xb72d72feu, 0x2e9eu}, {0xb672ff69u, 0x2e10u}, {0xb5bac0afu, 0x2d86u},
    {0xb504abc2u, 0x2cfeu}, {0xb450b5e1u, 0x2c79u}, {0xb39ed495u, 0x2bf6u}, {0xb2eefdafu, 0x2b76u},
    {0xb2412747u, 0x2af9u}, {0xb19547b5u, 0x2a7du}, {0xb0eb5593u, 0x2a04u}, {0xb04347bau, 0x298du},
    {0xaf9d153fu, 0x2919u}, {0xaef8b571u, 0x28a6u}, {0xae561fd7u, 0x2836u}, {0xadb54c32u, 0x27c7u},
    {0xad163273u, 0x275bu}, {0xac78cac2u, 0x26f0u}, {0xabdd0d77u, 0x2687u}, {0xab42f31bu, 0x2620u},
    {0xaaaa7463u, 0x25bbu}, {0xaa138a35u, 0x2558u}, {0xa97e2da0u, 0x24f6u}, {0xa8ea57deu, 0x2496u},
    {0xa8580253u, 0x2438u}, {0xa7c72688u, 0x23dbu}, {0xa737be31u, 0x237fu}, {0xa6a9c323u, 0x2326u},
    {0xa61d2f5au, 0x22cdu}, {0xa591fcf6u, 0x2276u}, {0xa5082637u, 0x2221u}, {0xa47fa57fu, 0x21cdu},
    {0xa3f87551u, 0x217au}, {0xa372904fu, 0x2128u}, {0xa2edf13au, 0x20d8u}, {0xa26a92efu, 0x2089u},
    {0xa1e8706au, 0x203cu}, {0xa16784c0u, 0x1fefu}, {0xa0e7cb25u, 0x1fa4u}, {0xa0693ee5u, 0x1f59u},
    {0x9febdb66u, 0x1f10u}, {0x9f6f9c27u, 0x1ec8u}, {0x9ef47cc0u, 0x1e82u}, {0x9e7a78dfu, 0x1e3cu},
    {0x9e018c4du, 0x1df7u}, {0x9d89b2e4u, 0x1db3u}, {0x9d12e898u, 0x1d70u}, {0x9c9d2971u, 0x1d2fu},
    {0x9c28718au, 0x1ceeu}, {0x9bb4bd16u, 0x1caeu}, {0x9b420858u, 0x1c6fu}, {0x9ad04fa7u, 0x1c31u},
    {0x9a5f8f6fu, 0x1bf3u}, {0x99efc42au, 0x1bb7u}, {0x9980ea68u, 0x1b7bu}, {0x9912fec7u, 0x1b41u},
    {0x98a5fdf9u, 0x1b07u}, {0x9839e4bcu, 0x1aceu}, {0x97ceafe3u, 0x1a95u}, {0x97645c4cu, 0x1a5eu},
    {0x96fae6e8u, 0x1a27u}, {0x96924cb5u, 0x19f1u}, {0x962a8abfu, 0x19bcu}, {0x95c39e22u, 0x1987u},
    {0x955d8406u, 0x1953u}, {0x94f839a2u, 0x1920u}, {0x9493bc39u, 0x18edu}, {0x9430091bu, 0x18bbu},
    {0x93cd1da5u, 0x188au}, {0x936af740u, 0x185au}, {0x93099362u, 0x182au}, {0x92a8ef8au, 0x17fau},
    {0x92490946u, 0x17cbu}, {0x91e9de2cu, 0x179du}, {0x918b6bdfu, 0x1770u}, {0x912db00bu, 0x1742u},
    {0x90d0a869u, 0x1716u}, {0x907452b9u, 0x16eau}, {0x9018acc7u, 0x16bfu}, {0x8fbdb469u, 0x1694u},
    {0x8f63677du, 0x1669u}, {0x8f09c3ebu, 0x1640u}, {0x8eb0c7a4u, 0x1616u}, {0x8e5870a4u, 0x15edu},
    {0x8e00bcebu, 0x15c5u}, {0x8da9aa87u, 0x159du}, {0x8d53378bu, 0x1576u}, {0x8cfd6212u, 0x154fu},
    {0x8ca82840u, 0x1529u}, {0x8c538842u, 0x1503u}, {0x8bff804au, 0x14ddu}, {0x8bac0e95u, 0x14b8u},
    {0x8b593163u, 0x1493u}, {0x8b06e6feu, 0x146fu}, {0x8ab52db8u, 0x144bu}, {0x8a6403e7u, 0x1428u},
    {0x8a1367eau, 0x1404u}, {0x89c35825u, 0x13e2u}, {0x8973d303u, 0x13c0u}, {0x8924d6f7u, 0x139eu},
    {0x88d66279u, 0x137cu}, {0x88887406u, 0x135bu}, {0x883b0a22u, 0x133au}, {0x87ee2357u, 0x131au},
    {0x87a1be35u, 0x12fau}, {0x8755d951u, 0x12dau}, {0x870a7346u, 0x12bbu}, {0x86bf8ab4u, 0x129cu},
    {0x86751e40u, 0x127du}, {0x862b2c95u, 0x125fu}, {0x85e1b464u, 0x1241u}, {0x8598b460u, 0x1223u},
    {0x85502b44u, 0x1205u}, {0x850817ceu, 0x11e8u}, {0x84c078c1u, 0x11cbu}, {0x84794ce6u, 0x11afu},
    {0x84329309u, 0x1193u}, {0x83ec49fau, 0x1177u}, {0x83a67090u, 0x115bu}, {0x836105a4u, 0x1140u},
    {0x831c0814u, 0x1125u}, {0x82d776c1u, 0x110au}, {0x82935092u, 0x10f0u}, {0x824f9472u, 0x10d5u},
    {0x820c414du, 0x10bbu}, {0x81c95617u, 0x10a2u}, {0x8186d1c4u, 0x1088u}, {0x8144b34eu, 0x106fu},
    {0x8102f9b2u, 0x1056u}, {0x80c1a3f1u, 0x103du}, {0x8080b10fu, 0x1025u}, {0x80402014u, 0x100du}};

/// 2^64 / sqrt(m / 2^62) for m in [2^62, 2^64): the argument is m as Q2.62, the result in [1/2, 1) as Q0.64; 1 itself
/// is given as 1 - 2^-64.
/// Symbols: y0 = seed, e = 1 - m y0^2 exactly known to 2^-78, 0 < e < 2^-14.41.
///          1/sqrt(m) = y0 (1 - e)^(-1/2) = y0 (1 + e/2 + e^2 (c2 + c3 e)).
/// Error:   c2, c3 minimax on that interval, 2^-65.2; with the last rounding the result is within 1 unit of 2^-64.
///          Measured in tests/unit/scalar/math_test.cpp.
ISO_INLINE constexpr std::uint64_t rsqrt_q64(std::uint64_t m) {
  constexpr std::uint64_t c2 = 0x5ffffffe95dec083u;  // 0.37499999966964480, Q0.64
  constexpr std::uint64_t c3 = 0x5001468a502b3882u;  // 0.31251946331773873, Q0.64
  const RsqrtSeed seed = kRsqrtSeed[(m >> 56) - 64];
  const std::uint64_t y0 = seed.value - ((seed.slope * static_cast<std::uint32_t>((m >> 40) & 0xffffu)) >> 6);  // Q0.32
  const UInt128Parts square = multiply(m, y0 * y0);                                         // Q2.126
  const std::uint64_t e = 0 - ((square.high << 16) | (square.low >> 48));                   // units of 2^-78
  const std::uint64_t factor = c2 + (multiply_high(c3, e) >> 14);                           // Q0.64
  const std::uint64_t correction = e + (multiply_high(multiply_high(e, e), factor) >> 13);  // units of 2^-79
  const std::uint64_t y = (y0 << 32) + ((multiply_high(correction, y0 << 32) + (1u << 14)) >> 15);
  return y - ((y >> 63) ^ 1u);  // 2^64 itself has wrapped to zero
}

/// The integer s nearest to sqrt(n), from a guess: as exact as if every s had been tried, however bad the guess.
/// Wide: a signed integer that holds n - guess^2 and 2 guess.
template <class Wide> ISO_INLINE constexpr std::uint64_t nearest_root(Wide n_less_guess_squared, std::uint64_t guess) {
  Wide d = n_less_guess_squared;
  std::uint64_t s = guess;
  const auto wide = [](std::uint64_t value) ISO_INLINE_LAMBDA {
    if constexpr (sizeof(Wide) == 8) return static_cast<std::int64_t>(value);
    if constexpr (sizeof(Wide) == 16) return int128_from({0, value});
  };
  while (d > wide(s)) {  // (s + 1/2)^2 < n
    d = d - wide(s) - wide(s + 1);
    ++s;
  }
  while (d + wide(s) <= Wide(0)) {  // n < (s - 1/2)^2
    d = d + wide(s) + wide(s - 1);
    --s;
  }
  return s;
}

}  // namespace isostep::detail
