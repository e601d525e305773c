// What random worlds are made of: every kind of shape, body and joint, with the bounds within which it is drawn.
// What is new joins here, once, and is in every random world: a shape in draw_primitive, a joint in draw_joint, a
// property of bodies in draw_body. A command joins random/changes.hpp, energy that is held or given
// random/energy_book.hpp, a query random/questions.hpp. Records follow from their kind's file: random/records.hpp.
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <vector>

#include "random/dice.hpp"
#include "random/hull.hpp"
#include "random/joint_angles.hpp"

namespace isostep::test {

inline constexpr double kLeast = 0.1, kMost = 0.4;  // [m] sizes: inside every scalar's range with the arms below

/// A shape and the radius of a ball about the body's origin that it is in.
struct DrawnShape {
  ShapeId shape;
  double reach;  // [m]
};

static_assert(kShapeTypes == 9, "random worlds have every shape that moves: see draw_primitive()");
/// `blobs` are those of its shape. Half of the boxes are hulls in a box of that size, a third of them rounded, and a
/// third each of the capsules cylinders and cones, drawn by dice of their own: what is drawn after them is as it was
/// before there were those.
template <class S> Primitive<S> draw_primitive(Dice& dice, double* reach, std::vector<BlobRef>& blobs) {
  const double a = dice.in(kLeast, kMost), b = dice.in(kLeast, kMost), c = dice.in(kLeast, kMost);
  const std::uint32_t kind = dice.below(3);
  *reach = kind == 0 ? a : kind == 1 ? length({a, b, c}) : a + b;
  if (kind == 0) return primitive_of(Sphere<S>{num<S>(a)});
  Dice own = dice;
  if (kind == 2) {
    const std::uint32_t round = own.below(3);
    if (round == 0) return primitive_of(Capsule<S>{num<S>(a), num<S>(b)});
    return round == 1 ? primitive_of(Cylinder<S>{num<S>(a), num<S>(b)}) : primitive_of(Cone<S>{num<S>(a), num<S>(b)});
  }
  if (own.one_in(2)) return primitive_of(Box<S>{vec<S>(a, b, c)});
  blobs.push_back(draw_hull(own, {a, b, c}));
  const double radius = own.one_in(3) ? own.in(0.02, 0.25) : 0.0;
  *reach += radius;
  return primitive_of(Hull<S>{static_cast<std::uint32_t>(blobs.size()), num<S>(radius)});
}
/// Static friction, a grain, a kind. By dice of its own: what is drawn after it is as it was before there was this.
template <class S> void draw_surface(std::uint64_t seed, Material<S>& material);

/// What a part has of its own, by dice of its own. The first of a body's weighs something and rests on the ground; the
/// others may sense, or pass whatever they meet.
template <class S> PartTraits<S> draw_traits(Dice own, std::uint32_t part) {
  PartTraits<S> traits;
  if (own.one_in(3)) {
    Material<S> material;
    material.friction = num<S>(own.in(0, 1.25));
    if (own.one_in(4)) material.restitution = num<S>(own.in(0, 1));
    draw_surface(own.next(), material);
    traits.with(material);
  }
  if (own.one_in(4)) traits.with(part_flag::kReportContacts);
  const Filter passes = {1u << own.below(2), 0, own.below(3)};
  if (part != 0 && own.one_in(4)) traits.with(passes);
  if (part != 0 && own.one_in(4)) traits.with(part_flag::kSensor);
  return traits;
}
/// A primitive, or two or three of them in one body.
template <class S> DrawnShape draw_shape(World<S>& w, Dice& dice) {
  std::vector<Child<S>> children;
  std::vector<BlobRef> blobs;
  double reach = 0;
  const std::uint32_t count = dice.one_in(4) ? 2 + dice.below(2) : 1;
  for (std::uint32_t i = 0; i < count; ++i) {
    double own = 0;
    Child<S> child = {draw_primitive<S>(dice, &own, blobs), Pose<S>::identity()};
    if (count > 1) {
      const D3 at = dice.point(0.25);
      child.pose = {vec<S>(at), dice.orientation<S>()};
      child.traits = draw_traits<S>(dice, i);
      own += length(at);
    }
    reach = std::max(reach, own);
    children.push_back(child);
  }
  return {w.add_shape(std::span<const Child<S>>(children), blobs), reach};
}

template <class S> void draw_surface(std::uint64_t seed, Material<S>& material) {
  Dice dice(seed);
  if (dice.one_in(3)) material.static_friction = num<S>(dice.in(0, 2));
  if (dice.one_in(3)) {
    const auto factor = [&] { return std::exp2(-dice.in(0, 6)); };  // as little as a material may have
    const double x = factor(), y = factor();
    material.anisotropy = vec<S>(x, y, factor());
  }
  if (dice.one_in(2)) material.kind = 1 + dice.below(kMaterialKinds);
}
/// Anything but a pose, a type and a speed.
template <class S> BodyDefinition<S> draw_body(Dice& dice, ShapeId shape) {
  BodyDefinition<S> d;
  d.type = BodyType::dynamic;
  d.shape = shape;
  d.orientation = dice.orientation<S>();
  d.mass = num<S>(dice.magnitude(0.25, 4));
  d.material.friction = num<S>(dice.in(0, 1.25));
  if (dice.one_in(4)) d.material.restitution = num<S>(dice.in(0, 1));
  if (dice.one_in(6)) d.material.rolling_resistance = num<S>(dice.in(0, 0.0625));
  if (dice.one_in(6)) d.linear_damping = num<S>(dice.in(0, 0.5));
  if (dice.one_in(4)) d.angular_damping = num<S>(dice.in(0, 0.5));
  if (dice.one_in(8)) d.gravity_scale = num<S>(dice.in(0, 1));
  if (dice.one_in(12)) d.locks = body_flag::kLockX << dice.below(6);
  if (dice.one_in(24)) d.collide = false;
  d.allow_sleep = !dice.one_in(8);
  d.user_data = dice.next();
  d.bullet = d.user_data % 8 == 0;
  d.report_contacts = d.user_data % 3 != 0;
  draw_surface(d.user_data, d.material);
  return d;
}

/// The drives that may put energy into a world, so what bounds it: a world has its own and those before it.
enum class Drive {
  commands,
  springs,  // that held some at the start
  motors,   // of joints
  movers    // kinematic bodies, belts and forces, which have as much as they like
};
inline constexpr int kDrives = 4;

/// Limits, springs and motors of a joint that was just placed: what holds at its pose. Distance joints join centres.
template <class S> void draw_joint(const World<S>& w, Dice& dice, Drive drive, JointProperties<S>& p) {
  using namespace joint_flag;
  const bool springs = drive >= Drive::springs, motors = drive >= Drive::motors;
  p.frame_b.position = p.type == JointType::distance ? Vec3<S>::zero() : p.frame_b.position;
  if (dice.one_in(8)) p.flags |= kCollideConnected;
  p.lower = num<S>(-dice.in(0.05, 1.5));
  p.upper = num<S>(dice.in(0.05, 1.5));
  p.cone = num<S>(dice.in(0.1, 1.5));
  p.spring_target = num<S>(dice.in(-0.5, 0.5));
  p.spring_frequency = num<S>(dice.magnitude(0.5, 6));
  p.spring_damping = num<S>(dice.in(0, 1));
  switch (p.type) {
    case JointType::ball: p.flags |= (dice.one_in(2) ? 0u : kLimit) | (dice.one_in(2) ? 0u : kCone); break;
    case JointType::hinge:
    case JointType::planar:
    case JointType::slider:
    case JointType::cylindrical:
      p.flags |= (dice.one_in(3) ? 0u : kLimit) | (springs && dice.one_in(2) ? kSpring : 0u);
      if (!motors || dice.one_in(2)) break;
      p.flags |= kMotor;
      p.motor_speed = num<S>((dice.one_in(2) ? 1 : -1) * dice.in(0.5, 5));
      p.max_force = num<S>(dice.magnitude(0.25, 25));
      break;
    case JointType::constant_velocity: p.flags |= dice.one_in(2) ? 0u : kCone; break;
    case JointType::fixed:
    case JointType::universal:
    case JointType::angular: break;
    case JointType::six_axis: {
      Dice own = dice;
      p.flags |= own.one_in(2) ? kLockPoint : own.below(8) * kLockX;
      p.flags |= own.below(8) * kLockSwingX;
      if ((p.flags & kLockPoint) == 0) p.flags |= kLockX;  // something holds
      if (own.one_in(2)) p.flags |= kCone;
      break;
    }
    case JointType::distance: {
      const double apart = angles_of(w, p).apart;
      p.flags |= springs && dice.one_in(2) ? kSpring : kLimit;
      if (dice.one_in(3)) p.flags |= kLimit;
      const bool rod = dice.one_in(3) && (p.flags & kSpring) == 0;
      p.lower = num<S>(rod ? apart : apart * dice.in(0, 0.9));
      p.upper = rod ? p.lower : num<S>(apart * dice.in(1.1, 1.5));
      p.spring_target = num<S>(apart * dice.in(0.75, 1.25));
      break;
    }
  }
}

/// Draws drives of the axes that a six-axis joint leaves: limits about where they are, brakes, springs and servos at
/// rest. None of them gives energy.
template <class S> void draw_axis_drives(World<S>& w, Dice& dice, Drive drive, JointId joint) {
  for (std::uint32_t i = 0; i < kJointAxes; ++i) {
    const JointAxis axis = static_cast<JointAxis>(i);
    const bool way = is_length(axis);  // always limited: what slides metres away is on a lever of its own
    if ((w.joint(joint)->flags & lock_of(axis)) != 0 || (dice.one_in(3) && !way)) continue;
    AxisDrive<S> d;
    d.joint = joint;
    d.axis = axis;
    d.limited = !dice.one_in(3) || way;
    d.upper = num<S>(dice.in(0.05, 1.5));
    d.lower = (w.joint(joint)->flags & joint_flag::kCone) != 0 ? -d.upper : num<S>(-dice.in(0.05, 1.5));
    d.motor = dice.one_in(3);
    if (d.motor || dice.one_in(2)) d.max_force = num<S>(dice.magnitude(0.25, 25));
    if (drive >= Drive::springs && dice.one_in(2)) {
      d.spring_frequency = num<S>(dice.magnitude(0.5, 6));
      d.spring_damping = num<S>(dice.in(0, 1));
    }
    Dice yields = dice.apart();
    if (yields.one_in(4)) {
      d.limit_frequency = num<S>(yields.magnitude(2, 60));
      d.limit_damping = num<S>(yields.in(0, 2));
    }
    if (yields.one_in(3)) d.spring_mass = num<S>(yields.magnitude(0.0625, 64));
    w.add(d);
  }
}

}  // namespace isostep::test
