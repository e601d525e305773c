// The joints, compiled once for every shipped scalar.
// SPDX-License-Identifier: MIT
#include "isostep/core/instantiate.hpp"
#include "isostep/dynamics/joints/joint_tree.inl"

namespace isostep {

#define ISO_INSTANTIATE(S)                                                                            \
  template void prepare_joint<S>(const JointProperties<S>&, const JointState<S>&, const JointEnd<S>&, \
                                 const JointEnd<S>&, const SolverBodies<S>&, JointConstraint<S>&);    \
  template void linearise_joint<S>(JointConstraint<S>&, const JointStep<S>&);                         \
  template void weigh_joint<S>(JointConstraint<S>&, const Mat3<S>&, const Mat3<S>&);                  \
  template void weigh_drives<S>(JointConstraint<S>&);                                                 \
  template void apply_impulses<S>(const JointConstraint<S>&, SolverBodies<S>&);                       \
  template void solve_drives<S>(JointConstraint<S>&, const JointStep<S>&, bool);                      \
  template void solve_blocks<S>(JointConstraint<S>&, const JointStep<S>&, bool);                      \
  template void solve_joint<S>(JointConstraint<S>&, const JointStep<S>&, bool);                       \
  template void store_joint<S>(const JointConstraint<S>&, JointState<S>&);                            \
  template void warm_start_joints<S>(std::span<JointConstraint<S>>, const JointStep<S>&);             \
  template void solve_joints<S>(std::span<JointConstraint<S>>, const JointStep<S>&, bool);            \
  template class JointTrees<S>;
ISO_FOR_EACH_SCALAR(ISO_INSTANTIATE)
#undef ISO_INSTANTIATE

}  // namespace isostep
