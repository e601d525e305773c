// SessionRecorder: the confirmed frames of a session that rolls back, as a replay that needs no code of the game.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "isostep/replay/frame_history.hpp"
#include "isostep/replay/recorder.hpp"

namespace isostep {

/// Observes `drive` beside the FrameHistory of the same world, which keeps at least as many frames as may be predicted.
/// The recording starts with the state before the first stepped frame, and a frame is written once it is confirmed. If
/// the session restarts from another state, the recording ends as a whole file; the rest needs another recorder. Errors
/// stay, and `finish` returns them, because the hooks of observers return nothing.
template <class S> class SessionRecorder {
 public:
  /// `scene` is copied. `history` must outlive this. `block_frames`: see MatchRecorder.
  ISO_INLINE SessionRecorder(const FrameHistory<S>& history, ReplaySink sink, std::string_view scene,
                             std::uint32_t block_frames = 0)
      : history_(history), recorder_(sink, block_frames), scene_(scene) {}

  ISO_INLINE void before_step(Frame frame) {
    if (phase_ == Phase::waiting) begin(frame);
  }
  ISO_INLINE void rolled_back(Frame frame) {
    if (phase_ == Phase::open && frame < first_) fail("the first frame was stepped again from another state");
  }
  ISO_INLINE void confirmed(Frame frame, std::uint64_t) {
    if (phase_ != Phase::open || frame < first_) return;
    const typename FrameHistory<S>::Kept* kept = history_.find(frame);
    if (frame != next_) return fail("frames were not confirmed one after the other");
    if (kept == nullptr) return fail("the history is too short: a frame left it before it was confirmed");
    if (kept->flaw != nullptr) return fail(kept->flaw);
    keep(recorder_.frame(kept->commands, kept->hash));
    if (result_) ++next_;
  }
  ISO_INLINE void restarted(Frame) {
    if (phase_ == Phase::open) end();
  }

  /// Passes all final frames so far to the sink.
  ISO_INLINE const Result<void>& flush() {
    if (phase_ == Phase::open) keep(recorder_.flush());
    return result_;
  }
  /// Ends the file after the last confirmed frame.
  ISO_INLINE Result<void> finish() {
    if (phase_ == Phase::waiting) fail("no frame was stepped");
    if (phase_ == Phase::open) end();
    return result_;
  }
  ISO_INLINE const Result<void>& result() const { return result_; }
  /// The number of written frames.
  ISO_INLINE Frame frames() const { return next_ - first_; }
  /// Returns false after `finish`, after the session restarted, or after an error.
  ISO_INLINE bool recording() const { return phase_ == Phase::waiting || phase_ == Phase::open; }

 private:
  enum class Phase : std::uint8_t { waiting, open, ended };

  ISO_INLINE void begin(Frame frame) {
    const World<S>& world = history_.world();
    const Result<ReplayHeader> header = header_of_world(world.settings(), scene_.view(), frame);
    phase_ = Phase::open;
    first_ = next_ = frame;
    keep(header ? recorder_.begin(world, header.value()) : Result<void>(header.error()));
  }
  ISO_INLINE void end() {
    keep(recorder_.finish());
    phase_ = Phase::ended;
  }
  ISO_INLINE void keep(const Result<void>& result) {
    if (result || !result_) return;
    result_ = result;
    phase_ = Phase::ended;
  }
  ISO_INLINE void fail(const char* message) { keep(Error{ErrorCode::invalid, message, "session recorder"}); }

  const FrameHistory<S>& history_;
  Recorder<World<S>> recorder_;
  ShortText<kReplayValueCap> scene_;
  Phase phase_ = Phase::waiting;
  Frame first_ = 0, next_ = 0;
  Result<void> result_;
};

}  // namespace isostep
