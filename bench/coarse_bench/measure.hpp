// The cost of each coarse structure: to build, to renew, to find pairs, to ask, and in memory.
// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "coarse_bench/fields.hpp"

namespace isostep::bench {

struct CoarseRow {
  std::string field, scalar, structure;
  int count = 0;
  std::size_t pairs = 0;
  double build = 0;   // [ns a box] to insert all into an empty structure that is warm
  double update = 0;  // [ns a box] to move all by a tenth of their size
  double find = 0;    // [ns a box] all pairs, in canonical order
  double query = 0;   // [ns] what overlaps a box of 2 m
  double ray = 0;     // [ns] the nearest box on a way of 20 m
  double bytes = 0;   // a box
};

/// Measures every structure in every field of that many boxes, in float and Q32.32. Times are medians of `rounds`.
/// Throws where two structures find other pairs.
std::vector<CoarseRow> measure_coarse(int count, int rounds);

/// [bytes] That operator new gave and has not got back.
std::size_t bytes_in_use();

}  // namespace isostep::bench
