// A scene as peers are given it: doubles, every body's frame at its centre of mass along its principal axes.
// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "isostep/math/transform.hpp"
#include "peer_surface.hpp"

namespace isostep::bench {

struct PeerPart {
  ShapeType type;
  Vec3<double> half_extents;   // [m] box
  double radius, half_height;  // [m] sphere; capsule, cylinder, cone along local y, its apex up
  Vec3<double> normal;         // [1] half-space, in the part's frame: normal . p <= offset is inside
  double offset;               // [m] half-space
  Vec3<double> position;       // [m] in the frame of PeerBody
  Quat<double> orientation;
  BlobRef hull;                                // null: no hull
  std::vector<Vec3<double>> points;            // [m] its vertices; hulls lie in PeerBody's frame as they are
  double thickness;                            // [m] radius of a sphere that fits into it; 0 of what has no inside
  std::shared_ptr<const PeerSurface> surface;  // null: no mesh and no height field; that one's frame is at its middle
};
struct PeerBody {
  BodyType type;
  std::vector<PeerPart> parts;
  Vec3<double> position, velocity, angular_velocity;  // [m], [m/s], [rad/s] world; of the centre of mass
  Quat<double> orientation;                           // of the principal axes
  Pose<double> frame;                                 // this frame in the scene's frame of the body
  double mass;                                        // [kg]
  Vec3<double> inertia;                               // [kg m^2] principal
  double friction, restitution;                       // [1] pairs: root of the product, the larger
  double gravity_scale;                               // [1]
  double linear_damping, angular_damping;             // [1/s]
  std::uint32_t group;                                // bodies of one group other than 0 do not collide
  bool collide;
  bool fast;  // it moves by more than its thickness in a step: an engine that has a switch for such bodies is to use it
};
/// One end of a joint, in the frame of PeerBody; the world's for the world.
using PeerEnd = Pose<double>;
/// Hinges and sliders may have limits and motors, balls a cone and a twist as far to both sides, hinges and distance
/// joints may be springs.
struct PeerJoint {
  JointType type;
  int a, b;             // a = -1: the world
  PeerEnd on_a, on_b;   // z is the axis
  bool is_limited;      // a hinge, a slider, or the twist of a ball
  double lower, upper;  // [rad], 0 at the start; of distance joints and sliders [m]
  double cone;          // [rad] of a ball; 0: none
  bool has_motor;
  double motor_speed, motor_force;  // [rad/s] and [N m] of a hinge, [m/s] and [N] of a slider; of b against a
  bool is_spring;
  double rest, stiffness, damping;  // [m], [N/m], [N s/m]; of a hinge [rad], [N m/rad], [N m s/rad]
  bool collide;                     // the two bodies with each other
};
/// Two hinges whose angles go together: ratio_a angle_a + ratio_b angle_b stays 0.
struct PeerGear {
  std::size_t joint_a, joint_b;  // in the list of joints; their other ends are the world
  double ratio_a, ratio_b;
};

/// A constant force at the centre of mass of a body that does not turn.
struct PeerForce {
  std::size_t body;
  Vec3<double> force;  // [N] world
};

/// Throw SceneError with the reason where peers cannot be told.
PeerBody peer_body(const scenes::SceneBody& body);
PeerJoint peer_joint(const scenes::SceneJoint& joint, const std::vector<PeerBody>& bodies);
PeerGear peer_gear(const scenes::SceneRecord& record, const std::vector<scenes::SceneJoint>& joints);
/// Returns the force of a thruster that pushes its body at the centre of mass, and nowhere else.
PeerForce peer_force(const scenes::SceneRecord& record, const std::vector<scenes::SceneBody>& bodies);
Vec3<double> peer_gravity(const scenes::Scene& scene);
/// The bodies of the scene are PeerBody::fast: bullets, and thin boxes.
bool has_fast_bodies(const scenes::Scene& scene);

}  // namespace isostep::bench
