// Finer<S>: a format beside S with room for both large numbers and small ones, for coefficients reckoned once.
// SPDX-License-Identifier: MIT
#pragma once

#include <concepts>
#include <cstdint>

#include "isostep/scalar/scalar.hpp"

namespace isostep {

namespace detail {
template <class S> struct FinerOf { using Type = S; };
template <int F, Overflow P> struct FinerOf<Fixed<std::int32_t, F, P>> { using Type = Fixed<std::int64_t, 32, P>; };
}  // namespace detail

/// Q32.32 for every 32-bit format, else S itself.
template <class S> using Finer = typename detail::FinerOf<S>::Type;

/// Converts to Out, which is some Finer<S> or its Unit: exact from 32 bits, to nearest from another format of 64 bits.
template <class Out, std::floating_point S> ISO_INLINE Out finer(S a) { return a; }
template <class Out, int F, Overflow P> ISO_INLINE Out finer(Fixed<std::int64_t, F, P> a) { return convert<Out>(a); }
template <class Out, int F, Overflow P> ISO_INLINE Out finer(Fixed<std::int32_t, F, P> a) {
  return Out::from_raw(std::int64_t{a.raw()} << (Out::kFracBits - F));
}
/// Converts back, to nearest. What does not fit becomes the end of the format.
template <class Out, class In> ISO_INLINE Out coarser(In a) {
  if constexpr (std::same_as<Out, In>) {
    return a;
  } else {
    constexpr int kDrop = In::kFracBits - Out::kFracBits;
    const std::int64_t raw = (a.raw() + (std::int64_t{1} << (kDrop - 1))) >> kDrop;
    constexpr std::int64_t kMost = Out::highest().raw();
    return Out::from_raw(static_cast<typename Out::Raw>(raw > kMost ? kMost : raw < -kMost ? -kMost : raw));
  }
}

}  // namespace isostep
