// Scenes into the doubles of peers.
// SPDX-License-Identifier: MIT
#include "peer_scene.hpp"

#include <cmath>
#include <utility>

#include "isostep/dynamics/joints/joint_kinds.hpp"
#include "isostep/geometry/content.hpp"
#include "isostep/geometry/mass_properties.hpp"
#include "scenes/build.hpp"
#include "scenes/hull_points.hpp"
#include "scenes/shapes.hpp"

namespace isostep::bench {
namespace {

using scenes::SceneError;

double real(const scenes::Number& number) { return scenes::value_of<double>(number, "peer"); }
Vec3<double> real(const scenes::Vector& v) { return {real(v[0]), real(v[1]), real(v[2])}; }
Quat<double> real(const scenes::Rotation& q) { return {real(q[0]), real(q[1]), real(q[2]), real(q[3])}; }

/// The thickness of a part; of a hull, a mesh, a height field and a half-space 0.
double thickness_of(const PeerPart& part) {
  switch (part.type) {
    case ShapeType::box: return min(part.half_extents.x, min(part.half_extents.y, part.half_extents.z));
    case ShapeType::sphere:
    case ShapeType::capsule: return part.radius;
    case ShapeType::cylinder: return min(part.radius, part.half_height);
    case ShapeType::cone: return min(part.radius, part.half_height) / 2;
    default: return 0;
  }
}

PeerPart peer_part(const scenes::ScenePart& part) {
  PeerPart made = {part.type,
                   real(part.half_extents),
                   real(part.radius),
                   real(part.half_height),
                   real(part.normal),
                   real(part.offset),
                   real(part.position),
                   real(part.orientation),
                   nullptr,
                   {},
                   0,
                   nullptr};
  made.thickness = thickness_of(made);
  if (part.type == ShapeType::hull) {
    if (made.radius != 0) throw SceneError("", "other engines are given no hulls with a radius");
    made.hull = scenes::hull_of_part(part, "peer");
    const auto solid = scenes::solid_hull(*made.hull);
    made.points = solid->vertices;
    made.thickness = solid->inner_radius;
  } else if (part.type == ShapeType::mesh || part.type == ShapeType::height_field) {
    made.surface = peer_surface(part);
    if (part.type == ShapeType::height_field) {
      made.position += to_matrix(normalise(made.orientation)) * made.surface->middle();
    }
  }
  return made;
}

/// `blob` as Primitive has it.
Primitive<double> primitive(const PeerPart& part, std::uint32_t blob) {
  switch (part.type) {
    case ShapeType::sphere: return primitive_of(Sphere<double>{part.radius});
    case ShapeType::capsule: return primitive_of(Capsule<double>{part.radius, part.half_height});
    case ShapeType::hull: return primitive_of(Hull<double>{blob});
    case ShapeType::cylinder: return primitive_of(Cylinder<double>{part.radius, part.half_height});
    case ShapeType::cone: return primitive_of(Cone<double>{part.radius, part.half_height});
    default: return primitive_of(Box<double>{part.half_extents});
  }
}

/// The mass properties that World<double> has of the same body.
MassProperties<double> mass_of(const PeerBody& body, const scenes::SceneBody& of) {
  std::vector<Child<double>> children;
  std::vector<BlobRef> blobs;
  for (const PeerPart& part : body.parts) {
    if (part.hull != nullptr) blobs.push_back(part.hull);
    const auto blob = static_cast<std::uint32_t>(blobs.size());
    children.push_back({primitive(part, blob), {part.position, part.orientation}});
  }
  std::vector<const void*> contents;
  find_contents<double>(blobs, contents);
  const double density = real(of.density);
  MassProperties<double> p = mass_properties<double>(std::span<const Child<double>>(children),
                                                     density > 0 ? density : 1, Contents<double>{contents.data()});
  if (real(of.mass) > 0) p = with_mass(p, real(of.mass));
  const Vec3<double> inertia = real(of.inertia);
  return inertia == Vec3<double>::zero() ? p : from_mass_and_inertia(p.mass, inertia, p.centre);
}

/// Moves a body from the scene's frame to `frame` within it.
void move_frame(PeerBody& body, const Pose<double>& frame) {
  if (frame.is_identity()) return;
  body.frame = frame;
  const Quat<double> back = conjugate(frame.orientation);
  for (PeerPart& part : body.parts) {
    part.position = to_matrix(back) * (part.position - frame.position);
    part.orientation = normalise(back * part.orientation);
  }
  body.position += to_matrix(body.orientation) * frame.position;
  body.orientation = normalise(body.orientation * frame.orientation);
}

void set_mass(PeerBody& body, const scenes::SceneBody& of) {
  for (const PeerPart& part : body.parts) {
    if (is_bounded(part.type)) continue;
    const bool alone = part.surface != nullptr && body.parts.size() == 1;
    if (alone) move_frame(body, {part.position, normalise(part.orientation)});
    return;
  }
  const MassProperties<double> p = mass_of(body, of);
  if (body.type != BodyType::dynamic) return move_frame(body, {p.centre, Quat<double>::identity()});
  move_frame(body, {p.centre, p.principal});
  body.mass = p.mass;
  body.inertia = {p.mass / p.kappa.x, p.mass / p.kappa.y, p.mass / p.kappa.z};
  if (!is_finite(body.inertia)) throw SceneError("", "peers are given no body that cannot turn");
}

/// Moves points into the frame of the body: engines have hulls of one part where the body is.
void move_points(PeerPart& part) {
  const Mat3<double> axes = to_matrix(part.orientation);
  for (Vec3<double>& point : part.points) point = part.position + axes * point;
  part.position = {0, 0, 0};
  part.orientation = Quat<double>::identity();
}

/// [kg] The reduced mass of the two bodies; one that no force moves counts as infinitely heavy.
double reduced_mass(const PeerJoint& joint, const std::vector<PeerBody>& bodies) {
  double inverse = 0;
  for (const int body : {joint.a, joint.b}) {
    if (body < 0 || bodies[static_cast<std::size_t>(body)].type != BodyType::dynamic) continue;
    inverse += 1 / bodies[static_cast<std::size_t>(body)].mass;
  }
  return inverse > 0 ? 1 / inverse : 0;
}
/// [kg m^2] The same of their inertias about the joint's axis.
double reduced_inertia(const PeerJoint& joint, const std::vector<PeerBody>& bodies) {
  double inverse = 0;
  const auto add = [&](int index, const PeerEnd& end) {
    if (index < 0 || bodies[static_cast<std::size_t>(index)].type != BodyType::dynamic) return;
    const Vec3<double> axis = to_matrix(end.orientation).column(2),
                       of = bodies[static_cast<std::size_t>(index)].inertia;
    inverse += axis.x * axis.x / of.x + axis.y * axis.y / of.y + axis.z * axis.z / of.z;
  };
  add(joint.a, joint.on_a);
  add(joint.b, joint.on_b);
  return inverse > 0 ? 1 / inverse : 0;
}
void set_spring(PeerJoint& joint, const scenes::SceneJoint& of, double mass) {
  const double omega = scenes::kTurn * real(of.spring_frequency);  // [rad/s]
  joint.rest = real(of.spring_target);
  joint.stiffness = mass * omega * omega;
  joint.damping = 2 * real(of.spring_damping) * mass * omega;
}
/// Swaps the ends, so that the world is always the first.
void turn_round(PeerJoint& joint) {
  std::swap(joint.a, joint.b);
  std::swap(joint.on_a, joint.on_b);
  joint.motor_speed = -joint.motor_speed;
  if (!joint.is_limited) return;
  std::swap(joint.lower, joint.upper);
  joint.lower = -joint.lower;
  joint.upper = -joint.upper;
}
void require_plain(const scenes::SceneJoint& joint) {
  const std::uint32_t limit = joint_flag::kLimit, spring = joint_flag::kSpring, plain = joint_flag::kCollideConnected;
  const bool turns = joint.type == JointType::hinge, slides = joint.type == JointType::slider,
             distance = joint.type == JointType::distance;
  const std::uint32_t known = plain | (turns || slides ? limit | joint_flag::kMotor : 0u) |
                              (turns || distance ? spring : 0u) | (distance ? limit : 0u);
  const std::uint32_t both = limit | joint_flag::kCone;
  const bool shoulder = joint.type == JointType::ball && (joint.flags & both) == both &&
                        real(joint.lower) == -real(joint.upper) && (joint.flags & ~(plain | both)) == 0;
  if (shoulder) return;
  const bool is_sprung = (joint.flags & spring) != 0 && (joint.flags & (limit | joint_flag::kMotor)) != 0;
  if ((joint.flags & ~known) != 0 || is_sprung) {
    throw SceneError(
        "",
        "peers are given motors and limits of hinges and sliders, limits of whole shoulders, and springs of "
        "hinges and distances by themselves");
  }
}

}  // namespace

PeerBody peer_body(const scenes::SceneBody& of) {
  if (of.sensor) throw SceneError("", "peers are given no sensors");
  if (of.locks != 0) throw SceneError("", "peers are given no locked axes");
  if (real(of.rolling_resistance) != 0 || !(real(of.surface_velocity) == Vec3<double>::zero())) {
    throw SceneError("", "peers are given no rolling resistance and no moving surfaces");
  }
  if (real(of.static_friction) > real(of.friction) || !(real(of.anisotropy) == Vec3<double>{1, 1, 1}) || of.kind != 0) {
    throw SceneError("", "peers are given one coefficient of friction a body");
  }
  PeerBody body = {};
  body.type = of.type;
  for (const scenes::ScenePart& part : of.parts) body.parts.push_back(peer_part(part));
  body.position = real(of.position);
  body.velocity = real(of.velocity);
  body.angular_velocity = real(of.angular_velocity);
  body.orientation = normalise(real(of.orientation));
  body.frame = Pose<double>::identity();
  body.friction = real(of.friction);
  body.restitution = real(of.restitution);
  body.gravity_scale = real(of.gravity_scale);
  body.linear_damping = real(of.linear_damping);
  body.angular_damping = real(of.angular_damping);
  body.group = of.group;
  body.collide = of.collide;
  set_mass(body, of);
  for (PeerPart& part : body.parts) {
    if (part.type == ShapeType::hull) move_points(part);
  }
  return body;
}

PeerJoint peer_joint(const scenes::SceneJoint& of, const std::vector<PeerBody>& bodies) {
  require_plain(of);
  const Quat<double> axes = normalise(real(of.orientation));
  const auto end = [&](int body, const scenes::Vector& anchor) -> PeerEnd {
    if (body < 0) return {real(anchor), axes};
    const PeerBody& at = bodies[static_cast<std::size_t>(body)];
    return {transposed_times(to_matrix(at.orientation), real(anchor) - at.position),
            normalise(conjugate(at.orientation) * axes)};
  };
  PeerJoint joint = {};
  joint.type = of.type;
  joint.a = of.a;
  joint.b = of.b;
  joint.on_a = end(of.a, of.anchor);
  joint.on_b = end(of.b, joins_two_points(of.type) ? of.anchor_b : of.anchor);
  joint.is_limited = of.type != JointType::distance && (of.flags & joint_flag::kLimit) != 0;
  joint.cone = (of.flags & joint_flag::kCone) != 0 ? real(of.cone) : 0;
  joint.lower = real(of.lower);
  joint.upper = real(of.upper);
  joint.has_motor = (of.flags & joint_flag::kMotor) != 0;
  joint.motor_speed = real(of.motor_speed);
  joint.motor_force = real(of.max_force);
  joint.is_spring = (of.flags & joint_flag::kSpring) != 0;
  joint.collide = (of.flags & joint_flag::kCollideConnected) != 0;
  const bool turns = of.type == JointType::hinge;
  if (joint.is_spring) set_spring(joint, of, turns ? reduced_inertia(joint, bodies) : reduced_mass(joint, bodies));
  if (joint.b < 0) turn_round(joint);
  return joint;
}

PeerGear peer_gear(const scenes::SceneRecord& record, const std::vector<scenes::SceneJoint>& joints) {
  const auto refuse = [] {
    return SceneError("", "of records peers are given gears between two wheels on the world, and forces on bodies");
  };
  if (record.kind != "coupling") throw refuse();
  PeerGear gear = {joints.size(), joints.size(), 1, 1};
  for (const scenes::SceneField& field : record.fields) {
    const double value = real(field.numbers.front());
    if (field.name == "joint_a") gear.joint_a = static_cast<std::size_t>(value);
    else if (field.name == "joint_b") gear.joint_b = static_cast<std::size_t>(value);
    else if (field.name == "ratio_a") gear.ratio_a = value;
    else if (field.name == "ratio_b") gear.ratio_b = value;
    else throw refuse();
  }
  for (const std::size_t joint : {gear.joint_a, gear.joint_b}) {
    const bool wheel = joint < joints.size() && joints[joint].type == JointType::hinge && joints[joint].a < 0;
    if (!wheel || joints[joint].b < 0) throw refuse();
  }
  return gear;
}

PeerForce peer_force(const scenes::SceneRecord& record, const std::vector<scenes::SceneBody>& bodies) {
  PeerForce made = {bodies.size(), {0, 0, 0}};
  Vec3<double> local = {0, 0, 0};
  for (const scenes::SceneField& field : record.fields) {
    if (field.name == "body") {
      made.body = static_cast<std::size_t>(real(field.numbers.front()));
    } else if (field.name == "force" && field.numbers.size() == 3) {
      local = {real(field.numbers[0]), real(field.numbers[1]), real(field.numbers[2])};
    } else {
      throw SceneError("", "peers are given thrusters that have a body and a force alone");
    }
  }
  if (made.body >= bodies.size()) throw SceneError("", "a thruster of no body");
  made.force = to_matrix(normalise(real(bodies[made.body].orientation))) * local;
  return made;
}

Vec3<double> peer_gravity(const scenes::Scene& scene) { return real(scene.gravity); }

bool has_fast_bodies(const scenes::Scene& scene) {
  return scene.name.rfind("S13", 0) == 0 || scene.name.rfind("S15", 0) == 0;
}

}  // namespace isostep::bench
