// StagedReplay: the world that a replay needs, played with somebody who watches.
// SPDX-License-Identifier: MIT
#include "diagnostics/staged_replay.hpp"

#include "diagnostics/fault_injection.hpp"
#include "isostep/core/number_text.hpp"
#include "isostep/core/simd_choice.hpp"
#include "isostep/replay/world_kinds.hpp"
#include "isostep/state/replay_format.hpp"

namespace isostep {
namespace {

/// The action at a point: look(point's step and stage, what was left there).
struct Watch {
  const StagedReplay& how;
  const TraceSink* trace;  // or, for the fields of one point:
  const StagePoint* at;
  const FieldSink* fields;
  EditFields edit = nullptr;  // of the world's engine
  std::uint64_t frame = 0;
  bool injected = false, visited = false;

  bool is_at(const StagePoint& point, std::uint32_t step, std::string_view stage) const {
    return point.frame == frame && point.step == step && point.stage == stage;
  }
  void look(std::uint32_t step, const char* stage, const StageView& view) {
    const StageFault* const fault = how.fault;
    const bool faulty = fault != nullptr && is_at(fault->at, step, stage);
    if (faulty) injected = FaultInjection(fault->path, fault->bit).inject(view, edit);
    tell(step, stage, view);
    if (faulty && fault->heals) FaultInjection(fault->path, fault->bit).inject(view, edit);
  }
  void tell(std::uint32_t step, const char* stage, const StageView& view) {
    if (trace != nullptr) trace->stage(trace->user, {frame, step, stage, view.hash()});
    if (at == nullptr || !is_at(*at, step, stage)) return;
    view.visit(*fields);
    visited = true;
  }
  /// Others are played as ever.
  bool watches() const {
    return trace != nullptr || at->frame == frame || (how.fault != nullptr && how.fault->at.frame == frame);
  }
};

template <class W> struct Watched {
  W& world;
  Watch& watch;
  std::uint32_t number;  // of the step

  template <class Stage> static void after(void* user, Stage stage, const StageView& left) {
    const Watched& step = *static_cast<const Watched*>(user);
    step.watch.look(step.number, WorldTraits<W>::kStages[static_cast<std::size_t>(stage)], left);
  }
  static void step(void* user) {
    Watched& one = *static_cast<Watched*>(user);
    ++one.number;
    one.look_at_commands();
    one.world.step({&Watched::after, user});
  }
  void look_at_commands() { watch.look(number, kCommandsStage, world.state_fields()); }
};

template <class W> Result<void> play_frame(W& world, Bytes commands, Watch& watch) {
  if (!watch.watches()) return world.step_recorded(commands);
  Watched<W> watched = {world, watch, 0};
  const Result<void> played = world.step_recorded(commands, {&Watched<W>::step, &watched});
  ++watched.number;
  if (played) watched.look_at_commands();
  return played;
}

template <class W> Result<void> play_as(const ReplayReader& replay, Watch& watch) {
  W world;
  watch.edit = edit_fields_of(WorldTag<W>{});
  use_lanes(world, watch.how.simd);
  Reader reader(replay.state());
  const Result<void> read = world.read_portable(reader);
  if (!read) return read;
  for (; watch.frame < replay.frame_count() && watch.frame < watch.how.frames; ++watch.frame) {
    const Result<void> played = play_frame(world, replay.frame(watch.frame).input, watch);
    if (!played) return played;
    if (watch.visited) break;
  }
  return {};
}

Result<void> play(const ReplayReader& replay, Watch& watch) {
  if (!replay.has_state() || replay.status() == ReplayStatus::corrupt || replay.status() == ReplayStatus::incompatible)
    return replay.error();
  const Result<RecordedWorld> world = recorded_world(replay.header());
  if (!world) return world.error();
  Result<void> played;
  const std::string_view missing =
      with_world(world.value(), [&](auto tag) { played = play_as<typename decltype(tag)::Type>(replay, watch); });
  if (!missing.empty()) return Error{ErrorCode::incompatible, "of a world that this build lacks", missing};
  return played;
}

/// A fault that was not injected is an error.
Result<void> end_of(const Watch& watch) {
  const StageFault* const fault = watch.how.fault;
  const bool reached = fault != nullptr && (watch.at == nullptr || fault->at.frame <= watch.at->frame);
  if (!reached || watch.injected) return {};
  return Error{ErrorCode::invalid, "the fault was not injected: no such stage, or no such field that may be written",
               std::string_view(fault->path)};
}

}  // namespace

bool read_stage_step(std::string_view text, StagePoint& point) {
  const std::size_t dot = text.find('.');
  std::uint64_t step = 1;
  if (dot != std::string_view::npos && !read_number(text.substr(dot + 1), step)) return false;
  if (step == 0 || step > kFrameStepCap + 1) return false;
  point.step = static_cast<std::uint32_t>(step);
  return read_number(text.substr(0, dot), point.frame);
}

bool read_stage_fault(std::string_view text, StageFault& fault) {
  const std::size_t first = text.find(':'), last = text.rfind(':');
  const std::size_t second = first == std::string_view::npos ? first : text.find(':', first + 1);
  std::uint64_t bit = 0;
  if (second == std::string_view::npos || second == last) return false;
  if (!read_stage_step(text.substr(0, first), fault.at) || !read_number(text.substr(last + 1), bit)) return false;
  fault.at.stage = text.substr(first + 1, second - first - 1);
  fault.path = text.substr(second + 1, last - second - 1);
  fault.bit = static_cast<std::uint32_t>(bit < 64 ? bit : 64);
  return true;
}

Result<void> trace_stages(const ReplayReader& replay, const StagedReplay& how, const TraceSink& sink) {
  Watch watch = {how, &sink, nullptr, nullptr};
  const Result<void> played = play(replay, watch);
  return played ? end_of(watch) : played;
}

Result<void> visit_stage(const ReplayReader& replay, const StagedReplay& how, const StagePoint& at,
                         const FieldSink& sink) {
  Watch watch = {how, nullptr, &at, &sink};
  const Result<void> played = play(replay, watch);
  if (!played) return played;
  if (!watch.visited) return Error{ErrorCode::invalid, "the recording has no such stage", std::string_view(at.stage)};
  return end_of(watch);
}

}  // namespace isostep
