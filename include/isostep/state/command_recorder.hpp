// CommandRecorder: records every command that a world accepts, so that the stock tool replays any game without its
// code. It takes the command logs that the world's CommandJournal fills, and writes them to a replay.
// SPDX-License-Identifier: MIT
#pragma once

#include <concepts>
#include <cstdint>
#include <string_view>
#include <vector>

#include "isostep/core/short_text.hpp"
#include "isostep/state/command_log.hpp"
#include "isostep/state/concepts.hpp"
#include "isostep/state/frame.hpp"
#include "isostep/state/record.hpp"

namespace isostep {

/// Returns the header of a recording from frame `first` on. `identity_of_world(settings, scene)` is found beside the
/// settings and tells what must be equal where a recording of such a world is replayed.
template <class Settings>
ISO_INLINE Result<ReplayHeader> header_of_world(const Settings& settings, std::string_view scene, Frame first) {
  Result<ReplayHeader> header = make_replay_header(identity_of_world(settings, scene));
  if (header && first > 0) {
    header.value().set(kFirstFrameKey, ShortText<20>().append_number(static_cast<std::uint64_t>(first)).view(), false);
  }
  return header;
}

/// A world whose mutators and steps append themselves to the command log that it was given, as `play_commands` reads
/// it: write_command for what it accepts, kStepMarker for a step.
template <class W>
concept RecordableWorld = ReplayableSimulation<W> && requires(W& world, const W& same, std::vector<std::uint8_t>* log) {
  typename W::EveryCommand;
  world.record_to(log);
  { same.records_to(log) } -> std::same_as<bool>;
  { same.tick() } -> std::convertible_to<std::uint64_t>;   // steps taken
  { same.loads() } -> std::convertible_to<std::uint64_t>;  // how often its state was replaced
  { identity_of_world(same.settings(), std::string_view{}) } -> std::same_as<ReplayIdentity>;
};

/// The place where a frame's command log began.
template <RecordableWorld W> struct CommandLogStart {
  std::uint64_t loads = 0, tick = 0;

  CommandLogStart() = default;
  ISO_INLINE explicit CommandLogStart(const W& world) : loads(world.loads()), tick(world.tick()) {}
  /// Returns why the command log does not lead from the state then to the state now; null: it does.
  ISO_INLINE const char* flaw(const W& world, const std::vector<std::uint8_t>& log) const {
    if (!world.records_to(&log) || world.loads() != loads) {
      return "the world was loaded or replaced while it was recorded";
    }
    return world.tick() - tick > kFrameStepCap ? kTooManySteps : nullptr;
  }
};

/// Call `begin`; for every frame commands and steps, in any number and order, and `end_frame`; then `finish`. A frame
/// without a step is a pause, and a frame has at most kFrameStepCap steps. The world must outlive the recorder and
/// records to nothing else meanwhile. Loading a snapshot ends a recording, because commands alone do not lead there.
/// Without `finish` the file is truncated, and its whole blocks still play: a crash costs at most a second of frames,
/// or `block_frames`, or what came after the last `flush`.
template <RecordableWorld W> class CommandRecorder {
 public:
  ISO_INLINE CommandRecorder(W& world, ReplaySink sink, std::uint32_t block_frames = 0)
      : world_(world), recorder_(sink, block_frames) {}
  ISO_INLINE ~CommandRecorder() { world_.record_to(nullptr); }
  CommandRecorder(const CommandRecorder&) = delete;
  CommandRecorder& operator=(const CommandRecorder&) = delete;

  /// Begins with the world as it is now, whatever it holds, as the first state, before the game's frame `first`.
  ISO_INLINE Result<void> begin(std::string_view scene, Frame first = 0) {
    const Result<ReplayHeader> header = header_of_world(world_.settings(), scene, first);
    if (!header) return header.error();
    start_frame();
    world_.record_to(&log_);
    return recorder_.begin(world_, header.value());
  }
  /// `hash`: the world's present one. Callers that have it need not compute it twice.
  ISO_INLINE Result<void> end_frame(std::uint64_t hash) {
    if (const char* flaw = start_.flaw(world_, log_)) return Error{ErrorCode::invalid, flaw, "recorder"};
    const Result<void> result = recorder_.frame(log_, hash);
    start_frame();
    return result;
  }
  ISO_INLINE Result<void> end_frame() { return end_frame(world_.hash()); }
  /// Writes the state as a keyframe. Call it after `end_frame`, with no call to the world in between: whoever verifies
  /// the recording compares this state byte for byte with its own.
  ISO_INLINE Result<void> keyframe() {
    const char* flaw = start_.flaw(world_, log_);
    if (flaw == nullptr && !log_.empty()) flaw = "a keyframe stands between two frames";
    if (flaw != nullptr) return Error{ErrorCode::invalid, flaw, "recorder"};
    return recorder_.keyframe(world_);
  }
  /// Passes all frames so far to the sink.
  ISO_INLINE Result<void> flush() { return recorder_.flush(); }
  ISO_INLINE Result<void> finish() { return recorder_.finish(); }

 private:
  ISO_INLINE void start_frame() {
    log_.clear();
    start_ = CommandLogStart<W>(world_);
  }

  W& world_;
  Recorder<W> recorder_;
  std::vector<std::uint8_t> log_;
  CommandLogStart<W> start_;
};

}  // namespace isostep
