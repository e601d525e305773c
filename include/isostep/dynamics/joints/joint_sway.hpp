// Sway: what a taut rod, rope or spring does across itself when its ends move sideways in a sub-step.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/dynamics/joints/joint_couplings.hpp"
#include "isostep/dynamics/joints/joint_frames.hpp"

namespace isostep::detail {

/// [1] The (angular frequency h)^2 up to which explicit steps act across a taut rod: an eighth of what they can follow,
/// since a light link hangs on two rods and its arms add as much.
template <class S> inline constexpr S kSwayLimit = S(0.5);
/// [m] A shorter rod pulls sideways like one of this length.
template <class S> inline constexpr S kShortestSway = S(0x1p-10);

/// Returns a row along the line between the origins, or across it.
template <class S> ISO_INLINE JointRow<S> line_row(const JointFrames<S>& f, Vec3<Unit<S>> axis) {
  const Vec3<S> zero = Vec3<S>::zero();
  return {convert<S>(axis), cross(f.arm_a, axis), cross(f.arm_b, axis), zero, zero};
}

/// Adds the drives of rows 1 and 2 of the first block.
template <class S> ISO_INLINE void add_sways(JointConstraint<S>& joint) {
  for (const std::uint32_t place : {1u, 2u}) {
    JointDrive<S>& drive = joint.drives[joint.drive_count++];
    drive = {};
    drive.block = 0;
    drive.place = place;
    drive.sways = true;
  }
}

/// [m/s] Returns the tension of a rod, rope or spring: the impulse of its own row, an equality or the first drive.
template <class S> ISO_INLINE Velocity<S> tension_of(const JointConstraint<S>& joint) {
  return joint.drives[0].sways ? -joint.blocks[0].impulse.x : -joint.drives[0].impulse;
}

/// Source:  Andrews, Teichmann, Kovecses 2017 (joint_tension.hpp): under a tension f a rod of length l pulls its ends
///          back across itself with f / l for each metre, and turns links on arms a with f a^2 / l.
/// Why:     its direction is that at the start of the sub-step. A light link between short rods under a heavy weight
///          sways faster than such steps can follow, and they would drive it.
/// Method:  the direction at the end of the sub-step is the present one plus the way across it, h v / l. So the impulse
///          across is -(h p / l) v, by backward Euler: a damper, which takes energy and gives none. The part that
///          explicit steps can follow is left to them.
/// Symbols: p = impulse of the rod itself, as velocity of the reduced mass: that of the last sub-step, and of this one
///          if it is much more. sway = h / l.
template <class S>
ISO_INLINE void set_sways(const JointFrames<S>& f, Vec3<Unit<S>> unit, S length, Step<S> h, JointDrive<S>* sways) {
  const Tangents<Unit<S>> across = tangents_of(unit);
  sways[0].row = line_row(f, across.t);
  sways[1].row = line_row(f, across.u);
  sways[0].sway = sways[1].sway = divide_to<S>(S(1) * h, max(length, kShortestSway<S>));
}

/// [1] Returns the part of h p / l for which a sub-step is too long.
template <class S> ISO_INLINE S excess_sway(const JointDrive<S>& drive, Velocity<S> tension) {
  return saturate_to<S>(product(drive.sway, max(tension, Velocity<S>(0)))) - drive.sway_left;
}
template <class S> ISO_INLINE void set_sway(JointDrive<S>& drive, S excess) {
  drive.spring = S(8) * resolution<S>() < excess ? sqrt(excess) : S(0);
  drive.spring_row = direction_of(S(1), drive.spring, S(0));
  drive.spring_push = drive.spring_speed = Velocity<S>(0);
}
template <class S>
ISO_INLINE void weigh_sway(const JointConstraint<S>& joint, const JointStep<S>& step, JointDrive<S>& drive) {
  drive.spring = S(0);
  drive.sway_left = S(0);
  if (step.bodies == nullptr || !joint.holds) return;
  const std::vector<SolverMass<S>>& mass = step.bodies->mass;
  set_turns(drive.row, mass[joint.row_a].kappa, mass[joint.row_b].kappa);
  drive.sway_left = kSwayLimit<S> / self_coupling(drive.row, drive.row, joint.share);
  set_sway(drive, excess_sway(drive, tension_of(joint)));
}
/// Returns true if the rod pulls so much harder in this pass that its ends would be driven: then the pass begins again.
template <class S> ISO_INLINE bool judge_sway(const JointConstraint<S>& joint, JointDrive<S>& drive, bool may_hold) {
  drive.next = drive.piece;
  const S excess = excess_sway(drive, tension_of(joint));
  if (!may_hold || !(drive.sway_left + S(1.5) * (drive.spring * drive.spring) < excess)) return false;
  set_sway(drive, excess);
  return true;
}

}  // namespace isostep::detail
