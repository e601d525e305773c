// Lanes of arrays that begin anywhere. Included by kernels: everything here is inline.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstring>

#include "isostep/particles/axes.hpp"
#include "isostep/scalar/lanes.hpp"

namespace isostep {
namespace {

template <int W, class Isa, class T> ISO_INLINE Lanes<T, W, Isa> load_loose(const T* from) {
  alignas(kLaneAlignment<T, W>) T copy[W];
  std::memcpy(copy, from, sizeof copy);
  return Lanes<T, W, Isa>::load(copy);
}
template <class T, int W, class Isa> ISO_INLINE void store_loose(Lanes<T, W, Isa> value, T* to) {
  alignas(kLaneAlignment<T, W>) T copy[W];
  value.store(copy);
  std::memcpy(to, copy, sizeof copy);
}
template <int W, class Isa, class T> ISO_INLINE Vec3<Lanes<T, W, Isa>> load_loose(AxesView<T> from, std::uint32_t i) {
  return {load_loose<W, Isa>(from.x + i), load_loose<W, Isa>(from.y + i), load_loose<W, Isa>(from.z + i)};
}
template <class T, int W, class Isa>
ISO_INLINE void store_loose(Vec3<Lanes<T, W, Isa>> value, AxesView<T> to, std::uint32_t i) {
  store_loose(value.x, to.x + i);
  store_loose(value.y, to.y + i);
  store_loose(value.z, to.z + i);
}

/// W vectors of four numbers each, the last of which is not used.
template <int W, class Isa, class T> ISO_INLINE Vec3<Lanes<T, W, Isa>> load_vectors(const T* const* rows) {
  Lanes<T, W, Isa> v[4];
  Lanes<T, W, Isa>::template load_rows<4>(rows, v);
  return {v[0], v[1], v[2]};
}
template <class T, int W, class Isa> ISO_INLINE void store_vectors(Vec3<Lanes<T, W, Isa>> value, T* const* rows) {
  using L = Lanes<T, W, Isa>;
  const L v[4] = {value.x, value.y, value.z, L::zero()};
  L::template store_rows<4>(rows, v, 0xffffffffu >> (32 - W));
}

}  // namespace
}  // namespace isostep
