// Peers in a process of their own.
// SPDX-License-Identifier: MIT
#include "peer_program.hpp"

#include <algorithm>
#include <cstdlib>
#include <iostream>
#include <thread>

#include "tool/common/tool.hpp"
#include "tool/lab/gnuplot.hpp"

namespace isostep::tool::lab {

void run_peer_program(const PeerProgram& program) {
  const unsigned cores = std::max(1u, std::thread::hardware_concurrency());
  const int jobs = program.jobs > 0 ? program.jobs : static_cast<int>(cores);
  const std::string command = shell_quoted(program.path) + " --out " + shell_quoted(program.out) + " --jobs " +
                              std::to_string(jobs) + " --limit " + std::to_string(program.limit) + " " + program.words;
  const int status = std::system(command.c_str());
  stop_if_interrupted();
  if (status != 0) std::cerr << "isostep: " << program.path << " failed: peers are as far as they are kept\n";
}

}  // namespace isostep::tool::lab
