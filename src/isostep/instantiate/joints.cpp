// The joints, compiled once for every shipped scalar.
// SPDX-License-Identifier: MIT
#include "isostep/core/instantiate.hpp"
#include "isostep/dynamics/joints/joint_alone.inl"
#include "isostep/dynamics/joints/joint_tree.inl"

namespace isostep {

#define ISO_INSTANTIATE(S) \
  ISO_JOINTS_OF(, S)       \
  template class JointTrees<S>;
ISO_FOR_EACH_SCALAR(ISO_INSTANTIATE)
#undef ISO_INSTANTIATE

}  // namespace isostep
