// Rows of a product too large to be tried whole, in which every pair of values of two factors meets.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <vector>

namespace isostep::test {

/// A value's number for every factor.
using Row = std::vector<std::size_t>;

/// The product of all factors but the last, whose values take turns along every other: a Latin square where the sizes
/// allow one.
inline std::vector<Row> covering_rows(const std::vector<std::size_t>& sizes) {
  std::vector<Row> rows{Row{}};
  for (std::size_t factor = 0; factor + 1 < sizes.size(); ++factor) {
    std::vector<Row> longer;
    for (const Row& row : rows) {
      for (std::size_t value = 0; value < sizes[factor]; ++value) {
        longer.push_back(row);
        longer.back().push_back(value);
      }
    }
    rows = longer;
  }
  for (Row& row : rows) {
    std::size_t turn = row.back() * 2;  // two values more, so that it does not fall in step with the factor before
    for (std::size_t factor = 0; factor + 1 < row.size(); ++factor) turn += row[factor];
    row.push_back(turn % sizes.back());
  }
  return rows;
}

/// Does not know how the rows were found.
inline bool covers_every_pair(const std::vector<Row>& rows, const std::vector<std::size_t>& sizes) {
  for (std::size_t a = 0; a < sizes.size(); ++a) {
    for (std::size_t b = a + 1; b < sizes.size(); ++b) {
      std::vector<bool> seen(sizes[a] * sizes[b]);
      for (const Row& row : rows) seen[row[a] * sizes[b] + row[b]] = true;
      for (const bool met : seen) {
        if (!met) return false;
      }
    }
  }
  return true;
}

}  // namespace isostep::test
