// What `isostep diff` is given, and how it names differences and refuses files.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdio>
#include <cstring>
#include <string>
#include <vector>

#include "files.hpp"
#include "isostep/state/verify.hpp"
#include "tool.hpp"
#include "worlds.hpp"

namespace isostep::tool {

inline constexpr std::size_t kShown = 8;  // differences printed

/// `a`: the first of the two states, for the owners' slots.
template <class State> void print(const DiffReport& report, const State& a) {
  for (const Difference& difference : report.kept()) {
    const std::string owner = owner_of(a, difference.path.view());
    std::printf("  %s%s\n", describe(difference).c_str(), owner.empty() ? "" : (" [" + owner + "]").c_str());
  }
  if (report.count() > report.kept().size()) {
    std::printf("  and %llu more\n", static_cast<unsigned long long>(report.count() - report.kept().size()));
  }
}

/// Of all of two states; whether there are any.
template <class State> bool print_differences(const State& a, const State& b) {
  DiffReport report(kShown);
  diff_states(a, b, report);
  print(report, a);
  return report.any();
}
inline constexpr char kTapesDiffer[] = "  the commands or steps of this frame differ\n";

struct Input {
  std::string path;
  std::vector<std::uint8_t> bytes;

  explicit Input(const std::string& p) : path(p), bytes(read_file(p)) {}
  bool is_replay() const {
    return bytes.size() >= sizeof kReplayMagic && std::memcmp(bytes.data(), kReplayMagic, sizeof kReplayMagic) == 0;
  }
};

/// With the exit status of `verify` for such a file.
[[noreturn]] inline void refuse(const std::string& path, VerifyOutcome outcome, const Error& error) {
  throw ToolError(exit_code(outcome),
                  path + ": " + std::string(error.message.view()) + " (" + std::string(error.place.view()) + ")");
}

}  // namespace isostep::tool
