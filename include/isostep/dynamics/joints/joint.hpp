// Joints: the calls by which a step solves them. What is stored of one: joint_record.hpp.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>

#include "isostep/core/instantiate.hpp"
#include "isostep/dynamics/body.hpp"
#include "isostep/dynamics/joints/joint_drive.hpp"
#include "isostep/dynamics/joints/joint_record.hpp"
#include "isostep/dynamics/solver_body.hpp"

namespace isostep {

/// One end of a joint for the solver.
template <class S> struct JointEnd {
  std::uint32_t row;  // of SolverBodies
  Pose<S> pose;       // centre and orientation when the step begins; the world's is the identity
};
template <class S> struct JointEnds { JointEnd<S> a, b; };

/// A joint for the length of one step.
template <class S> struct JointConstraint {
  JointProperties<S> properties;
  std::uint32_t row_a, row_b;
  MassShare<S> share;
  Pose<S> pose_a, pose_b;  // when the step began: what stands for row 0 throughout
  Vec3<S> arm_a, arm_b;    // [m] from each centre to the joint, world, now
  S radius;                // [m] lever of purely angular rows, so that their coefficients are near one
  S reach;                 // [m] farther out, what slides along a counts as that far
  std::uint32_t block_count, drive_count;
  bool holds;                        // something moves at all
  JointBlock<S> blocks[2];           // where the origins are, angles
  Mat3<S> up, down;                  // [1] D_1^-1 K_10 and K_01 of a joint solved by itself
  JointDrive<S> drives[kJointRows];  // drive_count of them, each in a row of its own; first the one of the properties
};

/// Holds the values that the calls of one sub-step share. Row r > 0 of the bodies is states[r - 1].
template <class S> struct JointStep {
  const BodyState<S>* states;
  SolverBodies<S>* bodies;
  S rate;     // [1/s] sub-steps a second
  Step<S> h;  // [s]
  Softness<S> softness;
  // [rad/s] Arms are straight if the faster body is below rapid_angular_speed() or above angular_speed_to_follow().
  Velocity<S> rapid = Velocity<S>(0), fastest = highest<Velocity<S>>();
};

/// Returns the softness of joints that JointTrees does not solve at once, and the rate at which others close their
/// errors: a frequency of a quarter of the sub-step rate, and a damping ratio of 5. On S6 ratios 1, 2, 5, 10 leave
/// one-by-one joints (two sweeps) 0.52, 0.18, 0.09, 0.08 m apart and trees 1.3, 1.9, 3.4, 5.2 mm.
template <class S> ISO_INLINE constexpr Softness<S> joint_softness(S rate) {
  return soften(S(1.5707963267948966), S(5), rate);
}

/// Holds a number for each row of a joint.
template <class S> struct JointRows {
  Vec3<Velocity<S>> point, angular;  // [m/s] of the two blocks
};

/// Holds the state of a joint and its bodies that a pass changes.
template <class S> struct JointStart {
  JointMotion<S> motion;
  JointRows<S> impulses;
  Velocity<S> drives[kJointRows];  // [m/s] their impulses
};

/// Prepares a joint once a step, when masses and rows are gathered. `axes`: the joint's drives, at most one an axis.
template <class S>
void prepare_joint(const JointProperties<S>& properties, const JointState<S>& state, const JointEnd<S>& a,
                   const JointEnd<S>& b, const SolverBodies<S>& bodies, JointConstraint<S>& joint,
                   std::span<const JointAxisDrive<S>> axes = {});
/// Computes the Jacobian and the position errors at the present poses.
template <class S> void linearise_joint(JointConstraint<S>& joint, const JointStep<S>& step);
/// Computes how arms curve, for velocities: after linearise_joint(), from the angular velocities of `step.bodies`.
/// Solvers that close position errors separately leave this out: the curvature then stays as speed.
template <class S> void curve_joint(JointConstraint<S>& joint, const JointStep<S>& step);
/// Computes the turns that the rows give bodies with the inverse inertia kappa.
template <class S> void weigh_joint(JointConstraint<S>& joint, const Mat3<S>& kappa_a, const Mat3<S>& kappa_b);
/// Places the drives' rows as their pieces require, and computes the couplings within each block.
template <class S> void couple_blocks(JointConstraint<S>& joint);
/// Warm starts with the last sub-step's impulses. Motors at their largest force give it anew.
template <class S> void apply_impulses(JointConstraint<S>& joint, const JointStep<S>& step);
/// Returns the speed changes [m/s] that the rows of a block ask for: minus speed and bias.
template <class S>
Vec3<Velocity<S>> right_side(const JointConstraint<S>& joint, std::uint32_t block, const JointMotion<S>& motion,
                             const JointStep<S>& step, bool relax);
/// Adds impulses to all rows, with the softness `soft`, and applies them to the bodies.
template <class S>
void push_joint(JointConstraint<S>& joint, const JointRows<S>& change, Softness<S> soft, SolverBodies<S>& bodies);
/// Returns true if a drive is off its piece of the law. Without `may_hold` only drives count that hold a speed and
/// should not: they let go, and the pass ends.
template <class S> bool judge_drives(JointConstraint<S>& joint, const JointStep<S>& step, bool relax, bool may_hold);
/// Restart a pass with the next pieces, from its start: a wrong piece may ask for impulses that are far from any right
/// ones. Blocks must be coupled again.
template <class S> JointStart<S> start_of(const JointConstraint<S>& joint, const SolverBodies<S>& bodies);
template <class S> void restart_joint(JointConstraint<S>& joint, const JointStart<S>& start, SolverBodies<S>& bodies);
template <class S> void change_pieces(JointConstraint<S>& joint, const JointStep<S>& step);
template <class S> void store_joint(const JointConstraint<S>& joint, JointState<S>& state);

/// Solve a joint by itself, all of its rows at once: for joints that form loops, and for comparison.
template <class S> void factor_joint(JointConstraint<S>& joint);
template <class S> JointRows<S> substitute_joint(const JointConstraint<S>& joint, JointRows<S> right);
template <class S> void solve_joint(JointConstraint<S>& joint, const JointStep<S>& step, bool relax);

/// Solve joints one after another in array order. The first runs once a sub-step, then the second with bias and, after
/// positions moved, relaxed.
template <class S> void warm_start_joints(std::span<JointConstraint<S>> joints, const JointStep<S>& step);
template <class S> void solve_joints(std::span<JointConstraint<S>> joints, const JointStep<S>& step, bool relax);

#define ISO_JOINTS_OF(KEYWORD, S)                                                                                   \
  KEYWORD template void prepare_joint<S>(const JointProperties<S>&, const JointState<S>&, const JointEnd<S>&,       \
                                         const JointEnd<S>&, const SolverBodies<S>&, JointConstraint<S>&,           \
                                         std::span<const JointAxisDrive<S>>);                                       \
  KEYWORD template void linearise_joint<S>(JointConstraint<S>&, const JointStep<S>&);                               \
  KEYWORD template void curve_joint<S>(JointConstraint<S>&, const JointStep<S>&);                                   \
  KEYWORD template void weigh_joint<S>(JointConstraint<S>&, const Mat3<S>&, const Mat3<S>&);                        \
  KEYWORD template void couple_blocks<S>(JointConstraint<S>&);                                                      \
  KEYWORD template void apply_impulses<S>(JointConstraint<S>&, const JointStep<S>&);                                \
  KEYWORD template Vec3<Velocity<S>> right_side<S>(const JointConstraint<S>&, std::uint32_t, const JointMotion<S>&, \
                                                   const JointStep<S>&, bool);                                      \
  KEYWORD template void push_joint<S>(JointConstraint<S>&, const JointRows<S>&, Softness<S>, SolverBodies<S>&);     \
  KEYWORD template bool judge_drives<S>(JointConstraint<S>&, const JointStep<S>&, bool, bool);                      \
  KEYWORD template JointStart<S> start_of<S>(const JointConstraint<S>&, const SolverBodies<S>&);                    \
  KEYWORD template void restart_joint<S>(JointConstraint<S>&, const JointStart<S>&, SolverBodies<S>&);              \
  KEYWORD template void change_pieces<S>(JointConstraint<S>&, const JointStep<S>&);                                 \
  KEYWORD template void factor_joint<S>(JointConstraint<S>&);                                                       \
  KEYWORD template JointRows<S> substitute_joint<S>(const JointConstraint<S>&, JointRows<S>);                       \
  KEYWORD template void solve_joint<S>(JointConstraint<S>&, const JointStep<S>&, bool);                             \
  KEYWORD template void store_joint<S>(const JointConstraint<S>&, JointState<S>&);                                  \
  KEYWORD template void warm_start_joints<S>(std::span<JointConstraint<S>>, const JointStep<S>&);                   \
  KEYWORD template void solve_joints<S>(std::span<JointConstraint<S>>, const JointStep<S>&, bool);
#define ISO_EXTERN_JOINTS(S) ISO_JOINTS_OF(extern, S)
ISO_FOR_EACH_SCALAR(ISO_EXTERN_JOINTS)
#undef ISO_EXTERN_JOINTS

}  // namespace isostep
