// A busy scene and a hail of random commands, for the tests of determinism: every command, every shape, every joint.
// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "random/dice.hpp"

namespace isostep::test {

template <class S> struct Mess {
  ShapeId box, ball, capsule, hammer;
  std::vector<BodyId> moving, chain;
  BodyId ground, rotor, sensor;
};

/// A pile of everything, a chain, a stack, a spinning paddle, a sensor, a trap. `at`: the scene's origin.
template <class S> Mess<S> build_mess(World<S>& w, D3 at = {0, 0, 0}) {
  Mess<S> m;
  const auto place = [&](D3 p) { return p + at; };
  BodyDefinition<S> d =
      still<S>(w.add_shape(HalfSpace<S>{{Unit<S>(0), Unit<S>(1), Unit<S>(0)}, S(0)}), place({0, 0, 0}));
  m.ground = w.create(d);
  m.box = add_box(w, 0.5, 0.25, 0.375);
  m.ball = add_ball(w, 0.375);
  m.capsule = w.add_shape(Capsule<S>{num<S>(0.25), num<S>(0.375)});
  const Child<S> parts[] = {
      {primitive_of(Box<S>{vec<S>(0.125, 0.5, 0.125)}), Pose<S>::identity()},
      {primitive_of(Box<S>{vec<S>(0.375, 0.25, 0.25)}), {vec<S>(0, 0.75, 0), Quat<Unit<S>>::identity()}}};
  m.hammer = w.add_shape(std::span<const Child<S>>(parts));
  Dice dice(7);
  const ShapeId shapes[] = {m.box, m.ball, m.capsule, m.hammer};
  for (int i = 0; i < 36; ++i) {
    d = moving<S>(shapes[i % 4], place({dice.in(-1.5, 1.5), 1.0 + 0.6 * i, dice.in(-1.5, 1.5)}));
    d.orientation = dice.orientation<S>();
    if (i % 5 == 0) d.material.restitution = num<S>(0.5);
    if (i % 7 == 0) d.material.rolling_resistance = num<S>(0.03125);
    if (i % 6 == 0) d.angular_damping = num<S>(0.25);
    d.user_data = static_cast<std::uint64_t>(i);
    m.moving.push_back(w.create(d));
  }
  for (int i = 0; i < 5; ++i) m.moving.push_back(w.create(moving<S>(m.box, place({12, 0.25 + 0.5 * i, 0}))));
  BodyId previous;
  for (int i = 0; i < 6; ++i) {
    m.chain.push_back(w.create(moving<S>(m.capsule, place({-6.0, 8.0 - 1.25 * i, 0.25 * i}))));
    const Pose<S> frame = {vec<S>(place({-6.0, 8.625 - 1.25 * i, 0.25 * i - 0.125})), Quat<Unit<S>>::identity()};
    const JointType kinds[] = {JointType::ball,     JointType::hinge, JointType::ball,
                               JointType::distance, JointType::fixed, JointType::ball};
    JointProperties<S> j = w.joint_at(kinds[i], previous, m.chain.back(), frame);
    if (j.type == JointType::distance) j.upper = num<S>(0.25);
    if (!w.create(j)) ADD_FAILURE() << describe(w.fault());
    previous = m.chain.back();
  }
  d = still<S>(m.hammer, place({1, 0.75, 1}));
  d.type = BodyType::kinematic;
  d.angular_velocity = vec<S>(0, 1.5, 0);
  m.rotor = w.create(d);
  d = still<S>(add_box(w, 2, 1, 2), place({0, 1, 0}));
  d.sensor = true;
  m.sensor = w.create(d);
  return m;
}

/// The activity that a scene must show for equal hashes to mean something.
struct Activity {
  std::uint32_t contacts = 0, sleepers = 0, begins = 0, woke = 0, sensed = 0, joints = 0, accepted = 0, refused = 0;
  double spread = 0;

  template <class S> void watch(const World<S>& w) {
    const WorldCounts c = w.counts();
    contacts = std::max(contacts, c.contacts);
    sleepers = std::max(sleepers, c.asleep);
    joints = std::max(joints, c.joints);
    begins += static_cast<std::uint32_t>(w.events().contact_begin.size());
    woke += static_cast<std::uint32_t>(w.events().woke.size());
    sensed += static_cast<std::uint32_t>(w.events().sensor_begin.size());
    for (const BodyState<S>& b : w.state().awake.states) spread = std::max(spread, std::fabs(to_double(b.centre.x)));
  }
};

/// One frame of random commands: a function of the world's state and the frame's number alone.
template <class S> void hail(World<S>& w, std::uint64_t frame, Activity* activity = nullptr) {
  Dice dice(frame * 1000003 + 17);
  const std::vector<BodyId> bodies = w.bodies();
  const auto body = [&] { return bodies.empty() ? BodyId{} : dice.one_of(bodies); };
  const auto shape = [&] {
    const SlotMap& slots = w.state().shape_slots;
    const std::uint32_t slot = dice.below(static_cast<std::uint32_t>(slots.entries().size()));
    return slots.id_of<ShapeId>(slot);
  };
  const auto point = [&](double reach) { return vec<S>(dice.point(reach)); };
  // Anchors far apart would fling two bodies: the nearest other one is joined.
  const auto neighbour = [&](BodyId of) {
    BodyId best;
    for (const BodyId id : bodies) {
      if (id == of || w.type(id) == BodyType::static_) continue;
      const auto distance = [&](BodyId other) {
        return length(real(w.center_of_mass(other)) - real(w.center_of_mass(of)));
      };
      if (!best || distance(id) < distance(best)) best = id;
    }
    return best;
  };
  const std::uint32_t count = dice.below(5);
  for (std::uint32_t i = 0; i < count; ++i) {
    bool done = false;
    const BodyId b = body();
    switch (dice.below(20)) {
      case 0:
      case 1:
      case 2: {
        const D3 velocity = dice.point(4), at = dice.point(4) + D3{0, 6, 0};
        BodyDefinition<S> d = moving<S>(shape(), at, velocity);
        d.orientation = dice.orientation<S>();
        d.angular_velocity = point(3);
        if (dice.below(12) == 0) d.type = BodyType::kinematic;
        if (dice.below(20) == 0) d.sensor = true;
        if (dice.below(4) == 0) d.material.restitution = num<S>(0.5);
        if (dice.below(12) == 0) d.locks = body_flag::kLockX << dice.below(6);
        if (dice.below(12) == 0) d.material.surface_velocity = point(1);
        done = static_cast<bool>(w.create(d));
        break;
      }
      case 3: done = bodies.size() > 30 && w.type(b) != BodyType::static_ && w.destroy(b); break;
      case 4: {
        const Vec3<S> twist = point(0.5), push = point(2);
        done = w.apply_impulse(b, push, twist);
        break;
      }
      case 5: {
        const Vec3<S> aside = point(0.25), push = point(2);
        done = w.apply_impulse_at(b, push, w.center_of_mass(b) + aside);
        break;
      }
      case 6: {
        const Vec3<S> torque = point(3), force = point(20);
        done = w.apply_force(b, force, torque);
        break;
      }
      case 7: {
        const Vec3<S> aside = point(0.25), force = point(20);
        done = w.apply_force_at(b, force, w.center_of_mass(b) + aside);
        break;
      }
      case 8:
        done = w.type(b) != BodyType::static_ &&
               w.set_pose(b, {vec<S>(dice.point(4) + D3{0, 5, 0}), dice.orientation<S>()});
        break;
      case 9: {
        const Vec3<S> spin = point(3), velocity = point(3);
        done = w.set_velocity(b, velocity, spin);
        break;
      }
      case 10: {
        Material<S> material;
        material.friction = num<S>(dice.in(0, 1));
        material.rolling_resistance = num<S>(dice.in(0, 0.0625));
        done = w.set_material(b, material);
        break;
      }
      case 11: done = w.set_filter(b, {1u << dice.below(2), 0xffffffffu, dice.below(8) == 0 ? 3u : 0u}); break;
      case 12: {
        const S angular = num<S>(dice.in(0, 0.5)), linear = num<S>(dice.in(0, 0.5)), gravity = num<S>(dice.in(0.5, 1));
        done = w.set_motion(b, gravity, linear, angular, 0);
        break;
      }
      case 13: done = w.wake(b); break;
      case 14:
        done = dice.below(8) == 0 ? w.set_gravity(vec<S>(0, -10 + dice.in(-1, 1), 0)) : w.set_user_data(b, dice.next());
        break;
      case 15: done = static_cast<bool>(w.add_shape(Box<S>{vec<S>(0.25 + dice.in(0, 0.5), 0.375, 0.25)})); break;
      case 16: done = w.counts().shapes > 6 && w.remove_shape(shape()); break;
      case 17: {
        const BodyId c = neighbour(b);
        const auto type = static_cast<JointType>(dice.below(kJointTypes));
        JointProperties<S> j = w.joint_at(type, b, c, {w.center_of_mass(b), dice.orientation<S>()});
        if (type == JointType::distance) j.upper = num<S>(20);
        if (type == JointType::distance) j.flags = joint_flag::kLimit;
        if (type == JointType::hinge && dice.below(2) == 0) {
          j.flags = joint_flag::kMotor;
          j.motor_speed = num<S>(2);
          j.max_force = num<S>(3);
        }
        done = static_cast<bool>(w.create(j));
        break;
      }
      case 18: {
        const std::vector<JointId> joints = w.joints();
        done = joints.size() > 4 && w.destroy(dice.one_of(joints));
        break;
      }
      default: {
        const std::vector<JointId> joints = w.joints();
        if (joints.empty()) break;
        const JointId id = dice.one_of(joints);
        JointProperties<S> j = *w.joint(id);
        j.motor_speed = num<S>(dice.in(-2, 2));
        j.user_data = frame;
        done = w.set_joint(id, j);
      }
    }
    if (activity != nullptr) ++(done ? activity->accepted : activity->refused);
  }
}

/// A frame of the hail: its commands, a step, the hash. Every fifth second is quiet, so that islands fall asleep.
template <class S> std::uint64_t play(World<S>& w, std::uint64_t frame, Activity* activity = nullptr) {
  if (frame / 60 % 5 != 4) hail(w, frame, activity);
  w.step();
  if (activity != nullptr) activity->watch(w);
  return w.hash();
}

}  // namespace isostep::test
