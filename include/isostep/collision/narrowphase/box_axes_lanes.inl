// The separating axes of W pairs of boxes at once: best_axis() of box_axes.hpp but for the crosses that are examined in
// full. Part of pair_kernel.inl, with internal linkage like it.
// SPDX-License-Identifier: MIT
#pragma once

#include <utility>

#include "isostep/collision/narrowphase/face_clip.hpp"
#include "isostep/collision/narrowphase/pair_lanes.inl"

namespace isostep {
namespace {

template <class S, int W, class Isa> struct BoxAxesLanes {
  using Pairs = PairLanes<S, W, Isa>;
  using L = typename Pairs::L;
  using U = typename Pairs::U;
  using Mask = typename Pairs::Mask;
  using Batch = typename Pairs::Batch;
  using Bodies = typename Pairs::Bodies;

  /// Two boxes of each pair, in a's frame.
  struct Boxes {
    Vec3<L> half_a, half_b;
    Mat3<U> turn_a, turn_b;  // to the world's axes
    Vec3<L> offset;          // [m] b's centre
    Mat3<U> turn;            // rows: a's axes; columns: b's
    L tolerance;             // [m] axis_tolerance()
  };
  /// The best face of each pair, and the crosses that might be better.
  struct Best {
    Mask apart;
    Mask of_b, axis0, axis1;   // neither 0 nor 1: 2
    L separation, limit;       // [m] of the face, what a cross must exceed
    std::uint32_t crosses[9];  // a bit a lane: worth examining
    std::uint32_t examine;     // lanes with any

    /// Returns the number of the face: see BestAxis::face.
    ISO_INLINE int face(int lane) const {
      const auto bit = [lane](Mask of) ISO_INLINE_LAMBDA { return static_cast<int>(to_bits(of) >> lane & 1u); };
      return 3 * bit(of_b) + 2 - 2 * bit(axis0) - bit(axis1);
    }
  };

  static ISO_INLINE Mat3<U> gather_turn(const typename Pairs::Frame* const* frames) {
    U w[8], rest[4];
    Pairs::template gather<8>(
        frames, [](const typename Pairs::Frame& f) ISO_INLINE_LAMBDA { return &f.origin.rotation.rows[0].x; }, w);
    Pairs::template gather<4>(
        frames, [](const typename Pairs::Frame& f) ISO_INLINE_LAMBDA { return &f.origin.rotation.rows[1].z; }, rest);
    return {{{w[0], w[1], w[2]}, {w[3], w[4], w[5]}, {w[6], w[7], rest[3]}}};
  }

  static ISO_INLINE Vec3<L> gather_half(const typename Pairs::Frame* const* frames) {
    L w[4];
    Pairs::template gather<4>(
        frames, [](const typename Pairs::Frame& f) ISO_INLINE_LAMBDA { return &f.half.x; }, w);
    return {w[0], w[1], w[2]};
  }

  static ISO_INLINE L tolerance_of(Vec3<L> half_a, Vec3<L> half_b) {
    const Vec3<L> low = min(half_a, half_b);
    const L smallest = min(low.x, min(low.y, low.z));
    const L rounding = (max_abs(half_a) + max_abs(half_b)) * U::broadcast(resolution<Unit<S>>());
    return smallest * L::broadcast(S(0.0078125)) + rounding * L::broadcast(S(8)) + L::broadcast(resolution<S>() * S(4));
  }

  /// Returns |gap| - reach, rounded once, as the larger of both signs: rounding is monotonic.
  template <int I, int J> static ISO_INLINE L cross_separation(const Boxes& boxes, const Mat3<U>& q) {
    constexpr int i1 = (I + 1) % 3, i2 = (I + 2) % 3, j1 = (J + 1) % 3, j2 = (J + 2) % 3;
    const Mat3<U>& r = boxes.turn;
    const auto gap = product(boxes.offset[i2], r.rows[i1][J]) - product(boxes.offset[i1], r.rows[i2][J]);
    const auto reach = product(boxes.half_a[i1], q.rows[i2][J]) + product(boxes.half_a[i2], q.rows[i1][J]) +
                       product(boxes.half_b[j1], q.rows[I][j2]) + product(boxes.half_b[j2], q.rows[I][j1]);
    return max(round_to<L>(gap - reach), round_to<L>(-gap - reach));
  }
  template <int K> static ISO_INLINE void weigh_cross(const Boxes& boxes, const Mat3<U>& q, L worth, Best& best) {
    best.crosses[K] = to_bits(less(worth, cross_separation<K / 3, K % 3>(boxes, q)));
    best.examine |= best.crosses[K];
  }
  template <int... K>
  static ISO_INLINE void weigh_crosses(const Boxes& boxes, const Mat3<U>& q, L worth, Best& best,
                                       std::integer_sequence<int, K...>) {
    (weigh_cross<K>(boxes, q, worth, best), ...);
  }

  /// The index of the largest of three: neither 0 nor 1 means 2.
  struct Largest {
    Mask is0, is1;

    template <class T> ISO_INLINE T pick(T x, T y, T z) const { return select(is0, x, select(is1, y, z)); }
  };
  static ISO_INLINE Largest largest_of(const L (&x)[3]) {
    const Mask is0 = less_equal(x[1], x[0]) & less_equal(x[2], x[0]);
    return {is0, less_equal(x[2], x[1]) & ~is0};
  }
  /// See are_beside() of box_axes.hpp.
  static ISO_INLINE Mask are_beside(const Boxes& boxes, const L (&offset_a)[3], const Largest& a,
                                    const L (&offset_b)[3], const Largest& b) {
    const Mask below_a = less(a.pick(offset_a[0], offset_a[1], offset_a[2]), L::zero());
    const Mask below_b = less(b.pick(offset_b[0], offset_b[1], offset_b[2]), L::zero());
    U along[3];
    ISO_UNROLL for (int i = 0; i < 3; ++i) {
      const Vec3<U>& row = boxes.turn.rows[i];
      along[i] = b.pick(row.x, row.y, row.z);
    }
    const U cosine = a.pick(along[0], along[1], along[2]);
    const Mask differ = (below_a & ~below_b) | (~below_a & below_b);
    return less_equal(U::broadcast(Unit<S>(detail::kNearFace)), select(differ, -cosine, cosine));
  }

  /// Finds the best axis of every pair. Returns false if every pair is apart.
  static ISO_INLINE bool find(const Batch& batch, const Bodies& p, S margin, Boxes& boxes, Best& best) {
    boxes.half_a = gather_half(batch.a);
    boxes.half_b = gather_half(batch.b);
    boxes.turn_a = gather_turn(batch.a);
    boxes.turn_b = gather_turn(batch.b);
    const L reach = L::broadcast(margin) + p.radius_a + p.radius_b;
    L a[3], b[3];
    Mat3<U> size;
    best.apart = Mask::from_bits(0);
    L offset[3];
    ISO_UNROLL for (int i = 0; i < 3; ++i) {
      const Vec3<U> axis = boxes.turn_a.column(i);
      offset[i] = dot(axis, p.gap);
      boxes.turn.rows[i] = transposed_times(boxes.turn_b, axis);
      size.rows[i] = abs(boxes.turn.rows[i]);
      a[i] = abs(offset[i]) - boxes.half_a[i] - dot(size.rows[i], boxes.half_b);
      best.apart = best.apart | less(reach, a[i]);
    }
    boxes.offset = {offset[0], offset[1], offset[2]};
    if ((~to_bits(best.apart) & batch.real) == 0) return false;
    L offset_b[3];
    ISO_UNROLL for (int j = 0; j < 3; ++j) {
      offset_b[j] = dot(boxes.offset, boxes.turn.column(j));
      b[j] = abs(offset_b[j]) - boxes.half_b[j] - dot(size.column(j), boxes.half_a);
      best.apart = best.apart | less(reach, b[j]);
    }
    if ((~to_bits(best.apart) & batch.real) == 0) return false;

    const L of_a = max(a[0], max(a[1], a[2])), of_b = max(b[0], max(b[1], b[2]));
    boxes.tolerance = tolerance_of(boxes.half_a, boxes.half_b);
    const Largest face_a = largest_of(a), face_b = largest_of(b);
    const Mask shallow = less(L::broadcast(-detail::kMostBeside<S>), of_b);
    best.of_b = less(of_a + boxes.tolerance, of_b) & ~(shallow & are_beside(boxes, offset, face_a, offset_b, face_b));
    best.separation = select(best.of_b, of_b, of_a);
    best.axis0 = (best.of_b & face_b.is0) | (~best.of_b & face_a.is0);
    best.axis1 = (best.of_b & face_b.is1) | (~best.of_b & face_a.is1);
    best.examine = 0;
    best.limit = max(of_a, of_b) + boxes.tolerance;
    const L worth = min(best.limit, L::zero());
    weigh_crosses(boxes, size, worth, best, std::make_integer_sequence<int, 9>{});
    best.examine &= ~to_bits(best.apart) & batch.real;
    return true;
  }

  /// Holds the lanes' values in memory, for work that is done pair by pair.
  struct Rest {
    alignas(kLaneAlignment<S, W>) S separation[W], limit[W], offset[3][W];
    alignas(kLaneAlignment<S, W>) Unit<S> turn[3][3][W];
  };
  static ISO_INLINE void store(const Boxes& boxes, const Best& best, Rest& rest) {
    best.separation.store(rest.separation);
    best.limit.store(rest.limit);
    for (int i = 0; i < 3; ++i) {
      boxes.offset[i].store(rest.offset[i]);
      for (int j = 0; j < 3; ++j) boxes.turn.rows[i][j].store(rest.turn[i][j]);
    }
  }
  static ISO_INLINE detail::BoxPair<S> pair_of(const Batch& batch, const Rest& rest, int lane) {
    detail::BoxPair<S> pair;
    pair.half_a = batch.a[lane]->half;
    pair.half_b = batch.b[lane]->half;
    for (int i = 0; i < 3; ++i) {
      pair.offset[i] = rest.offset[i][lane];
      for (int j = 0; j < 3; ++j) pair.turn.rows[i][j] = rest.turn[i][j][lane];
    }
    return pair;
  }

  /// Examines candidate crosses one by one, and collides the pairs whose best axis is a cross. Returns a bit for the
  /// lane of each of those, and of each pair that a cross separates.
  static ISO_INLINE std::uint32_t finish_crosses(const PairRun<S>& run, const Batch& batch, const Best& best,
                                                 const Rest& rest) {
    std::uint32_t done = 0;
    for (std::uint32_t lanes = best.examine; lanes != 0; lanes &= lanes - 1) {
      const int lane = first_bit(lanes);
      const BodyFrame<S>&a = *batch.a[lane], &b = *batch.b[lane];
      const detail::BoxPair<S> pair = pair_of(batch, rest, lane);
      std::uint32_t candidates = 0;
      for (int k = 0; k < 9; ++k) candidates |= (best.crosses[k] >> lane & 1u) << k;
      detail::BestAxis<S> axis = {0, best.face(lane), rest.separation[lane], Vec3<Unit<S>>::zero()};
      detail::examine_crosses(pair, candidates, run.margin + a.radius + b.radius, rest.limit[lane], axis);
      if (axis.axis == 0) continue;  // a face, as before
      done |= 1u << lane;
      Manifold<S>& out = run.manifolds[batch.pair[lane]];
      if (axis.axis < 0) continue;
      out.clear();
      detail::touch_crossing(pair, axis, a.radius, a.origin, b.radius, origin_beside(a, b), run.margin, out);
      run.counts[batch.pair[lane]] = static_cast<std::uint8_t>(out.count);
    }
    return done;
  }
};

}  // namespace
}  // namespace isostep
