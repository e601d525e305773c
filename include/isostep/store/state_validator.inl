// Bodies of state_validator.hpp.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "isostep/dynamics/checks.hpp"
#include "isostep/dynamics/joints/joint_checks.hpp"
#include "isostep/geometry/content.hpp"
#include "isostep/geometry/surfaces.hpp"
#include "isostep/store/body_map.hpp"
#include "isostep/store/record_validator.hpp"
#include "isostep/store/state_validator.hpp"

namespace isostep {

namespace detail {

/// Checks one state: `broken_rule` is called once.
template <class S> class StateValidator {
 public:
  explicit StateValidator(const WorldState<S>& state) : state_(state) {}

  const char* broken_rule() {
    const Settings<S>& s = state_.settings;
    if (s.hz < kLeastHz || kMostHz < s.hz || s.substeps < 1 || s.substeps > 64 || substep_rate(s) > kMaxRate ||
        !is_finite(s.gravity) || !detail::within(s.gravity, Limits<S>::speed()) ||
        static_cast<std::uint32_t>(s.solver) >= kSolvers || s.id_space >= SlotMap::kIdSpaces ||
        s.most_pairs < kLeastPairs || kMostPairs < s.most_pairs ||
        static_cast<std::uint32_t>(s.projection) >= kProjections || !is_finite(s.restitution_threshold) ||
        s.restitution_threshold < S(0) || Limits<S>::speed() < s.restitution_threshold) {
      return "settings out of range";
    }
    seen_.set_of_body.assign(state_.body_slots.entries().size(), Location::kNone);
    seen_.properties_of_body.assign(seen_.set_of_body.size(), nullptr);
    leaves_of_body_.assign(seen_.set_of_body.size(), 0);
    seen_.joint_at.assign(state_.joint_slots.entries().size(), {nullptr, 0});
    for (const SlotMap* slot_map : {&state_.body_slots, &state_.shape_slots, &state_.joint_slots}) {
      if (!detail::lie_in(*slot_map, s.id_space)) return "a slot is of another id space";
    }
    if (const char* rule = shapes()) return rule;
    for (std::size_t p = 0; p < state_.static_bodies.pages(); ++p) {
      if (const char* rule = bodies(state_.static_bodies.page(p), Location::kStatic)) return rule;
    }
    if (const char* rule = bodies(state_.awake, Location::kAwake)) return rule;
    for (std::uint32_t i = 0; i < state_.sleeping.size(); ++i) {
      if (const char* rule = bodies(state_.sleeping[i]->bodies, i)) return rule;
      if (state_.sleeping[i]->bodies.states.empty()) return "a sleeping island has no bodies";
    }
    for (std::uint32_t slot = 0; slot < seen_.set_of_body.size(); ++slot) {
      if (state_.body_slots.is_taken(slot) != (seen_.set_of_body[slot] != Location::kNone))
        return "a body's slot is taken but has no body";
    }
    if (const char* rule = links(state_.contacts, state_.joints, Location::kAwake)) return rule;
    for (std::uint32_t i = 0; i < state_.sleeping.size(); ++i) {
      if (const char* rule = links(state_.sleeping[i]->contacts, state_.sleeping[i]->joints, i)) return rule;
    }
    for (std::uint32_t slot = 0; slot < seen_.joint_at.size(); ++slot) {
      if (state_.joint_slots.is_taken(slot) != (seen_.joint_at[slot].joint != nullptr))
        return "a joint's slot is taken but has no joint";
    }
    return others();
  }

 private:
  /// Checks that a taken slot has a valid shape, and a free one a shape without parts.
  const char* shapes() {
    if (state_.shapes.size() != state_.shape_slots.entries().size()) return "as many shapes as shape slots";
    leaves_of_shape_.assign(state_.shapes.size(), 0);
    for (std::uint32_t i = 0; i < state_.shapes.size(); ++i) {
      const std::span<const Child<S>> parts = parts_of(i);
      if (!state_.shape_slots.is_taken(i)) {
        if (!parts.empty()) return "a free shape has no parts";
        continue;
      }
      if (parts.size() > kMaxChildren || validate(parts, state_.geometry->contents()) != ShapeFault::none)
        return "a shape is not valid";
      for (const Child<S>& part : parts) {
        if (detail::fault_of(part.traits) != Fault::none) return "a part's traits are not valid";
        if (!(part.traits == part.traits.normalised())) return "a part's traits are zeros where no flag names them";
      }
      leaves_of_shape_[i] = leaves_of_parts(parts);
    }
    return blobs();
  }
  /// Checks that every blob is used as often as its name says.
  const char* blobs() const {
    const GeometryStore& store = *state_.geometry;
    std::vector<std::uint64_t> uses(store.names().size(), 0);
    for (const auto& shape : state_.shapes) {
      for (const Child<S>& child : shape->children) {
        const std::uint32_t blob = child.primitive.blob;
        const bool exists = blob != 0 && store.is_taken(blob - 1);
        if (blob != 0 && !exists) return "a part names no blob";
        if (exists) ++uses[blob - 1];
      }
    }
    for (std::uint32_t place = 0; place < uses.size(); ++place) {
      const BlobName& name = store.names()[place];
      if (name.uses != uses[place] || (name.uses == 0 && !(name.id == ContentId{})) ||
          (place + 1 == uses.size() && name.uses == 0))
        return "a blob is named more or less often than it is used";
      if (name.uses != 0 && store.find(name.id) != place) return "two blobs have one name";
    }
    return nullptr;
  }
  std::span<const Child<S>> parts_of(std::uint32_t shape) const { return state_.shapes[shape]->children; }
  bool has_part(std::uint32_t body, std::uint32_t child) const {
    return child < parts_of(seen_.properties_of_body[body]->shape).size();
  }

  /// Counts the leaves of valid parts.
  std::uint32_t leaves_of_parts(std::span<const Child<S>> parts) const {
    std::uint32_t leaves = 0;
    for (const Child<S>& part : parts) {
      const std::uint32_t blob = part.primitive.blob;
      leaves +=
          leaves_of<S>({part.primitive, blob == 0 ? nullptr : content_of<S>(*state_.geometry->content(blob - 1))});
    }
    return leaves;
  }

  const char* bodies(const BodySet<S>& set, std::uint32_t name) {
    if (set.states.size() != set.properties.size()) return "as many bodies as properties";
    for (std::size_t i = 0; i < set.states.size(); ++i) {
      const BodyState<S>& b = set.states[i];
      if (b.slot >= seen_.set_of_body.size() || seen_.set_of_body[b.slot] != Location::kNone)
        return "a body's slot is unknown or twice used";
      if (i > 0 && !(set.states[i - 1].slot < b.slot)) return "bodies ascend by slot";
      seen_.set_of_body[b.slot] = name;
      seen_.properties_of_body[b.slot] = &set.properties[i];
      if (const char* rule = properties(set.properties[i], name)) return rule;
      leaves_of_body_[b.slot] = leaves_of_shape_[set.properties[i].shape];
      if (const char* rule = motion(b)) return rule;
    }
    return nullptr;
  }
  const char* properties(const BodyProperties<S>& p, std::uint32_t name) const {
    constexpr std::uint32_t kKnown = body_flag::kSensor | body_flag::kAllowSleep | body_flag::kCollide |
                                     body_flag::kSpins | body_flag::kBullet | body_flag::kDisabled |
                                     body_flag::kReportContacts | body_flag::kAllLocks;
    const bool dynamic_body = p.type == BodyType::dynamic;
    if (p.type > BodyType::dynamic || is_fixed(p) != (name == Location::kStatic) ||
        (name < Location::kAwake && !dynamic_body)) {
      return "a body's type does not fit its set";
    }
    if ((p.flags & ~kKnown) != 0) return "a body has an unknown flag";
    if (p.shape >= state_.shapes.size() || !state_.shape_slots.is_taken(p.shape)) return "a body's shape is unknown";
    if (!detail::is_unit<S>(p.principal) || !is_finite(p.local_centre) ||
        !detail::within(p.local_centre, Limits<S>::extent())) {
      return "a body's centre or axes are out of range";
    }
    const bool even = p.kappa.x == p.kappa.y && p.kappa.y == p.kappa.z;
    const bool spins = (p.flags & body_flag::kSpins) != 0;
    const bool weightless = p.mass == S(0) && p.kappa == Vec3<S>::zero();
    if (dynamic_body ? detail::fault_of_mass(p.mass, p.kappa) != Fault::none || spins == even : !weightless || spins) {
      return "a body's mass does not fit its type";
    }
    if (detail::fault_of(p.material) != Fault::none || p.reserved != S(0) ||
        detail::fault_of_motion(p.gravity_scale, p.linear_damping, p.angular_damping, p.flags & body_flag::kAllLocks) !=
            Fault::none) {
      return "a body's material or damping is out of range";
    }
    return nullptr;
  }
  static const char* motion(const BodyState<S>& b) {
    if (!is_finite(b.centre) || !detail::within(b.centre, Limits<S>::position()) ||
        !detail::is_unit<S>(b.orientation)) {
      return "a body's pose is out of range";
    }
    // Impulses cut speeds a quarter above the limits, axis by axis.
    const S quarter = S(1.25);
    if (!is_finite(b.velocity) || !is_finite(b.angular_velocity) ||
        !detail::within(b.velocity, convert<Velocity<S>>(Limits<S>::speed() * quarter)) ||
        !detail::within(b.angular_velocity, convert<Velocity<S>>(Limits<S>::angular_speed() * quarter))) {
      return "a body's speed is out of range";
    }
    const S edge = Limits<S>::position() + Limits<S>::position() + Limits<S>::position();
    if (!is_finite(b.fat.low) || !is_finite(b.fat.high) || !detail::within(b.fat.low, edge) ||
        !detail::within(b.fat.high, edge) || b.fat.high.x < b.fat.low.x || b.fat.high.y < b.fat.low.y ||
        b.fat.high.z < b.fat.low.z) {
      return "a body's box is out of range";
    }
    return nullptr;
  }

  /// Returns true if a link of set `name` ties no body of another island.
  bool belongs(std::uint32_t a, std::uint32_t b, std::uint32_t name) const {
    return (!seen_.moves(a) || seen_.set_of_body[a] == name) && (!seen_.moves(b) || seen_.set_of_body[b] == name);
  }
  const char* contact(const Contact<S>& c, std::uint32_t name) const {
    const ContactKey& key = c.key;
    if (!seen_.is_body(key.body_a) || !seen_.is_body(key.body_b) || !(key.body_a < key.body_b))
      return "a contact names no two bodies";
    if (seen_.is_disabled(key.body_a) || seen_.is_disabled(key.body_b)) return "a contact names a disabled body";
    if (!(seen_.moves(key.body_a) || seen_.moves(key.body_b)) || !belongs(key.body_a, key.body_b, name))
      return "a contact lies in another island than its bodies";
    if (key.child_a >= leaves_of_body_[key.body_a] || key.child_b >= leaves_of_body_[key.body_b])
      return "a contact names no part of a body";
    if (c.count < 1 || c.count > kMaxContactPoints || c.flags > (contact_flag::kTouching | contact_flag::kReported))
      return "a contact has 1 to 4 points";
    bool good = is_finite(c.friction_impulse) && is_finite(c.twist_impulse);
    for (std::uint32_t p = 0; p < kMaxContactPoints; ++p) {
      const Velocity<S> impulse = c.normal_impulse[p];
      good = good && is_finite(impulse) && !(impulse < Velocity<S>(0));
      if (p >= c.count) good = good && c.features[p] == 0 && impulse == Velocity<S>(0);
    }
    return good ? nullptr : "a contact's impulse is not one";
  }
  const char* links(const std::vector<Contact<S>>& contacts, const JointSet<S>& joints, std::uint32_t name) {
    for (std::size_t i = 0; i < contacts.size(); ++i) {
      if (const char* rule = contact(contacts[i], name)) return rule;
      if (i > 0 && !(contacts[i - 1].key < contacts[i].key)) return "contacts ascend by key";
    }
    if (joints.states.size() != joints.properties.size()) return "as many joints as properties";
    for (std::size_t i = 0; i < joints.states.size(); ++i) {
      const JointState<S>& state = joints.states[i];
      const JointProperties<S>& joint = joints.properties[i];
      if (state.slot >= seen_.joint_at.size() || seen_.joint_at[state.slot].joint != nullptr)
        return "a joint's slot is unknown or twice used";
      if (i > 0 && !(joints.states[i - 1].slot < state.slot)) return "joints ascend by slot";
      seen_.joint_at[state.slot] = {&joint, name};
      if (joint.body_a == joint.body_b) return "a joint ties a body to itself";
      for (const std::uint32_t body : {joint.body_a, joint.body_b}) {
        if (body != kNoBody && !seen_.is_body(body)) return "a joint names no body";
      }
      // One that holds nothing is awake.
      const bool holds = seen_.moves(joint.body_a) || seen_.moves(joint.body_b);
      if (!belongs(joint.body_a, joint.body_b, name) || (!holds && name != Location::kAwake))
        return "a joint lies in another island than its bodies";
      if (detail::fault_of(joint, substep_rate(state_.settings)) != Fault::none) return "a joint is out of range";
      if (!state.has_known_pieces() || !is_finite(state.point) || !is_finite(state.angular)) {
        return "a joint's impulse is not one";
      }
    }
    return nullptr;
  }
  const char* others() const {
    const std::vector<PendingForce<S>>& forces = state_.forces;
    for (std::size_t i = 0; i < forces.size(); ++i) {
      const std::uint32_t slot = forces[i].slot;
      if (!seen_.is_body(slot) || seen_.set_of_body[slot] != Location::kAwake ||
          seen_.type_of(slot) != BodyType::dynamic) {
        return "a force acts on no dynamic body that is awake";
      }
      const std::int32_t hz = state_.settings.hz;
      if (forces[i].cut > 1 || !is_finite(forces[i].linear) || !is_finite(forces[i].angular) ||
          !detail::within(forces[i].linear, detail::most_acceleration(hz, Limits<S>::speed())) ||
          !detail::within(forces[i].angular, detail::most_acceleration(hz, Limits<S>::angular_speed()))) {
        return "a force is out of range";
      }
      if (i > 0 && !(forces[i - 1].slot < slot)) return "forces ascend by slot";
    }
    const std::vector<PendingMove<S>>& moves = state_.moves;
    for (std::size_t i = 0; i < moves.size(); ++i) {
      const std::uint32_t slot = moves[i].slot;
      if (!seen_.is_body(slot) || seen_.type_of(slot) != BodyType::kinematic) return "a move is of no kinematic body";
      if (moves[i].reserved != 0 || detail::fault_of_pose(moves[i].pose) != Fault::none)
        return "a move is out of range";
      if (i > 0 && !(moves[i - 1].slot < slot)) return "moves ascend by slot";
    }
    for (std::size_t i = 0; i < state_.overlaps.size(); ++i) {
      if (!seen_.is_body(state_.overlaps[i].sensor) || !seen_.is_body(state_.overlaps[i].other))
        return "an overlap names no two bodies";
      if (!has_part(state_.overlaps[i].sensor, state_.overlaps[i].sensor_child) ||
          !has_part(state_.overlaps[i].other, state_.overlaps[i].other_child))
        return "an overlap names no part of a body";
      if (i > 0 && !(state_.overlaps[i - 1] < state_.overlaps[i])) return "overlaps ascend";
    }
    if (const char* rule = RecordValidator<S>(state_, seen_).broken_rule()) return rule;
    return untold();
  }
  const char* untold() const {
    const std::vector<ContactEnd>& contacts = state_.untold.contact_end;
    const std::vector<SensorEvent>& overlaps = state_.untold.sensor_end;
    for (std::size_t i = 0; i < contacts.size(); ++i) {
      if (!was_body(contacts[i].a) || !was_body(contacts[i].b) || !(contacts[i].a.slot < contacts[i].b.slot))
        return "an ended contact names no two bodies";
      if (i > 0 && !ascend(contacts[i - 1].a, contacts[i - 1].b, contacts[i].a, contacts[i].b))
        return "ended contacts ascend";
    }
    for (std::size_t i = 0; i < overlaps.size(); ++i) {
      if (!was_body(overlaps[i].sensor) || !was_body(overlaps[i].other)) return "an ended overlap names no two bodies";
      if (i > 0 && !(overlap_of(overlaps[i - 1]) < overlap_of(overlaps[i]))) return "ended overlaps ascend";
    }
    for (const BodyId body : state_.untold.woke) {
      if (!was_body(body)) return "who woke is no body";
    }
    for (const BodyId body : state_.untold.sensors) {
      if (!was_body(body)) return "a sensor that was changed is no body";
    }
    return nullptr;
  }
  /// Returns true if the slot was given to a body, which may be gone.
  bool was_body(BodyId body) const {
    return body && body.slot < seen_.set_of_body.size() && SlotMap::space_of(body) == state_.settings.id_space;
  }
  static SensorOverlap overlap_of(const SensorEvent& e) {
    return {e.sensor.slot, e.other.slot, e.sensor_child, e.other_child};
  }
  static bool ascend(BodyId a, BodyId b, BodyId next_a, BodyId next_b) {
    return a.slot != next_a.slot ? a.slot < next_a.slot : b.slot < next_b.slot;
  }

  const WorldState<S>& state_;
  SlotTables<S> seen_;
  std::vector<std::uint32_t> leaves_of_shape_, leaves_of_body_;  // by slot; as contacts count them
};

}  // namespace detail

template <class S> const char* broken_rule(const WorldState<S>& state) {
  return detail::StateValidator<S>(state).broken_rule();
}

}  // namespace isostep
