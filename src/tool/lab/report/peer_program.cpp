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

void run(const ReportOptions& options, const std::string& out, const std::string& words) {
  const unsigned cores = std::max(1u, std::thread::hardware_concurrency());
  const int jobs = options.jobs > 0 ? options.jobs : static_cast<int>(cores);
  const std::string command =
      shell_quoted(options.peers) + " --out " + shell_quoted(out) + " --jobs " + std::to_string(jobs) + " " + words;
  const int status = std::system(command.c_str());
  stop_if_interrupted();
  if (status != 0) std::cerr << "isostep: " << options.peers << " failed: peers are as far as they are kept\n";
}

}  // namespace

std::vector<LabResult> peers_of(const ReportOptions& options, const PeerRuns& runs) {
  const std::string path = options.out + "/" + runs.file;
  if (!options.peers.empty()) run(options, path, runs.words);
  std::vector<LabResult> peers;
  for (LabRecord& record : read_records(path)) {
    if (runs.counts(record.result.point.scene)) peers.push_back(std::move(record.result));
  }
  std::stable_sort(peers.begin(), peers.end(),
                   [](const LabResult& a, const LabResult& b) { return name_of(a.point) < name_of(b.point); });
  return peers;
}

}  // namespace isostep::tool::lab
