// EPA: how deep two convex solids overlap, and the shortest way apart.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "isostep/collision/narrowphase/convex_core.hpp"
#include "isostep/core/instantiate.hpp"

namespace isostep {

enum class EpaStatus : std::uint8_t {
  converged,   // no axis is better by more than rounding
  apart,       // the solids do not overlap: depth is their distance, negative
  flat,        // the solids lie in one plane, which decides: the normal is its own
  unfinished,  // rounds, room or digits ended: moving b by depth along the normal parts them, a shorter way may too
};

template <class S> struct EpaPenetration {
  EpaStatus status;
  S depth;               // [m]
  Vec3<Unit<S>> normal;  // [1] from a to b: b moved by depth along it no longer overlaps a
  Vec3<S> on_a, on_b;    // [m] of a's and b's surface, deepest in the other
  std::int32_t rounds;
};

/// Works in the frame that both transforms lead to. Contacts of polyhedra do not use it: their axes are exact.
/// Source:  van den Bergen 2001, Proximity Queries and Penetration Depth Computation on 3D Game Objects, GDC.
/// Differs: starts with the simplex that GJK ended with, grown to a tetrahedron by supports across it. The axis is the
///          best of all those examined, whose depth its own support proves. 64 rounds. Formats of 32 bits are searched
///          in Q32.32.
/// Error:   depth and normal: tests/unit/collision/narrowphase/epa_test.cpp. Faces whose height is a few digits, as of
///          long thin triangles, have poor normals: then the depth is still one that parts the solids, but not the
///          least, and the status says so.
/// Order:   of faces that are equally near, the one in the lowest slot; of vertices, the first.
template <class S>
EpaPenetration<S> epa_penetration(const ConvexCore<S>& a, const Transform<S>& ta, const ConvexCore<S>& b,
                                  const Transform<S>& tb);
template <class S>
EpaPenetration<S> epa_penetration(const Polyhedron<S>& a, const Transform<S>& ta, const Polyhedron<S>& b,
                                  const Transform<S>& tb);

#define ISO_EPA_OF(extern, S)                                                                      \
  extern template EpaPenetration<S> epa_penetration<S>(const ConvexCore<S>&, const Transform<S>&,  \
                                                       const ConvexCore<S>&, const Transform<S>&); \
  extern template EpaPenetration<S> epa_penetration<S>(const Polyhedron<S>&, const Transform<S>&,  \
                                                       const Polyhedron<S>&, const Transform<S>&);
ISO_EXTERN_FOR_EACH_SCALAR(ISO_EPA_OF)

}  // namespace isostep
