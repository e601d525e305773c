// Bodies of partial_state.hpp.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/core/lower_bound.hpp"
#include "isostep/dynamics/records/record_store.hpp"
#include "isostep/world/resimulation/affected_bodies.inl"
#include "isostep/world/resimulation/joined_lists.hpp"
#include "isostep/world/resimulation/partial_state.hpp"
#include "isostep/world/resimulation/same_bits.hpp"

namespace isostep {

// ---- the part

template <class S> std::size_t PartialState<S>::take(WorldState<S>& part) {
  const BodySet<S>& all = now_.awake;
  absent_.assign(now_.body_slots.entries().size(), 0);
  part.awake.states.clear();
  part.awake.properties.clear();
  std::size_t movable = 0;
  for (std::size_t i = 0; i < all.states.size(); ++i) {
    const bool is_dynamic = all.properties[i].type == BodyType::dynamic;
    if (is_dynamic && !affected_.contain(all.states[i].slot)) {
      absent_[all.states[i].slot] = 1;
      continue;
    }
    movable += is_dynamic ? 1u : 0u;
    part.awake.states.push_back(all.states[i]);
    part.awake.properties.push_back(all.properties[i]);
  }
  const auto filter = [](const auto& from, auto& to, const auto& absent) {
    to.clear();
    for (const auto& record : from) {
      if (!absent(record)) to.push_back(record);
    }
  };
  filter(now_.contacts, part.contacts,
         [&](const Contact<S>& c) { return is_absent(c.key.body_a) || is_absent(c.key.body_b); });
  filter(now_.forces, part.forces, [&](const PendingForce<S>& force) { return is_absent(force.slot); });
  filter(now_.moves, part.moves, [&](const PendingMove<S>& move) { return is_absent(move.slot); });
  filter(now_.overlaps, part.overlaps,
         [&](const SensorOverlap& o) { return is_absent(o.sensor) || is_absent(o.other); });
  part.joints.states.clear();
  part.joints.properties.clear();
  for (std::size_t i = 0; i < now_.joints.states.size(); ++i) {
    const JointProperties<S>& joint = now_.joints.properties[i];
    if (is_absent(joint.body_a) || is_absent(joint.body_b)) continue;
    part.joints.states.push_back(now_.joints.states[i]);
    part.joints.properties.push_back(joint);
  }
  part.settings = now_.settings;
  part.tick = now_.tick;
  part.body_slots = now_.body_slots;
  part.shape_slots = now_.shape_slots;
  part.joint_slots = now_.joint_slots;
  part.shapes = now_.shapes;
  part.geometry = now_.geometry;
  part.static_bodies = now_.static_bodies;
  part.untold = now_.untold;
  part.sleeping = now_.sleeping;
  part.records = now_.records;
  part.parts = now_.parts;
  take_records(part);
  return movable;
}

/// Takes the records away that name an absent body: they would find none.
template <class S> void PartialState<S>::take_records(WorldState<S>& part) const {
  if (now_.records->kinds() == 0) return;
#define ISO_TAKE(name, Record, Id, S)                                                            \
  for (std::uint32_t slot = 0; slot < now_.records->name##s.all().size(); ++slot) {              \
    if (now_.records->name##s.is_taken(slot) && names_absent(now_.records->name##s.all()[slot])) \
      part.records.change().name##s.remove_at(slot);                                             \
  }
  ISO_FOR_EACH_RECORD(ISO_TAKE, S)
#undef ISO_TAKE
}
template <class S> template <class Record> bool PartialState<S>::names_absent(const Record& record) const {
  bool absent = false;
  detail::for_each_named(record, map_, [&](std::uint32_t slot) { absent = absent || is_absent(slot); });
  return absent;
}
template <class S> template <class Record> bool PartialState<S>::names_affected(const Record& record) const {
  bool affected = false;
  detail::for_each_named(record, map_, [&](std::uint32_t slot) { affected = affected || affected_.contain(slot); });
  return affected;
}

// ---- the whole

template <class S>
bool PartialState<S>::fit(const WorldState<S>& part, const WorldState<S>& stepped, const WorldState<S>& old_before,
                          const WorldState<S>& old_after) const {
  return !changed_ground(part, stepped, old_before, old_after) && sleepers_fit(stepped, old_before, old_after) &&
         same_unaffected(stepped.awake, old_after.awake);
}

template <class S>
void PartialState<S>::join(const WorldState<S>& stepped, const WorldState<S>& old_before, WorldState<S>& after) {
  const auto affected = [&](std::uint32_t slot) ISO_INLINE_LAMBDA { return affected_.contain(slot); };
  const auto slot_of = [](const auto& pending) ISO_INLINE_LAMBDA { return pending.slot; };
  const auto owns_pending = [&](const auto& pending) ISO_INLINE_LAMBDA { return affected(pending.slot); };
  if (!detail::all_same(now_.sleeping, stepped.sleeping, detail::SameObject{})) after.sleeping = stepped.sleeping;
  else if (detail::all_same(old_before.sleeping, after.sleeping, detail::SameObject{})) after.sleeping = now_.sleeping;
  detail::replace_owned_rows(
      after.awake, stepped.awake,
      [&](detail::SetRow<BodySet<S>> row) ISO_INLINE_LAMBDA { return affected(row.slot()); }, scratch_.awake);
  detail::replace_owned_rows(
      after.joints, stepped.joints,
      [&](detail::SetRow<JointSet<S>> row)
          ISO_INLINE_LAMBDA { return affected(row.properties().body_a) || affected(row.properties().body_b); },
      scratch_.joints);
  detail::replace_owned(
      after.contacts, stepped.contacts,
      [](const Contact<S>& contact) ISO_INLINE_LAMBDA -> const ContactKey& { return contact.key; },
      [&](const Contact<S>& contact) ISO_INLINE_LAMBDA { return affected_.contain_one_of(contact); },
      scratch_.contacts);
  detail::replace_owned(after.forces, stepped.forces, slot_of, owns_pending, scratch_.forces);
  detail::replace_owned(after.moves, stepped.moves, slot_of, owns_pending, scratch_.moves);
  detail::replace_owned(
      after.overlaps, stepped.overlaps, [](const SensorOverlap& o) ISO_INLINE_LAMBDA { return o; },
      [&](const SensorOverlap& o) ISO_INLINE_LAMBDA { return affected(o.sensor) || affected(o.other); },
      scratch_.overlaps);
  join_records(stepped, after);
  after.body_slots = now_.body_slots;
  after.joint_slots = now_.joint_slots;
  after.shapes = now_.shapes;
  after.static_bodies = now_.static_bodies;
  after.records = now_.records;
}

/// Returns true if a step changed what is of no single body: a joint or a record ended, something waits to be told.
template <class S>
bool PartialState<S>::changed_ground(const WorldState<S>& part, const WorldState<S>& stepped,
                                     const WorldState<S>& old_before, const WorldState<S>& old_after) const {
  const auto changed = [](const WorldState<S>& before, const WorldState<S>& after) {
    return !after.records.is_same(before.records) || !detail::all_same(after.joint_slots, before.joint_slots) ||
           !detail::all_same(after.body_slots, before.body_slots) || !after.untold.woke.empty() ||
           !after.untold.contact_end.empty() || !after.untold.sensor_end.empty() || !after.untold.sensors.empty();
  };
  return changed(part, stepped) || changed(old_before, old_after);
}

/// Islands that fall asleep or wake change places in the list. The list of one step is that of both if the other step
/// changed none, and both began with the same.
template <class S>
bool PartialState<S>::sleepers_fit(const WorldState<S>& stepped, const WorldState<S>& old_before,
                                   const WorldState<S>& old_after) const {
  const auto same = [](const SleepingIslands<S>& a, const SleepingIslands<S>& b) {
    return detail::all_same(a, b, detail::SameObject{});
  };
  const bool fresh = !same(now_.sleeping, stepped.sleeping), old = !same(old_before.sleeping, old_after.sleeping);
  if (fresh && old) return false;
  if (old && !detail::same_bits(now_.untold.woke, old_before.untold.woke)) return false;  // both tell of waking
  if (fresh) return are_affected(now_.sleeping, stepped.sleeping, true);
  return !old ||
         (same(now_.sleeping, old_before.sleeping) && are_affected(old_before.sleeping, old_after.sleeping, false));
}
/// Returns true if the bodies of all islands that only one list has, at their place, are affected, or if none is.
/// An island that moved to another place of the list counts as one of both.
template <class S>
bool PartialState<S>::are_affected(const SleepingIslands<S>& a, const SleepingIslands<S>& b, bool expected) const {
  std::vector<const SleepingIsland<S>*> gone, come;
  detail::each_other(a, b, detail::SameObject{}, [&](std::size_t i) {
    if (i < a.size()) gone.push_back(a[i].get());
    if (i < b.size()) come.push_back(b[i].get());
  });
  const auto holds = [](const auto& list, const SleepingIsland<S>* island) {
    for (const SleepingIsland<S>* other : list) {
      if (other == island) return true;
    }
    return false;
  };
  bool all = true;
  const auto judge = [&](const SleepingIsland<S>* island) {
    for (const BodyState<S>& body : island->bodies.states) all = all && affected_.contain(body.slot) == expected;
  };
  for (const SleepingIsland<S>* island : gone) {
    if (!holds(come, island)) judge(island);
  }
  for (const SleepingIsland<S>* island : come) {
    if (!holds(gone, island)) judge(island);
  }
  return all;
}

/// Returns true if the part's bodies that are not affected, which are kinematic, end as in the known step.
template <class S> bool PartialState<S>::same_unaffected(const BodySet<S>& stepped, const BodySet<S>& old) const {
  for (std::size_t i = 0; i < stepped.states.size(); ++i) {
    const BodyState<S>& state = stepped.states[i];
    if (affected_.contain(state.slot)) continue;
    const std::size_t at = place_of_slot(old.states, state.slot);
    if (at == old.states.size() || !detail::same_bits(state, old.states[at]) ||
        !detail::same_bits(stepped.properties[i], old.properties[at]))
      return false;
  }
  return true;
}

template <class S> void PartialState<S>::join_records(const WorldState<S>& stepped, WorldState<S>& after) const {
  if (now_.records->kinds() == 0) return;
  const auto join = [&](const auto& registry, const auto& from, auto& to) {
    to.resize(from.size());
    for (std::uint32_t slot = 0; slot < to.size(); ++slot) {
      if (!registry.is_taken(slot) || names_affected(registry.all()[slot])) to[slot] = from[slot];
    }
  };
#define ISO_JOIN(name, Record, Id, S)                                                                          \
  if constexpr (requires { detail::inputs_of(after.parts, Id{}); })                                            \
    join(now_.records->name##s, detail::inputs_of(stepped.parts, Id{}), detail::inputs_of(after.parts, Id{})); \
  if constexpr (requires { detail::states_of(after.parts, Id{}); })                                            \
    join(now_.records->name##s, detail::states_of(stepped.parts, Id{}), detail::states_of(after.parts, Id{}));
  ISO_FOR_EACH_RECORD(ISO_JOIN, S)
#undef ISO_JOIN
}

}  // namespace isostep
