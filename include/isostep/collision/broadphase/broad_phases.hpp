// The coarse structures of the list of names: broad_phase_name.hpp.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/collision/broadphase/broad_phase.hpp"
#include "isostep/collision/broadphase/broad_phase_name.hpp"
#include "isostep/collision/broadphase/bsp_tree.hpp"
#include "isostep/collision/broadphase/cell_grid.hpp"
#include "isostep/collision/broadphase/cell_tree.hpp"
#include "isostep/collision/broadphase/sphere_tree.hpp"
#include "isostep/collision/broadphase/sweep_and_prune.hpp"
#include "isostep/collision/broadphase/tree.hpp"
