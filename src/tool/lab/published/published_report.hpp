// isostep lab --published: published comparisons of engines repeated, beside the figures of their authors.
// SPDX-License-Identifier: MIT
#pragma once

#include <string>

namespace isostep::tool::lab {

struct PublishedOptions {
  std::string out = "build/lab";  // directory; what it holds of this version is not run again
  bool is_short = false;          // the longest steps of tests that end within a minute of simulation
  bool full = false;              // steps below a millisecond too
  bool fresh = false;             // run again what is already kept
  int jobs = 0;                   // runs at a time; 0: as many as there are cores
  double limit = 60;              // [s] CPU time of a run
  std::string peers;              // program that runs the peers; empty: what published_peers.jsonl already holds
};

/// published.html, its picture and its table; with peers, where the sources still are, bench/charts/published.png and
/// bench/results/published.md are renewed too. An exit status; throws ToolError.
int write_published_report(const PublishedOptions& options);

}  // namespace isostep::tool::lab
