// The convex algorithms over the pairs: time a pair, and error against brute force.
// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "hull_pairs.hpp"

namespace isostep::bench {

struct ConvexRow {
  std::string scalar, algorithm, pairs;  // as kAlgorithmNames and kClosenessNames have them
  std::size_t count = 0;                 // of pairs
  double ns = 0;                         // CPU time a pair, the lowest of the rounds
  double worst = -1, mean = -1;          // [m] error; less than 0: the algorithm says only that they overlap
  int wrong = 0;                         // pairs with no answer, or apart where they overlap, or the other way round
};

/// `sat` in the widest lanes of the processor, as the step has it, and in one; `v_clip` from no features and from those
/// of a pose 5 mm off. Errors: of `sat` by how much its axis falls short of the best; of the others the distance's, or
/// depth's.
enum class Algorithm { sat, sat_one_lane, gjk, epa, v_clip, v_clip_warm };
inline constexpr const char* kAlgorithmNames[] = {"sat", "sat_one_lane", "gjk", "epa", "v_clip", "v_clip_warm"};

/// Rows by scalar, algorithm, closeness. The algorithms take turns within a round.
std::vector<ConvexRow> measure_convex(const PairSet& set, int rounds);

}  // namespace isostep::bench
