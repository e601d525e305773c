// The manifold of two parts as their bodies are now, for those that look at a world from outside.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/collision/narrowphase/collide.hpp"
#include "isostep/geometry/surfaces.hpp"
#include "isostep/store/body_frames.hpp"
#include "isostep/store/views.hpp"

namespace isostep::detail {

/// Returns a part relative to `centre`, as the narrow phase needs it.
template <class S> ISO_INLINE Transform<S> part_beside(const BodyView<S>& view, std::uint32_t child, Vec3<S> centre) {
  const Child<S>& part = view.children[child];
  const Transform<S> origin = Transform<S>::of({view.pose.position - centre, view.pose.orientation});
  return part.pose.is_identity() ? origin : compose(origin, Transform<S>::of(part.pose));
}

/// Collides leaf i of a with leaf j of b, relative to a's centre of mass. Points may be apart by the distance at which
/// the step keeps a contact.
template <class S> ISO_INLINE Manifold<S> manifold_of(const BodyView<S>& a, Leaf i, const BodyView<S>& b, Leaf j) {
  const LeafView<S> part_a = {a.contents.view(a.children[i.child].primitive), i.triangle};
  const LeafView<S> part_b = {b.contents.view(b.children[j.child].primitive), j.triangle};
  const Vec3<S> centre = a.state->centre;
  Manifold<S> manifold;
  collide_leaves(part_a, part_beside(a, i.child, centre), part_b, part_beside(b, j.child, centre),
                 kSpeculativeDistance<S>, manifold);
  return manifold;
}

}  // namespace isostep::detail
