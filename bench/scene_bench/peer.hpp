// What the peers share: the scene as doubles, and measures by the same exact geometry as ours.
// SPDX-License-Identifier: MIT
#pragma once

#include "engine.hpp"
#include "isostep/math/transform.hpp"

namespace isostep::bench {

struct PeerPart {
  ShapeType type;
  Vec3<double> half_extents;   // [m] box
  double radius, half_height;  // [m] sphere, capsule along local y
  Vec3<double> position;       // [m] in the body's frame
  Quat<double> orientation;
};
/// A body of one part at its origin, or one that no force moves: so its origin is its centre of mass.
struct PeerBody {
  BodyType type;
  std::vector<PeerPart> parts;
  Vec3<double> position, velocity, spin;  // [m], [m/s], [rad/s] world
  Quat<double> orientation;
  double mass;           // [kg]
  Vec3<double> inertia;  // [kg m^2] principal, body axes
  double friction;
  bool collide;
};
struct PeerJoint {
  int a, b;             // -1: the world
  Vec3<double> anchor;  // [m] world, at the start
};
struct PeerAnchors {
  Vec3<double> on_a, on_b;  // [m] in the bodies' frames
};
/// How a peer says where a body is.
struct Motion {
  Vec3<double> position, velocity, spin;
  Quat<double> orientation;
};

PeerBody peer_body(const scenes::SceneBody& body);

/// Bodies and ball joints; the script of S9. The rest of what a scene may say is refused by a SceneError.
class Peer : public Engine {
 public:
  explicit Peer(const scenes::Scene& scene);

  void before_step(int frame, bool script) override;
  int faults() const override;
  std::vector<Place> places() const override;
  double joint_error() const override;
  scenes::Energy energy() const override;
  scenes::Overlap overlap() const override;

 protected:
  const std::vector<PeerBody>& bodies() const { return bodies_; }
  const std::vector<PeerJoint>& joints() const { return joints_; }
  const std::vector<PeerAnchors>& anchors() const { return anchors_; }  // of the joints
  Vec3<double> gravity() const { return gravity_; }
  bool allow_sleep() const { return scene_.allow_sleep; }

  virtual Motion motion(std::size_t body) const = 0;
  /// The body at this index is gone; another takes its place.
  virtual void replace(std::size_t body, const PeerBody& by) = 0;
  /// Kinematic bodies are moved by whoever drives the engine, where it does not do so itself.
  virtual void drive(int frame) = 0;

 private:
  Vec3<double> anchor_now(int body, Vec3<double> local) const;

  scenes::Scene scene_;  // with the bodies of now
  std::vector<PeerBody> bodies_;
  std::vector<PeerJoint> joints_;
  std::vector<PeerAnchors> anchors_;
  Vec3<double> gravity_;
};

}  // namespace isostep::bench
