// StateValidator: whether a state read from outside keeps every rule that the step relies on.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "isostep/collision/broadphase/pairs.hpp"
#include "isostep/core/stable_sort.hpp"
#include "isostep/geometry/content.hpp"
#include "isostep/geometry/surfaces.hpp"
#include "isostep/world/body_map.hpp"
#include "isostep/world/checks.hpp"
#include "isostep/world/command.hpp"
#include "isostep/world/record_checks.hpp"
#include "isostep/world/state.hpp"

namespace isostep {

/// `broken_rule` is null, or a sentence for the first rule that the state breaks. Call once.
template <class S> class StateValidator {
 public:
  explicit StateValidator(const WorldState<S>& state) : state_(state) {}

  const char* broken_rule() {
    const Settings<S>& s = state_.settings;
    if (s.hz < 10 || s.hz > 1000 || s.substeps < 1 || s.substeps > 64 || substep_rate(s) > kMaxRate ||
        !is_finite(s.gravity) || !detail::within(s.gravity, Limits<S>::speed()) ||
        static_cast<std::uint32_t>(s.solver) >= kSolvers || s.id_space >= SlotMap::kIdSpaces ||
        s.most_pairs < kLeastPairs || kMostPairs < s.most_pairs ||
        static_cast<std::uint32_t>(s.projection) >= kProjections || !is_finite(s.restitution_threshold) ||
        s.restitution_threshold < S(0) || Limits<S>::speed() < s.restitution_threshold) {
      return "settings out of range";
    }
    set_of_body_.assign(state_.body_slots.entries().size(), Location::kNone);
    type_of_body_.assign(set_of_body_.size(), BodyType::static_);
    leaves_of_body_.assign(set_of_body_.size(), 0);
    joint_at_.assign(state_.joint_slots.entries().size(), {nullptr, 0});
    for (const SlotMap* slots : {&state_.body_slots, &state_.shape_slots, &state_.joint_slots}) {
      if (!lie_in(*slots, s.id_space)) return "a slot is of another id space";
    }
    if (const char* rule = shapes()) return rule;
    if (const char* rule = bodies(*state_.static_bodies, Location::kStatic)) return rule;
    if (const char* rule = bodies(state_.awake, Location::kAwake)) return rule;
    for (std::uint32_t i = 0; i < state_.sleeping.size(); ++i) {
      if (const char* rule = bodies(state_.sleeping[i]->bodies, i)) return rule;
      if (state_.sleeping[i]->bodies.states.empty()) return "a sleeping island has no bodies";
    }
    for (std::uint32_t slot = 0; slot < set_of_body_.size(); ++slot) {
      if (state_.body_slots.is_taken(slot) != (set_of_body_[slot] != Location::kNone))
        return "a body's slot is taken but has no body";
    }
    if (const char* rule = links(state_.contacts, state_.joints, Location::kAwake)) return rule;
    for (std::uint32_t i = 0; i < state_.sleeping.size(); ++i) {
      if (const char* rule = links(state_.sleeping[i]->contacts, state_.sleeping[i]->joints, i)) return rule;
    }
    for (std::uint32_t slot = 0; slot < joint_at_.size(); ++slot) {
      if (state_.joint_slots.is_taken(slot) != (joint_at_[slot].joint != nullptr))
        return "a joint's slot is taken but has no joint";
    }
    return others();
  }

 private:
  static bool lie_in(const SlotMap& slots, std::uint32_t space) {
    bool all = true;
    for (std::uint32_t i = 0; i < slots.entries().size(); ++i)
      all = all && SlotMap::space_of(slots.id_of<BodyId>(i)) == space;
    return all;
  }
  bool is_body(std::uint32_t slot) const { return slot < set_of_body_.size() && set_of_body_[slot] != Location::kNone; }

  /// The taken shapes' parts fill the pool without gap or overlap.
  const char* shapes() {
    if (state_.shapes->size() != state_.shape_slots.entries().size()) return "as many shapes as shape slots";
    leaves_of_shape_.assign(state_.shapes->size(), 0);
    std::vector<std::uint8_t> used(state_.children->size(), 0);
    std::size_t total = 0;
    for (std::uint32_t i = 0; i < state_.shapes->size(); ++i) {
      const ShapeRecord& shape = (*state_.shapes)[i];
      if (!state_.shape_slots.is_taken(i)) {
        if (shape.first_child != 0 || shape.child_count != 0) return "a free shape has no parts";
        continue;
      }
      if (shape.first_child > state_.children->size() ||
          shape.child_count > state_.children->size() - shape.first_child || shape.child_count > kMaxChildren) {
        return "a shape's parts lie outside the pool";
      }
      for (std::uint32_t c = 0; c < shape.child_count; ++c) {
        if (used[shape.first_child + c]++ != 0) return "two shapes share a part";
      }
      total += shape.child_count;
      if (validate(parts_of(i), state_.geometry->contents()) != ShapeFault::none) return "a shape is not valid";
      leaves_of_shape_[i] = leaves_of_parts(parts_of(i));
    }
    if (total != state_.children->size()) return "a part belongs to no shape";
    return blobs();
  }
  /// Every blob is used as often as its name says.
  const char* blobs() const {
    const GeometryStore& store = *state_.geometry;
    std::vector<std::uint64_t> uses(store.names().size(), 0);
    for (const Child<S>& child : *state_.children) {
      const std::uint32_t blob = child.primitive.blob;
      const bool exists = blob != 0 && store.is_taken(blob - 1);
      if (blob != 0 && !exists) return "a part names no blob";
      if (exists) ++uses[blob - 1];
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
  std::span<const Child<S>> parts_of(std::uint32_t shape) const {
    return {state_.children->data() + (*state_.shapes)[shape].first_child, (*state_.shapes)[shape].child_count};
  }

  /// Of valid ones.
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
      if (b.slot >= set_of_body_.size() || set_of_body_[b.slot] != Location::kNone)
        return "a body's slot is unknown or twice used";
      if (i > 0 && !(set.states[i - 1].slot < b.slot)) return "bodies ascend by slot";
      set_of_body_[b.slot] = name;
      type_of_body_[b.slot] = set.properties[i].type;
      if (const char* rule = properties(set.properties[i], name)) return rule;
      leaves_of_body_[b.slot] = leaves_of_shape_[set.properties[i].shape];
      if (const char* rule = motion(b)) return rule;
    }
    return nullptr;
  }
  const char* properties(const BodyProperties<S>& p, std::uint32_t name) const {
    constexpr std::uint32_t kKnown = body_flag::kSensor | body_flag::kAllowSleep | body_flag::kCollide |
                                     body_flag::kSpins | body_flag::kBullet | body_flag::kDisabled |
                                     body_flag::kAllLocks;
    const bool dynamic_body = p.type == BodyType::dynamic;
    if (p.type > BodyType::dynamic || is_fixed(p) != (name == Location::kStatic) ||
        (name < Location::kAwake && !dynamic_body)) {
      return "a body's type does not fit its set";
    }
    if ((p.flags & ~kKnown) != 0) return "a body has an unknown flag";
    if (p.shape >= state_.shapes->size() || !state_.shape_slots.is_taken(p.shape)) return "a body's shape is unknown";
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
    if (detail::fault_of(p.material) != Fault::none ||
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
        convert<Velocity<S>>(Limits<S>::speed() * quarter) < max_abs(b.velocity) ||
        convert<Velocity<S>>(Limits<S>::angular_speed() * quarter) < max_abs(b.angular_velocity)) {
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

  bool is_disabled(std::uint32_t slot) const {
    return set_of_body_[slot] == Location::kStatic && type_of_body_[slot] != BodyType::static_;
  }
  /// Whether forces move it.
  bool moves(std::uint32_t slot) const {
    return slot != kNoBody && type_of_body_[slot] == BodyType::dynamic && set_of_body_[slot] != Location::kStatic;
  }
  /// A link of set `name` ties no body of another island.
  bool belongs(std::uint32_t a, std::uint32_t b, std::uint32_t name) const {
    return (!moves(a) || set_of_body_[a] == name) && (!moves(b) || set_of_body_[b] == name);
  }
  const char* contact(const Contact<S>& c, std::uint32_t name) const {
    const ContactKey& key = c.key;
    if (!is_body(key.body_a) || !is_body(key.body_b) || !(key.body_a < key.body_b))
      return "a contact names no two bodies";
    if (is_disabled(key.body_a) || is_disabled(key.body_b)) return "a contact names a disabled body";
    if (!(moves(key.body_a) || moves(key.body_b)) || !belongs(key.body_a, key.body_b, name))
      return "a contact lies in another island than its bodies";
    if (key.child_a >= leaves_of_body_[key.body_a] || key.child_b >= leaves_of_body_[key.body_b])
      return "a contact names no part of a body";
    if (c.count < 1 || c.count > kMaxContactPoints || c.flags > contact_flag::kTouching)
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
      if (state.slot >= joint_at_.size() || joint_at_[state.slot].joint != nullptr)
        return "a joint's slot is unknown or twice used";
      if (i > 0 && !(joints.states[i - 1].slot < state.slot)) return "joints ascend by slot";
      joint_at_[state.slot] = {&joint, name};
      if (joint.body_a == joint.body_b) return "a joint ties a body to itself";
      for (const std::uint32_t body : {joint.body_a, joint.body_b}) {
        if (body != kNoBody && !is_body(body)) return "a joint names no body";
      }
      // One that holds nothing is awake.
      const bool holds = moves(joint.body_a) || moves(joint.body_b);
      if (!belongs(joint.body_a, joint.body_b, name) || (!holds && name != Location::kAwake))
        return "a joint lies in another island than its bodies";
      if (detail::fault_of(joint, substep_rate(state_.settings)) != Fault::none)
        return "a joint is out of range";
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
      if (!is_body(slot) || set_of_body_[slot] != Location::kAwake || type_of_body_[slot] != BodyType::dynamic) {
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
    for (std::size_t i = 0; i < state_.overlaps.size(); ++i) {
      if (!is_body(state_.overlaps[i].sensor) || !is_body(state_.overlaps[i].other))
        return "an overlap names no two bodies";
      if (i > 0 && !(state_.overlaps[i - 1] < state_.overlaps[i])) return "overlaps ascend";
    }
    if (const char* rule = force_records()) return rule;
    return untold();
  }
  const char* force_records() const {
    const char* broken = nullptr;
    ForceRecords<S>::members(
        [&](const char*, const auto& registry) {
          if (broken == nullptr) broken = force_records(registry);
        },
        *state_.force_records);
    if (broken == nullptr) broken = kind_pairs(state_.force_records->material_pairs);
    if (broken == nullptr) broken = one_a_joint(state_.force_records->joint_loads, "two loads have the same joint");
    if (broken == nullptr) broken = one_a_body(state_.force_records->breakables, "two breakables have the same body");
    if (broken == nullptr) broken = one_a_body(state_.force_records->characters, "two characters have the same body");
    if (broken == nullptr) broken = one_a_body(state_.force_records->vehicles, "two vehicles have the same body");
    return broken != nullptr ? broken : contact_records();
  }
  const char* contact_records() const {
    const ForceRecords<S>& records = *state_.force_records;
    if (const char* rule = one_a_body(records.surface_velocitys, "two belts have the same body")) return rule;
    if (const char* rule = one_a_body(records.one_ways, "two one-way records have the same body")) return rule;
    if (const char* rule = one_a_body(records.hit_reports, "two reports of hits have the same body")) return rule;
    if (const char* rule = one_a_body(records.contact_reports, "two reports of contacts have the same body"))
      return rule;
    if (const char* rule = one_a_body(records.move_targets, "two targets have the same body")) return rule;
    if (const char* rule = kind_pairs(records.kind_ghosts)) return rule;
    std::vector<std::uint64_t> pairs;
    for (std::uint32_t slot = 0; slot < records.ghosts.all().size(); ++slot) {
      const Ghost<S>& ghost = records.ghosts.all()[slot];
      if (records.ghosts.is_taken(slot)) pairs.push_back(pair_key(ghost.a.slot, ghost.b.slot));
    }
    return has_twins(pairs) ? "two ghosts have the same bodies" : nullptr;
  }
  static bool has_twins(std::vector<std::uint64_t>& keys) {
    std::vector<std::uint64_t> scratch(keys.size());
    stable_sort(keys.data(), scratch.data(), static_cast<std::uint32_t>(keys.size()), OwnKey{});
    for (std::size_t i = 1; i < keys.size(); ++i) {
      if (keys[i - 1] == keys[i]) return true;
    }
    return false;
  }
  template <class Record, class IdType> const char* force_records(const Registry<Record, IdType>& registry) const {
    const std::vector<Record>& all = registry.all();
    if (all.size() != registry.slots().entries().size()) return "force records are not one a slot";
    if (!lie_in(registry.slots(), state_.settings.id_space)) return "a force's slot is of another id space";
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
      if (!ties_well(all[slot])) return "a spring or a coupling ties two islands, or a record names no joint";
    }
    return nullptr;
  }
  bool names_well(const detail::NamedBody<S>& named) const {
    if (!named.body) return named.may_be_null;
    return state_.body_slots.holds(named.body) && detail::is_as_asked(type_of_body_[named.body.slot], named.must_be);
  }
  template <class Record> bool ties_well(const Record&) const { return true; }
  bool ties_well(const BodySpring<S>& spring) const {
    const auto is_dynamic = [&](BodyId body) { return body && type_of_body_[body.slot] == BodyType::dynamic; };
    if (!is_dynamic(spring.a) && !is_dynamic(spring.b)) return false;
    const bool ties = spring.a && spring.b && moves(spring.a.slot) && moves(spring.b.slot);
    return !ties || set_of_body_[spring.a.slot] == set_of_body_[spring.b.slot];
  }
  bool ties_well(const JointLoad<S>& load) const { return state_.joint_slots.holds(load.joint); }
  bool ties_well(const AxisDrive<S>& drive) const {
    if (!state_.joint_slots.holds(drive.joint)) return false;
    const JointProperties<S>& joint = *joint_at_[drive.joint.slot].joint;
    if (detail::fault_of_joint(drive, joint, substep_rate(state_.settings)) != Fault::none)
      return false;
    const auto& all = state_.force_records->axis_drives;
    for (std::uint32_t slot = 0; slot < all.all().size(); ++slot) {
      const AxisDrive<S>& other = all.all()[slot];
      if (&other != &drive && all.is_taken(slot) && other.joint == drive.joint && other.axis == drive.axis)
        return false;
    }
    return true;
  }
  bool ties_well(const Coupling<S>& coupling) const {
    const detail::NamedJoints named = detail::joints_of(coupling);
    const JointProperties<S>* joints[3] = {};
    std::uint32_t set = Location::kNone;  // of those that hold something
    for (int i = 0; i < 3; ++i) {
      if (i == 2 && !named.all[i]) continue;
      if (!state_.joint_slots.holds(named.all[i])) return false;
      const JointAt& at = joint_at_[named.all[i].slot];
      joints[i] = at.joint;
      if (!moves(at.joint->body_a) && !moves(at.joint->body_b)) continue;
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
  const char* one_a_slot(const Records& all, const SlotMap& slots, const SlotOf& slot_of, const char* rule) const {
    std::vector<std::uint8_t> has(slots.entries().size(), 0);
    for (std::uint32_t slot = 0; slot < all.all().size(); ++slot) {
      if (all.is_taken(slot) && has[slot_of(all.all()[slot])]++ != 0) return rule;
    }
    return nullptr;
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
      if (i > 0 && !ascend(overlaps[i - 1].sensor, overlaps[i - 1].other, overlaps[i].sensor, overlaps[i].other))
        return "ended overlaps ascend";
    }
    for (const BodyId body : state_.untold.woke) {
      if (!was_body(body)) return "who woke is no body";
    }
    return nullptr;
  }
  /// Of a slot that was given: the body may be gone.
  bool was_body(BodyId body) const {
    return body && body.slot < set_of_body_.size() && SlotMap::space_of(body) == state_.settings.id_space;
  }
  static bool ascend(BodyId a, BodyId b, BodyId next_a, BodyId next_b) {
    return a.slot != next_a.slot ? a.slot < next_a.slot : b.slot < next_b.slot;
  }

  const WorldState<S>& state_;
  std::vector<std::uint32_t>
      set_of_body_;  // by slot: Location::kNone, Location::kStatic, Location::kAwake or a sleeping island
  std::vector<BodyType> type_of_body_;                           // by slot
  std::vector<std::uint32_t> leaves_of_shape_, leaves_of_body_;  // by slot; as contacts count them
  struct JointAt {
    const JointProperties<S>* joint;
    std::uint32_t set;  // as set_of_body_
  };
  std::vector<JointAt> joint_at_;  // by slot
};

}  // namespace isostep
