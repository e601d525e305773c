// isostep_prover snapshot and continue: a state is carried from one build to another, in the middle of a recording.
// SPDX-License-Identifier: MIT
#include "checks.hpp"
#include "commands.hpp"
#include "isostep/core/number_text.hpp"
#include "streams.hpp"

namespace isostep::prover {
namespace {

/// The state to continue from is at fault, not the recording: it fails before any frame is stepped.
bool is_state_refused(std::string_view path, const CheckedReplay& checked, ReplayCheck check) {
  const VerifyResult& result = checked.result;
  if (result.outcome == VerifyOutcome::diverged) return result.where == VerifyResult::Where::start;
  const bool damaged = result.outcome == VerifyOutcome::corrupt && *checked.lanes != '\0';  // and the file is not
  check.span.count = 0;
  return damaged && prove(path, check).checked.result.outcome == VerifyOutcome::corrupt;
}

}  // namespace

int command_snapshot(const Request& request) {
  const std::string_view path = request.operands[0];
  std::uint64_t frame = 0;
  if (!read_number(request.operands[1], frame)) {
    return refuse(exit_status::kUsage, "FRAME is no number", request.operands[1]);
  }
  std::vector<std::uint8_t> state;
  const Proof proof = prove(path, {.simd = request.simd, .span = {.count = frame}, .reached = &state});
  if (proof.status() != exit_status::kOk) return refuse(proof.status(), proof.text(), path);
  if (proof.compared < frame) {
    return refuse(exit_code(VerifyOutcome::truncated),
                  "the recording has " + std::to_string(proof.compared) + " frames", path);
  }
  print(hex_text(state));
  return exit_status::kOk;
}

int command_continue(const Request& request) {
  const std::string_view path = request.operands[0];
  std::uint64_t frame = 0;
  if (!read_number(request.operands[1], frame)) {
    return refuse(exit_status::kUsage, "FRAME is no number", request.operands[1]);
  }
  if (path == "-") return refuse(exit_status::kUsage, "standard input holds the state, not the recording");
  std::vector<std::uint8_t> text, state;
  if (const std::string error = read_file("-", text); !error.empty()) return refuse(exit_status::kNoInput, error);
  if (!read_hex(text, state) || state.empty()) {
    return refuse(exit_code(VerifyOutcome::corrupt), "standard input holds no state in hexadecimal digits");
  }
  const ReplayCheck check = {.simd = request.simd, .span = {.first = frame, .count = request.frames, .state = state}};
  const Proof proof = prove(path, check);
  print(line_of(is_state_refused(path, proof.checked, check) ? "-" : path, proof));
  if (!proof.unreadable.empty()) return refuse(proof.status(), proof.unreadable, path);
  return proof.status();
}

}  // namespace isostep::prover
