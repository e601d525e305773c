// Springs over lanes: the forces of W of them side by side, then added one by one in the order of their slots.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/particles/loose_lanes.inl"
#include "isostep/particles/spring_rows.hpp"
#include "isostep/scalar/lanes_bounded.hpp"
#include "isostep/scalar/lanes_math.hpp"

namespace isostep {
namespace {

/// Hooke's law with damping along the spring (Millington, ch. 6.1; the damping is not the book's).
template <class S, int W, class Isa> struct SpringKernel {
  using L = Lanes<S, W, Isa>;
  using V = Lanes<Velocity<S>, W, Isa>;
  using M = Lanes<InverseMass<S>, W, Isa>;

  /// These move between arrays of axes and rows of four, particle by particle.
  template <class T> static ISO_INLINE void gather(AxesView<T> from, T* to, std::uint32_t i) {
    T* rows[W];
    for (int k = 0; k < W; ++k) rows[k] = to + 4u * (i + static_cast<std::uint32_t>(k));
    store_vectors(load_loose<W, Isa>(from, i), rows);
  }
  template <class T> static ISO_INLINE void scatter(const T* from, AxesView<T> to, std::uint32_t i) {
    const T* rows[W];
    for (int k = 0; k < W; ++k) rows[k] = from + 4u * (i + static_cast<std::uint32_t>(k));
    store_loose(load_vectors<W, Isa>(rows), to, i);
  }
  static ISO_INLINE void gather_block(const SpringRun<S>& run, std::uint32_t i) {
    gather(run.now, run.places, i);
    gather(run.acceleration, run.pulls, i);
    if (run.damped) gather(run.velocity, run.paces, i);
  }
  static ISO_INLINE void scatter_block(const SpringRun<S>& run, std::uint32_t i) {
    scatter(run.pulls, run.acceleration, i);
  }

  /// The vector from b to a.
  template <class T>
  static ISO_INLINE Vec3<Lanes<T, W, Isa>> difference(const T* ends, const std::uint32_t* a, const std::uint32_t* b) {
    const T *of_a[W], *of_b[W];
    for (int k = 0; k < W; ++k) {
      of_a[k] = ends + 4u * a[k];
      of_b[k] = ends + 4u * b[k];
    }
    const auto va = load_vectors<W, Isa>(of_a), vb = load_vectors<W, Isa>(of_b);
    return {va.x - vb.x, va.y - vb.y, va.z - vb.z};
  }
  /// Adds to sums, saturated at the format's ends.
  static ISO_INLINE void add(S* sum, const S* x, const S* y, const S* z) {
    sum[0] = saturating_add(sum[0], *x);
    sum[1] = saturating_add(sum[1], *y);
    sum[2] = saturating_add(sum[2], *z);
  }

  /// Returns the acceleration by a force; 0 for a pinned particle.
  static ISO_INLINE L accelerated(L force, M inverse_mass) {
    return select(less(M::zero(), inverse_mass), round_saturated<L>(product(force, inverse_mass)), L::zero());
  }

  /// Components of velocities stay below 3/2 of the speed limit, so differences fit.
  static ISO_INLINE void pull_block(const SpringRun<S>& run, std::uint32_t first) {
    const auto load = [first](const auto* array) ISO_INLINE_LAMBDA { return load_loose<W, Isa>(array + first); };
    const std::uint32_t *const a = run.a + first, *const b = run.b + first;
    const Vec3<L> d = difference(run.places, a, b);
    const auto every = less_equal(L::zero(), L::zero());
    const Direction<L> along = direction_where(every, d.x, d.y, d.z);
    const L extension = along.length - load(run.rest_length);
    auto tension = product(load(run.stiffness), extension);
    if (run.damped) {
      const Vec3<V> v = difference(run.paces, a, b);
      const V speed = round_saturated<V>(product(along.x, v.x) + product(along.y, v.y) + product(along.z, v.z));
      tension = tension + product(load(run.damping), convert<L>(speed));
    }
    const L force = round_saturated<L>(tension);
    const L to_a = accelerated(force, load(run.of_a)), to_b = accelerated(force, load(run.of_b));
    alignas(kLaneAlignment<S, W>) S on[6][W];  // on a, then on b
    round_product<L>(to_a, -along.x).store(on[0]);
    round_product<L>(to_a, -along.y).store(on[1]);
    round_product<L>(to_a, -along.z).store(on[2]);
    round_product<L>(to_b, along.x).store(on[3]);
    round_product<L>(to_b, along.y).store(on[4]);
    round_product<L>(to_b, along.z).store(on[5]);
    const std::uint32_t pulls = to_bits(less(load(run.least_extension), extension));
    S* const sums = run.pulls;
    for (int k = 0; k < W; ++k) {
      if (((pulls >> k) & 1u) == 0) continue;
      add(sums + 4u * a[k], on[0] + k, on[1] + k, on[2] + k);
      add(sums + 4u * b[k], on[3] + k, on[4] + k, on[5] + k);
    }
  }
};

/// Springs that fill no block are done one by one.
template <class S, int W, class Isa> void pull_springs(const SpringRun<S>& run) {
  using Wide = SpringKernel<S, W, Isa>;
  using Single = SpringKernel<S, 1, Isa>;
  const std::uint32_t count = run.count;
  std::uint32_t i = 0;
  for (; i + W <= run.particles; i += W) Wide::gather_block(run, i);
  for (; i < run.particles; ++i) Single::gather_block(run, i);
  for (i = 0; i + W <= count; i += W) Wide::pull_block(run, i);
  for (; i < count; ++i) Single::pull_block(run, i);
  for (i = 0; i + W <= run.particles; i += W) Wide::scatter_block(run, i);
  for (; i < run.particles; ++i) Single::scatter_block(run, i);
}

}  // namespace
}  // namespace isostep
