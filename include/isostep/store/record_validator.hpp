// RecordValidator: whether the records of a state read from outside keep every rule that the step relies on.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "isostep/collision/broadphase/pairs.hpp"
#include "isostep/core/stable_sort.hpp"
#include "isostep/store/body_map.hpp"
#include "isostep/store/record_checks.hpp"
#include "isostep/store/state.hpp"

namespace isostep {

/// What a state has in its slots of bodies and joints, and in which set.
template <class S> struct SlotTables {
  struct JointAt {
    const JointProperties<S>* joint;
    std::uint32_t set;  // as set_of_body
  };

  std::vector<std::uint32_t> set_of_body;                    // Location::kNone, kStatic, kAwake or a sleeping island
  std::vector<const BodyProperties<S>*> properties_of_body;  // null: there is no body
  std::vector<JointAt> joint_at;

  bool is_body(std::uint32_t slot) const { return slot < set_of_body.size() && set_of_body[slot] != Location::kNone; }
  /// Of a body that is there.
  BodyType type_of(std::uint32_t slot) const { return properties_of_body[slot]->type; }
  bool is_disabled(std::uint32_t slot) const {
    return set_of_body[slot] == Location::kStatic && type_of(slot) != BodyType::static_;
  }
  /// Whether forces move it.
  bool moves(std::uint32_t slot) const {
    return slot != kNoBody && type_of(slot) == BodyType::dynamic && set_of_body[slot] != Location::kStatic;
  }
};

namespace detail {
ISO_INLINE bool lie_in(const SlotMap& slot_map, std::uint32_t space) {
  bool all = true;
  for (std::uint32_t i = 0; i < slot_map.entries().size(); ++i)
    all = all && SlotMap::space_of(slot_map.id_of<BodyId>(i)) == space;
  return all;
}
}  // namespace detail

/// Input:   a state, and tables of it in which every body and joint has its place.
template <class S> class RecordValidator {
 public:
  RecordValidator(const WorldState<S>& state, const SlotTables<S>& seen) : state_(state), seen_(seen) {}

  /// Null, or a sentence for the first rule that is broken.
  const char* broken_rule() const {
    const char* broken = nullptr;
    ForceRecords<S>::members(
        [&](const char*, const auto& registry) {
          if (broken == nullptr) broken = records(registry);
        },
        *state_.force_records);
    if (broken == nullptr) broken = kind_pairs(state_.force_records->material_pairs);
    if (broken == nullptr) broken = one_a_joint(state_.force_records->joint_loads, "two loads have the same joint");
    if (broken == nullptr) broken = one_an_axis(state_.force_records->axis_drives);
    if (broken == nullptr) broken = one_a_body(state_.force_records->breakables, "two breakables have the same body");
    if (broken == nullptr) broken = one_a_body(state_.force_records->characters, "two characters have the same body");
    if (broken == nullptr) broken = one_a_body(state_.force_records->vehicles, "two vehicles have the same body");
    return broken != nullptr ? broken : contact_records();
  }

 private:
  const char* contact_records() const {
    const ForceRecords<S>& all = *state_.force_records;
    const auto part_of = [](const SurfaceVelocity<S>& v) { return std::uint64_t{v.body.slot} << 32 | v.part; };
    if (const char* rule = one_a_key(all.surface_velocitys, part_of, "two belts have the same part")) return rule;
    if (const char* rule = one_a_body(all.one_ways, "two one-way records have the same body")) return rule;
    if (const char* rule = one_a_body(all.hit_reports, "two reports of hits have the same body")) return rule;
    if (const char* rule = one_a_body(all.contact_reports, "two reports of contacts have the same body")) return rule;
    if (const char* rule = one_a_body(all.move_targets, "two targets have the same body")) return rule;
    const auto sensor_of = [](const SensorMount<S>& mount) { return std::uint64_t{mount.sensor.slot}; };
    if (const char* rule = one_a_key(all.sensor_mounts, sensor_of, "two mounts have the same sensor")) return rule;
    if (const char* rule = no_mounted_carrier(all.sensor_mounts)) return rule;
    if (const char* rule = kind_pairs(all.kind_ghosts)) return rule;
    if (const char* rule = kind_pairs(all.kind_responses)) return rule;
    return one_a_key(
        all.ghosts, [](const Ghost<S>& ghost) { return pair_key(ghost.a.slot, ghost.b.slot); },
        "two ghosts have the same bodies");
  }
  template <class Mounts> const char* no_mounted_carrier(const Mounts& all) const {
    std::vector<std::uint8_t> is_mounted(seen_.set_of_body.size(), 0);
    for (const SensorMount<S>& mount : all.all()) {
      if (mount.sensor) is_mounted[mount.sensor.slot] = 1;
    }
    for (const SensorMount<S>& mount : all.all()) {
      if (mount.sensor && is_mounted[mount.on.slot] != 0) return "a sensor is mounted on one that is mounted";
    }
    return nullptr;
  }
  template <class Drives> static const char* one_an_axis(const Drives& all) {
    const auto axis_of = [](const AxisDrive<S>& drive) {
      return std::uint64_t{drive.joint.slot} << 32 | static_cast<std::uint32_t>(drive.axis);
    };
    return one_a_key(all, axis_of, "two drives have the same axis of a joint");
  }
  template <class Records, class KeyOf>
  static const char* one_a_key(const Records& all, const KeyOf& key_of, const char* rule) {
    std::vector<std::uint64_t> keys;
    for (std::uint32_t slot = 0; slot < all.all().size(); ++slot) {
      if (all.is_taken(slot)) keys.push_back(key_of(all.all()[slot]));
    }
    return has_twins(keys) ? rule : nullptr;
  }
  static bool has_twins(std::vector<std::uint64_t>& keys) {
    std::vector<std::uint64_t> scratch(keys.size());
    stable_sort(keys.data(), scratch.data(), static_cast<std::uint32_t>(keys.size()), OwnKey{});
    for (std::size_t i = 1; i < keys.size(); ++i) {
      if (keys[i - 1] == keys[i]) return true;
    }
    return false;
  }
  template <class Record, class IdType> const char* records(const Registry<Record, IdType>& registry) const {
    const std::vector<Record>& all = registry.all();
    if (all.size() != registry.slot_map().entries().size()) return "force records are not one a slot";
    if (!detail::lie_in(registry.slot_map(), state_.settings.id_space)) return "a force's slot is of another id space";
    for (std::uint32_t slot = 0; slot < all.size(); ++slot) {
      if (!registry.is_taken(slot)) {
        if (detail::first_body_of(all[slot]) || detail::second_body_of(all[slot]) ||
            detail::joints_of(all[slot]).all[0]) {
          return "a free force names a body or a joint";
        }
        continue;
      }
      if (detail::fault_of(all[slot]) != Fault::none) return "a force record is out of range";
      const detail::NamedBodies<S> bodies = detail::bodies_of(all[slot]);
      for (int i = 0; i < bodies.count; ++i) {
        if (!names_well(bodies.all[i])) return "a force record names no body that it may act on";
      }
      if (!ties_well(all[slot]))
        return "a spring or a coupling ties two islands, a record names no joint, part or sensor, a character has "
               "a shape that cannot be cast, or direct is to scale masses";
    }
    return nullptr;
  }
  bool names_well(const detail::NamedBody<S>& named) const {
    if (!named.body) return named.may_be_null;
    return state_.body_slots.holds(named.body) && detail::is_as_asked(seen_.type_of(named.body.slot), named.must_be);
  }
  template <class Record> bool ties_well(const Record&) const { return true; }
  bool ties_well(const SurfaceVelocity<S>& surface) const {
    const std::uint32_t shape = seen_.properties_of_body[surface.body.slot]->shape;
    return surface.part == kEveryPart || surface.part < state_.shapes[shape]->children.size();
  }
  bool ties_well(const Character<S>& character) const {
    return detail::can_walk<S>(state_.shapes[seen_.properties_of_body[character.body.slot]->shape]->children);
  }
  bool ties_well(const SensorMount<S>& mount) const {
    return (seen_.properties_of_body[mount.sensor.slot]->flags & body_flag::kSensor) != 0;
  }
  bool ties_well(const KindResponse<S>&) const { return state_.settings.solver != SolverName::direct; }
  bool ties_well(const BodySpring<S>& spring) const {
    const auto is_dynamic = [&](BodyId body) { return body && seen_.type_of(body.slot) == BodyType::dynamic; };
    if (!is_dynamic(spring.a) && !is_dynamic(spring.b)) return false;
    const bool ties = spring.a && spring.b && seen_.moves(spring.a.slot) && seen_.moves(spring.b.slot);
    return !ties || seen_.set_of_body[spring.a.slot] == seen_.set_of_body[spring.b.slot];
  }
  bool ties_well(const JointLoad<S>& load) const { return state_.joint_slots.holds(load.joint); }
  bool ties_well(const AxisDrive<S>& drive) const {
    if (!state_.joint_slots.holds(drive.joint)) return false;
    const JointProperties<S>& joint = *seen_.joint_at[drive.joint.slot].joint;
    return detail::fault_of_joint(drive, joint, substep_rate(state_.settings)) == Fault::none;
  }
  bool ties_well(const Coupling<S>& coupling) const {
    const detail::NamedJoints named = detail::joints_of(coupling);
    const JointProperties<S>* joints[3] = {};
    std::uint32_t set = Location::kNone;  // of those that hold something
    for (int i = 0; i < 3; ++i) {
      if (i == 2 && !named.all[i]) continue;
      if (!state_.joint_slots.holds(named.all[i])) return false;
      const typename SlotTables<S>::JointAt& at = seen_.joint_at[named.all[i].slot];
      joints[i] = at.joint;
      if (!seen_.moves(at.joint->body_a) && !seen_.moves(at.joint->body_b)) continue;
      if (set != Location::kNone && set != at.set) return false;
      set = at.set;
    }
    return detail::fault_of_joints(coupling, joints) == Fault::none;
  }
  template <class Pairs> static const char* kind_pairs(const Pairs& pairs) {
    std::vector<std::uint64_t> kinds;
    for (std::uint32_t slot = 0; slot < pairs.all().size(); ++slot) {
      const std::uint64_t key = kinds_key(pairs.all()[slot].kind_a, pairs.all()[slot].kind_b);
      if (pairs.is_taken(slot)) kinds.push_back(key);
      else if (key != 0) return "a free pair names a kind";
    }
    return has_twins(kinds) ? "two pairs have the same kinds" : nullptr;
  }
  template <class Records> const char* one_a_body(const Records& all, const char* rule) const {
    return one_a_slot(
        all, state_.body_slots, [](const auto& record) { return record.body.slot; }, rule);
  }
  template <class Records> const char* one_a_joint(const Records& all, const char* rule) const {
    return one_a_slot(
        all, state_.joint_slots, [](const auto& record) { return record.joint.slot; }, rule);
  }
  template <class Records, class SlotOf>
  const char* one_a_slot(const Records& all, const SlotMap& slot_map, const SlotOf& slot_of, const char* rule) const {
    std::vector<std::uint8_t> has(slot_map.entries().size(), 0);
    for (std::uint32_t slot = 0; slot < all.all().size(); ++slot) {
      if (all.is_taken(slot) && has[slot_of(all.all()[slot])]++ != 0) return rule;
    }
    return nullptr;
  }

  const WorldState<S>& state_;
  const SlotTables<S>& seen_;
};

}  // namespace isostep
