// The pair kernels over W lanes, written once for every scalar and instruction set. Included by one file per
// instruction set; everything here is inline or has internal linkage, so that no copy compiled for one instruction set
// can serve another.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/collision/narrowphase/box_lanes.inl"
#include "isostep/collision/narrowphase/pair_lanes.inl"
#include "isostep/collision/narrowphase/pair_scalar.inl"
#include "isostep/collision/narrowphase/polyhedra.inl"

namespace isostep {
namespace {

/// The part of two boxes' work that is done over lanes. Products and quotients of fixed point are hardly faster there,
/// and one by one a pair ends at the first axis that separates it. Stage update_manifolds of S3 on Zen 5, g++ 12,
/// AVX-512 [us]:
///             alone    axes  polygons
///   float       610                310
///   double      690                450
///   Q16.16      700     660        695
///   Q32.32     1140    1340
enum class BoxWork { alone, axes, polygons };

template <class S, int W, class Isa>
void polyhedra_in_lanes(const Polyhedron<S>& a, const Transform<S>& ta, const Polyhedron<S>& b, const Transform<S>& tb,
                        S margin, Manifold<S>& out) {
  detail::collide_polyhedra_over<S, W, Isa>(a, ta, b, tb, margin, out);
}

template <class S, int W, class Isa, BoxWork Boxes> constexpr PairKernels<S> make_pair_kernels() {
  if constexpr (Boxes == BoxWork::alone) {
    return {PairLanes<S, W, Isa>::spheres, collide_one_by_one<S, collide_box_box<S>>, polyhedra_in_lanes<S, W, Isa>};
  } else {
    return {PairLanes<S, W, Isa>::spheres, BoxLanes<S, W, Isa, Boxes == BoxWork::polygons>::boxes,
            polyhedra_in_lanes<S, W, Isa>};
  }
}

}  // namespace
}  // namespace isostep
