// The base of the peers: the scene as doubles, and measures by the same exact geometry as ours.
// SPDX-License-Identifier: MIT
#pragma once

#include "engine.hpp"
#include "peer_scene.hpp"

namespace isostep::bench {

/// The place and motion of a body, as a peer tells them in the frame of PeerBody.
struct Motion {
  Vec3<double> position, velocity, angular_velocity;
  Quat<double> orientation;
  bool awake;
};

/// Bodies, joints, gears, constant forces, the scripts that exchange bodies or hit one. The rest of what a scene may
/// say is refused by a SceneError.
class Peer : public Engine {
 public:
  explicit Peer(const scenes::Scene& scene);

  void before_step(int frame) override;
  bool all_asleep() const override;
  int faults() const override;
  scenes::Sight sight() const override;
  scenes::Overlap overlap() const override;

 protected:
  const std::vector<PeerBody>& bodies() const { return bodies_; }
  const std::vector<PeerJoint>& joints() const { return joints_; }
  const std::vector<PeerGear>& gears() const { return gears_; }
  const std::vector<PeerForce>& forces() const { return forces_; }
  Vec3<double> gravity() const { return gravity_; }
  double hz() const { return scene_.hz; }  // [1/s] rate of steps
  /// Returns true if the scene lets any of its bodies sleep. Peers take no such setting of one body.
  bool allow_sleep() const;

  virtual Motion motion(std::size_t body) const = 0;
  /// The body at this index is gone; another takes its place.
  virtual void replace(std::size_t body, const PeerBody& by) = 0;
  virtual void launch(std::size_t body, Vec3<double> velocity) = 0;  // [m/s], and does not turn
  /// Drives what the engine does not do itself: kinematic bodies, forces.
  virtual void drive(int frame) = 0;

 private:
  void exchange(int frame);
  void hit(int frame);
  PeerEnd end_now(int body, const PeerEnd& end) const;
  double joint_error() const;
  scenes::Energy energy() const;

  scenes::Scene scene_;  // with the bodies of now
  std::vector<PeerBody> bodies_;
  std::vector<PeerJoint> joints_;
  std::vector<PeerGear> gears_;
  std::vector<PeerForce> forces_;
  Vec3<double> gravity_;
  int frames_ = 0;
};

}  // namespace isostep::bench
