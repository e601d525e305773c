// Bodies of flush_contacts.hpp.
// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "isostep/geometry/baked/unit_of_steps.hpp"
#include "isostep/geometry/bounds.hpp"
#include "isostep/math/rotations.hpp"
#include "isostep/store/body_frames.inl"
#include "isostep/systems/contacts/flush_contacts.hpp"

namespace isostep {

template <class S>
void FlushContacts<S>::update(std::vector<Contact<S>>& contacts, std::vector<ContactGeometry<S>>& geometry) {
  if (!chain(geometry)) return;
  left_out_.assign(contacts.size(), 0);
  any_left_out_ = false;
  for (std::uint32_t i = 0; i < contacts.size(); ++i) {
    if (next_[i] != i) judge(i, contacts, geometry);
  }
  if (!any_left_out_) return;
  std::size_t kept = 0;
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    if (left_out_[i] != 0) continue;
    contacts[kept] = contacts[i];
    geometry[kept] = geometry[i];
    ++kept;
  }
  contacts.resize(kept);
  geometry.resize(kept);
}

/// Chains the contacts of each moving body with fixed ones, others to themselves. Returns false if no body has two.
template <class S> bool FlushContacts<S>::chain(const std::vector<ContactGeometry<S>>& geometry) {
  const std::size_t bodies = state_.awake.properties.size();
  stands_.resize(bodies + 1);
  for (std::size_t i = 0; i < bodies; ++i) stands_[i + 1] = state_.awake.properties[i].type != BodyType::dynamic;
  last_.assign(bodies + 1, kNone);
  next_.resize(geometry.size());
  bool any = false;
  for (std::uint32_t i = 0; i < geometry.size(); ++i) {
    const ContactGeometry<S>& g = geometry[i];
    next_[i] = i;
    if (stands(g.row_a) == stands(g.row_b)) continue;
    std::uint32_t& last = last_[stands(g.row_a) ? g.row_b : g.row_a];
    any = any || last != kNone;
    next_[i] = last;
    last = i;
  }
  return any;
}

template <class S> auto FlushContacts<S>::seen(const Contact<S>& contact, const ContactGeometry<S>& g) const -> Seen {
  const bool is_a = stands(g.row_b);  // the mover
  const ContactKey& key = contact.key;
  Seen seen = {g.normal, key.body_b, g.row_b, key.body_a, key.child_a, -highest<S>()};
  if (is_a) seen = {-g.normal, key.body_a, g.row_a, key.body_b, key.child_b, -highest<S>()};
  for (std::uint32_t p = 0; p < contact.count; ++p) {
    const Vec3<S> arm = is_a ? g.points[p].arm_a : g.points[p].arm_b;
    seen.plane = max(seen.plane, dot(arm, seen.normal) - g.points[p].separation * S(0.5));
  }
  return seen;
}
template <class S> auto FlushContacts<S>::part_of(const Seen& seen) const -> Part {
  const BodyFrame<S> ground = frame_at(map_, map_.location(seen.ground));
  const Vec3<S> mover = map_.state_at(map_.location(seen.mover)).centre;
  const Leaf leaf = detail::leaf_at(ground, seen.leaf);
  const Transform<S> origin = {ground.origin.position + (ground.centre - mover), ground.origin.rotation};
  return {detail::part(ground, leaf.child), detail::placed(origin, ground.children[leaf.child]), leaf.triangle,
          detail::leaves_of_part(ground, leaf.child)};
}

/// Returns true if the part reaches no further along the normal than the plane.
template <class S> bool FlushContacts<S>::is_behind(const Part& part, Vec3<U> normal, S plane) {
  S reach = -highest<S>();
  if (part.is_of_surface()) {
    detail::visit_surface(part.shape, [&](const auto& surface) {
      for (const MeshPoint& p : surface.corners(part.triangle).points)
        reach = max(reach, dot(to_world(part.at, detail::point_of_steps<S>(p, surface.exponent())), normal));
    });
  } else if (is_bounded(part.shape.primitive.type)) {
    const Mat3<U> upright = to_matrix(rotation_between(normal, Vec3<U>{U(0), U(1), U(0)}));
    reach = bounds(part.shape, Transform<S>{upright * part.at.position, upright * part.at.rotation}).high.y;
  } else {
    return false;
  }
  return reach <= plane + kFlush;
}

template <class S>
void FlushContacts<S>::judge(std::uint32_t at, const std::vector<Contact<S>>& contacts,
                             std::vector<ContactGeometry<S>>& geometry) {
  const Seen own = seen(contacts[at], geometry[at]);
  std::optional<Part> part;
  for (std::uint32_t i = last_[own.row]; i != kNone; i = next_[i]) {
    if (i == at || left_out_[i] != 0) continue;
    const Seen other = seen(contacts[i], geometry[i]);
    if (max_abs(other.normal - own.normal) <= U(kAlike)) continue;
    if (!part) part.emplace(part_of(own));
    const bool same =
        part->is_of_surface() && other.ground == own.ground && other.leaf - part->leaves.first < part->leaves.count;
    if (same || !is_behind(*part, other.normal, other.plane) || is_behind(part_of(other), own.normal, own.plane))
      continue;
    const U lean = dot(own.normal, other.normal);
    any_left_out_ = any_left_out_ || lean < U(kLeans);
    left_out_[at] = lean < U(kLeans);
    ContactGeometry<S>& g = geometry[at];
    g.normal = own.mover == contacts[at].key.body_a ? -other.normal : other.normal;
    for (std::uint32_t p = 0; p < contacts[at].count; ++p) g.points[p].separation = g.points[p].separation * lean;
    return;
  }
}

}  // namespace isostep
