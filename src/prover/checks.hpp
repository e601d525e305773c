// One recording checked, and the line that says how it went.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "isostep/replay/replay_check.hpp"

namespace isostep::prover {

struct Proof {
  CheckedReplay checked;
  std::string unreadable;      // why the file could not be read; empty: it was
  std::uint64_t compared = 0;  // frames whose hashes agreed
  double milliseconds = 0;     // real time of the check

  /// 0..4 as the library's exit_code, or 66.
  int status() const;
  std::string text() const;
};

Proof prove(std::string_view path, const ReplayCheck& check);

/// file, scene, scalar, lanes, frames, milliseconds, result; what is not known is "-".
std::string line_of(std::string_view path, const Proof& proof);
std::string total_line(std::uint64_t frames, double milliseconds, std::size_t verified, std::size_t files);

}  // namespace isostep::prover
