// The pair kernels of one lane: the reference, pair by pair.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/collision/narrowphase/box_box.hpp"
#include "isostep/collision/narrowphase/pair_kernels.hpp"
#include "isostep/collision/narrowphase/polyhedra.hpp"
#include "isostep/collision/narrowphase/sphere_pairs.hpp"

namespace isostep {
namespace {

template <class S, auto Collide> void collide_one_by_one(const PairRun<S>& run) {
  for (std::uint32_t i = run.begin; i < run.end; ++i) {
    const PartPair& pair = run.pairs[run.order[i]];
    const BodyFrame<S>& a = run.frames[pair.frame_a];
    const BodyFrame<S>& b = run.frames[pair.frame_b];
    Manifold<S>& out = run.manifolds[run.order[i]];
    Collide(a.children->primitive, a.origin, b.children->primitive, origin_beside(a, b), run.margin, out);
    run.counts[run.order[i]] = static_cast<std::uint8_t>(out.count);
  }
}
template <class S> constexpr PairKernels<S> make_scalar_pair_kernels() {
  return {collide_one_by_one<S, collide_sphere_sphere<S>>, collide_one_by_one<S, collide_box_box<S>>,
          collide_polyhedra<S>};
}

}  // namespace

#define ISO_DEFINE_SCALAR_PAIR_KERNELS(S) \
  ISO_DEFINE_KERNEL_TABLE(PairKernels<S>, Simd::scalar, make_scalar_pair_kernels<S>())

}  // namespace isostep
