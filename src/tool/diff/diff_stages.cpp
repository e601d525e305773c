// isostep diff --stages: the first stage after which two builds or two recordings differ, in state or in scratch.
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cstdio>

#include "commands.hpp"
#include "diff_replays.hpp"
#include "differences.hpp"
#include "isostep/state/replay_format.hpp"
#include "stage_side.hpp"
#include "stage_trace.hpp"
#include "tool/common/tool.hpp"

namespace isostep::tool {
namespace {

using Points = std::vector<TracePoint>;

/// One frame's part of a trace.
class FrameOf {
 public:
  FrameOf(const Points& points, std::uint64_t frame) {
    for (const TracePoint& point : points) {
      if (point.at.frame != frame) continue;
      hashes_.push_back(point.hash);
      if (point.at.step == 1 && point.at.stage != kCommandsStage) stages_.push_back(point.at.stage.c_str());
    }
    if (!hashes_.empty()) hashes_.pop_back();  // what came after the last step
  }
  Trace hashes() const { return hashes_; }
  const std::vector<const char*>& stages() const { return stages_; }

 private:
  std::vector<std::uint64_t> hashes_;
  std::vector<const char*> stages_;
};

/// `parted`: at this point the hashes differ, not just what comes next.
void print_fields(const FieldList& a, const FieldList& b, bool parted) {
  DiffReport report(kShown);
  const std::optional<std::string> missing = diff_fields(a, b, report);
  print(report, a);
  if (missing) std::printf("  and lists are of different lengths: %s is in one of them\n", missing->c_str());
  if (parted && !report.any() && !missing) {
    std::printf("  the hashes differ though none of %zu fields does: they are not of these fields\n", a.all().size());
    return;
  }
  std::printf("  %llu of %zu fields differ\n", static_cast<unsigned long long>(report.count()), a.all().size());
}

/// Reports the first point at which the traces part: where in a frame, and what differs there.
int report(const Input& input_a, const StageSide& a, const Points& trace_a, const Input& input_b, const StageSide& b,
           const Points& trace_b, std::size_t first) {
  const std::uint64_t frame = std::min(trace_a[first].at.frame, trace_b[first].at.frame);
  const FrameOf of_a(trace_a, frame), of_b(trace_b, frame);
  const std::vector<const char*>& stages = (of_a.stages().empty() ? of_b : of_a).stages();
  const StagePlace place(of_a.hashes(), of_b.hashes(), stages);
  std::printf("frame %llu, %s\n", static_cast<unsigned long long>(frame), place.text().c_str());
  const bool same_commands =
      isostep::detail::same_bytes(input_a.replay.frame(frame).input, input_b.replay.frame(frame).input);
  if (!same_commands) std::printf("%s", kCommandsDiffer);
  const std::size_t stage = place.index % place.hashes;
  const StagePoint at = {frame, static_cast<std::uint32_t>(place.index / place.hashes) + 1,
                         stage == 0 ? kCommandsStage : stages[stage - 1]};
  print_fields(a.fields_at(at), b.fields_at(at), trace_a[first].at == trace_b[first].at);
  return exit_status::kDifferent;
}

std::uint64_t frames_of(const Points& points) { return points.empty() ? 0 : points.back().at.frame + 1; }

}  // namespace

int print_first_difference(const Input& input_a, const StageSide& a, const Input& input_b, const StageSide& b) {
  const Points trace_a = a.trace(), trace_b = b.trace();
  const auto [in_a, in_b] = std::mismatch(
      trace_a.begin(), trace_a.end(), trace_b.begin(), trace_b.end(),
      [](const TracePoint& one, const TracePoint& other) { return one.at == other.at && one.hash == other.hash; });
  if (in_a != trace_a.end() && in_b != trace_b.end())
    return report(input_a, a, trace_a, input_b, b, trace_b, static_cast<std::size_t>(in_a - trace_a.begin()));
  const auto frames_a = static_cast<unsigned long long>(frames_of(trace_a));
  const auto frames_b = static_cast<unsigned long long>(frames_of(trace_b));
  if (!are_recorded_alike(input_a, input_b, std::min(frames_a, frames_b))) return exit_status::kDifferent;
  if (trace_a.size() != trace_b.size()) {
    std::printf("the same as far as both go: %llu and %llu frames\n", frames_a, frames_b);
    return exit_status::kDifferent;
  }
  std::printf("the same: %llu frames, stage by stage\n", frames_a);
  return exit_status::kOk;
}

int diff_stages(const DiffOptions& options) {
  const Input input_a(options.a), input_b(options.b.empty() ? options.a : options.b);
  for (const Input* input : {&input_a, &input_b}) {
    if (!input->is_replay()) throw ToolError(exit_status::kUsage, input->path + ": --stages compares replays");
  }
  const RecordedWorld world = world_of(input_a);
  if (!options.b.empty() && !are_comparable(world, world_of(input_b))) return exit_status::kDifferent;
  const auto side = [](const Input& input, const std::string& prover) {
    return prover.empty() ? played_here(input) : played_by(prover, input);
  };
  return print_first_difference(input_a, *side(input_a, options.prover_a), input_b, *side(input_b, options.prover_b));
}

}  // namespace isostep::tool
