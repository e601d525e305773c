// The pairs of hulls that the convex benchmark asks about: those of S10 at rest, and the same pushed into one another.
// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <vector>

#include "isostep/geometry/baked/hull_blob.hpp"
#include "isostep/math/transform.hpp"
#include "scenes/hull_points.hpp"

namespace isostep::bench {

/// A hull as scalars are made of it, and as the oracle in double has it.
struct BenchHull {
  GridHull grid;
  std::shared_ptr<const scenes::SolidHull> solid;
};

/// Two hulls beside one another: the middle of the two is near the origin, as the step sees its pairs.
struct BenchPair {
  std::size_t a, b;  // hulls
  Pose<double> at_a, at_b;
};

enum class Closeness { near, touching, deep };
inline constexpr const char* kClosenessNames[] = {"near", "touching", "deep"};

struct PairSet {
  std::vector<BenchHull> hulls;
  std::vector<BenchPair> pairs[std::size(kClosenessNames)];
};

/// The pairs of S10 after `frames`, at most `most` of each kind. Near: up to 10 cm apart. Touching: at rest on one
/// another, less than 2 mm apart or overlapping by less than 20 mm. Deep: those with the second pushed in by half of
/// the smaller inner radius.
PairSet pairs_of_pile(int frames, std::size_t most);

}  // namespace isostep::bench
