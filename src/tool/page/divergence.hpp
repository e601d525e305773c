// The place at which two recordings of one scene part.
// SPDX-License-Identifier: MIT
#pragma once

#include "recording.hpp"

namespace isostep::tool::page {

struct Divergence {
  static constexpr std::int32_t kNever = -1;
  std::int32_t frame = kNever;             // of the recordings: the first beyond the tolerance
  std::uint32_t slot = 0, generation = 0;  // of the body that was farthest apart in it
  double distance = 0;                     // [m] in it; 0: the body is in one of the runs alone
  std::vector<double> apart;               // [m] largest distance of each frame
};

/// Bodies are compared with those of the same id, by their origins to within kGrid.
Divergence compare(const Recording& a, const Recording& b, double tolerance);

}  // namespace isostep::tool::page
