// Bodies of affected_bodies.hpp.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/core/lower_bound.hpp"
#include "isostep/dynamics/records/record_store.hpp"
#include "isostep/store/fat_box.hpp"
#include "isostep/world/resimulation/affected_bodies.hpp"
#include "isostep/world/resimulation/same_bits.hpp"

namespace isostep {

namespace detail {
/// Calls visit(a, b) for every record whose key only one of two ascending lists has, or that differs: null for none.
/// Blocks that are equal as a whole cost one comparison.
template <class Record, class Key, class Visit>
ISO_INLINE void each_other(const std::vector<Record>& a, const std::vector<Record>& b, const Key& key,
                           const Visit& visit) {
  constexpr std::size_t kBlock = 16;  // records: a kilobyte or two
  std::size_t i = 0, j = 0;
  while (i < a.size() || j < b.size()) {
    const bool blocks = i + kBlock <= a.size() && j + kBlock <= b.size();
    if (blocks && std::memcmp(&a[i], &b[j], kBlock * sizeof(Record)) == 0) {
      i += kBlock;
      j += kBlock;
      continue;
    }
    // One record at a time up to the end of the block, else the rest of it would be compared for each.
    for (std::size_t n = 0; n < kBlock && (i < a.size() || j < b.size()); ++n) {
      const bool only_a = j == b.size() || (i < a.size() && key(a[i]) < key(b[j]));
      const bool only_b = i == a.size() || (j < b.size() && key(b[j]) < key(a[i]));
      const Record *of_a = only_b ? nullptr : &a[i++], *of_b = only_a ? nullptr : &b[j++];
      if (of_a == nullptr || of_b == nullptr || !same_bits(*of_a, *of_b)) visit(of_a, of_b);
    }
  }
}
/// Calls visit(slot) for the bodies that a record names, and those of its joints.
template <class Record, class S, class Visit>
ISO_INLINE void for_each_named(const Record& record, const BodyMap<S>& map, const Visit& visit) {
  const auto bodies = bodies_of(record);
  for (int i = 0; i < bodies.count; ++i) {
    if (bodies.all[i].body) visit(bodies.all[i].body.slot);
  }
  const NamedJoints joints = joints_of(record);
  for (int i = 0; i < joints.count; ++i) {
    const JointProperties<S>* const joint = map.joints.properties_of(joints.all[i]);
    if (joint == nullptr) continue;
    if (joint->body_a != kNoBody) visit(joint->body_a);
    if (joint->body_b != kNoBody) visit(joint->body_b);
  }
}
}  // namespace detail

template <class S> bool AffectedBodies<S>::find(const WorldState<S>& old, std::size_t most) {
  old_ = &old;
  most_ = most;
  marks_.assign(now_.body_slots.entries().size(), 0);
  slots_.clear();
  boxes_.clear();
  reached_ = 0;
  if (!same_ground() || !mark_tenants() || !mark_records()) return false;
  mark_bodies();
  if (!are_few()) return false;
  mark_sleepers();
  mark_contacts();
  mark_joints();
  mark_pending();
  mark_overlaps();
  mark_untold();
  if (!reach_is_known()) return false;
  while (are_few() && reach_neighbours()) {
    tie_contacts(now_.contacts);
    tie_contacts(old.contacts);
    tie_joints(now_.joints.properties);
    tie_joints(old.joints.properties);
    tie_records(*now_.records);
    if (!now_.records.is_same(old.records)) tie_records(*old.records);
  }
  return are_few();
}

/// Compares what every body may depend on.
template <class S> bool AffectedBodies<S>::same_ground() const {
  const WorldState<S>& old = *old_;
  const auto same_shape = [](const auto& a, const auto& b)
                              ISO_INLINE_LAMBDA { return a == b || (a && b && a->hash == b->hash); };
  bool same = now_.tick == old.tick && now_.settings == old.settings &&
              detail::same_bits(now_.untold.sensors, old.untold.sensors) &&
              detail::all_same(now_.shapes, old.shapes, same_shape) && now_.geometry.is_same(old.geometry) &&
              detail::all_same(now_.shape_slots, old.shape_slots) &&
              now_.static_bodies.pages() == old.static_bodies.pages();
  for (std::size_t p = 0; same && p < old.static_bodies.pages(); ++p) {
    if (now_.static_bodies.shares_page(p, old.static_bodies)) continue;
    const BodySet<S>&a = now_.static_bodies.page(p), &b = old.static_bodies.page(p);
    same = detail::same_bits(a.states, b.states) && detail::same_bits(a.properties, b.properties);
  }
  return same;
}

/// Returns false if a bullet is awake, which looks for others along its way, or a kinematic body that differs is on its
/// way: it may pass what its box does not meet.
template <class S> bool AffectedBodies<S>::reach_is_known() const {
  for (const WorldState<S>* state : {&now_, old_}) {
    for (std::size_t i = 0; i < state->awake.states.size(); ++i) {
      const BodyProperties<S>& body = state->awake.properties[i];
      if (body.type == BodyType::dynamic && (body.flags & body_flag::kBullet) != 0) return false;
      if (body.type != BodyType::kinematic || !contain(state->awake.states[i].slot)) continue;
      const BodyState<S>& its = state->awake.states[i];
      if (!(its.velocity == Vec3<Velocity<S>>::zero() && its.angular_velocity == Vec3<Velocity<S>>::zero()))
        return false;
      const std::size_t move = place_of_slot(state->moves, its.slot);
      if (move < state->moves.size() && state->moves[move].slot == its.slot) return false;
    }
  }
  return true;
}

// ---- what differs

template <class S> void AffectedBodies<S>::mark(std::uint32_t slot) {
  if (slot >= marks_.size()) marks_.resize(slot + 1, 0);
  if (marks_[slot] != 0) return;
  marks_[slot] = 1;
  slots_.push_back(slot);
}
template <class S> void AffectedBodies<S>::mark_movable(std::uint32_t slot) {
  if (slot != kNoBody && is_movable(slot)) mark(slot);
}
template <class S> void AffectedBodies<S>::mark_island(const SleepingIsland<S>& island) {
  for (const BodyState<S>& body : island.bodies.states) mark(body.slot);
}
/// Returns true for a body that others can push: a dynamic one that exists now.
template <class S> bool AffectedBodies<S>::is_movable(std::uint32_t slot) const {
  if (slot >= map_.slot_count()) return false;
  const Location at = map_.location(slot);
  if (at.set == Location::kNone || at.set == Location::kStatic) return false;
  return map_.properties_at(at).type == BodyType::dynamic;
}

/// Marks slots in which another body lives. Returns false if it is a static one.
template <class S> bool AffectedBodies<S>::mark_tenants() {
  bool moves = true;
  detail::each_other(
      now_.body_slots.entries(), old_->body_slots.entries(),
      [](const SlotEntry& a, const SlotEntry& b) ISO_INLINE_LAMBDA { return detail::same_bits(a, b); },
      [&](std::size_t i) ISO_INLINE_LAMBDA {
        const auto slot = static_cast<std::uint32_t>(i);
        mark(slot);
        moves = moves && !(slot < map_.slot_count() && map_.location(slot).set == Location::kStatic);
      });
  return moves;
}

template <class S> void AffectedBodies<S>::mark_bodies() {
  constexpr std::size_t kBlock = 16;  // bodies: two kilobytes of each array
  const BodySet<S>&a = now_.awake, &b = old_->awake;
  const auto same_block = [&](std::size_t i, std::size_t j) ISO_INLINE_LAMBDA {
    return std::memcmp(&a.states[i], &b.states[j], kBlock * sizeof(BodyState<S>)) == 0 &&
           std::memcmp(&a.properties[i], &b.properties[j], kBlock * sizeof(BodyProperties<S>)) == 0;
  };
  const std::size_t of_a = a.states.size(), of_b = b.states.size();
  std::size_t i = 0, j = 0;
  while ((i < of_a || j < of_b) && are_few()) {
    if (i + kBlock <= of_a && j + kBlock <= of_b && same_block(i, j)) {
      i += kBlock;
      j += kBlock;
      continue;
    }
    for (std::size_t n = 0; n < kBlock && (i < of_a || j < of_b); ++n) {
      const bool only_a = j == of_b || (i < of_a && a.states[i].slot < b.states[j].slot);
      const bool only_b = i == of_a || (j < of_b && b.states[j].slot < a.states[i].slot);
      const std::uint32_t slot = only_b ? b.states[j].slot : a.states[i].slot;
      if (only_a || only_b || !detail::same_bits(a.states[i], b.states[j]) ||
          !detail::same_bits(a.properties[i], b.properties[j]))
        mark(slot);
      i += only_b ? 0 : 1;
      j += only_a ? 0 : 1;
    }
  }
}

template <class S> void AffectedBodies<S>::mark_sleepers() {
  detail::each_other(now_.sleeping, old_->sleeping, detail::SameObject{}, [&](std::size_t i) ISO_INLINE_LAMBDA {
    if (i < now_.sleeping.size()) mark_island(*now_.sleeping[i]);
    if (i >= old_->sleeping.size()) return;
    mark_island(*old_->sleeping[i]);
    for (const BodyState<S>& body : old_->sleeping[i]->bodies.states) boxes_.push_back(body.fat);
  });
}

template <class S> void AffectedBodies<S>::mark_contacts() {
  const auto key = [](const Contact<S>& contact) ISO_INLINE_LAMBDA { return contact.key; };
  detail::each_other(now_.contacts, old_->contacts, key, [&](const Contact<S>* a, const Contact<S>* b) {
    const ContactKey& pair = (a != nullptr ? a : b)->key;
    mark_movable(pair.body_a);
    mark_movable(pair.body_b);
  });
}

template <class S> void AffectedBodies<S>::mark_ends(const JointProperties<S>& joint) {
  mark_movable(joint.body_a);
  mark_movable(joint.body_b);
}
template <class S> void AffectedBodies<S>::mark_joints() {
  const JointSet<S>&a = now_.joints, &b = old_->joints;
  // An equal joint in a slot with another id is another joint.
  detail::each_other(
      now_.joint_slots.entries(), old_->joint_slots.entries(),
      [](const SlotEntry& x, const SlotEntry& y) ISO_INLINE_LAMBDA { return detail::same_bits(x, y); },
      [&](std::size_t slot) ISO_INLINE_LAMBDA {
        const std::size_t at = place_of_slot(a.states, static_cast<std::uint32_t>(slot));
        if (at < a.states.size() && a.states[at].slot == slot) mark_ends(a.properties[at]);
      });
  std::size_t i = 0, j = 0;
  while (i < a.states.size() || j < b.states.size()) {
    const bool only_a = j == b.states.size() || (i < a.states.size() && a.states[i].slot < b.states[j].slot);
    const bool only_b = i == a.states.size() || (j < b.states.size() && b.states[j].slot < a.states[i].slot);
    const bool same = !only_a && !only_b && detail::same_bits(a.states[i], b.states[j]) &&
                      detail::same_bits(a.properties[i], b.properties[j]);
    if (!same && !only_b) mark_ends(a.properties[i]);
    if (!same && !only_a) mark_ends(b.properties[j]);
    i += only_b ? 0 : 1;
    j += only_a ? 0 : 1;
  }
}

/// Marks bodies that forces or targets wait for.
template <class S> void AffectedBodies<S>::mark_pending() {
  const auto slot_of = [](const auto& pending) ISO_INLINE_LAMBDA { return pending.slot; };
  const auto mark_one = [&](const auto* a, const auto* b) { mark((a != nullptr ? a : b)->slot); };
  detail::each_other(now_.forces, old_->forces, slot_of, mark_one);
  detail::each_other(now_.moves, old_->moves, slot_of, mark_one);
}

template <class S> void AffectedBodies<S>::mark_overlaps() {
  const auto self = [](const SensorOverlap& overlap) ISO_INLINE_LAMBDA { return overlap; };
  detail::each_other(now_.overlaps, old_->overlaps, self, [&](const SensorOverlap* a, const SensorOverlap* b) {
    mark_movable((a != nullptr ? a : b)->sensor);
    mark_movable((a != nullptr ? a : b)->other);
  });
}

/// Marks bodies of contacts and overlaps that commands ended in one of the two.
template <class S> void AffectedBodies<S>::mark_untold() {
  const auto mark_pairs = [&](const auto& a, const auto& b, const auto& slots_of) {
    if (detail::same_bits(a, b)) return;
    for (const auto* list : {&a, &b}) {
      for (const auto& end : *list) slots_of(end);
    }
  };
  mark_pairs(now_.untold.contact_end, old_->untold.contact_end, [&](const ContactEnd& end) {
    mark(end.a.slot);
    mark(end.b.slot);
  });
  mark_pairs(now_.untold.sensor_end, old_->untold.sensor_end, [&](const SensorEvent& end) {
    mark(end.sensor.slot);
    mark(end.other.slot);
  });
}

/// Marks the bodies of records that differ, or whose inputs or states do. Returns false if such a record names none,
/// for it is about all, or if there are records that see bodies beyond those that they name.
template <class S> bool AffectedBodies<S>::mark_records() {
  const RecordStore<S>&now = *now_.records, &old = *old_->records;
  if (now.kinds() == 0 && old.kinds() == 0) return true;
  bool known = true;
  const auto mark_parts = [&](const auto& records, const auto& a, const auto& b) {
    for (std::size_t slot = 0; slot < records.size(); ++slot) {
      const bool same = slot < a.size() && slot < b.size() && detail::same_bits(a[slot], b[slot]);
      if (!same) detail::for_each_named(records[slot], map_, [&](std::uint32_t body) { mark_movable(body); });
    }
  };
#define ISO_MARK(name, Record, Id, S)                                                                         \
  if (detail::RecordRules<Record>::kSeesOthers && !(now.name##s.all().empty() && old.name##s.all().empty()))  \
    return false;                                                                                             \
  known = known && mark_records(now.name##s, old.name##s);                                                    \
  if constexpr (requires { detail::inputs_of(now_.parts, Id{}); })                                            \
    mark_parts(now.name##s.all(), detail::inputs_of(now_.parts, Id{}), detail::inputs_of(old_->parts, Id{})); \
  if constexpr (requires { detail::states_of(now_.parts, Id{}); })                                            \
    mark_parts(now.name##s.all(), detail::states_of(now_.parts, Id{}), detail::states_of(old_->parts, Id{}));
  ISO_FOR_EACH_RECORD(ISO_MARK, S)
#undef ISO_MARK
  return known;
}
template <class S>
template <class Record, class IdType>
bool AffectedBodies<S>::mark_records(const Registry<Record, IdType>& now, const Registry<Record, IdType>& old) {
  const bool same_slots = detail::all_same(now.slot_map(), old.slot_map());
  if (same_slots && (&now.all() == &old.all() || detail::same_bits(now.all(), old.all()))) return true;
  bool known = true;
  const std::size_t most = max(now.all().size(), old.all().size());
  for (std::uint32_t slot = 0; slot < most; ++slot) {
    const bool is = slot < now.all().size() && now.is_taken(slot), was = slot < old.all().size() && old.is_taken(slot);
    const bool same =
        is == was &&
        (!is || (detail::same_bits(now.all()[slot], old.all()[slot]) &&
                 now.slot_map().template id_of<IdType>(slot) == old.slot_map().template id_of<IdType>(slot)));
    if (same) continue;
    int named = 0;
    const auto mark_one = [&](std::uint32_t body) {
      mark(body);
      ++named;
    };
    if (is) detail::for_each_named(now.all()[slot], map_, mark_one);
    if (was) detail::for_each_named(old.all()[slot], map_, mark_one);
    known = known && named > 0;
  }
  return known;
}

// ---- what that reaches

/// Marks the neighbours of bodies that were marked since the last call. Returns false if there were none.
template <class S> bool AffectedBodies<S>::reach_neighbours() {
  if (reached_ == slots_.size() && boxes_.empty()) return false;
  for (const Aabb<S>& box : boxes_) reach(box);
  boxes_.clear();
  while (reached_ < slots_.size() && are_few()) {
    const std::uint32_t slot = slots_[reached_++];
    const Location at = slot < map_.slot_count() ? map_.location(slot) : Location{};
    const bool exists = at.set != Location::kNone;
    if (exists) reach(map_.state_at(at).fat);
    const std::size_t i = place_of_slot(old_->awake.states, slot);
    const bool existed = i < old_->awake.states.size() && old_->awake.states[i].slot == slot;
    if (existed && !(exists && map_.state_at(at).fat == old_->awake.states[i].fat)) reach(old_->awake.states[i].fat);
  }
  return true;
}
template <class S> void AffectedBodies<S>::reach(const Aabb<S>& box) {
  proxies_.boxes().query(box, [&](std::uint32_t other) {
    if (contain(other) || !is_movable(other)) return true;
    const Location at = map_.location(other);
    if (!overlap(box, map_.state_at(at).fat)) return true;
    if (at.is_asleep()) mark_island(*now_.sleeping[at.set]);
    else mark(other);
    return true;
  });
}

template <class S> void AffectedBodies<S>::tie(std::uint32_t a, std::uint32_t b) {
  if (a == kNoBody || b == kNoBody || contain(a) == contain(b)) return;
  mark_movable(contain(a) ? b : a);
}
template <class S> void AffectedBodies<S>::tie_contacts(const std::vector<Contact<S>>& contacts) {
  for (const Contact<S>& contact : contacts) tie(contact.key.body_a, contact.key.body_b);
}
template <class S> void AffectedBodies<S>::tie_joints(const std::vector<JointProperties<S>>& joints) {
  for (const JointProperties<S>& joint : joints) tie(joint.body_a, joint.body_b);
}
template <class S> void AffectedBodies<S>::tie_records(const RecordStore<S>& records) {
  if (records.kinds() == 0) return;
#define ISO_TIE(name, Record, Id, S) \
  for (const Record& record : records.name##s.all()) tie_record(record);
  ISO_FOR_EACH_RECORD(ISO_TIE, S)
#undef ISO_TIE
}
template <class S> template <class Record> void AffectedBodies<S>::tie_record(const Record& record) {
  bool affected = false;
  detail::for_each_named(record, map_, [&](std::uint32_t body) { affected = affected || contain(body); });
  if (affected) detail::for_each_named(record, map_, [&](std::uint32_t body) { mark_movable(body); });
}
}  // namespace isostep
