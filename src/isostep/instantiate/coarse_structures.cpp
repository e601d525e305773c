// The coarse structures beside the tree of boxes, for the shipped scalars.
// SPDX-License-Identifier: MIT
#include "isostep/collision/broadphase/broad_phases.hpp"
#include "isostep/collision/broadphase/bsp_tree.inl"
#include "isostep/collision/broadphase/cell_grid.inl"
#include "isostep/collision/broadphase/cell_tree.inl"
#include "isostep/collision/broadphase/hierarchy.inl"
#include "isostep/collision/broadphase/sphere_tree.inl"
#include "isostep/collision/broadphase/sweep_and_prune.inl"

namespace isostep {

#define ISO_INSTANTIATE(S)                        \
  template class Hierarchy<S, BoundingSphere<S>>; \
  template class Hierarchy<S, Aabb<S>>;           \
  template class SphereTree<S>;                   \
  template class BspTree<S>;                      \
  template class CellTree<S, 2>;                  \
  template class CellTree<S, 3>;                  \
  template class CellGrid<S, false>;              \
  template class CellGrid<S, true>;               \
  template class SweepAndPrune<S>;
ISO_FOR_EACH_SCALAR(ISO_INSTANTIATE)
#undef ISO_INSTANTIATE

#define ISO_IS_BROAD_PHASE(name, Structure) &&BroadPhase<Structure<S>, S>
template <class S> inline constexpr bool kAreBroadPhases = true ISO_FOR_EACH_BROAD_PHASE(ISO_IS_BROAD_PHASE);
#define ISO_CHECK(S) static_assert(kAreBroadPhases<S>);
ISO_FOR_EACH_SCALAR(ISO_CHECK)
#undef ISO_CHECK

}  // namespace isostep
