// isostep_prover trace and fields: what `isostep diff --stages` asks of a build that is not its own.
// SPDX-License-Identifier: MIT
#include <string>

#include "commands.hpp"
#include "diagnostics/staged_replay.hpp"
#include "isostep/core/short_text.hpp"
#include "isostep/state/replay_format.hpp"
#include "streams.hpp"

namespace isostep::prover {
namespace {

StagedReplay how(const Request& request) {
  return {request.simd, request.frames, request.fault ? &*request.fault : nullptr};
}

/// "invalid" is what the words ask for; all else is the file's fault.
int status_of(const Error& error) {
  switch (error.code) {
    case ErrorCode::invalid: return exit_status::kUsage;
    case ErrorCode::incompatible: return exit_code(VerifyOutcome::incompatible);
    case ErrorCode::truncated: return exit_code(VerifyOutcome::truncated);
    default: return exit_code(VerifyOutcome::corrupt);
  }
}
int answer(const Result<void>& played) {
  if (played) return exit_status::kOk;
  return refuse(status_of(played.error()), played.error().message.view(), played.error().place.view());
}

/// All that is there has been traced; that more was asked for is reported as `verify` reports it.
int end_of(const ReplayReader& replay, std::uint64_t frames) {
  if (replay.status() != ReplayStatus::truncated || frames <= replay.frame_count()) return exit_status::kOk;
  return answer(replay.error());
}

/// The first operand's, into `file`; 0, or the exit status.
int read_recording(const Request& request, std::vector<std::uint8_t>& file) {
  const std::string error = read_file(request.operands[0], file);
  return error.empty() ? exit_status::kOk : refuse(exit_status::kNoInput, error, request.operands[0]);
}

}  // namespace

int command_trace(const Request& request) {
  std::vector<std::uint8_t> file;
  if (const int status = read_recording(request, file); status != exit_status::kOk) return status;
  const TraceSink sink = {[](void*, const TracedStage& traced) {
                            ShortText<96> line;
                            line.append_number(traced.frame).append(" ").append_number(traced.step).append(" ");
                            line.append(traced.stage).append(" ").append_hex(traced.hash).append("\n");
                            print(line.view());
                          },
                          nullptr};
  const ReplayReader replay(file);
  const int status = answer(trace_stages(replay, how(request), sink));
  return status == exit_status::kOk ? end_of(replay, request.frames) : status;
}

int command_fields(const Request& request) {
  std::vector<std::uint8_t> file;
  if (const int status = read_recording(request, file); status != exit_status::kOk) return status;
  StagePoint at;
  if (!read_stage_step(request.operands[1], at)) {
    return refuse(exit_status::kUsage, "FRAME[.STEP] is no number", request.operands[1]);
  }
  at.stage = request.operands[2];
  const FieldSink sink = {[](void*, const PathPart& path, FieldFormat format, std::uint64_t bits) {
                            print(field_line({path_text(path), format, bits}) + "\n");
                          },
                          nullptr};
  const ReplayReader replay(file);
  const Result<void> visited = visit_stage(replay, how(request), at, sink);
  if (!visited && visited.error().code == ErrorCode::invalid && at.frame >= replay.frame_count()) {
    return refuse(exit_code(VerifyOutcome::truncated), "the recording is shorter than that", request.operands[1]);
  }
  return answer(visited);
}

}  // namespace isostep::prover
