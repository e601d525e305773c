// Scenes of any size: square pyramids as S3, piles as S4 in a pit that grows with them, and sleepers around the awake.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/world/world.hpp"
#include "scenes/scene.hpp"

namespace isostep::bench {

/// The pyramid on the base whose number of boxes is nearest to `bodies`. Nobody sleeps.
scenes::Scene pyramid_of(int bodies);
/// The base grows with the number, so the pile is as deep as S4. Dropped from just above where it will lie: every third
/// layer of S4's lattice is as dense as the pile, so few frames settle it. Nobody sleeps.
scenes::Scene pile_of(int bodies);
/// `awake` boxes in columns of five that never sleep, and beside them `sleeping` boxes in columns of `column`: each
/// column is an island. All are of one shape.
scenes::Scene sleepers(int awake, int sleeping, int column);
/// A player, a ball that never sleeps, at the edge of a square field of `boxes` in columns of two; each column is an
/// island. The floor is the first body, the player the second.
scenes::Scene field(int boxes);

/// Gives up after ten seconds of the world's time.
template <class S> void step_until_asleep(World<S>& world, std::uint32_t awake) {
  for (int i = 0; i < 600 && world.counts().awake > awake; ++i) world.step();
}

}  // namespace isostep::bench
