// Engines beside one another: who is fastest in a scene, and how far ours are from that.
// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "race.hpp"

namespace isostep::bench {

/// A time to be compared: S8's is that of a step with everybody asleep, less than 0 where that never came.
double shown_ms(const Row& row);
/// Returns true if the engine has its best settings, not its defaults.
bool is_best(std::string_view engine);
/// The name of an engine in a report.
std::string title_of(std::string_view engine);

/// The time that a dated engine would take today: its time then, times how much slower kAnchor is among these rows than
/// it was then. Where kAnchor has no figure of the scene: than it was in the others, the median of them.
std::optional<double> estimated_ms(const std::vector<Row>& rows, std::string_view scene, std::string_view engine);

struct Fastest {
  std::string engine;
  double ms;
};
/// The fastest peer that did not lose the scene, of those measured here and of those of the dated run.
struct FastestPeers {
  std::optional<Fastest> here, dated;
  std::optional<Fastest> of_all() const;
};
FastestPeers fastest_peers(const std::vector<Row>& rows, std::string_view scene);

/// kAnchor's time here over that of the dated run, scene by scene: "S1 1.03, S2 0.99".
std::string anchor_since(const std::vector<Row>& rows);

/// Markdown: a line a scene, a column an engine, its best settings behind a stroke; ours with the ratio to the fastest
/// of all peers.
std::string comparison(const std::vector<Row>& rows);

}  // namespace isostep::bench
