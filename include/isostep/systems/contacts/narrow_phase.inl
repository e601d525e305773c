// Bodies of narrow_phase.hpp.
// SPDX-License-Identifier: MIT
#pragma once

#include <bit>

#include "isostep/core/lower_bound.hpp"
#include "isostep/dynamics/contact_friction.hpp"
#include "isostep/dynamics/solver_name.hpp"
#include "isostep/systems/contacts/flush_contacts.inl"
#include "isostep/systems/contacts/narrow_phase.hpp"
#include "isostep/systems/contacts/narrow_phase_join.inl"
#include "isostep/systems/contacts/part_pairs.inl"

namespace isostep {

namespace detail {
/// Returns true if both have the same features in the same order, each once: then every impulse stays where it is.
template <class S> ISO_INLINE bool has_same_points(const Contact<S>& old, const Contact<S>& contact) {
  const std::uint32_t *f = old.features, *g = contact.features;
  if (old.count != contact.count || f[0] != g[0] || f[1] != g[1] || f[2] != g[2] || f[3] != g[3]) return false;
  const bool distinct2 = old.count < 2 || f[0] != f[1];
  const bool distinct3 = old.count < 3 || (f[0] != f[2] && f[1] != f[2]);
  return distinct2 && distinct3 && (old.count < 4 || (f[0] != f[3] && f[1] != f[3] && f[2] != f[3]));
}

/// Gives each point the impulse of its feature. Points without one share the impulses that no feature claims: when the
/// reference box of a pair changes, all features change at once, and the load that they carry must not vanish with the
/// names.
template <class S> void inherit_impulses(const Contact<S>& old, Contact<S>& contact) {
  using V = Velocity<S>;
  if (has_same_points(old, contact)) {
    for (std::uint32_t p = 0; p < contact.count; ++p) contact.normal_impulse[p] = old.normal_impulse[p];
    return;
  }
  std::uint32_t claimed = 0, missing = 0;  // bit q: of old's point q; bit p: of contact's point p
  for (std::uint32_t p = 0; p < contact.count; ++p) {
    bool found = false;
    for (std::uint32_t q = 0; q < old.count; ++q) {
      if (old.features[q] != contact.features[p]) continue;
      contact.normal_impulse[p] = old.normal_impulse[q];
      claimed |= 1u << q;
      found = true;
    }
    if (!found) missing |= 1u << p;
  }
  if (missing == 0) return;
  V left = V(0);
  for (std::uint32_t q = 0; q < old.count; ++q) left += (claimed >> q & 1u) != 0 ? V(0) : old.normal_impulse[q];
  if (!(left > V(0))) return;
  const V share = left / V(std::popcount(missing));
  for (std::uint32_t p = 0; p < contact.count; ++p) {
    if ((missing >> p & 1u) != 0) contact.normal_impulse[p] = share;
  }
}
/// Holds the old contacts of two bodies with surfaces among their parts.
template <class S> struct TriangleContacts {
  std::span<const Contact<S>> of_bodies;
  bool surface_is_b;

  /// Returns the contact with a feature of the convex, also on another triangle: the feature keeps its name there.
  ISO_INLINE const Contact<S>* holder_of(const ContactKey& key, std::uint32_t feature, std::uint32_t& point) const {
    for (const Contact<S>& old : of_bodies) {
      if (surface_is_b ? old.key.child_a != key.child_a : old.key.child_b != key.child_b) continue;
      for (point = 0; point < old.count; ++point) {
        if (old.features[point] == feature) return &old;
      }
    }
    return nullptr;
  }
};
/// Gives touching points without impulse that of their feature on another triangle. A new contact also takes its share
/// of the friction impulse there.
template <class S>
void inherit_across_edges(const TriangleContacts<S>& old, const ContactGeometry<S>& g, bool is_new,
                          Contact<S>& contact) {
  constexpr S kTouching = S(0.001);  // [m]
  for (std::uint32_t p = 0; p < contact.count; ++p) {
    const std::uint32_t feature = contact.features[p];
    if (feature >> 28 != triangle_feature::kOfConvexAlone >> 28 || g.points[p].separation > kTouching ||
        contact.normal_impulse[p] > Velocity<S>(0))
      continue;
    std::uint32_t point = 0;
    const Contact<S>* const holder = old.holder_of(contact.key, feature, point);
    if (holder == nullptr) continue;
    contact.normal_impulse[p] = holder->normal_impulse[point];
    contact.flags |= holder->flags & contact_flag::kTouching;
    if (!is_new) continue;
    const Velocity<S> share = Velocity<S>(static_cast<std::int32_t>(holder->count));
    for (int axis = 0; axis < 3; ++axis) contact.friction_impulse[axis] += holder->friction_impulse[axis] / share;
    contact.twist_impulse += holder->twist_impulse / share;
  }
}
}  // namespace detail

template <class S>
std::uint32_t NarrowPhase<S>::update(std::span<const std::uint64_t> pairs, const StepTools<S>& tools,
                                     const ContactRules<S>& rules) {
  pairs_ = pairs;
  belts_ = rules.belts == nullptr || rules.belts->empty() ? nullptr : rules.belts;
  kernels_ = tools.pair_kernels;
  part_pairs_.begin(rules.apart);
  material_table_.update(state_.records->material_pairs);
  old_contacts_.swap(state_.contacts);
  overlaps_.clear();
  placed_ = 0;
  if (tools.runner.threads > 1 && pairs.size() >= kLeastSharedPairs) update_shared(tools.runner);
  else update_alone();
  state_.contacts.resize(placed_);
  geometry_.resize(placed_);
  flush_.update(state_.contacts, geometry_);
  pairs_ = {};
  return part_pairs_.cut_compounds();
}

template <class S> void NarrowPhase<S>::update_alone() {
  for (std::size_t i = 0; i < state_.awake.states.size(); ++i) part_pairs_.frame_awake_body(i);
  part_pairs_.gather(pairs_);
  std::size_t old_cursor = 0;
  for (std::size_t group = 0; group < part_pairs_.groups(); ++group) {  // merged while its manifolds are in the cache
    const std::size_t size = part_pairs_.group(group).parts.size();
    if (point_counts_.size() < size) point_counts_.resize(size);
    if (manifolds_.size() < size) manifolds_.resize(size);
    collide_group(group, point_counts_.data(), manifolds_.data());
    const std::size_t first = place_group(group, point_counts_.data());
    merge_group(group, point_counts_.data(), manifolds_.data(), first, old_cursor);
  }
}

/// Updates on threads: frames, collisions and merging run in parallel, serial stages between them count places.
template <class S> void NarrowPhase<S>::update_shared(const TaskRunner& runner) {
  pieces_ = min(4 * static_cast<std::uint32_t>(runner.threads), kMaxPieces);
  const std::uint32_t stages[] = {pieces_, 1, pieces_, 1, pieces_};  // of run_piece
  run_stages(runner, stages, &NarrowPhase::run_piece, this);
}
template <class S> void NarrowPhase<S>::run_piece(void* data, std::uint32_t stage, std::uint32_t piece) {
  NarrowPhase& phase = *static_cast<NarrowPhase*>(data);
  PartPairs<S>& part_pairs = phase.part_pairs_;
  const auto each = [&](std::size_t count, const auto& work) {
    const std::size_t pieces = phase.pieces_;
    for (std::size_t i = count * piece / pieces; i < count * (piece + 1) / pieces; ++i) work(i);
  };
  const auto counts = [&](std::size_t group) { return phase.point_counts_.data() + part_pairs.group(group).first; };
  const auto manifolds = [&](std::size_t group) { return phase.manifolds_.data() + part_pairs.group(group).first; };
  const std::size_t groups = part_pairs.groups();
  switch (stage) {
    case 0: return each(phase.state_.awake.states.size(), [&](std::size_t i) { part_pairs.frame_awake_body(i); });
    case 1:
      part_pairs.gather(phase.pairs_);
      phase.point_counts_.resize(part_pairs.parts());
      phase.manifolds_.resize(part_pairs.parts());
      return;
    case 2: return each(groups, [&](std::size_t g) { phase.collide_group(g, counts(g), manifolds(g)); });
    case 3:
      phase.group_firsts_.resize(groups);
      for (std::size_t g = 0; g < groups; ++g) phase.group_firsts_[g] = phase.place_group(g, counts(g));
      return;
    default: break;
  }
  each(groups, [&](std::size_t g) {
    std::size_t old_cursor = phase.first_old_contact(g);
    phase.merge_group(g, counts(g), manifolds(g), phase.group_firsts_[g], old_cursor);
  });
}

/// Collides one group. Every pair writes only its own count and manifold and reads only frames. With room for all
/// manifolds, groups may run in parallel.
template <class S>
void NarrowPhase<S>::collide_group(std::size_t index, std::uint8_t* counts, Manifold<S>* manifolds) const {
  const PartGroup group = part_pairs_.group(index);
  PairRun<S> run = {part_pairs_.frames().data(),
                    group.parts.data(),
                    nullptr,
                    0,
                    0,
                    detail::kSpeculativeDistance<S>,
                    counts,
                    manifolds};
  const auto run_of = [&](std::span<const std::uint32_t> list) {
    run.order = list.data();
    run.end = static_cast<std::uint32_t>(list.size());
    return run;
  };
  kernels_->spheres(run_of(group.spheres));
  kernels_->boxes(run_of(group.boxes));
  collide_others(run_of(group.others));
  join_flat(run_of(group.others));
}
template <class S> void NarrowPhase<S>::collide_others(const PairRun<S>& run) const {
  for (std::uint32_t i = run.begin; i < run.end; ++i) {
    const PartPair& pair = run.pairs[run.order[i]];
    const BodyFrame<S>&a = run.frames[pair.frame_a], &b = run.frames[pair.frame_b];
    const S margin = is_sensed(pair) ? S(0) : run.margin;
    Manifold<S>& out = run.manifolds[run.order[i]];
    collide_parts(kernels_->polyhedra, a, pair.child_a, b, pair.child_b, margin, out);
    run.counts[run.order[i]] = static_cast<std::uint8_t>(out.count);
  }
}

template <class S>
ISO_INLINE void NarrowPhase<S>::fill_contact(const PartPair& parts, const Manifold<S>& manifold, Contact<S>& contact,
                                             ContactGeometry<S>& g, std::size_t& old_cursor) const {
  const std::vector<BodyFrame<S>>& frames = part_pairs_.frames();
  const std::vector<Material<S>>& materials = part_pairs_.materials();
  const BodyFrame<S>&a = frames[parts.frame_a], &b = frames[parts.frame_b];
  contact = {};
  contact.key = {a.slot, b.slot, parts.child_a, parts.child_b};
  contact.count = static_cast<std::uint32_t>(manifold.count);
  g.row_a = a.row;
  g.row_b = b.row;
  g.normal = manifold.normal;
  g.axis = Vec3<Unit<S>>::zero();
  g.ratio = Unit<S>(1);
  const Material<S>&of_a = materials[parts.frame_a], &of_b = materials[parts.frame_b];
  g.material = a.varied || b.varied
                   ? mix(material_of_leaf(a, parts.child_a, of_a), material_of_leaf(b, parts.child_b, of_b))
                   : mix(of_a, of_b);
  const Vec3<S> from_a_to_b = b.centre - a.centre;
  const auto is_ball = [](const BodyFrame<S>& body) {
    return body.plain && body.children[0].primitive.type == ShapeType::sphere;
  };
  if (part_pairs_.any_throng() && from_a_to_b == Vec3<S>::zero() && is_ball(a) && is_ball(b))
    g.normal = Throng<S>::way_apart(a.slot, b.slot);
  for (int p = 0; p < kMaxContactPoints; ++p) {
    if (p == manifold.count) break;
    const ManifoldPoint<S>& point = manifold.points[p];
    contact.features[p] = point.feature;
    g.points[p] = {point.position, point.position - from_a_to_b, point.separation};
  }
  while (old_cursor < old_contacts_.size() && old_contacts_[old_cursor].key < contact.key) ++old_cursor;
  const bool is_new = old_cursor == old_contacts_.size() || !(old_contacts_[old_cursor].key == contact.key);
  if (!is_new) {
    const Contact<S>& old = old_contacts_[old_cursor];
    contact.flags = old.flags & contact_flag::kTouching;
    contact.friction_impulse = old.friction_impulse;
    contact.twist_impulse = old.twist_impulse;
    detail::inherit_impulses(old, contact);
  }
  if (a.surfaces || b.surfaces)
    detail::inherit_across_edges<S>({old_contacts_of(contact.key, old_cursor), b.surfaces}, g, is_new, contact);
  if (a.reports || b.reports) contact.flags |= reported_flag(a, b, contact.key);
  if (belts_ != nullptr) add_belts(*belts_, contact.key, contact.count, g);
  if (!a.mixes_alone || !b.mixes_alone) settle_friction(parts, contact, g);
}

/// Returns kReported if one of the two parts reports contacts, itself or through its body.
template <class S>
std::uint32_t NarrowPhase<S>::reported_flag(const BodyFrame<S>& a, const BodyFrame<S>& b, const ContactKey& key) const {
  const auto reports = [&](const BodyFrame<S>& body, std::uint32_t leaf) {
    return body.reports &&
           map_.shapes.reports(map_.properties_at(map_.location(body.slot)), detail::leaf_at(body, leaf).child);
  };
  return reports(a, key.child_a) || reports(b, key.child_b) ? contact_flag::kReported : 0u;
}

/// Sets the friction of a contact whose materials do not simply mix, from their pair's record and by the slip.
template <class S>
void NarrowPhase<S>::settle_friction(const PartPair& parts, const Contact<S>& contact, ContactGeometry<S>& g) const {
  using Arms = detail::ContactArms<S>;
  const BodyFrame<S>&a = part_pairs_.frames()[parts.frame_a], &b = part_pairs_.frames()[parts.frame_b];
  Material<S> of_a = part_pairs_.materials()[parts.frame_a], of_b = part_pairs_.materials()[parts.frame_b];
  if (a.varied) of_a = material_of_leaf(a, parts.child_a, of_a);
  if (b.varied) of_b = material_of_leaf(b, parts.child_b, of_b);
  SurfaceContact<S> surface;
  surface.friction = g.material.friction;
  surface.static_friction = mixed_friction(static_friction_of(of_a), static_friction_of(of_b));
  if (const MaterialPair<S>* const pair = material_table_.find(of_a.kind, of_b.kind)) {
    surface.friction = pair->friction;
    surface.static_friction = max(pair->friction, pair->static_friction);
    g.material.restitution = pair->restitution;
    g.material.rolling_resistance = pair->rolling_resistance;
    g.material.spin_resistance = pair->spin_resistance;
  }
  surface.a = {of_a.anisotropy, a.origin.rotation};
  surface.b = {of_b.anisotropy, b.origin.rotation};
  const auto state_of = [&](std::uint32_t row) { return row == 0 ? nullptr : &state_.awake.states[row - 1]; };
  const auto slip_at = [&](const Arms& arms) {
    return detail::velocity_at<S>(state_of(g.row_b), arms.b) - detail::velocity_at<S>(state_of(g.row_a), arms.a) +
           convert<Velocity<S>>(g.material.surface_velocity);
  };
  surface.slip = slip_at(Arms::middle_of(g, contact.count));
  surface.first_slip = slip_at({g.points[0].arm_a, g.points[0].arm_b});
  choose_friction(surface, g);
}
/// Returns the old contacts of the key's bodies. The cursor is among them or next to them.
template <class S>
std::span<const Contact<S>> NarrowPhase<S>::old_contacts_of(const ContactKey& key, std::size_t cursor) const {
  const auto same = [&](std::size_t i) {
    return old_contacts_[i].key.body_a == key.body_a && old_contacts_[i].key.body_b == key.body_b;
  };
  std::size_t begin = cursor, end = cursor;
  while (begin > 0 && same(begin - 1)) --begin;
  while (end < old_contacts_.size() && same(end)) ++end;
  return std::span(old_contacts_).subspan(begin, end - begin);
}

/// Makes room for a group's contacts behind the existing ones, and notes sensor overlaps. Returns the first place.
/// Contacts overwrite those of the step before the last, so nothing is cleared first.
template <class S> std::size_t NarrowPhase<S>::place_group(std::size_t index, const std::uint8_t* counts) {
  const PartGroup group = part_pairs_.group(index);
  const std::vector<BodyFrame<S>>& frames = part_pairs_.frames();
  const std::size_t first = placed_, parts = group.parts.size();
  std::size_t touching = 0;
  for (std::size_t i = 0; i < parts; ++i) touching += counts[i] != 0 ? 1u : 0u;
  for (const std::uint32_t i : group.others) {
    const PartPair& part = group.parts[i];
    const BodyFrame<S>&a = frames[part.frame_a], &b = frames[part.frame_b];
    if (counts[i] == 0 || !is_sensed(part)) continue;
    const SensorOverlap overlap = detail::overlap_of(a, part.child_a, b, part.child_b);
    if (overlaps_.empty() || !(overlaps_.back() == overlap)) overlaps_.push_back(overlap);
    --touching;
  }
  placed_ += touching;
  if (state_.contacts.size() < placed_) state_.contacts.resize(placed_);
  if (geometry_.size() < placed_) geometry_.resize(placed_);
  return first;
}

/// Turns the manifolds of one group into contacts, in order, from `next` on.
template <class S>
void NarrowPhase<S>::merge_group(std::size_t index, const std::uint8_t* counts, const Manifold<S>* manifolds,
                                 std::size_t next, std::size_t& old_cursor) {
  const PartGroup group = part_pairs_.group(index);
  for (std::size_t i = 0; i < group.parts.size(); ++i) {
    const PartPair& part = group.parts[i];
    if (counts[i] == 0 || is_sensed(part)) continue;
    fill_contact(part, manifolds[i], state_.contacts[next], geometry_[next], old_cursor);
    ++next;
  }
}

/// Returns the first of the last step's contacts that a pair of the group may continue.
template <class S> std::size_t NarrowPhase<S>::first_old_contact(std::size_t index) const {
  const std::vector<BodyFrame<S>>& frames = part_pairs_.frames();
  const PartPair& part = part_pairs_.group(index).parts.front();
  const ContactKey least = {frames[part.frame_a].slot, frames[part.frame_b].slot, part.child_a, part.child_b};
  return lower_bound(old_contacts_.size(), [&](std::size_t i) { return old_contacts_[i].key < least; });
}

}  // namespace isostep
