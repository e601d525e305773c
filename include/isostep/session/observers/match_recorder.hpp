// MatchRecorder: records a session's confirmed inputs and state hashes, for SessionMode::replay and for archives.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/session/session.hpp"
#include "isostep/session/solo/replay_core.hpp"
#include "isostep/state/record.hpp"

namespace isostep {

/// An observer of drive() that records a state, the inputs since and every frame's hash: 49 kB a minute for two
/// players, 51 for four and 55 for eight who change inputs of four bytes three times a second; hashes and lengths take
/// 43 of them. The game can play it again. (SessionRecorder records the world's commands, for whoever has no game.)
///
/// The recording begins with the state before the first stepped frame. For a late joiner this is the snapshot that it
/// received, and the header's `first_frame` is its number. If the session restarts from another snapshot, the recording
/// ends as a whole file; the rest needs another recorder. Errors stay, and `finish` returns them.
template <class Game, class Predictor = typename DefaultPredictor<typename Game::Input>::Type> class MatchRecorder {
 public:
  /// `session` and `game` must outlive the recorder. `block_frames`: 1 to kReplayBlockFrames, the most final frames
  /// that a crash may cost; 0: a second.
  MatchRecorder(const Session<Game, Predictor>& session, const Game& game, ReplaySink sink,
                std::uint32_t block_frames = 0)
      : session_(session),
        game_(game),
        recorder_(sink, block_frames != 0 ? block_frames : a_second(session)),
        // The newest frame and the one before it.
        streams_(static_cast<std::size_t>(session.config().players), InputStream(2, kInputCap)) {}

  void before_step(Frame frame) {
    if (phase_ == Phase::waiting) begin(frame);
  }
  void rolled_back(Frame frame) {
    if (phase_ == Phase::open && frame < first_) fail("the first frame was stepped again from another state");
  }
  void confirmed(Frame frame, std::uint64_t hash) {
    if (phase_ != Phase::open || frame < first_) return;
    if (frame != next_) return fail("frames were not confirmed one after the other");
    using Codec = InputCodec<typename Game::Input>;
    const int players = session_.config().players;
    std::uint8_t bytes[kInputCap];
    for (int p = 0; p < players; ++p) {
      const bool absent = session_.status(frame, p) == InputStatus::disconnected;
      const std::size_t size = absent ? 0 : Codec::encode(session_.input(frame, p), bytes);
      static_cast<void>(streams_[static_cast<std::size_t>(p)].append({absent, Bytes(bytes, size)}));
    }
    write_match_frame(streams_, frame_);
    keep(recorder_.frame(frame_, hash));
    if (result_) ++next_;
  }
  void restarted(Frame) {
    if (phase_ == Phase::open) end();
  }

  /// Passes all final frames so far to the sink, so that a crash loses none of them.
  const Result<void>& flush() {
    if (phase_ == Phase::open) keep(recorder_.flush());
    return result_;
  }
  /// Ends the file after the last confirmed frame.
  Result<void> finish() {
    if (phase_ == Phase::waiting) fail("no frame was stepped");
    if (phase_ == Phase::open) end();
    return result_;
  }
  /// The first error so far.
  const Result<void>& result() const { return result_; }
  /// The first recorded frame, and the number of written ones.
  Frame first() const { return first_; }
  Frame frames() const { return next_ - first_; }
  /// Returns false after `finish`, after the session restarted, or after an error.
  bool recording() const { return phase_ == Phase::waiting || phase_ == Phase::open; }

 private:
  enum class Phase : std::uint8_t { waiting, open, ended };

  /// The rate is the session's, because a game without a world has none in its header.
  static std::uint32_t a_second(const Session<Game, Predictor>& session) {
    return second_of_frames(static_cast<std::uint64_t>(session.config().hz));
  }

  void begin(Frame frame) {
    ReplayHeader header = session_.config().identity;
    phase_ = Phase::open;
    first_ = next_ = frame;
    ShortText<kReplayValueCap> number;
    number.append_number(static_cast<std::uint64_t>(frame));
    if (frame > 0 && !header.set(kFirstFrameKey, number.view(), false)) return fail("no room for first_frame");
    keep(recorder_.begin(game_, header));
  }
  void end() {
    keep(recorder_.finish());
    phase_ = Phase::ended;
  }
  void keep(const Result<void>& result) {
    if (result || !result_) return;
    result_ = result;
    phase_ = Phase::ended;
  }
  void fail(const char* message) { keep(Error{ErrorCode::invalid, message, "match recorder"}); }

  const Session<Game, Predictor>& session_;
  const Game& game_;
  Recorder<Game> recorder_;
  std::vector<InputStream> streams_;
  Phase phase_ = Phase::waiting;
  Frame first_ = 0, next_ = 0;
  Result<void> result_;
  std::vector<std::uint8_t> frame_;
};

}  // namespace isostep
