// The broad phase: its bodies, and the list of what a scalar needs of it.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/collision/broadphase/bsp_tree.inl"
#include "isostep/collision/broadphase/cell_grid.inl"
#include "isostep/collision/broadphase/cell_tree.inl"
#include "isostep/collision/broadphase/child_tree.inl"
#include "isostep/collision/broadphase/chosen_broad_phase.inl"
#include "isostep/collision/broadphase/hierarchy.inl"
#include "isostep/collision/broadphase/pairs.inl"
#include "isostep/collision/broadphase/sphere_tree.inl"
#include "isostep/collision/broadphase/sweep_and_prune.inl"
#include "isostep/collision/broadphase/tree.inl"

#define ISO_BOX_TREES_OF(S)    \
  template class AabbTree<S>;  \
  template class ChildTree<S>; \
  template class PairSet<S>;
#define ISO_COARSE_STRUCTURES_OF(S)               \
  template class Hierarchy<S, BoundingSphere<S>>; \
  template class Hierarchy<S, Aabb<S>>;           \
  template class SphereTree<S>;                   \
  template class BspTree<S>;                      \
  template class CellTree<S, 2>;                  \
  template class CellTree<S, 3>;                  \
  template class CellGrid<S, false>;              \
  template class CellGrid<S, true>;               \
  template class SweepAndPrune<S>;                \
  template class ChosenBroadPhase<S>;
