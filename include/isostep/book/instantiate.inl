// The book's methods: their bodies, and the lists of what a scalar needs of them.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/book/bsp_tree.inl"
#include "isostep/book/cell_grid.inl"
#include "isostep/book/cell_tree.inl"
#include "isostep/book/hierarchy.inl"
#include "isostep/book/sphere_tree.inl"
#include "isostep/book/sweep_and_prune.inl"
#include "isostep/book/v_clip.inl"
#include "isostep/book/worst_first.inl"

#define ISO_COARSE_STRUCTURES_OF(S) \
  ISO_HIERARCHY_OF(, S)             \
  ISO_SPHERE_TREE_OF(, S)           \
  ISO_BSP_TREE_OF(, S)              \
  ISO_CELL_TREE_OF(, S)             \
  ISO_CELL_GRID_OF(, S)             \
  ISO_SWEEP_AND_PRUNE_OF(, S)
#define ISO_BOOK_OF(S)        \
  ISO_COARSE_STRUCTURES_OF(S) \
  ISO_V_CLIP_OF(, S)          \
  template class WorstFirstResolver<S>;
