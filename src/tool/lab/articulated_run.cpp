// A scene's tree of hinges as an articulation.
// SPDX-License-Identifier: MIT
#include "articulated_run.hpp"

#include "scenes/trials/scene_numbers.hpp"

namespace isostep::tool::lab {
namespace {

using scenes::Scene;
using scenes::SceneBody;
using scenes::SceneJoint;
using scenes::value;

template <class T> T told(double number) {
  T value{};
  TextError error = TextError::none;
  if (scenes::Number(number).read(value, error)) return value;
  throw scenes::SceneError("", to_text(number) + " is out of range for " + ScalarTraits<T>::kName);
}
template <class T> Vec3<T> told(Vec3<double> v) {
  const T x = told<T>(v.x);
  const T y = told<T>(v.y);
  return {x, y, told<T>(v.z)};
}
template <class S> Quat<Unit<S>> told_turn(Quat<double> q) {
  const Unit<S> x = told<Unit<S>>(q.x);
  const Unit<S> y = told<Unit<S>>(q.y);
  const Unit<S> z = told<Unit<S>>(q.z);
  return {x, y, z, told<Unit<S>>(q.w)};
}

/// A frame of the world in that of a body.
template <class S> Pose<S> frame_in(const SceneBody& body, const SceneJoint& joint) {
  const Quat<double> back = conjugate(value(body.orientation));
  return {told<S>(to_matrix(back) * (value(joint.anchor) - value(body.position))),
          told_turn<S>(normalise(back * value(joint.orientation)))};
}
const SceneBody& body_at(const Scene& scene, int index) { return scene.bodies[static_cast<std::size_t>(index)]; }

/// [rad/s] Of b against a, about the joint's axis.
double rate_of(const Scene& scene, const SceneJoint& joint) {
  const Vec3<double> axis = to_matrix(value(joint.orientation)).column(2);
  return dot(axis, value(body_at(scene, joint.b).angular_velocity) - value(body_at(scene, joint.a).angular_velocity));
}

template <class S> LinkMass<S> link_mass_of(const SceneBody& body) {
  const Vec3<double> own = value(body.inertia);
  const Mat3<double> shape = scenes::inertia_of(body);
  const bool given = dot(own, own) > 0;
  LinkMass<S> mass;
  mass.mass = told<S>(scenes::mass_of(body));
  mass.inertia = told<S>(given ? own : Vec3<double>{shape.rows[0].x, shape.rows[1].y, shape.rows[2].z});
  return mass;
}

/// A motor with the force to reach its speed within a sub-step is a damper of that speed.
template <class S> ArticulationDrive<S> motor_of(const SceneJoint& joint) {
  constexpr double kStrong = 1e3;  // [s/rad] of the motor's greatest torque: all of it beyond 1e-3 rad/s of error
  ArticulationDrive<S> drive;
  drive.speed.x = told<S>(value(joint.motor_speed));
  drive.max_force = told<S>(value(joint.max_force));
  drive.damping = told<S>(kStrong * value(joint.max_force));
  return drive;
}

template <class S> ArticulationDefinition<S> articulation_of(const Scene& scene, const LabPoint& point) {
  ArticulationDefinition<S> definition;
  definition.settings.hz = point.hz;
  definition.settings.substeps = point.substeps;
  definition.settings.gravity = told<S>(value(scene.gravity));
  ArticulationLink<S> trunk;
  trunk.type = ArticulationJoint::free;
  trunk.mass = link_mass_of<S>(scene.bodies.front());
  definition.links.push_back(trunk);
  for (const SceneJoint& joint : scene.joints) {
    ArticulationLink<S> link;
    link.parent = static_cast<std::uint32_t>(joint.a);
    link.frame_a = frame_in<S>(body_at(scene, joint.a), joint);
    link.frame_b = frame_in<S>(body_at(scene, joint.b), joint);
    link.mass = link_mass_of<S>(body_at(scene, joint.b));
    if ((joint.flags & joint_flag::kMotor) != 0) link.drive = motor_of<S>(joint);
    definition.links.push_back(link);
  }
  return definition;
}

template <class S> void set_start(const Scene& scene, Articulation<S>& tree) {
  const SceneBody& trunk = scene.bodies.front();
  JointCoordinates<S> free;
  free.position = told<S>(value(trunk.position));
  free.rotation = told_turn<S>(value(trunk.orientation));
  free.velocity = told<S>(value(trunk.velocity));
  free.angular_velocity = told<S>(value(trunk.angular_velocity));
  bool taken = tree.set_coordinates(0, free);
  for (const SceneJoint& joint : scene.joints) {
    JointCoordinates<S> hinge;
    hinge.velocity.x = told<S>(rate_of(scene, joint));
    taken = taken && tree.set_coordinates(static_cast<std::uint32_t>(joint.b), hinge);
  }
  if (!taken) throw scenes::SceneError("", std::string("the articulation is refused: ") + describe(tree.fault()));
}

}  // namespace

std::string refusal_of_articulation(const Scene& scene) {
  if (scene.script != scenes::Script::none || !scene.records.empty())
    return "an articulation has no scripts or records";
  for (const SceneBody& body : scene.bodies) {
    if (body.type != BodyType::dynamic || body.collide) return "an articulation has no contacts";
    if (body.parts.size() != 1) return "of an articulation each body has one part";
  }
  if (scene.joints.size() + 1 != scene.bodies.size()) return "the scene is not one tree";
  for (std::size_t i = 0; i < scene.joints.size(); ++i) {
    const SceneJoint& joint = scene.joints[i];
    if (joint.type != JointType::hinge || (joint.flags & ~joint_flag::kMotor) != 0) return "not all joints are hinges";
    if (joint.a < 0 || joint.b != static_cast<int>(i) + 1 || joint.b <= joint.a)
      return "bodies do not stand in a tree's order";
  }
  return "";
}

template <class S> ArticulatedRun<S>::ArticulatedRun(const Subject& subject, const LabPoint& point) {
  if (const std::string why = refusal_of_articulation(subject.scene); !why.empty()) throw scenes::SceneError("", why);
  if (const auto built = tree_.build(articulation_of<S>(subject.scene, point)); !built) {
    throw scenes::SceneError(std::string(built.error().place.view()), std::string(built.error().message.view()));
  }
  set_start(subject.scene, tree_);
}

template <class S> bool ArticulatedRun<S>::step() {
  const ArticulationReport report = tree_.step();
  return report.clamped + report.lost != 0;
}

template <class S> scenes::Energy ArticulatedRun<S>::energy() const {
  scenes::Energy energy;
  const Vec3<double> gravity = scenes::in_double(tree_.definition().settings.gravity);
  for (std::uint32_t i = 0; i < tree_.links(); ++i) {
    const LinkMass<S>& of = tree_.definition().links[i].mass;
    const double mass = to_double(of.mass);
    const LinkVelocity<S> moves = tree_.link_velocity(i);
    const Mat3<double> axes = to_matrix(normalise(scenes::in_double(tree_.link_pose(i).orientation)));
    const Vec3<double> v = scenes::in_double(moves.linear),
                       spin = transposed_times(axes, scenes::in_double(moves.angular));
    const Vec3<double> inertia = scenes::in_double(of.inertia);
    energy.kinetic += 0.5 * (mass * dot(v, v) + inertia.x * spin.x * spin.x + inertia.y * spin.y * spin.y +
                             inertia.z * spin.z * spin.z);
    energy.potential -= mass * dot(gravity, scenes::in_double(tree_.link_centre(i)));
    energy.mass += mass;
  }
  return energy;
}

/// A link's frame is at its centre of mass.
template <class S> scenes::Sight ArticulatedRun<S>::sight(int faults) const {
  scenes::Sight sight;
  sight.time = static_cast<double>(tree_.tick()) / tree_.definition().settings.hz;
  for (std::uint32_t i = 0; i < tree_.links(); ++i) {
    const LinkVelocity<S> moves = tree_.link_velocity(i);
    sight.bodies.push_back({scenes::in_double(tree_.link_centre(i)), scenes::in_double(tree_.link_pose(i).orientation),
                            scenes::in_double(moves.linear), scenes::in_double(moves.angular), true, true});
  }
  sight.energy = energy();
  sight.faults = faults;
  return sight;
}

#define ISO_INSTANTIATE(S) template class ArticulatedRun<S>;
ISO_IF_FLOAT(ISO_INSTANTIATE) ISO_IF_DOUBLE(ISO_INSTANTIATE) ISO_IF_Q32_32(ISO_INSTANTIATE)
#undef ISO_INSTANTIATE

}  // namespace isostep::tool::lab
