// WorldEngine: from fat pairs to contacts, sensor overlaps and their events.
// SPDX-License-Identifier: MIT
#pragma once

#include <bit>

#include "isostep/collision/narrowphase/collide.hpp"
#include "isostep/core/stable_sort.hpp"
#include "isostep/geometry/bounds.hpp"
#include "isostep/world/engine.hpp"

namespace isostep {

namespace detail {
/// Points keep the impulse of their feature. What no feature claims is shared among the points that found none: when
/// two boxes trade places as reference every feature changes at once, and the load they carry must not vanish with the
/// names.
template <class S> void inherit_impulses(const Contact<S>& old, Contact<S>& contact) {
  using V = Velocity<S>;
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
}  // namespace detail

template <class S> std::uint32_t WorldEngine<S>::row_of(std::uint32_t slot) const {
  if (slot == kNoBody) return 0;
  const Location at = locations_[slot];
  return at.set == Location::kAwake ? at.index + 1 : 0;
}

template <class S> void WorldEngine<S>::find_pairs() {
  proxies_.update();
  wake_touched_islands();
}

template <class S> BodyFrame<S> WorldEngine<S>::frame_at(Location at) const {
  const BodyState<S>& state = state_at(at);
  const BodyProperties<S>& body = properties_at(at);
  const std::span<const Child<S>> children = children_of(body.shape);
  const Mat3<Unit<S>> turn = to_matrix(state.orientation);
  return {state.centre,
          {-(turn * body.local_centre), turn},
          children.data(),
          static_cast<std::uint32_t>(children.size()),
          at.set == Location::kAwake ? at.index + 1 : 0,
          children.size() == 1 && children[0].pose.is_identity(),
          (body.flags & body_flag::kSensor) != 0,
          at.is_frozen()};
}

/// visit(child_a, child_b, manifold) for every two parts within the margin, in order of their indices.
/// Frames: everything relative to a's centre of mass, axes as the world's: far from the origin costs no precision.
template <class S>
template <class Visit>
ISO_INLINE void WorldEngine<S>::visit_manifolds(const BodyFrame<S>& a, const BodyFrame<S>& b, S margin, Visit&& visit) {
  const Transform<S> origin_b = {b.centre - a.centre + b.origin.position, b.origin.rotation};
  Manifold<S> manifold;
  if (a.plain && b.plain) {
    collide(a.children->primitive, a.origin, b.children->primitive, origin_b, margin, manifold);
    if (manifold.count > 0) visit(0u, 0u, manifold);
    return;
  }
  const auto placed = [](const Transform<S>& origin, const Child<S>& child) {
    return child.pose.is_identity() ? origin : compose(origin, Transform<S>::of(child.pose));
  };
  const bool several = a.child_count > 1 || b.child_count > 1;
  for (std::uint32_t i = 0; i < a.child_count; ++i) {
    const Transform<S> ta = placed(a.origin, a.children[i]);
    const Aabb<S> box_a = several ? grow(bounds(a.children[i].primitive, ta), margin) : Aabb<S>{};
    for (std::uint32_t j = 0; j < b.child_count; ++j) {
      const Transform<S> tb = placed(origin_b, b.children[j]);
      if (several && !overlap(box_a, bounds(b.children[j].primitive, tb))) continue;
      collide(a.children[i].primitive, ta, b.children[j].primitive, tb, margin, manifold);
      if (manifold.count > 0 && !visit(i, j, manifold)) return;
    }
  }
}

template <class S> bool WorldEngine<S>::bodies_touch(std::uint32_t slot_a, std::uint32_t slot_b) const {
  bool touch = false;
  visit_manifolds(frame_at(locations_[slot_a]), frame_at(locations_[slot_b]), detail::kSpeculativeDistance<S>,
                  [&](std::uint32_t, std::uint32_t, const Manifold<S>&) {
                    touch = true;
                    return false;
                  });
  return touch;
}

/// An island wakes when something awake that moves has a contact with it. Waking brings new pairs, so until none is
/// left.
template <class S> void WorldEngine<S>::wake_touched_islands() {
  if (state_.frozen.empty()) return;
  std::vector<std::uint32_t>& touched = slots_;
  do {
    touched.clear();
    for (const std::uint64_t key : proxies_.pairs()) {
      const Location a = locations_[pair_a(key)], b = locations_[pair_b(key)];
      if (a.is_frozen() == b.is_frozen()) continue;
      const Location mover = a.is_frozen() ? b : a;
      if (mover.set != Location::kAwake) continue;
      const BodyState<S>& state = state_.awake.states[mover.index];
      const BodyProperties<S>& body = state_.awake.properties[mover.index];
      const bool still = state.velocity == Vec3<Velocity<S>>::zero() && state.spin == Vec3<Velocity<S>>::zero();
      if (body.type == BodyType::kinematic && still) continue;
      if (((body.flags | properties_at(a.is_frozen() ? a : b).flags) & body_flag::kSensor) != 0) continue;
      if (bodies_touch(pair_a(key), pair_b(key))) touched.push_back(a.is_frozen() ? pair_a(key) : pair_b(key));
    }
    thaw_bodies(touched);
    if (!touched.empty()) proxies_.update();
  } while (!touched.empty());
}

/// Pairs that a joint keeps from colliding, ascending.
template <class S> void WorldEngine<S>::collect_joined_pairs() {
  joined_pairs_.clear();
  for (const JointProperties<S>& joint : state_.joints.properties) {
    if ((joint.flags & joint_flag::kCollideConnected) != 0 || joint.body_a == kNoBody || joint.body_b == kNoBody)
      continue;
    joined_pairs_.push_back(pair_key(joint.body_a, joint.body_b));
  }
  sort_scratch_.resize(joined_pairs_.size());
  stable_sort(joined_pairs_.data(), sort_scratch_.data(), static_cast<std::uint32_t>(joined_pairs_.size()), OwnKey{});
}

template <class S>
void WorldEngine<S>::add_contact(const ContactKey& key, const Manifold<S>& manifold, const BodyFrame<S>& a,
                                 const BodyFrame<S>& b) {
  Contact<S>& contact = state_.contacts.emplace_back();
  contact.key = key;
  contact.count = static_cast<std::uint32_t>(manifold.count);
  ContactGeometry<S>& g = geometry_.emplace_back();
  g.row_a = a.row;
  g.row_b = b.row;
  g.normal = manifold.normal;
  g.material = mix(properties_at(locations_[key.body_a]).material, properties_at(locations_[key.body_b]).material);
  const Vec3<S> from_a_to_b = b.centre - a.centre;
  for (int p = 0; p < kMaxContactPoints; ++p) {
    if (p == manifold.count) break;
    const ManifoldPoint<S>& point = manifold.points[p];
    contact.features[p] = point.feature;
    g.points[p] = {point.position, point.position - from_a_to_b, point.separation};
  }
  while (old_cursor_ < old_contacts_.size() && old_contacts_[old_cursor_].key < key) ++old_cursor_;
  if (old_cursor_ == old_contacts_.size() || !(old_contacts_[old_cursor_].key == key)) return;
  const Contact<S>& old = old_contacts_[old_cursor_];
  contact.flags = old.flags;
  contact.friction_impulse = old.friction_impulse;
  contact.twist_impulse = old.twist_impulse;
  detail::inherit_impulses(old, contact);
}

template <class S> void WorldEngine<S>::update_manifolds() {
  collect_joined_pairs();
  frames_.resize(state_.awake.states.size());
  for (std::uint32_t i = 0; i < frames_.size(); ++i) frames_[i] = frame_at({Location::kAwake, i});
  old_contacts_.swap(state_.contacts);
  state_.contacts.clear();
  geometry_.clear();
  new_overlaps_.clear();
  old_cursor_ = 0;
  std::size_t joined = 0;
  std::uint32_t slot_a = kNoBody;  // whose frame `own_a` is, unless awake: pairs of one body follow each other
  BodyFrame<S> own_a, own_b;
  for (const std::uint64_t key : proxies_.pairs()) {
    while (joined < joined_pairs_.size() && joined_pairs_[joined] < key) ++joined;
    if (joined < joined_pairs_.size() && joined_pairs_[joined] == key) continue;
    const std::uint32_t a = pair_a(key), b = pair_b(key);
    const Location at_a = locations_[a], at_b = locations_[b];
    if (at_a.set != Location::kAwake && slot_a != a) own_a = frame_at(at_a);
    if (at_b.set != Location::kAwake) own_b = frame_at(at_b);
    slot_a = a;
    const BodyFrame<S>& frame_a = at_a.set == Location::kAwake ? frames_[at_a.index] : own_a;
    const BodyFrame<S>& frame_b = at_b.set == Location::kAwake ? frames_[at_b.index] : own_b;
    if (frame_a.sensor || frame_b.sensor) {
      if (frame_a.sensor && frame_b.sensor) continue;
      visit_manifolds(frame_a, frame_b, S(0), [&](std::uint32_t, std::uint32_t, const Manifold<S>&) {
        new_overlaps_.push_back(frame_a.sensor ? SensorOverlap{a, b} : SensorOverlap{b, a});
        return false;
      });
      continue;
    }
    if (frame_a.frozen || frame_b.frozen) continue;  // a kinematic body at rest against sleepers
    visit_manifolds(frame_a, frame_b, detail::kSpeculativeDistance<S>,
                    [&](std::uint32_t i, std::uint32_t j, const Manifold<S>& manifold) {
                      add_contact({a, b, i, j}, manifold, frame_a, frame_b);
                      return true;
                    });
  }
}

/// Overlaps of bodies that both lie still are kept: nobody looked, because nothing moved.
template <class S> void WorldEngine<S>::update_sensors() {
  for (const SensorOverlap& old : state_.overlaps) {
    const bool watched =
        locations_[old.sensor].set == Location::kAwake || locations_[old.other].set == Location::kAwake;
    if (!watched) new_overlaps_.push_back(old);
  }
  overlap_scratch_.resize(new_overlaps_.size());
  struct ByPair {
    ISO_INLINE std::uint64_t operator()(SensorOverlap o) const { return std::uint64_t{o.sensor} << 32 | o.other; }
  };
  stable_sort(new_overlaps_.data(), overlap_scratch_.data(), static_cast<std::uint32_t>(new_overlaps_.size()),
              ByPair{});
  const auto event = [&](SensorOverlap o) {
    return SensorEvent{state_.body_slots.template id_of<BodyId>(o.sensor),
                       state_.body_slots.template id_of<BodyId>(o.other)};
  };
  std::size_t i = 0, j = 0;
  while (i < state_.overlaps.size() || j < new_overlaps_.size()) {
    const bool old_first =
        j == new_overlaps_.size() || (i < state_.overlaps.size() && state_.overlaps[i] < new_overlaps_[j]);
    const bool new_first =
        i == state_.overlaps.size() || (j < new_overlaps_.size() && new_overlaps_[j] < state_.overlaps[i]);
    if (old_first) events_.sensor_end.push_back(event(state_.overlaps[i++]));
    else if (new_first) events_.sensor_begin.push_back(event(new_overlaps_[j++]));
    else ++i, ++j;
  }
  state_.overlaps.swap(new_overlaps_);
}

/// Two bodies touch when any of their contacts carried an impulse. Both lists ascend, so the events do.
template <class S> void WorldEngine<S>::emit_contact_events() {
  const std::vector<Contact<S>>& now = state_.contacts;
  const auto id = [&](std::uint32_t slot) { return state_.body_slots.template id_of<BodyId>(slot); };
  constexpr std::uint64_t kNone = ~std::uint64_t{0};
  const auto pair_at = [&](const std::vector<Contact<S>>& list, std::size_t at) {
    return at < list.size() ? pair_key(list[at].key.body_a, list[at].key.body_b) : kNone;
  };
  const auto touching = [](const Contact<S>& c) { return (c.flags & contact_flag::kTouching) != 0; };
  std::size_t i = 0, j = 0;
  std::uint64_t old_pair = pair_at(old_contacts_, 0), new_pair = pair_at(now, 0);
  while (min(old_pair, new_pair) != kNone) {
    const std::uint64_t pair = min(old_pair, new_pair);
    const std::size_t first = j;
    bool was = false, is = false;
    for (; old_pair == pair; old_pair = pair_at(old_contacts_, ++i)) was = was || touching(old_contacts_[i]);
    for (; new_pair == pair; new_pair = pair_at(now, ++j)) is = is || touching(now[j]);
    if (was && !is) events_.contact_end.push_back({id(pair_a(pair)), id(pair_b(pair))});
    if (!was && is)
      events_.contact_begin.push_back(
          {id(pair_a(pair)), id(pair_b(pair)), pressing(first, j), geometry_[first].normal});
  }
}

/// What contacts first..end-1 gave over the step along their normals [kg m/s].
template <class S> S WorldEngine<S>::pressing(std::size_t first, std::size_t end) const {
  const SolverBodies<S>& bodies = solver_.bodies();
  auto total = SumOf<S, Velocity<S>>{};
  for (std::size_t i = first; i < end; ++i) {
    const S mass_a = bodies.mass[geometry_[i].row_a].mass, mass_b = bodies.mass[geometry_[i].row_b].mass;
    const MassShare<S> share = mass_share(mass_a, mass_b);
    total = total + product(mass_b > S(0) ? share.b * mass_b : mass_a, step_impulses_[i]);
  }
  const auto most = product(highest<S>(), Velocity<S>(1));
  return most < total ? highest<S>() : round_to<S>(total);
}

}  // namespace isostep
