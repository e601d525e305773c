// WorldEngine: from fat pairs to contacts, sensor overlaps and their events.
// SPDX-License-Identifier: MIT
#pragma once

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
  bool claimed[kMaxContactPoints] = {};
  bool found[kMaxContactPoints] = {};
  std::uint32_t missing = 0;
  for (std::uint32_t p = 0; p < contact.count; ++p) {
    for (std::uint32_t q = 0; q < old.count; ++q) {
      if (old.features[q] != contact.features[p]) continue;
      contact.normal_impulse[p] = old.normal_impulse[q];
      found[p] = claimed[q] = true;
    }
    missing += found[p] ? 0u : 1u;
  }
  V left = V(0);
  for (std::uint32_t q = 0; q < old.count; ++q) left += claimed[q] ? V(0) : old.normal_impulse[q];
  if (missing == 0 || !(left > V(0))) return;
  const V share = left / V(missing);
  for (std::uint32_t p = 0; p < contact.count; ++p) {
    if (!found[p]) contact.normal_impulse[p] = share;
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

/// visit(child_a, child_b, manifold, from_a_to_b) for every two parts within the margin, in order of their indices.
/// Frames: everything relative to a's centre of mass, axes as the world's: far from the origin costs no precision.
template <class S>
template <class Visit>
ISO_INLINE void WorldEngine<S>::visit_manifolds(std::uint32_t slot_a, std::uint32_t slot_b, S margin,
                                                Visit&& visit) const {
  const Location at_a = locations_[slot_a], at_b = locations_[slot_b];
  const BodyState<S>& state_a = state_at(at_a);
  const BodyState<S>& state_b = state_at(at_b);
  const BodyProperties<S>& body_a = properties_at(at_a);
  const BodyProperties<S>& body_b = properties_at(at_b);
  const std::span<const Child<S>> children_a = children_of(body_a.shape), children_b = children_of(body_b.shape);
  const auto rotation = [&](Location at, const BodyState<S>& state) {
    return at.set == Location::kAwake && at.index < rotations_.size() ? rotations_[at.index]
                                                                      : to_matrix(state.orientation);
  };
  const Mat3<Unit<S>> turn_a = rotation(at_a, state_a), turn_b = rotation(at_b, state_b);
  const Vec3<S> from_a_to_b = state_b.centre - state_a.centre;
  const Transform<S> origin_a = {-(turn_a * body_a.local_centre), turn_a};
  const Transform<S> origin_b = {from_a_to_b - turn_b * body_b.local_centre, turn_b};
  const auto placed = [](const Transform<S>& origin, const Child<S>& child) {
    return child.pose.is_identity() ? origin : compose(origin, Transform<S>::of(child.pose));
  };
  const bool several = children_a.size() > 1 || children_b.size() > 1;
  Manifold<S> manifold;
  for (std::uint32_t i = 0; i < children_a.size(); ++i) {
    const Transform<S> ta = placed(origin_a, children_a[i]);
    const Aabb<S> box_a = several ? grow(bounds(children_a[i].primitive, ta), margin) : Aabb<S>{};
    for (std::uint32_t j = 0; j < children_b.size(); ++j) {
      const Transform<S> tb = placed(origin_b, children_b[j]);
      if (several && !overlap(box_a, bounds(children_b[j].primitive, tb))) continue;
      collide(children_a[i].primitive, ta, children_b[j].primitive, tb, margin, manifold);
      if (manifold.count > 0 && !visit(i, j, manifold, from_a_to_b)) return;
    }
  }
}

template <class S> bool WorldEngine<S>::bodies_touch(std::uint32_t slot_a, std::uint32_t slot_b) const {
  bool touch = false;
  visit_manifolds(slot_a, slot_b, detail::kSpeculativeDistance<S>,
                  [&](std::uint32_t, std::uint32_t, const Manifold<S>&, Vec3<S>) {
                    touch = true;
                    return false;
                  });
  return touch;
}

/// An island wakes when something awake that moves has a contact with it. Waking brings new pairs, so until none is
/// left.
template <class S> void WorldEngine<S>::wake_touched_islands() {
  if (state_.frozen.empty()) return;
  rotations_.clear();
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
    for (const std::uint32_t slot : touched) thaw_body(slot);
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
void WorldEngine<S>::add_contact(const ContactKey& key, const Manifold<S>& manifold, const BodyProperties<S>& a,
                                 const BodyProperties<S>& b, Vec3<S> from_a_to_b) {
  Contact<S> contact = {};
  contact.key = key;
  contact.count = static_cast<std::uint32_t>(manifold.count);
  ContactGeometry<S> g;
  g.row_a = row_of(key.body_a);
  g.row_b = row_of(key.body_b);
  g.normal = manifold.normal;
  g.material = mix(a.material, b.material);
  for (std::uint32_t p = 0; p < contact.count; ++p) {
    const ManifoldPoint<S>& point = manifold.points[p];
    contact.features[p] = point.feature;
    g.points[p] = {point.position, point.position - from_a_to_b, point.separation};
  }
  while (old_cursor_ < old_contacts_.size() && old_contacts_[old_cursor_].key < key) ++old_cursor_;
  if (old_cursor_ < old_contacts_.size() && old_contacts_[old_cursor_].key == key) {
    const Contact<S>& old = old_contacts_[old_cursor_];
    contact.flags = old.flags;
    contact.friction_impulse = old.friction_impulse;
    contact.twist_impulse = old.twist_impulse;
    detail::inherit_impulses(old, contact);
  }
  state_.contacts.push_back(contact);
  geometry_.push_back(g);
}

template <class S> void WorldEngine<S>::update_manifolds() {
  collect_joined_pairs();
  rotations_.resize(state_.awake.states.size());
  for (std::size_t i = 0; i < rotations_.size(); ++i) rotations_[i] = to_matrix(state_.awake.states[i].orientation);
  old_contacts_.swap(state_.contacts);
  state_.contacts.clear();
  geometry_.clear();
  new_overlaps_.clear();
  old_cursor_ = 0;
  std::size_t joined = 0;
  for (const std::uint64_t key : proxies_.pairs()) {
    while (joined < joined_pairs_.size() && joined_pairs_[joined] < key) ++joined;
    if (joined < joined_pairs_.size() && joined_pairs_[joined] == key) continue;
    const std::uint32_t a = pair_a(key), b = pair_b(key);
    const BodyProperties<S>& body_a = properties_at(locations_[a]);
    const BodyProperties<S>& body_b = properties_at(locations_[b]);
    const bool sensor_a = (body_a.flags & body_flag::kSensor) != 0, sensor_b = (body_b.flags & body_flag::kSensor) != 0;
    if (sensor_a || sensor_b) {
      if (sensor_a && sensor_b) continue;
      visit_manifolds(a, b, S(0), [&](std::uint32_t, std::uint32_t, const Manifold<S>&, Vec3<S>) {
        new_overlaps_.push_back(sensor_a ? SensorOverlap{a, b} : SensorOverlap{b, a});
        return false;
      });
      continue;
    }
    if (locations_[a].is_frozen() || locations_[b].is_frozen()) continue;  // a kinematic body at rest against sleepers
    visit_manifolds(a, b, detail::kSpeculativeDistance<S>,
                    [&](std::uint32_t i, std::uint32_t j, const Manifold<S>& manifold, Vec3<S> from_a_to_b) {
                      add_contact({a, b, i, j}, manifold, body_a, body_b, from_a_to_b);
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
  const auto pair_of = [](const Contact<S>& c) { return pair_key(c.key.body_a, c.key.body_b); };
  const auto touched = [&](const std::vector<Contact<S>>& list, std::size_t& at) {
    const std::uint64_t pair = pair_of(list[at]);
    bool any = false;
    for (; at < list.size() && pair_of(list[at]) == pair; ++at)
      any = any || (list[at].flags & contact_flag::kTouching) != 0;
    return any;
  };
  std::size_t i = 0, j = 0;
  while (i < old_contacts_.size() || j < now.size()) {
    const std::uint64_t none = ~std::uint64_t{0};
    const std::uint64_t old_pair = i < old_contacts_.size() ? pair_of(old_contacts_[i]) : none;
    const std::uint64_t new_pair = j < now.size() ? pair_of(now[j]) : none;
    const std::uint64_t pair = min(old_pair, new_pair);
    const std::size_t first = j;
    const bool was = old_pair == pair && touched(old_contacts_, i);
    const bool is = new_pair == pair && touched(now, j);
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
