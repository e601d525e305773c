// The broad phase for the shipped scalars.
// SPDX-License-Identifier: MIT
#include "isostep/collision/broadphase/child_tree.inl"
#include "isostep/collision/broadphase/pairs.inl"
#include "isostep/collision/broadphase/tree.inl"

namespace isostep {

#define ISO_INSTANTIATE(S)     \
  template class AabbTree<S>;  \
  template class ChildTree<S>; \
  template class PairSet<S>;
ISO_FOR_EACH_SCALAR(ISO_INSTANTIATE)
#undef ISO_INSTANTIATE

}  // namespace isostep
