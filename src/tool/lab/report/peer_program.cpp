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
namespace {

/// Returns whether the program did all it had to.
bool run(const ReportOptions& options, const std::string& out, const std::string& words) {
  const unsigned cores = std::max(1u, std::thread::hardware_concurrency());
  const int jobs = options.jobs > 0 ? options.jobs : static_cast<int>(cores);
  const std::string command =
      shell_quoted(options.peers) + " --out " + shell_quoted(out) + " --jobs " + std::to_string(jobs) + " " + words;
  const int status = std::system(command.c_str());
  stop_if_interrupted();
  return status == 0;
}

}  // namespace

void expect_peers(const ReportOptions& options) {
  if (options.peers.empty()) return;
  const std::string command = "command -v " + shell_quoted(options.peers) + " >/dev/null 2>&1";
  if (std::system(command.c_str()) != 0) throw ToolError(exit_status::kNoInput, options.peers + ": no such program");
}

Peers peers_of(const ReportOptions& options, const PeerRuns& runs) {
  const std::string path = options.out + "/" + runs.file;
  Peers peers;
  peers.failed = !options.peers.empty() && !run(options, path, runs.words);
  for (LabRecord& record : read_records(path)) {
    if (runs.counts(record.result.point.scene)) peers.results.push_back(std::move(record.result));
  }
  std::stable_sort(peers.results.begin(), peers.results.end(),
                   [](const LabResult& a, const LabResult& b) { return name_of(a.point) < name_of(b.point); });
  return peers;
}

int status_of(const Peers& peers, const ReportOptions& options) {
  if (!peers.failed) return exit_status::kOk;
  std::cerr << "isostep: " << options.peers << " failed: the report has of other engines what it left\n";
  return exit_status::kSoftware;
}

}  // namespace isostep::tool::lab
