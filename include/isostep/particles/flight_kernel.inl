// The flight kernels: W particles side by side, written once for every scalar and instruction set. Included by one file
// per instruction set; everything here is inline or has internal linkage.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/particles/flight.hpp"
#include "isostep/particles/loose_lanes.inl"
#include "isostep/particles/spring_kernel.inl"
#include "isostep/scalar/lanes_bounded.hpp"
#include "isostep/scalar/lanes_math.hpp"

namespace isostep {
namespace {

/// Symbols: v = velocity, a = acceleration, d = displacement since the step began, w = 1/m.
template <class S, int W, class Isa> struct FlightKernel {
  using L = Lanes<S, W, Isa>;
  using V = Lanes<Velocity<S>, W, Isa>;
  using M = Lanes<InverseMass<S>, W, Isa>;
  using H = Lanes<Step<S>, W, Isa>;
  using Mask = typename L::Mask;

  struct Rows {
    Vec3<L> gravity;
    L linear_drag, quadratic_drag;
    H keep;
  };
  static ISO_INLINE bool is_uniform(const std::uint32_t* material) {
    std::uint32_t differ = 0;
    ISO_UNROLL for (int i = 1; i < W; ++i) differ |= material[i] ^ material[0];
    return differ == 0;
  }
  static ISO_INLINE Rows spread(const FlightRow<S>& row) {
    return {{L::broadcast(row.gravity.x), L::broadcast(row.gravity.y), L::broadcast(row.gravity.z)},
            L::broadcast(row.linear_drag),
            L::broadcast(row.quadratic_drag),
            H::broadcast(row.keep)};
  }
  static ISO_INLINE Rows gather(const FlightRow<S>* rows, const std::uint32_t* material) {
    if (is_uniform(material)) return spread(rows[material[0]]);
    alignas(kLaneAlignment<S, W>) S in[5][W];
    alignas(kLaneAlignment<Step<S>, W>) Step<S> keep[W];
    for (int i = 0; i < W; ++i) {
      const FlightRow<S>& row = rows[material[i]];
      in[0][i] = row.gravity.x;
      in[1][i] = row.gravity.y;
      in[2][i] = row.gravity.z;
      in[3][i] = row.linear_drag;
      in[4][i] = row.quadratic_drag;
      keep[i] = row.keep;
    }
    return {{L::load(in[0]), L::load(in[1]), L::load(in[2])}, L::load(in[3]), L::load(in[4]), H::load(keep)};
  }

  template <class T> static ISO_INLINE auto load(const T* from) { return load_loose<W, Isa>(from); }
  template <class T> static ISO_INLINE auto load(AxesView<T> from, std::uint32_t i) {
    return load_loose<W, Isa>(from, i);
  }

  /// Returns (k1 + k2 |v|) / m [1/s], at most 1/h: drag that would reverse a particle stops it.
  static ISO_INLINE L drag_rate(const Rows& rows, Vec3<L> v, M w, S rate) {
    const L most = L::broadcast(rate);
    L drag = rows.linear_drag;
    const Mask quadratic = less(L::zero(), rows.quadratic_drag);
    if (any(quadratic)) {
      const L speed = length_where(quadratic, v.x, v.y, v.z);
      const L more = round_within<L>(product(rows.quadratic_drag, speed), ParticleLimits<S>::acceleration());
      drag = select(quadratic, min(drag, L::broadcast(ParticleLimits<S>::acceleration())) + more, drag);
    }
    return min(round_within<L>(product(drag, w), rate), most);
  }

  static ISO_INLINE Vec3<L> acceleration(const Rows& rows, Vec3<V> velocity, M w, S rate) {
    Vec3<L> a = rows.gravity;
    const Mask dragged = less(L::zero(), rows.linear_drag) | less(L::zero(), rows.quadratic_drag);
    if (any(dragged)) {
      const Vec3<L> v = {convert<L>(velocity.x), convert<L>(velocity.y), convert<L>(velocity.z)};
      const L drag = drag_rate(rows, v, w, rate);
      const S most = ParticleLimits<S>::acceleration();
      // A particle without drag keeps even the sign of a zero, whether or not a neighbour in its lanes has drag.
      a = {select(dragged, a.x - round_within<L>(product(v.x, drag), most), a.x),
           select(dragged, a.y - round_within<L>(product(v.y, drag), most), a.y),
           select(dragged, a.z - round_within<L>(product(v.z, drag), most), a.z)};
    }
    const auto moves = less(M::zero(), w);
    const L zero = L::zero();
    return {select(moves, a.x, zero), select(moves, a.y, zero), select(moves, a.z, zero)};
  }
  static ISO_INLINE void accelerate_block(const FlightRun<S>& run, std::uint32_t i) {
    const Rows rows = gather(run.rows, run.material + i);
    store_loose(acceleration(rows, load(run.velocity, i), load(run.inverse_mass + i), run.rate), run.acceleration, i);
  }

  /// Advances one axis. A pinned particle keeps its velocity.
  static ISO_INLINE void advance_axis(const FlightRun<S>& run, V& v, V& d, L a, Mask moves, H keep) {
    const H h = H::broadcast(run.h);
    const Velocity<S> speed = convert<Velocity<S>>(ParticleLimits<S>::speed());
    const V limit = V::broadcast(passing_speed<S>());
    const V before = v;
    const V pushed = clamp(before + round_within<V>(product(a, h), speed + speed), V::zero() - limit, limit);
    v = select(moves, round_product<V>(pushed, keep), before);
    d = d + round_product<V>(run.moves_first ? before : v, h);
  }
  static ISO_INLINE void advance(const FlightRun<S>& run, Vec3<V>& v, Vec3<V>& d, Vec3<L> a, Mask moves, H keep) {
    advance_axis(run, v.x, d.x, a.x, moves, keep);
    advance_axis(run, v.y, d.y, a.y, moves, keep);
    advance_axis(run, v.z, d.z, a.z, moves, keep);
  }
  static ISO_INLINE void advance_block(const FlightRun<S>& run, std::uint32_t i) {
    const Rows rows = gather(run.rows, run.material + i);
    const auto moves = less(M::zero(), load(run.inverse_mass + i));
    Vec3<V> v = load(run.velocity, i), d = load(run.displacement, i);
    advance(run, v, d, load(run.acceleration, i), moves, rows.keep);
    store_loose(v, run.velocity, i);
    store_loose(d, run.displacement, i);
  }

  static ISO_INLINE void fly_block(const FlightRun<S>& run, std::uint32_t i) {
    const Rows rows = gather(run.rows, run.material + i);
    const M w = load(run.inverse_mass + i);
    const auto moves = less(M::zero(), w);
    Vec3<V> v = load(run.velocity, i), d = {V::zero(), V::zero(), V::zero()};
    for (std::int32_t k = 0; k < run.substeps; ++k)
      advance(run, v, d, acceleration(rows, v, w, run.rate), moves, rows.keep);
    store_loose(v, run.velocity, i);
    store_loose(d, run.displacement, i);
  }

  /// Blocks of one material side by side: each waits for its own roots and products. Four are no faster.
  static constexpr int kBlocks = 2;
  static ISO_INLINE bool fly_blocks(const FlightRun<S>& run, std::uint32_t first) {
    std::uint32_t differ = 0;
    for (std::uint32_t i = first; i < first + kBlocks * W; ++i) differ |= run.material[i] ^ run.material[first];
    if (differ != 0) return false;
    const Rows rows = spread(run.rows[run.material[first]]);
    Vec3<V> v[kBlocks], d[kBlocks];
    M w[kBlocks];
    for (int n = 0; n < kBlocks; ++n) {
      const std::uint32_t i = first + static_cast<std::uint32_t>(n * W);
      v[n] = load(run.velocity, i);
      d[n] = {V::zero(), V::zero(), V::zero()};
      w[n] = load(run.inverse_mass + i);
    }
    for (std::int32_t k = 0; k < run.substeps; ++k) {
      for (int n = 0; n < kBlocks; ++n)
        advance(run, v[n], d[n], acceleration(rows, v[n], w[n], run.rate), less(M::zero(), w[n]), rows.keep);
    }
    for (int n = 0; n < kBlocks; ++n) {
      const std::uint32_t i = first + static_cast<std::uint32_t>(n * W);
      store_loose(v[n], run.velocity, i);
      store_loose(d[n], run.displacement, i);
    }
    return true;
  }

  static ISO_INLINE Vec3<L> placed(const FlightRun<S>& run, std::uint32_t i) {
    const Vec3<L> p = load(run.position, i);
    const Vec3<V> d = load(run.displacement, i);
    return {p.x + convert<L>(d.x), p.y + convert<L>(d.y), p.z + convert<L>(d.z)};
  }
  static ISO_INLINE void place_block(const FlightRun<S>& run, std::uint32_t i) {
    store_loose(placed(run, i), run.now, i);
  }

  /// Returns true for lanes with |x| < limit. NaN lies nowhere.
  template <class T> static ISO_INLINE auto lies_inside(Lanes<T, W, Isa> x, T limit) {
    return less(Lanes<T, W, Isa>::broadcast(-limit), x) & less(x, Lanes<T, W, Isa>::broadcast(limit));
  }
  template <class T> static ISO_INLINE auto lies_inside(Vec3<Lanes<T, W, Isa>> v, T limit) {
    return lies_inside(v.x, limit) & lies_inside(v.y, limit) & lies_inside(v.z, limit);
  }
  static ISO_INLINE bool finish_block(const FlightRun<S>& run, std::uint32_t i) {
    const Vec3<L> p = placed(run, i);
    const Velocity<S> speed = convert<Velocity<S>>(ParticleLimits<S>::speed());
    const auto plain = lies_inside(p, ParticleLimits<S>::position()) & lies_inside(load(run.velocity, i), speed);
    if (!all(plain)) return false;
    store_loose(p, run.position, i);
    return true;
  }
};

/// Particles that fill no block are done one by one.
#define ISO_FLIGHT_LOOP(NAME)                                                        \
  template <class S, int W, class Isa> void NAME##_flight(const FlightRun<S>& run) { \
    std::uint32_t i = run.first;                                                     \
    for (; i + W <= run.end; i += W) FlightKernel<S, W, Isa>::NAME##_block(run, i);  \
    for (; i < run.end; ++i) FlightKernel<S, 1, Isa>::NAME##_block(run, i);          \
  }
ISO_FLIGHT_LOOP(accelerate)
ISO_FLIGHT_LOOP(advance)
ISO_FLIGHT_LOOP(place)
#undef ISO_FLIGHT_LOOP
template <class S, int W, class Isa> void fly_flight(const FlightRun<S>& run) {
  using Wide = FlightKernel<S, W, Isa>;
  constexpr std::uint32_t kMany = Wide::kBlocks * W;
  std::uint32_t i = run.first;
  while (i + W <= run.end) {
    if (i + kMany <= run.end && Wide::fly_blocks(run, i)) {
      i += kMany;
    } else {
      Wide::fly_block(run, i);
      i += W;
    }
  }
  for (; i < run.end; ++i) FlightKernel<S, 1, Isa>::fly_block(run, i);
}
template <class S, int W, class Isa> std::uint32_t finish_flight(const FlightRun<S>& run) {
  std::uint32_t i = run.first;
  while (i + W <= run.end && FlightKernel<S, W, Isa>::finish_block(run, i)) i += W;
  while (i + W > run.end && i < run.end && FlightKernel<S, 1, Isa>::finish_block(run, i)) ++i;
  return i;
}

template <class S, int W, class Isa> constexpr FlightKernels<S> make_flight_kernels(const char* name) {
  return {name,
          W,
          accelerate_flight<S, W, Isa>,
          advance_flight<S, W, Isa>,
          fly_flight<S, W, Isa>,
          place_flight<S, W, Isa>,
          finish_flight<S, W, Isa>,
          pull_springs<S, W, Isa>};
}

}  // namespace

/// The kernels of one lane of a scalar: any machine.
#define ISO_DEFINE_SCALAR_FLIGHT_KERNELS(S) \
  ISO_DEFINE_KERNEL_TABLE(FlightKernels<S>, Simd::scalar, make_flight_kernels<S, 1, isa::Portable>("scalar"))

}  // namespace isostep
