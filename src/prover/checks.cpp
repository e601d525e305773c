// The check of one recording.
// SPDX-License-Identifier: MIT
#include "checks.hpp"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <initializer_list>

#include "programs/exit_status.hpp"
#include "streams.hpp"

namespace isostep::prover {
namespace {

std::string row(std::initializer_list<std::string_view> cells) {
  std::string line;
  for (const std::string_view cell : cells) {
    if (!line.empty()) line += '\t';
    line += cell.empty() ? "-" : cell;
  }
  return line += '\n';
}
std::string in_text(double milliseconds) {
  char text[32];
  std::snprintf(text, sizeof text, "%.1f", milliseconds);
  return text;
}

}  // namespace

int Proof::status() const { return unreadable.empty() ? exit_code(checked.result.outcome) : exit_status::kNoInput; }
std::string Proof::text() const { return unreadable.empty() ? describe(checked.result) : "UNREADABLE: " + unreadable; }

Proof prove(std::string_view path, const ReplayCheck& check) {
  Proof proof;
  std::vector<std::uint8_t> file;
  proof.unreadable = read_file(path, file);
  if (!proof.unreadable.empty()) return proof;
  const auto start = std::chrono::steady_clock::now();
  proof.checked = check_replay(file, check);
  proof.milliseconds = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
  const VerifyResult& result = proof.checked.result;
  proof.compared = result.frames;
  if (result.outcome != VerifyOutcome::verified) {
    const std::uint64_t reached = result.frames > check.span.first ? result.frames - check.span.first : 0;
    proof.compared = std::min(reached, check.span.count);  // the file may end behind what was asked for
  }
  return proof;
}

std::string line_of(std::string_view path, const Proof& proof) {
  return row({path, proof.checked.scene, proof.checked.scalar, proof.checked.lanes, std::to_string(proof.compared),
              in_text(proof.milliseconds), proof.text()});
}
std::string total_line(std::uint64_t frames, double milliseconds, std::size_t verified, std::size_t files) {
  return row({"total", "", "", "", std::to_string(frames), in_text(milliseconds),
              std::to_string(verified) + " of " + std::to_string(files) + " verified"});
}

}  // namespace isostep::prover
