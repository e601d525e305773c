// Recordings played stage by stage, in this process and in others.
// SPDX-License-Identifier: MIT
#include "stage_side.hpp"

#include <sys/wait.h>

#include <algorithm>
#include <charconv>
#include <cstdio>
#include <span>
#include <sstream>
#include <utility>

#include "isostep/core/number_text.hpp"
#include "isostep/replay/world_kinds.hpp"
#include "isostep/state/command_log.hpp"
#include "isostep/state/replay_format.hpp"
#include "tool/common/tool.hpp"

namespace isostep::tool {
namespace {

class Here : public StageSide {
 public:
  Here(const Input& input, const StagedReplay& how) : input_(input), how_(how) {}

  std::vector<TracePoint> trace() const override {
    std::vector<TracePoint> points;
    const TraceSink sink = {[](void* user, const TracedStage& traced) {
                              static_cast<std::vector<TracePoint>*>(user)->push_back(
                                  {{traced.frame, traced.step, traced.stage}, traced.hash});
                            },
                            &points};
    check(trace_stages(input_.replay, how_, sink));
    return points;
  }
  FieldList fields_at(const StagePoint& at) const override {
    FieldList list;
    const FieldSink sink = {[](void* user, const PathPart& path, FieldFormat format, std::uint64_t bits) {
                              static_cast<FieldList*>(user)->add({path_text(path), format, bits});
                            },
                            &list};
    check(visit_stage(input_.replay, how_, at, sink));
    return list;
  }

 private:
  void check(const Result<void>& played) const {
    if (played) return;
    const bool incompatible = played.error().code == ErrorCode::incompatible;
    refuse(input_.path, incompatible ? VerifyOutcome::incompatible : VerifyOutcome::corrupt, played.error());
  }

  const Input& input_;
  StagedReplay how_;
};

/// The output of a shell's command.
class Pipe {
 public:
  explicit Pipe(const std::string& command) : file_(popen(command.c_str(), "r")) {
    if (file_ == nullptr) throw ToolError(exit_status::kSoftware, command + ": cannot be run");
  }
  ~Pipe() {
    if (file_ != nullptr) pclose(file_);
  }
  Pipe(const Pipe&) = delete;
  Pipe& operator=(const Pipe&) = delete;

  /// A line without its end, be it a Windows program's; false after the last.
  bool read(std::string& line) {
    line.clear();
    int c = std::fgetc(file_);
    for (; c != EOF && c != '\n'; c = std::fgetc(file_)) line += static_cast<char>(c);
    if (!line.empty() && line.back() == '\r') line.pop_back();
    return c != EOF || !line.empty();
  }
  /// Returns an empty text, or how the command failed. `also_well`: an exit status beside 0 that is no failure.
  std::string close(int also_well) {
    const int status = pclose(std::exchange(file_, nullptr));
    if (!WIFEXITED(status)) return "did not come to its end";
    const int code = WEXITSTATUS(status);
    return code == 0 || code == also_well ? "" : "ended with exit status " + std::to_string(code);
  }

 private:
  std::FILE* file_;
};

/// "frame step stage hash"
bool read_point(const std::string& line, TracePoint& point) {
  std::istringstream words(line);
  std::string frame, step, hash, more;
  std::uint64_t number = 0;
  words >> frame >> step >> point.at.stage >> hash;
  if (!words || words >> more || !read_number(frame, point.at.frame) || !read_number(step, number)) return false;
  if (number > kFrameStepCap + 1) return false;
  point.at.step = static_cast<std::uint32_t>(number);
  const auto [end, error] = std::from_chars(hash.data(), hash.data() + hash.size(), point.hash, 16);
  return error == std::errc() && end == hash.data() + hash.size();
}

/// The stages of the kind of world that was recorded, in their order; none of a kind that this build does not know.
using Stages = std::span<const char* const>;
Stages stages_of(const ReplayReader& replay) {
  const Result<RecordedWorld> world = recorded_world(replay.header());
  Stages stages;
  if (!world) return stages;
  any_world([&](auto tag) {
    using Traits = WorldTraits<typename decltype(tag)::Type>;
    if (world.value().kind != Traits::kName) return false;
    stages = Traits::kStages;
    return true;
  });
  return stages;
}

/// A trace may go on so: a frame begins with the commands, and a step is its commands and then every stage. Null: it
/// begins.
bool follows(Stages stages, const StagePoint* before, const StagePoint& at) {
  const bool commands = at.stage == kCommandsStage;
  if (before == nullptr) return commands && at.frame == 0 && at.step == 1;
  if (at.frame == before->frame + 1) return commands && at.step == 1 && before->stage == kCommandsStage;
  const auto last = std::find(stages.begin(), stages.end(), before->stage);  // the end: commands were
  const auto next = last == stages.end() ? stages.begin() : last + 1;
  if (at.frame != before->frame) return false;
  if (next == stages.end()) return commands && at.step == before->step + 1;
  return at.stage == *next && at.step == before->step;
}

class Elsewhere : public StageSide {
 public:
  Elsewhere(const Input& input, const std::string& prover) : input_(input), prover_(prover) {}

  std::vector<TracePoint> trace() const override {
    std::vector<TracePoint> points;
    const ReplayReader& replay = input_.replay;
    const Stages stages = stages_of(replay);
    const bool cut = replay.status() == ReplayStatus::truncated;  // which a prover tells by its status
    const auto take = [&](const std::string& line) {
      TracePoint point{};
      const StagePoint* const before = points.empty() ? nullptr : &points.back().at;
      if (!read_point(line, point)) throw not_understood(line);
      expect_known(stages, point.at.stage);
      if (point.at.frame >= replay.frame_count() || !follows(stages, before, point.at)) throw not_understood(line);
      points.push_back(point);
    };
    each_line("trace " + quoted(input_.path), take, cut ? exit_code(VerifyOutcome::truncated) : 0);
    if (points.empty() && replay.frame_count() != 0)
      throw ToolError(exit_status::kSoftware, prover_ + ": says nothing");
    return points;
  }
  FieldList fields_at(const StagePoint& at) const override {
    FieldList list;
    const std::string point = std::to_string(at.frame) + "." + std::to_string(at.step) + " " + quoted(at.stage);
    each_line("fields " + quoted(input_.path) + " " + point, [&](const std::string& line) {
      NamedField field;
      if (!read_field_line(line, field)) throw not_understood(line);
      list.add(std::move(field));
    });
    return list;
  }

 private:
  static std::string quoted(const std::string& text) {
    std::string out = "'";
    for (const char c : text) out += c == '\'' ? std::string("'\\''") : std::string(1, c);
    return out + "'";
  }
  ToolError not_understood(const std::string& line) const {
    return ToolError(exit_status::kSoftware, prover_ + ": not a prover's answer: " + line.substr(0, 80));
  }
  /// One more or one less is another behaviour, not a place where two of one behaviour part.
  void expect_known(Stages stages, const std::string& stage) const {
    if (stage == kCommandsStage || std::find(stages.begin(), stages.end(), stage) != stages.end()) return;
    throw ToolError(exit_status::kSoftware,
                    prover_ + ": not a prover's answer: this build has no stage " + stage.substr(0, 80));
  }
  template <class Each> void each_line(const std::string& words, const Each& each, int also_well = 0) const {
    const std::string command = prover_ + " " + words;
    Pipe out(command);
    std::string line;
    while (out.read(line)) {
      stop_if_interrupted();
      each(line);
    }
    // Its status is its own: 1 would be read as this command's "different".
    const std::string failure = out.close(also_well);
    if (!failure.empty()) throw ToolError(exit_status::kSoftware, command + ": " + failure);
  }

  const Input& input_;
  std::string prover_;
};

}  // namespace

std::unique_ptr<StageSide> played_here(const Input& input, const StagedReplay& how) {
  return std::make_unique<Here>(input, how);
}
std::unique_ptr<StageSide> played_by(const std::string& prover, const Input& input) {
  return std::make_unique<Elsewhere>(input, prover);
}

}  // namespace isostep::tool
