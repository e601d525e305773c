// Two peers, started, and their recordings, compared.
// SPDX-License-Identifier: MIT
#include "demo_match.hpp"

#include <chrono>
#include <cstdio>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <thread>

#include "tool/common/files.hpp"
#include "tool/common/tool.hpp"
#include "tool/verify/checked_file.hpp"

namespace isostep::tool {
namespace {

constexpr const char* kPeers[] = {"host", "client"};
constexpr const char* kDemoPatience = "120";  // [s] a machine that stalls is no player who left

/// The port that the host was given, once it has written it.
std::string port_of(ChildProcess& host, const std::string& file, const std::string& log) {
  while (!std::filesystem::exists(file)) {
    stop_if_interrupted();
    if (!host.runs()) throw ToolError(exit_status::kSoftware, "the host of a match ended at once: see " + log);
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  const std::vector<std::uint8_t> bytes = read_file(file);
  return std::string(bytes.begin(), bytes.end() - 1);
}

}  // namespace

std::string DemoMatch::path(const char* peer, const char* kind) const {
  return directory_ + "/match." + scalar_ + "." + peer + "." + kind;
}

DemoMatch::DemoMatch(const std::string& scalar, int frames, const std::string& directory)
    : scalar_(scalar), frames_(frames), directory_(directory) {
  const std::string port_file = path("host", "port");
  std::filesystem::remove(port_file);
  const auto start = [&](const char* peer, const std::vector<std::string>& where) {
    std::vector<std::string> words = {"peer",       "--json", "--scalar", scalar, "--frames", std::to_string(frames),
                                      "--patience", kDemoPatience};
    words.insert(words.end(), where.begin(), where.end());
    words.insert(words.end(), {"--hashes", path(peer, "hashes"), "--record", path(peer, "replay")});
    words.insert(words.end(), {"--bot", peer == kPeers[0] ? "1" : "2"});
    peers_.emplace_back(words, path(peer, "json"), path(peer, "log"));
  };
  start(kPeers[0], {"--listen", "0", "--port-file", port_file});
  start(kPeers[1],
        {"--connect", "127.0.0.1:" + port_of(peers_[0], port_file, path("host", "log")), "--profile", kDemoProfile});
}

std::string DemoMatch::header() {
  char text[160];
  std::snprintf(text, sizeof text, "%-7s %6s  %-16s  %-9s %-7s %6s  %s\n", "scalar", "frames", "last hash", "rollbacks",
                "deepest", "KB/s", "hashes of both; replays of both");
  return text;
}

bool DemoMatch::show() {
  int ended = 0;
  for (ChildProcess& peer : peers_) ended = std::max(ended, peer.wait());
  if (ended != 0) {
    std::printf("%-7s a peer ended with %d: see %s\n", scalar_.c_str(), ended, path("client", "log").c_str());
    return false;
  }
  nlohmann::json said[2];
  bool verified = true;
  std::string outcomes;
  for (int i = 0; i < 2; ++i) {
    said[i] = nlohmann::json::parse(read_file(path(kPeers[i], "json")));
    const CheckedReplay checked = check_replay(read_file(path(kPeers[i], "replay")));
    verified = verified && checked.result.outcome == VerifyOutcome::verified;
    outcomes += (i == 0 ? "" : ", ") + describe(checked.result);
  }
  const bool equal = read_file(path("host", "hashes")) == read_file(path("client", "hashes")) &&
                     said[0]["frames"] == frames_ && said[1]["frames"] == frames_;
  const auto both = [&](const char* key) { return said[0][key].dump() + " " + said[1][key].dump(); };
  std::printf("%-7s %6d  %-16s  %-9s %-7s %6.1f  %s; %s\n", scalar_.c_str(), frames_,
              said[0]["hash"].get<std::string>().c_str(), both("rollbacks").c_str(), both("deepest").c_str(),
              said[1]["kb_per_s"].get<double>(), equal ? "equal" : "DIFFERENT", outcomes.c_str());
  return equal && verified;
}

}  // namespace isostep::tool
