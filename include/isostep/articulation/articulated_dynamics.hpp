// ArticulatedDynamics<S>: accelerations of a tree of links by the articulated-body algorithm.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "isostep/articulation/joint_work.hpp"

namespace isostep::detail {

/// The quantities of one link in a sub-step. Vectors are along the world's axes; lengths in the tree's units, masses
/// over the tree's. Moments and accelerations are of the anchor, the origin of frame b.
template <class S> struct LinkWork {
  // Its pose.
  Quat<Unit<S>> orientation;  // of the link
  Mat3<Unit<S>> turn, frame;  // of the link and of frame a, to the world
  Vec3<Unit<S>> axis;         // [1]
  Vec3<S> arm;                // from the parent's anchor
  Vec3<S> place;              // from the base, or from the free link's own anchor
  Vec3<S> centre;             // of mass, from the anchor
  Mat3<S> inertia;            // about the centre of mass
  // Its motion.
  Vec3<S> spin;    // [rad/s]
  Vec3<S> moving;  // [1/s] of the anchor, against the base or the free link's own anchor
  Wrench<S> load;  // from outside, about the centre of mass
  // Its resistance: I^A, and the part of it that passes the joint.
  ArticulatedInertia<S> whole, passed;
  Wrench<S> column;           // U of a hinge or slider
  S pivot;                    // D of it; 0: nothing resists, and the joint does not move
  Symmetric3<S> pivots;       // D of a ball; of a free link the linear part and
  Symmetric3<S> turn_pivots;  // what is left of it for turning
  Vec3<S> stop_axis;          // of a ball at the edge of its cone: n,
  Vec3<S> stop_answer;        // D^-1 n,
  S stop_pivot;               // n D^-1 n
  // Forces.
  Wrench<S> bias;                // p^A
  PointAcceleration<S> carried;  // acceleration of the joint's place by spins alone
  Vec3<S> push;                  // u, of a hinge or slider x
  PointAcceleration<S> acceleration;
  Vec3<S> slide;  // of a free link, along frame a
  JointWork<S> joint;
};

/// Source:  Featherstone 2008, Rigid Body Dynamics Algorithms, table 7.1 and, for joints that are stopped, section 9.2
///          (hybrid dynamics).
/// Differs: axes are the world's, and accelerations those of the anchors (not spatial): speeds along a line cancel.
///          Gravity is an acceleration of the base upwards, so what is found of links is against free fall.
/// Symbols: I^A whole, p^A bias, U = I^A S column, D = S^T U + law pivot, u = law - S^T p^A push.
/// Limits:  fixed point: spins up to 256 rad/s or half a radian a sub-step, accelerations up to 2^22 rad/s^2 and 2^28
///          units/s^2; inertia is below 2^12 and every sum of forces is held within half of the format.
/// Order:   links in their order outwards, against it inwards.
template <class S> class ArticulatedDynamics {
 public:
  /// Makes scratch for a tree: this allocates, nothing else does.
  void reset(const ArticulatedTree<S>& tree);

  const LinkWork<S>& of(std::size_t link) const { return work_[link + 1]; }
  LinkWork<S>& of(std::size_t link) { return work_[link + 1]; }

  /// Finds poses from coordinates.
  void place(const ArticulatedTree<S>& tree, const ArticulationState<S>& state);
  /// Finds spins from speeds; these are scaled down where a link would be faster than it may, and false is returned.
  bool spin(const ArticulatedTree<S>& tree, std::vector<S>& speeds);
  /// [rad/s] The largest of those spins along an axis of the world.
  S fastest() const { return fastest_; }
  /// Finds speeds of anchors, after `spin`.
  void follow(const ArticulatedTree<S>& tree, const std::vector<S>& speeds);

  /// Prepares a step: drives and loads.
  void prepare(const ArticulatedTree<S>& tree, const ArticulationState<S>& state);
  /// Begins a sub-step, after `place`: measures joints, releases all stops.
  void begin(const ArticulatedTree<S>& tree, const ArticulationState<S>& state);
  /// Finds inertias under the laws and stops of joints.
  void factor(const ArticulatedTree<S>& tree);
  /// Finds accelerations, after `spin`.
  void accelerate(const ArticulatedTree<S>& tree, const std::vector<S>& speeds);
  /// Chooses stops and drives anew. Returns true if any changed: `factor` has to follow.
  bool choose(const ArticulatedTree<S>& tree, bool may_release);
  /// Computes to = from + share h acceleration. Returns false if a joint would be too fast, and was held.
  bool quicken(const ArticulatedTree<S>& tree, const std::vector<S>& from, S share, std::vector<S>& to) const;
  /// Holds the speeds of hinges and sliders to what limits allow.
  void hold_limits(const ArticulatedTree<S>& tree, std::vector<S>& speeds) const;

 private:
  void place_link(const ArticulatedTree<S>& tree, const ArticulationState<S>& state, std::size_t link);
  S spin_links(const ArticulatedTree<S>& tree, const std::vector<S>& speeds);
  void resist_scalar(const ArticulatedTree<S>& tree, const PreparedLink<S>& l, LinkWork<S>& w);
  void resist_ball(const ArticulatedTree<S>& tree, const PreparedLink<S>& l, LinkWork<S>& w);
  void stop_ball(LinkWork<S>& w);
  void resist_free(LinkWork<S>& w);
  void load(const ArticulatedTree<S>& tree, const std::vector<S>& speeds, std::size_t link);
  void pass_bias(const PreparedLink<S>& l, LinkWork<S>& w);
  Wrench<S> passed_bias(const PreparedLink<S>& l, LinkWork<S>& w);
  void answer(const PreparedLink<S>& l, LinkWork<S>& w);
  void answer_scalar(const PreparedLink<S>& l, LinkWork<S>& w);
  void answer_ball(LinkWork<S>& w);
  void answer_free(LinkWork<S>& w);

  std::vector<LinkWork<S>> work_;  // 0: the base
  S fastest_ = S(0);
};

}  // namespace isostep::detail
