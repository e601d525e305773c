// S14: the queries of a thousand bodies over the hills, several engines in turn.
// SPDX-License-Identifier: MIT
#pragma once

#include <array>

#include "race.hpp"
#include "scenes/bars.hpp"

namespace isostep::bench {

inline constexpr std::size_t kQueryKinds = std::size(kQueryNames);

/// The answers of one engine.
struct QueryRow {
  std::string engine;
  bool ours = false;
  std::array<double, kQueryKinds> us;          // CPU time of one query; less than 0: it has no such
  std::array<std::int64_t, kQueryKinds> hits;  // of all frames; less than 0 likewise
  scenes::Reach reach = scenes::Reach::no_bar;
};

/// Rows in the order of the makers; engines without queries have none. The time of a kind is the median of the frames,
/// the lowest of the rounds.
std::vector<QueryRow> race_queries(const scenes::Scene& scene, const std::vector<Maker>& makers,
                                   const RaceOptions& options);

/// Markdown, and how often the queries hit.
std::string table_of(const std::vector<QueryRow>& rows);

}  // namespace isostep::bench
