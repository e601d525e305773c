// W pairs of bodies side by side: gathering, and the spheres. Part of pair_kernel.inl, with internal linkage like it.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>

#include "isostep/collision/narrowphase/pair_kernels.hpp"
#include "isostep/scalar/lanes_math.hpp"

namespace isostep {
namespace {

/// Every lane has the bits that collide() gives its pair. Branches are selections.
template <class S, int W, class Isa> struct PairLanes {
  using L = Lanes<S, W, Isa>;
  using U = Lanes<Unit<S>, W, Isa>;
  using Mask = typename L::Mask;
  using Frame = BodyFrame<S>;

  static_assert(offsetof(Frame, radius) == offsetof(Frame, half) + 3 * sizeof(S));
  static_assert(offsetof(Frame, centre) == offsetof(Frame, half) + 4 * sizeof(S));
  static_assert(offsetof(Frame, origin) == offsetof(Frame, half) + 7 * sizeof(S));
  static_assert(sizeof(Transform<S>) == 12 * sizeof(S));

  /// W pairs. Spare lanes repeat the last pair.
  struct Batch {
    const Frame* a[W];
    const Frame* b[W];
    std::uint32_t pair[W];
    std::uint32_t real;  // a bit a lane
  };
  static ISO_INLINE Batch batch_at(const PairRun<S>& run, std::uint32_t at) {
    const std::uint32_t left = run.end - at;
    Batch batch;
    batch.real = left < W ? (1u << left) - 1 : 0xffffffffu >> (32 - W);
    for (std::uint32_t i = 0; i < W; ++i) {
      batch.pair[i] = run.order[i < left ? at + i : run.end - 1];
      batch.a[i] = &run.frames[run.pairs[batch.pair[i]].frame_a];
      batch.b[i] = &run.frames[run.pairs[batch.pair[i]].frame_b];
    }
    return batch;
  }

  template <int Words, class T, class Field>
  static ISO_INLINE void gather(const Frame* const* frames, Field&& field, Lanes<T, W, Isa>* out) {
    const T* rows[W];
    ISO_UNROLL for (int i = 0; i < W; ++i) rows[i] = field(*frames[i]);
    load_transposed<Words>(rows, out);
  }

  /// The two bodies of each pair. Positions are relative to a's centre of mass, as in origin_beside().
  struct Bodies {
    L radius_a, radius_b;
    Vec3<L> place_a, place_b;
    Vec3<L> gap;
  };
  static ISO_INLINE Bodies gather_bodies(const Batch& batch) {
    const auto words = [](const Frame& f) ISO_INLINE_LAMBDA { return &f.radius; };
    L a[8], b[8];  // the last is no length
    gather<8>(batch.a, words, a);
    gather<8>(batch.b, words, b);
    Bodies r = {a[0], b[0], {a[4], a[5], a[6]}, {}, {}};
    r.place_b = Vec3<L>{b[1], b[2], b[3]} - Vec3<L>{a[1], a[2], a[3]} + Vec3<L>{b[4], b[5], b[6]};
    r.gap = r.place_b - r.place_a;
    return r;
  }

  static void spheres(const PairRun<S>& run) {
    for (std::uint32_t at = run.begin; at < run.end; at += W) {
      const Batch batch = batch_at(run, at);
      const Bodies p = gather_bodies(batch);
      const Mask nearby = ~is_longer(p.gap.x, p.gap.y, p.gap.z, p.radius_a + p.radius_b + L::broadcast(run.margin));
      const std::uint32_t near_bits = to_bits(nearby), touching = near_bits & batch.real;
      for (int i = 0; i < W; ++i) run.counts[batch.pair[i]] = near_bits >> i & 1u;
      if (touching != 0) touch_spheres(run, batch, p, nearby, touching);
    }
  }

 private:
  /// Does touch_points() of sphere_pairs.inl, with an upright normal if centres coincide.
  static ISO_INLINE void touch_spheres(const PairRun<S>& run, const Batch& batch, const Bodies& p, Mask nearby,
                                       std::uint32_t touching) {
    const Direction<L> heading = direction_where(nearby, p.gap.x, p.gap.y, p.gap.z);
    const Mask apart = less(L::zero(), heading.length);
    const Vec3<U> normal = {select(apart, heading.x, U::zero()), select(apart, heading.y, U::broadcast(Unit<S>(1))),
                            select(apart, heading.z, U::zero())};
    const L length = select(apart, heading.length, L::zero());
    const Vec3<L> position = p.place_a + normal * ((length + p.radius_a - p.radius_b) * L::broadcast(S(0.5)));
    const U first[4] = {normal.x, normal.y, normal.z, U::zero()};
    const L second[4] = {position.x, position.y, position.z, length - p.radius_a - p.radius_b};
    Unit<S>* normals[W];
    S* points[W];
    for (int i = 0; i < W; ++i) {
      Manifold<S>& out = run.manifolds[batch.pair[i]];
      static_assert(offsetof(Manifold<S>, points) == 4 * sizeof(S), "what is stored after a normal is not a point's");
      normals[i] = &out.normal.x;
      points[i] = &out.points[0].position.x;
    }
    store_transposed<4>(normals, first, touching);
    store_transposed<4>(points, second, touching);
    for (int i = 0; i < W; ++i) {
      if ((touching >> i & 1u) == 0) continue;
      run.manifolds[batch.pair[i]].count = 1;
      run.manifolds[batch.pair[i]].points[0].feature = 0;
    }
  }
};

}  // namespace
}  // namespace isostep
