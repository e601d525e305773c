// The demo's match: a host and a client in processes of their own, with a bad line between them, for one scalar.
// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "child_process.hpp"

namespace isostep::tool {

inline constexpr char kDemoProfile[] = "latency=100,jitter=30,loss=5";

class DemoMatch {
 public:
  /// Both peers start now and write into `directory`.
  DemoMatch(const std::string& scalar, int frames, const std::string& directory);

  static std::string header();
  /// Waits for both; one row of the table, and whether all of it was well.
  bool show();

 private:
  std::string path(const char* peer, const char* kind) const;

  std::string scalar_;
  int frames_;
  std::string directory_;
  std::vector<ChildProcess> peers_;
};

}  // namespace isostep::tool
