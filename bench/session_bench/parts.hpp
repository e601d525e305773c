// The parts of the session benchmark; each prints a table for bench/pages/sessions.md.
// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

namespace isostep::bench {

struct SessionBenchOptions {
  int repeats = 5;  // of the same work; times are the least of them
  int frames = 1500;
  std::vector<int> players = {2, 4, 8};
  std::vector<std::string> scalars;  // names
};

/// Sessions without their games, in a frame.
void report_overhead(const SessionBenchOptions& options);
/// A host of 8, 16 and 32 players, in a frame.
void report_crowds(const SessionBenchOptions& options);
/// Bytes of a player's link.
void report_bandwidth(const SessionBenchOptions& options);
/// Reports what the presets give on several lines.
void report_genres(const SessionBenchOptions& options);
/// The longest drive() of a match with a thousand bodies.
void report_drives(const SessionBenchOptions& options);
/// Seals of datagrams and messages; only where libsodium is.
void report_sealing(const SessionBenchOptions& options);
/// Memory and time of the states that are kept to explain a desync.
void report_kept_states(const SessionBenchOptions& options);

}  // namespace isostep::bench
