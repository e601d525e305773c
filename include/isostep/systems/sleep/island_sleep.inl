// Bodies of island_sleep.hpp.
// SPDX-License-Identifier: MIT
#pragma once

#include <utility>

#include "isostep/state/members.hpp"
#include "isostep/store/contact_ends.hpp"
#include "isostep/store/fat_box.hpp"
#include "isostep/systems/sleep/island_sleep.hpp"

namespace isostep {

namespace detail {
template <class S> inline constexpr S kSleepSpeed = S(0.05);  // [m/s] and [rad/s]
/// [s] The time of fall in which a body counts as at rest. Thrown up, it is slow twice as long: less than the delay.
template <class S> inline constexpr S kSleepFall = S(0.1875);
/// [m/s^2] and [rad/s^2] The least pull that counts. Rounding of balanced forces leaves less.
template <class S> inline constexpr S kLeastPull = S(1.0 / 16384);
/// [m/s] or [rad/s] Returns the speed below which a body is at rest under `pull`, which counts if above `least`.
template <class S> ISO_INLINE S rest_speed_under(Vec3<S> pull, S least) {
  const S size = max_abs(pull);
  return size <= least ? kSleepSpeed<S> : min(kSleepSpeed<S>, size * kSleepFall<S>);
}
inline constexpr std::uint32_t kStepsPerSleepDelay = 2;  // a second over this: half a second of rest
/// Returns true if a step moved a slow body as if it had twice the speed `limit` [m/s] and [rad/s], or more:
/// corrections of positions move it without velocity. Source: Box2D 3, positionSleepFactor. Rounding of coordinates and
/// rotations is no motion.
template <class S>
ISO_INLINE bool is_corrected(const Pose<S>& start, const BodyState<S>& state, S limit, std::int32_t hz) {
  using U = Unit<S>;
  const S most = (limit + limit) / S(hz);  // [m] and [rad] in a step
  const S rounded = spacing_at(max(max_abs(start.position), max_abs(state.centre)));
  if (max_abs(state.centre - start.position) > max(most, rounded + rounded)) return true;
  const Quat<U> turn = conjugate(start.orientation) * state.orientation;  // half of the angle is the vector's length
  return max_abs(Vec3<U>{turn.x, turn.y, turn.z}) > max(convert<U>(most * S(0.5)), U(0x1p-20));
}
}  // namespace detail

template <class S>
void IslandSleep<S>::update(std::vector<BodyId>& fell_asleep, std::span<const Pose<S>> start, const Belts<S>* belts,
                            std::span<const Acceleration<S>> pulls) {
  if (!state_.settings.allow_sleep) return;
  update_clocks(start, pulls);
  stop_clocks_of_carried(belts);
  stop_clocks_of_motors();
  stop_clocks_by_forces();
  make_room();
  if (!some_body_is_ready()) return;
  find_islands();
  find_island_clocks();
  if (mark_ready_islands()) move_marked_islands(fell_asleep);
}

/// Allocates for the awake bodies now, so that memory does not depend on when the first of them is ready to sleep.
template <class S> void IslandSleep<S>::make_room() {
  const std::size_t count = state_.awake.states.size();
  islands_.make_room(count);
  if (clock_.size() < count) clock_.resize(count);
}

template <class S> bool IslandSleep<S>::put_to_sleep(std::uint32_t slot) {
  const std::size_t count = state_.awake.states.size();
  find_islands();
  const std::uint32_t root = islands_.find(map_.location(slot).index);
  clock_.assign(count, 0);
  clock_[root] = 1;
  const auto falls_asleep = [&](std::size_t i) { return islands_.find(static_cast<std::uint32_t>(i)) == root; };
  for (std::size_t i = 0; i < count; ++i) {
    if (falls_asleep(i) && (state_.awake.properties[i].flags & body_flag::kAllowSleep) == 0) return false;
  }
  std::erase_if(state_.forces, [&](const PendingForce<S>& f) { return falls_asleep(map_.location(f.slot).index); });
  move_marked_islands(state_.untold.woke);
  return true;
}

/// Puts the islands whose `clock_` is 1 to sleep.
template <class S> void IslandSleep<S>::move_marked_islands(std::vector<BodyId>& fell_asleep) {
  asleep_.resize(state_.awake.states.size());
  move_contacts();
  move_joints();
  move_bodies(fell_asleep);
  list_islands();
}

/// [steps] The time of rest before an island falls asleep.
template <class S> std::uint32_t IslandSleep<S>::delay() const {
  return static_cast<std::uint32_t>(state_.settings.hz) / detail::kStepsPerSleepDelay;
}

template <class S>
void IslandSleep<S>::update_clocks(std::span<const Pose<S>> start, std::span<const Acceleration<S>> pulls) {
  for (std::size_t i = 0; i < state_.awake.states.size(); ++i) {
    BodyState<S>& state = state_.awake.states[i];
    const BodyProperties<S>& body = state_.awake.properties[i];
    const bool may = (body.flags & body_flag::kAllowSleep) != 0;
    // A kinematic body rests when told to: however slow, it carries what lies on it.
    const bool still =
        state.velocity == Vec3<Velocity<S>>::zero() && state.angular_velocity == Vec3<Velocity<S>>::zero();
    const Vec3<S> weight = state_.settings.gravity * body.gravity_scale;
    S least = detail::rest_speed_under(weight, S(0));
    // Of a body that nothing pulls it is as if nothing pulled any: bodies elsewhere do not matter.
    if (!pulls.empty() && !(pulls[i].linear == Vec3<S>::zero() && pulls[i].angular == Vec3<S>::zero())) {
      least = min(detail::rest_speed_under(saturating_add(weight, pulls[i].linear), detail::kLeastPull<S>),
                  detail::rest_speed_under(pulls[i].angular, detail::kLeastPull<S>));
    }
    const Velocity<S> limit = convert<Velocity<S>>(least);
    const bool slow = max_abs(state.velocity) < limit && max_abs(state.angular_velocity) < limit &&
                      !detail::is_corrected(start[i], state, least, state_.settings.hz);
    const bool rests = body.type == BodyType::kinematic ? still : slow;
    state.sleep_clock = may && rests ? state.sleep_clock + (state.sleep_clock < 0xffffffffu ? 1u : 0u) : 0u;
  }
}
/// Stops clocks while an explosion exists, which may hit yet, and in water with waves, which move bodies after a rest.
template <class S> void IslandSleep<S>::stop_clocks_by_forces() {
  const auto& explosions = state_.records->explosions;
  const auto& waters = state_.records->waters;
  if (explosions.all().empty() && waters.all().empty()) return;
  bool blast = false;
  for (std::uint32_t slot = 0; slot < explosions.all().size(); ++slot) blast = blast || explosions.is_taken(slot);
  for (std::size_t i = 0; i < state_.awake.states.size(); ++i) {
    BodyState<S>& state = state_.awake.states[i];
    bool moved = blast;
    for (const Water<S>& water : waters.all()) {
      moved = moved || (S(0) < water.wave_height &&
                        in_region(water, detail::solid_box(map_, state, state_.awake.properties[i])));
    }
    if (moved) state.sleep_clock = 0;
  }
}
/// Returns the material of a leaf's part.
template <class S>
const Material<S>& IslandSleep<S>::surface_of(const BodyProperties<S>& body, std::uint32_t slot,
                                              std::uint32_t leaf) const {
  if (!map_.shapes.traits_of(body.shape).has(part_flag::kOwnMaterial)) return body.material;
  return map_.shapes.children_of(body.shape)[leaf_of(map_, slot, leaf).child].traits.material_or(body.material);
}
/// Stops the clocks of bodies on a moving surface, as a drum or a conveyor: those do not rest.
template <class S> void IslandSleep<S>::stop_clocks_of_carried(const Belts<S>* belts) {
  for (const Contact<S>& contact : state_.contacts) {
    const std::uint32_t slot_list[2] = {contact.key.body_a, contact.key.body_b};
    const std::uint32_t leaves[2] = {contact.key.child_a, contact.key.child_b};
    for (int side = 0; side < 2; ++side) {
      const Location at = map_.location(slot_list[side]);
      const Location other = map_.location(slot_list[1 - side]);
      if (other.set != Location::kAwake) continue;
      const BodyProperties<S>& body = map_.properties_at(at);
      const bool driven = body.type == BodyType::kinematic && map_.state_at(at).sleep_clock == 0;
      const bool runs = !(surface_of(body, slot_list[side], leaves[side]).surface_velocity == Vec3<S>::zero()) ||
                        (belts != nullptr && belts->find(slot_list[side], leaves[side]) != nullptr);
      if (driven || runs) state_.awake.states[other.index].sleep_clock = 0;
    }
  }
}
/// Stops the clocks of bodies of a running slow motor, even if they seem to rest. A limit or a load may stop the motor.
template <class S> void IslandSleep<S>::stop_clocks_of_motors() {
  const S slow = S(4) * detail::kSleepSpeed<S>;  // of two bodies neither component of which is kSleepSpeed
  const auto is_slow = [slow](S speed) { return !(speed == S(0)) && abs(speed) < slow; };
  const auto stop_if_runs = [&](std::uint32_t joint, std::uint32_t row) {
    const JointState<S>& state = state_.joints.states[joint];
    if (!state.has_drive(row) || state.piece(row) != DrivePiece::driven) return;
    const JointProperties<S>& properties = state_.joints.properties[joint];
    for (const std::uint32_t slot : {properties.body_a, properties.body_b}) {
      if (slot != kNoBody && is_dynamic(slot)) state_.awake.states[map_.location(slot).index].sleep_clock = 0;
    }
  };
  for (std::uint32_t i = 0; i < state_.joints.properties.size(); ++i) {
    const JointProperties<S>& joint = state_.joints.properties[i];
    if ((joint.flags & joint_flag::kMotor) == 0 || !is_slow(joint.motor_speed)) continue;
    for (std::uint32_t row = 0; row < kJointRows; ++row) stop_if_runs(i, row);
  }
  for (const AxisDrive<S>& drive : state_.records->axis_drives.all()) {
    if (!drive.motor || !is_slow(drive.motor_speed)) continue;
    const Location at = map_.joints.location(drive.joint.slot);
    if (!at.is_asleep()) stop_if_runs(at.index, static_cast<std::uint32_t>(drive.axis));
  }
}
template <class S> bool IslandSleep<S>::some_body_is_ready() const {
  const std::uint32_t least = delay();
  for (std::size_t i = 0; i < state_.awake.states.size(); ++i) {
    if (state_.awake.states[i].sleep_clock >= least && state_.awake.properties[i].type == BodyType::dynamic)
      return true;
  }
  return false;
}

/// Returns true if the body is dynamic and awake.
template <class S> bool IslandSleep<S>::is_dynamic(std::uint32_t slot) const {
  const Location at = map_.location(slot);
  return at.set == Location::kAwake && state_.awake.properties[at.index].type == BodyType::dynamic;
}

/// Finds islands: dynamic bodies connected by contacts, joints, springs, wheels and couplings.
template <class S> void IslandSleep<S>::find_islands() {
  islands_.begin(state_.awake.states.size());
  const auto tie = [&](std::uint32_t a, std::uint32_t b) {
    if (is_dynamic(a) && is_dynamic(b)) islands_.join(map_.location(a).index, map_.location(b).index);
  };
  const auto flags_of = [&](std::uint32_t slot) { return map_.properties_at(map_.location(slot)).flags; };
  for (const Contact<S>& contact : state_.contacts) {
    const std::uint32_t a = contact.key.body_a, b = contact.key.body_b;
    if (((flags_of(a) | flags_of(b)) & body_flag::kSensor) == 0) tie(a, b);
  }
  for (const JointProperties<S>& joint : state_.joints.properties) {
    if (joint.body_a != kNoBody && joint.body_b != kNoBody) tie(joint.body_a, joint.body_b);
  }
  for (const BodySpring<S>& spring : state_.records->body_springs.all()) {
    if (spring.a && spring.b) tie(spring.a.slot, spring.b.slot);
  }
  for_each_wheel_on_ground(tie);
  for (const Coupling<S>& coupling : state_.records->couplings.all()) tie_coupled(coupling);
}

/// Joins the bodies of all joints of a coupling into one island.
template <class S> void IslandSleep<S>::tie_coupled(const Coupling<S>& coupling) {
  std::uint32_t first = kNoBody;
  for (const JointId id : detail::joints_of(coupling).all) {
    const JointProperties<S>* joint = map_.joints.properties_of(id);
    if (joint == nullptr) continue;
    for (const std::uint32_t body : {joint->body_a, joint->body_b}) {
      if (body == kNoBody || !is_dynamic(body)) continue;
      if (first == kNoBody) first = body;
      islands_.join(map_.location(first).index, map_.location(body).index);
    }
  }
}

/// Calls visit(slot of the wheel's body, slot of the ground) for each wheel on ground.
template <class S> template <class Visit> void IslandSleep<S>::for_each_wheel_on_ground(const Visit& visit) const {
  detail::for_each_standing_wheel(
      state_, [&](BodyId body, const WheelState<S>& wheel) { visit(body.slot, wheel.contact_body.slot); });
}

/// Finds the least sleep clock of each island.
template <class S> void IslandSleep<S>::find_island_clocks() {
  const std::size_t count = state_.awake.states.size();
  clock_.assign(count, 0xffffffffu);
  for (std::size_t i = 0; i < count; ++i) {
    std::uint32_t& clock = clock_[islands_.find(static_cast<std::uint32_t>(i))];
    clock = min(clock, state_.awake.states[i].sleep_clock);
  }
  // A joint or spring to something driven keeps an island awake as a contact does.
  const auto keep_awake = [&](std::uint32_t a, std::uint32_t b) {
    for (const auto& [here, there] : {std::pair{a, b}, std::pair{b, a}}) {
      if (is_dynamic(here) || !is_dynamic(there)) continue;
      const Location at = map_.location(here);
      if (at.set == Location::kAwake && map_.state_at(at).sleep_clock == 0)
        clock_[islands_.find(map_.location(there).index)] = 0;
    }
  };
  for (const JointProperties<S>& joint : state_.joints.properties) {
    if (joint.body_a != kNoBody && joint.body_b != kNoBody) keep_awake(joint.body_a, joint.body_b);
  }
  for (const BodySpring<S>& spring : state_.records->body_springs.all()) {
    if (spring.a && spring.b) keep_awake(spring.a.slot, spring.b.slot);
  }
  for_each_wheel_on_ground(keep_awake);
}

/// Sets `clock_` to 1 for islands that fall asleep, to 0 for others. Returns false if none does.
template <class S> bool IslandSleep<S>::mark_ready_islands() {
  const std::uint32_t least = delay();
  bool any = false;
  for (std::size_t i = 0; i < clock_.size(); ++i) {
    const bool root = islands_.find(static_cast<std::uint32_t>(i)) == i;
    const bool dynamic_body = state_.awake.properties[i].type == BodyType::dynamic;
    clock_[i] = root && dynamic_body && clock_[i] >= least ? 1u : 0u;
    any = any || clock_[i] != 0;
  }
  return any;
}

/// Returns the sleeping island of the awake body at that index, or null if it stays awake.
template <class S> SleepingIsland<S>* IslandSleep<S>::island_of(std::size_t index) {
  const std::uint32_t root = islands_.find(static_cast<std::uint32_t>(index));
  if (clock_[root] == 0) return nullptr;
  if (asleep_[root] == nullptr) asleep_[root] = std::make_shared<SleepingIsland<S>>();
  return asleep_[root].get();
}
template <class S> SleepingIsland<S>* IslandSleep<S>::island_of_either(std::uint32_t slot_a, std::uint32_t slot_b) {
  for (const std::uint32_t slot : {slot_a, slot_b}) {
    if (slot == kNoBody || map_.location(slot).set != Location::kAwake) continue;
    SleepingIsland<S>* island = island_of(map_.location(slot).index);
    if (island != nullptr) return island;
  }
  return nullptr;
}

template <class S> void IslandSleep<S>::move_contacts() {
  std::size_t kept = 0;
  for (const Contact<S>& contact : state_.contacts) {
    SleepingIsland<S>* island = island_of_either(contact.key.body_a, contact.key.body_b);
    if (island != nullptr) island->contacts.push_back(contact);
    else state_.contacts[kept++] = contact;
  }
  state_.contacts.resize(kept);
}

template <class S> void IslandSleep<S>::move_joints() {
  std::size_t kept = 0;
  JointSet<S>& joints = state_.joints;
  for (std::size_t i = 0; i < joints.states.size(); ++i) {
    SleepingIsland<S>* island = island_of_either(joints.properties[i].body_a, joints.properties[i].body_b);
    if (island != nullptr) {
      island->joints.states.push_back(joints.states[i]);
      island->joints.properties.push_back(joints.properties[i]);
    } else {
      joints.states[kept] = joints.states[i];
      joints.properties[kept++] = joints.properties[i];
    }
  }
  joints.states.resize(kept);
  joints.properties.resize(kept);
}

template <class S> void IslandSleep<S>::move_bodies(std::vector<BodyId>& fell_asleep) {
  std::size_t kept = 0;
  BodySet<S>& awake = state_.awake;
  for (std::size_t i = 0; i < awake.states.size(); ++i) {
    SleepingIsland<S>* island = island_of(i);
    if (island != nullptr) {
      BodyState<S> still = awake.states[i];
      still.velocity = Vec3<Velocity<S>>::zero();
      still.angular_velocity = Vec3<Velocity<S>>::zero();
      island->bodies.states.push_back(still);
      island->bodies.properties.push_back(awake.properties[i]);
      fell_asleep.push_back(state_.body_slots.template id_of<BodyId>(still.slot));
    } else {
      awake.states[kept] = awake.states[i];
      awake.properties[kept++] = awake.properties[i];
    }
  }
  awake.states.resize(kept);
  awake.properties.resize(kept);
}

/// Adds the islands to the sleeping ones, in order of their first bodies.
template <class S> void IslandSleep<S>::list_islands() {
  map_.relabel(state_.awake, Location::kAwake, 0);
  map_.joints.relabel(state_.joints, Location::kAwake, 0);
  for (const std::shared_ptr<SleepingIsland<S>>& island : asleep_) {
    if (island == nullptr) continue;
    island->hash = detail::hash_sections(*island);
    const auto name = static_cast<std::uint32_t>(state_.sleeping.size());
    map_.relabel(island->bodies, name, 0);
    map_.joints.relabel(island->joints, name, 0);
    for (std::size_t i = 0; i < island->bodies.states.size(); ++i)
      proxies_.place(island->bodies.states[i], island->bodies.properties[i], false);
    map_.count_names(*island, 1);
    state_.sleeping.push_back(island);
  }
  asleep_.clear();
}

}  // namespace isostep
