// The common part of the tests of pair kernels: the instruction sets, and whether two manifolds have the same bits.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/collision/narrowphase/manifold.hpp"
#include "isostep/core/simd.hpp"

namespace isostep::test {

inline constexpr Simd kSets[] = {Simd::scalar, Simd::sse2, Simd::avx2, Simd::avx512,
                                 Simd::neon,   Simd::wasm, Simd::best};

template <class S> bool same_bits(const Manifold<S>& x, const Manifold<S>& y) {
  const auto same = [](auto a, auto b) {
    return to_bits(a.x) == to_bits(b.x) && to_bits(a.y) == to_bits(b.y) && to_bits(a.z) == to_bits(b.z);
  };
  if (x.count != y.count || (x.count > 0 && !same(x.normal, y.normal))) return false;
  for (int i = 0; i < x.count; ++i) {
    const ManifoldPoint<S>&p = x.points[i], &q = y.points[i];
    if (!same(p.position, q.position) || to_bits(p.separation) != to_bits(q.separation) || p.feature != q.feature)
      return false;
  }
  return true;
}

}  // namespace isostep::test
