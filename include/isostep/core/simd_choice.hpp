// Lanes by name, and the widest that a world has.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

#include "isostep/core/simd.hpp"

namespace isostep {

ISO_INLINE std::optional<Simd> simd_named(std::string_view name) {
  for (std::uint32_t i = 0; i < kSimds; ++i) {
    if (name == kSimdNames[i]) return static_cast<Simd>(i);
  }
  return std::nullopt;
}

/// Uses these lanes, or the widest narrower ones that processor, build and scalar have. Some worlds have no choice.
template <class W> ISO_INLINE void use_lanes(W& world, Simd simd) {
  if constexpr (requires { world.use_simd(simd); }) {
    if (world.use_simd(simd)) return;
    if (simd == Simd::avx512 && world.use_simd(Simd::avx2)) return;
    for (const Simd narrow : {Simd::sse2, Simd::neon, Simd::wasm}) {
      if (world.use_simd(narrow)) return;
    }
    world.use_simd(Simd::scalar);
  }
}

}  // namespace isostep
