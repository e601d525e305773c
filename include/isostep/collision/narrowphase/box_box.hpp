// Contacts of two boxes: up to four points of the overlap of two faces, or the crossing of two edges.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/collision/narrowphase/manifold.hpp"
#include "isostep/core/instantiate.hpp"
#include "isostep/geometry/shape.hpp"

namespace isostep {

/// Collides two boxes by separating axes, then clips the incident face.
/// Source:  Gottschalk, Lin, Manocha 1996, OBBTree, sec. 5 (the axes); Sutherland, Hodgman 1974, Reentrant Polygon
///          Clipping, CACM 17(1).
/// Differs: crosses of edges are normalised only when, unnormalised, they could still be the best or separate; a face
///          of a is preferred to one of b, and any face to a pair of edges, by axis_tolerance, and where they look at
///          each other, by kNearFace; where faces tell of the depth of the best cross, they touch (touch_crossing).
/// Error:   depth within 2 axis_tolerance and edge_slack of the least over all axes; position within a few resolutions
///          of the extents.
/// Limits:  the gap of boxes apart is that along the best axis, less than the distance of two corners; so it is for the
///          cores of rounded boxes (radius > 0), which touch there as if their corners were sharp.
/// Features: faces: 1u << 31 | reference box | reference face | incident face | the two edges that meet in the point;
///          edges: the axes' pair and the signs that pick an edge of each box.
template <class S>
void collide_box_box(const Primitive<S>& a, const Transform<S>& ta, const Primitive<S>& b, const Transform<S>& tb,
                     S margin, Manifold<S>& out);

#define ISO_BOX_BOX_OF(extern, S)                                                                        \
  extern template void collide_box_box<S>(const Primitive<S>&, const Transform<S>&, const Primitive<S>&, \
                                          const Transform<S>&, S, Manifold<S>&);
ISO_EXTERN_FOR_EACH_SCALAR(ISO_BOX_BOX_OF)

}  // namespace isostep
