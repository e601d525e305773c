// A run told: tables for people, JSON, and the points of the chart.
// SPDX-License-Identifier: MIT
#pragma once

#include "query_race.hpp"
#include "race.hpp"
#include "rollback.hpp"

namespace isostep::bench {

struct Report {
  std::string date, processor;
  RaceOptions options;
  std::vector<Row> rows;
  std::vector<QueryRow> queries;
  std::vector<RollbackRow> rollback;
};
/// Markdown: the comparison first, then every figure.
std::string tables_of(const Report& report);
std::string json_of(const Report& report);

/// Tab-separated, a line an engine and scene: what bench/chart/speed_accuracy.gp draws.
std::string chart_points(const Report& report);

}  // namespace isostep::bench
