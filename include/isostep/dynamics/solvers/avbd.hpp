// AvbdSystem<N>: an island solved body by body against penalties that become multipliers.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "isostep/dynamics/solvers/island_system.hpp"

namespace isostep {

/// Source:  Giles, Diaz, Yuksel 2025, Augmented Vertex Block Descent, ACM Trans. Graph. 44(4).
/// Method:  minimises |u|^2 / 2 and a penalty k c^2 / 2 for each row, c what its speed lacks. A pass takes body after
///          body and minimises over its six numbers while the others stay, by a Newton step: I + sum of k w w^T. Then
///          each multiplier x takes over what its penalty gave, within its bounds.
/// Symbols: u = change of M^1/2 v, w = row of W, k = penalty, x = answer.
/// Differs: on velocities: a sub-step begins with the last one's multipliers, and no speed that ended overlaps stays.
///          The penalty is 2^kPenalty of the row's effective mass, in any unit of mass; the paper's begin at 1 N/m and
///          grow. Growing ones would have to be in the state, and above 2 the multipliers of a stack of twenty boxes
///          grow without end. A solve that closes errors keeps no multipliers. Rows at a bound do not stiffen their
///          bodies. Friction is held in the cone of its load, and resists to be turned along its rim. Passes go through
///          the bodies forwards and backwards in turn.
/// Limits:  kPasses a solve, whatever is left: it never says that it found no solution. Bodies move by u, so action and
///          reaction differ by what the last pass left; by W^T x walls and cards tremble.
///          Rods that strike at hundreds of radians a second gain energy.
/// Order:   of bodies in the island. One thread.
/// Cost:    a row's part of a six by six matrix, and its factorisation, a body and pass. No allocation once warm.
template <class N> class AvbdSystem final : public IslandSystem<N> {
 public:
  using Base = IslandSystem<N>;
  using typename Base::D;
  static constexpr int kPasses = 4;   // with two, cubes on a slope tremble; with one, walls burst
  static constexpr int kPenalty = 1;  // exponent of two

  void tie(std::uint32_t body_count, std::uint64_t most_work);
  void assemble();
  bool solve(bool firm, std::uint64_t most_work);
  std::uint64_t least_work() const { return kPasses * this->block_count(); }

 private:
  using Base::at_body_, Base::blocks_, Base::first_, Base::motions_, Base::patches_;
  using Base::block_count, Base::clamped;

  struct Pushes {
    N size[3];
    bool yields[3];
    N rim[2];   // direction [1] along which friction at its limit turns
    N resists;  // [1] the part of the tangents' stiffness that is left along it
  };

  N answer_of(const IslandBlock<N>& block, int r) const;
  Pushes pushes_of(std::uint32_t block) const;
  static void lean(Pushes& pushes, N x, N y, N ratio);
  void descend(std::uint32_t body);
  void keep_multipliers(bool firm);

  std::vector<N> ratios_;   // of blocks whose first two rows are the tangents of a patch: IslandPatch::ratio; else 0
  bool are_aside_ = false;  // multipliers: they are in IslandRow::last
};

}  // namespace isostep
