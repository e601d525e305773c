// The broad phase: its bodies, and the list of what a scalar needs of it.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/collision/broadphase/child_tree.inl"
#include "isostep/collision/broadphase/pairs.inl"
#include "isostep/collision/broadphase/tree.inl"

#define ISO_BOX_TREES_OF(S)   \
  template class AabbTree<S>; \
  ISO_CHILD_TREE_OF(, S)      \
  template class PairSet<S>;
