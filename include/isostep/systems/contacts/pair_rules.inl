// Bodies of pair_rules.hpp.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/collision/broadphase/pairs.hpp"
#include "isostep/store/body_frames.inl"
#include "isostep/store/contact_pairs.hpp"
#include "isostep/store/fat_box.hpp"
#include "isostep/systems/contacts/pair_rules.hpp"

namespace isostep {

namespace detail {
/// [m] A shallower overlap from the wrong side counts as near only: a body that slides from a floor onto the one beside
/// it may meet its side first, as deep as it lies in the floor.
template <class S> inline constexpr S kPassingDepth = S(0x1p-7);
}  // namespace detail

template <class S> void PairRules<S>::update(std::span<const std::uint64_t> pairs) {
  apart_.clear();
  end_ghosts();
  add_kinds(pairs);
  add_mounts(pairs);
  sort();
  ghosts_ = apart_.size();
  ways_.update(state_.records->one_ways,
               [&](std::uint32_t slot) { return map_.state_at(map_.location(slot)).orientation; });
  if (!ways_.empty()) judge_pairs(pairs);
}

template <class S> void PairRules<S>::sort() {
  if (apart_.empty()) return;
  scratch_.resize(apart_.size());
  stable_sort(apart_.data(), scratch_.data(), static_cast<std::uint32_t>(apart_.size()), OwnKey{});
}

// ---- ghosts

template <class S> void PairRules<S>::end_ghosts() {
  const auto& ghosts = state_.records->ghosts;
  ended_.clear();
  for (std::uint32_t slot = 0; slot < ghosts.all().size(); ++slot) {
    if (!ghosts.is_taken(slot)) continue;
    const Ghost<S>& ghost = ghosts.all()[slot];
    if (still_meet(ghost.a, ghost.b)) apart_.push_back(pair_key(ghost.a.slot, ghost.b.slot));
    else ended_.push_back(slot);
  }
  if (ended_.empty()) return;
  auto& changed = state_.records.change().ghosts;
  for (const std::uint32_t slot : ended_) changed.remove_at(slot);
}

/// Adds the pairs of kinds that pass each other.
template <class S> void PairRules<S>::add_kinds(std::span<const std::uint64_t> pairs) {
  kinds_.update(state_.records->kind_ghosts);
  if (kinds_.empty()) return;
  const auto kind = [&](std::uint32_t slot) { return map_.properties_at(map_.location(slot)).material.kind; };
  for (const std::uint64_t key : pairs) {
    if (kinds_.find(kind(pair_a(key)), kind(pair_b(key))) != nullptr) apart_.push_back(key);
  }
}

/// Adds each sensor with its carrier, and all pairs of a sensor whose carrier is disabled.
template <class S> void PairRules<S>::add_mounts(std::span<const std::uint64_t> pairs) {
  const std::vector<SensorMount<S>>& mounts = state_.records->sensor_mounts.all();
  bool any_blind = false;
  for (const SensorMount<S>& mount : mounts) {
    if (!mount.sensor) continue;
    const std::uint32_t sensor = mount.sensor.slot, on = mount.on.slot;
    apart_.push_back(pair_key(min(sensor, on), max(sensor, on)));
    any_blind = any_blind || !map_.is_enabled(on);
  }
  if (!any_blind) return;
  blind_.assign(state_.body_slots.entries().size(), 0);
  for (const SensorMount<S>& mount : mounts) {
    if (mount.sensor && !map_.is_enabled(mount.on.slot)) blind_[mount.sensor.slot] = 1;
  }
  for (const std::uint64_t key : pairs) {
    if ((blind_[pair_a(key)] | blind_[pair_b(key)]) != 0) apart_.push_back(key);
  }
}

/// [m] The distance that a character keeps from obstacles. 0 for other bodies.
template <class S> S PairRules<S>::skin_of(BodyId body) const {
  const auto& characters = state_.records->characters;
  const CharacterId id =
      characters.id_where([&](const CharacterSettings<S>& character) { return character.body == body; });
  return id ? characters.find(id)->skin : S(0);
}

/// Returns true if two bodies still meet. Compares only boxes if neither is awake: a command may have moved them.
template <class S> bool PairRules<S>::still_meet(BodyId a, BodyId b) const {
  const std::uint32_t low = min(a.slot, b.slot), high = max(a.slot, b.slot);
  const Location at_low = map_.location(low), at_high = map_.location(high);
  const S margin = detail::kSpeculativeDistance<S> + skin_of(a) + skin_of(b);
  const BodyProperties<S>&of_low = map_.properties_at(at_low), &of_high = map_.properties_at(at_high);
  const Aabb<S> box_low = detail::solid_box(map_, map_.state_at(at_low), of_low);
  const Aabb<S> box_high = detail::solid_box(map_, map_.state_at(at_high), of_high);
  if (!overlap(grow(box_low, margin), box_high)) return false;
  const bool still = at_low.set != Location::kAwake && at_high.set != Location::kAwake;
  // Of a body that has other parts, those that sense do not keep the pair: what they see is no obstacle.
  const bool senses = map_.shapes.is_sensor(of_low) || map_.shapes.is_sensor(of_high);
  return still || bodies_touch(map_, low, high, senses ? ByParts::any : ByParts::solid, margin);
}

template <class S> void PairRules<S>::begin_ghost(std::uint64_t key) {
  const auto id = [&](std::uint32_t slot) { return state_.body_slots.template id_of<BodyId>(slot); };
  state_.records.change().ghosts.add({id(pair_a(key)), id(pair_b(key))}, state_.settings.id_space);
}

// ---- one-way bodies

template <class S> void PairRules<S>::judge_pairs(std::span<const std::uint64_t> pairs) {
  for (const std::uint64_t key : pairs) {
    if (ways_.find(pair_a(key)) == nullptr && ways_.find(pair_b(key)) == nullptr) continue;
    if (!may_judge(key)) continue;
    const Verdict verdict = judge(key);
    if (verdict == Verdict::open || verdict == Verdict::solid) continue;
    if (verdict == Verdict::passes) begin_ghost(key);
    apart_.push_back(key);
  }
  sort();
}

/// Returns false for ghosts, sleepers, sensors and pairs that already have contacts.
template <class S> bool PairRules<S>::may_judge(std::uint64_t key) const {
  const std::uint32_t a = pair_a(key), b = pair_b(key);
  const std::size_t ghost = lower_bound(ghosts_, [&](std::size_t i) { return apart_[i] < key; });
  if (ghost < ghosts_ && apart_[ghost] == key) return false;
  const Location at_a = map_.location(a), at_b = map_.location(b);
  if (at_a.is_asleep() || at_b.is_asleep()) return false;
  if (map_.shapes.is_sensor(map_.properties_at(at_a)) || map_.shapes.is_sensor(map_.properties_at(at_b))) return false;
  return detail::contacts_of<S>(state_.contacts, a, b).empty();
}

/// Judges how a pair meets. One contact in front makes it solid: a body on an edge of several parts touches sides too.
template <class S> typename PairRules<S>::Verdict PairRules<S>::judge(std::uint64_t key) const {
  if (!map_.is_pushed(pair_a(key), pair_b(key))) return Verdict::open;
  constexpr S kMargin = detail::kSpeculativeDistance<S>;
  const Location at_a = map_.location(pair_a(key)), at_b = map_.location(pair_b(key));
  const auto moving = [&](Location at) { return at.set == Location::kStatic ? nullptr : &map_.state_at(at); };
  const Meeting pair = {moving(at_a), moving(at_b), ways_.find(pair_a(key)), ways_.find(pair_b(key))};
  const BodyFrame<S> a = frame_at(map_, at_a), b = frame_at(map_, at_b);
  const Vec3<S> from_a_to_b = b.centre - a.centre;
  Verdict verdict = Verdict::open;
  visit_meetings(map_, a, b, kMargin, [&](std::uint32_t i, std::uint32_t j, PartMeeting meeting) {
    if (meeting != PartMeeting::solid) return true;
    Manifold<S> manifold;
    collide_parts(collide_polyhedra<S>, a, i, b, j, kMargin, manifold);
    if (manifold.count == 0) return true;
    if (is_in_front(pair, manifold, from_a_to_b)) {
      verdict = Verdict::solid;
      return false;
    }
    if (verdict == Verdict::open) verdict = Verdict::nearby;
    for (int p = 0; p < manifold.count; ++p) {
      if (manifold.points[p].separation < -detail::kPassingDepth<S>) verdict = Verdict::passes;
    }
    return true;
  });
  return verdict;
}

/// Returns true if the one-way bodies of the pair stop the other body at this manifold.
template <class S>
bool PairRules<S>::is_in_front(const Meeting& pair, const Manifold<S>& manifold, Vec3<S> from_a_to_b) const {
  ContactGeometry<S> g = {};
  for (int p = 0; p < manifold.count; ++p)
    g.points[p] = {manifold.points[p].position, manifold.points[p].position - from_a_to_b, S(0)};
  const auto arms = detail::ContactArms<S>::middle_of(g, static_cast<std::uint32_t>(manifold.count));
  const Vec3<Velocity<S>> b_from_a = detail::velocity_at<S>(pair.b, arms.b) - detail::velocity_at<S>(pair.a, arms.a);
  const auto stops = [&](const Way<S>* way, Vec3<Unit<S>> outward, Vec3<Velocity<S>> velocity) {
    return way == nullptr || (!(dot(outward, way->axis) < way->least_cosine) && !way->lets_out(velocity));
  };
  return stops(pair.way_a, manifold.normal, b_from_a) && stops(pair.way_b, -manifold.normal, -b_from_a);
}

}  // namespace isostep
