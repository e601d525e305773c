// Scenes after the peers' own benchmarks: sizes, counts, materials and settings are those of Box3D's
// shared/benchmarks.c and of Jolt's PerformanceTest; the makers are ours.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/world/world.hpp"
#include "scenes/scene.hpp"

namespace isostep::scenes {

// Box3D's.
Scene large_pyramid();
Scene many_pyramids();
Scene convex_pile();
Scene junkyard();
Scene washer();
Scene trees();
Scene joint_grid();
Scene human_rain();
Scene large_world();
// Jolt's Pyramid, MaxBodies, ConvexVsMesh and CharacterVirtual.
Scene jolt_pyramid();
Scene max_bodies();
/// Rows of boxes that touch side by side fall, two metres apart.
Scene max_bodies_of(int bodies);
Scene convex_on_land();
Scene crossers();

/// Moves the junkyard's pusher on by a step. Script::pusher.
template <class S> void push_junk(World<S>& world);
/// Sends each of the crossers to a new place every two seconds. Script::crossers.
template <class S> void lead_crossers(World<S>& world);

#define ISO_EXTERN(S)                                  \
  extern template void push_junk<S>(World<S> & world); \
  extern template void lead_crossers<S>(World<S> & world);
ISO_FOR_EACH_SCALAR(ISO_EXTERN)
#undef ISO_EXTERN

}  // namespace isostep::scenes
