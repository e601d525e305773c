// WorldEngine: hashing, loading, and the portable form.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/geometry/limits.hpp"
#include "isostep/geometry/validate.hpp"
#include "isostep/state/hash.hpp"
#include "isostep/world/engine.hpp"
#include "isostep/world/engine_sleep.inl"

namespace isostep {

namespace detail {
inline constexpr std::uint32_t kMaxRecords = 1u << 24;  // of any kind in a file; more is a damaged count

inline std::uint64_t hash_slots(const SlotMap& slots) {
  HashCombiner root;
  root.add(slots.first_free());
  root.add(hash_records(slots.entries().data(), slots.entries().size()));
  return root.value();
}
inline void write_slots(Writer& writer, const SlotMap& slots) {
  writer.write(slots.first_free());
  writer.write_array(slots.entries());
}
inline void read_slots(Reader& reader, SlotMap& slots) {
  const auto first_free = reader.read<std::uint32_t>();
  std::vector<SlotEntry> entries;
  reader.read_array(entries, kMaxRecords);
  if (reader.ok() && !slots.restore(entries, first_free)) reader.fail(ErrorCode::corrupt, "a slot table's free list is broken");
}
}  // namespace detail

/// Root: settings, tick, slot tables, arrays, then the frozen islands' own hashes, in this order.
template <class S> std::uint64_t WorldEngine<S>::hash() const {
  HashCombiner root;
  root.add(hash_records_by_fields(&state_.settings, 1));
  root.add(state_.tick);
  root.add(detail::hash_slots(state_.body_slots));
  root.add(detail::hash_slots(state_.shape_slots));
  root.add(detail::hash_slots(state_.joint_slots));
  WorldState<S>::sections([&](const char*, const auto& array) { root.add(hash_records(array.data(), array.size())); }, state_);
  for (const std::shared_ptr<const FrozenIsland<S>>& island : state_.frozen) root.add(island->hash);
  return root.value();
}

template <class S> void WorldEngine<S>::load(const WorldState<S>& from) {
  state_ = from;
  events_.clear();
  report_ = {};
  fault_ = Fault::none;
  woke_reported_ = 0;
  start_slots_.clear();
  refresh_caches();
}

/// Locations anew; the broad phase only where a body differs from what it knew.
template <class S> void WorldEngine<S>::refresh_caches() {
  locations_.assign(state_.body_slots.entries().size(), Location{});
  joint_locations_.assign(state_.joint_slots.entries().size(), Location{});
  const auto take = [&](const BodySet<S>& set, std::uint32_t name, bool awake) {
    relabel(set, name, 0);
    for (std::size_t i = 0; i < set.states.size(); ++i) proxies_.place(set.states[i], set.properties[i], awake);
  };
  take(state_.fixed, Location::kFixed, false);
  take(state_.awake, Location::kAwake, true);
  relabel_joints(state_.joints, Location::kAwake, 0);
  for (std::uint32_t i = 0; i < state_.frozen.size(); ++i) {
    take(state_.frozen[i]->bodies, i, false);
    relabel_joints(state_.frozen[i]->joints, i, 0);
  }
  for (std::uint32_t slot = 0; slot < proxies_.slots(); ++slot) {
    if (slot >= locations_.size() || locations_[slot].set == Location::kNone) proxies_.remove(slot);
  }
}

template <class S> void WorldEngine<S>::write_portable(Writer& writer) const {
  writer.write(ScalarTraits<S>::kId);
  writer.write(state_.settings);
  writer.write(state_.tick);
  detail::write_slots(writer, state_.body_slots);
  detail::write_slots(writer, state_.shape_slots);
  detail::write_slots(writer, state_.joint_slots);
  WorldState<S>::sections([&](const char*, const auto& array) { writer.write_array(array); }, state_);
  writer.write_count(state_.frozen.size());
  for (const std::shared_ptr<const FrozenIsland<S>>& island : state_.frozen) {
    FrozenIsland<S>::sections([&](const char*, const auto& array) { writer.write_array(array); }, *island);
  }
}

/// Whether a state read from outside keeps every rule that the step relies on; null, or the rule that it breaks.
template <class S> class StateValidator {
 public:
  explicit StateValidator(const WorldState<S>& state) : state_(state) {}

  const char* broken_rule() {
    const Settings<S>& s = state_.settings;
    if (s.hz < 10 || s.hz > 1000 || s.substeps < 1 || s.substeps > 64 || s.hz * s.substeps > kMaxRate || !is_finite(s.gravity) ||
        !detail::within(s.gravity, Limits<S>::speed()) || s.solver != SolverName::soft_step) {
      return "settings out of range";
    }
    body_met_.assign(state_.body_slots.entries().size(), 0);
    joint_met_.assign(state_.joint_slots.entries().size(), 0);
    if (const char* rule = shapes()) return rule;
    if (const char* rule = bodies(state_.fixed, true)) return rule;
    if (const char* rule = bodies(state_.awake, false)) return rule;
    for (const auto& island : state_.frozen) {
      if (const char* rule = bodies(island->bodies, false)) return rule;
      if (island->bodies.states.empty()) return "a frozen island is empty";
    }
    if (!all_met(state_.body_slots, body_met_)) return "a body's slot is taken but has no body";
    if (const char* rule = links(state_.contacts, state_.joints)) return rule;
    for (const auto& island : state_.frozen) {
      if (const char* rule = links(island->contacts, island->joints)) return rule;
    }
    if (!all_met(state_.joint_slots, joint_met_)) return "a joint's slot is taken but has no joint";
    return others();
  }

 private:
  static bool all_met(const SlotMap& slots, const std::vector<std::uint8_t>& met) {
    for (std::uint32_t i = 0; i < met.size(); ++i) {
      if (slots.is_taken(i) != (met[i] != 0)) return false;
    }
    return true;
  }
  bool is_body(std::uint32_t slot) const { return slot < body_met_.size() && body_met_[slot] != 0; }

  const char* shapes() {
    if (state_.shapes.size() != state_.shape_slots.entries().size()) return "as many shapes as shape slots";
    for (std::uint32_t i = 0; i < state_.shapes.size(); ++i) {
      const ShapeRecord& shape = state_.shapes[i];
      if (!state_.shape_slots.is_taken(i)) continue;
      if (shape.first_child > state_.children.size() || shape.child_count > state_.children.size() - shape.first_child) {
        return "a shape's parts lie outside the pool";
      }
      const std::span<const Child<S>> parts(state_.children.data() + shape.first_child, shape.child_count);
      if (validate(parts) != ShapeFault::none) return "a shape is not valid";
    }
    return nullptr;
  }
  const char* bodies(const BodySet<S>& set, bool fixed) {
    if (set.states.size() != set.properties.size()) return "as many bodies as properties";
    for (std::size_t i = 0; i < set.states.size(); ++i) {
      const BodyState<S>& b = set.states[i];
      const BodyProperties<S>& p = set.properties[i];
      if (b.slot >= body_met_.size() || body_met_[b.slot] != 0) return "a body's slot is unknown or twice used";
      if (i > 0 && !(set.states[i - 1].slot < b.slot)) return "bodies ascend by slot";
      body_met_[b.slot] = p.type == BodyType::dynamic && &set == &state_.awake ? 2 : 1;
      if (p.type > BodyType::dynamic || (p.type == BodyType::fixed) != fixed) return "a body's type does not fit its set";
      if (p.shape >= state_.shapes.size() || !state_.shape_slots.is_taken(p.shape)) return "a body's shape is unknown";
      const Pose<S> pose = {b.centre, b.orientation};
      const Pose<S> axes = {p.local_centre, p.principal};
      if (validate(pose) != ShapeFault::none || validate(axes) != ShapeFault::none || !detail::within(b.centre, Limits<S>::position())) {
        return "a body's pose is out of range";
      }
      if (!is_finite(b.velocity) || !is_finite(b.spin) || !is_finite(b.fat.low) || !is_finite(b.fat.high)) return "a body's number is not finite";
      if (b.fat.high.x < b.fat.low.x || b.fat.high.y < b.fat.low.y || b.fat.high.z < b.fat.low.z) return "a body's box is inside out";
      if (!is_finite(p.mass) || !is_finite(p.kappa) || !is_finite(p.gravity_scale) || (p.type == BodyType::dynamic) != (p.mass > S(0))) {
        return "a body's mass does not fit its type";
      }
    }
    return nullptr;
  }
  const char* links(const std::vector<Contact<S>>& contacts, const JointSet<S>& joints) {
    for (std::size_t i = 0; i < contacts.size(); ++i) {
      const ContactKey& key = contacts[i].key;
      if (!is_body(key.body_a) || !is_body(key.body_b) || !(key.body_a < key.body_b)) return "a contact names no two bodies";
      if (i > 0 && !(contacts[i - 1].key < key)) return "contacts ascend by key";
      if (contacts[i].count < 1 || contacts[i].count > kMaxContactPoints) return "a contact has 1 to 4 points";
    }
    if (joints.states.size() != joints.properties.size()) return "as many joints as properties";
    for (std::size_t i = 0; i < joints.states.size(); ++i) {
      const std::uint32_t slot = joints.states[i].slot;
      if (slot >= joint_met_.size() || joint_met_[slot] != 0) return "a joint's slot is unknown or twice used";
      if (i > 0 && !(joints.states[i - 1].slot < slot)) return "joints ascend by slot";
      joint_met_[slot] = 1;
      const JointProperties<S>& joint = joints.properties[i];
      if (joint.type > JointType::distance || joint.body_a == joint.body_b) return "a joint is of no known type or ties a body to itself";
      for (const std::uint32_t body : {joint.body_a, joint.body_b}) {
        if (body != kNoBody && !is_body(body)) return "a joint names no body";
      }
    }
    return nullptr;
  }
  const char* others() const {
    for (std::size_t i = 0; i < state_.forces.size(); ++i) {
      if (!is_body(state_.forces[i].slot) || body_met_[state_.forces[i].slot] != 2) return "a force acts on no dynamic body that is awake";
      if (i > 0 && !(state_.forces[i - 1].slot < state_.forces[i].slot)) return "forces ascend by slot";
    }
    for (std::size_t i = 0; i < state_.overlaps.size(); ++i) {
      if (!is_body(state_.overlaps[i].sensor) || !is_body(state_.overlaps[i].other)) return "an overlap names no two bodies";
      if (i > 0 && !(state_.overlaps[i - 1] < state_.overlaps[i])) return "overlaps ascend";
    }
    return nullptr;
  }

  const WorldState<S>& state_;
  std::vector<std::uint8_t> body_met_;   // 0 unmet, 1 met, 2 dynamic and awake
  std::vector<std::uint8_t> joint_met_;
};

template <class S> Result<void> WorldEngine<S>::read_portable(Reader& reader) {
  WorldState<S> next;
  if (reader.read<std::uint32_t>() != ScalarTraits<S>::kId && reader.ok()) {
    reader.fail(ErrorCode::incompatible, "written by a world of another scalar");
  }
  reader.read(next.settings);
  reader.read(next.tick);
  detail::read_slots(reader, next.body_slots);
  detail::read_slots(reader, next.shape_slots);
  detail::read_slots(reader, next.joint_slots);
  const auto read_section = [&](const char*, auto& array) { reader.read_array(array, detail::kMaxRecords); };
  WorldState<S>::sections(read_section, next);
  const std::uint32_t islands = reader.read_count(detail::kMaxRecords, 20);
  for (std::uint32_t i = 0; i < islands && reader.ok(); ++i) {
    auto island = std::make_shared<FrozenIsland<S>>();
    FrozenIsland<S>::sections(read_section, *island);
    island->hash = detail::hash_island(*island);
    next.frozen.push_back(island);
  }
  if (reader.ok()) {
    if (const char* rule = StateValidator<S>(next).broken_rule()) reader.fail(ErrorCode::corrupt, rule);
  }
  const Result<void> result = reader.result("world");
  if (reader.ok()) load(next);
  return result;
}

}  // namespace isostep
