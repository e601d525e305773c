// MatchRecorder: records a session's confirmed inputs and state hashes, for SessionMode::replay and for archives.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/session/session.hpp"
#include "isostep/session/solo/replay_core.hpp"
#include "isostep/state/record.hpp"

namespace isostep {

/// An observer of drive(). A match is a state, the inputs since and every frame's hash: 49 kB a minute of two players,
/// 51 of four and 55 of eight who change inputs of four bytes three times a second; 43 of them are hashes and lengths.
/// Whoever has the game plays it again. (SessionRecorder records the world's commands instead, for whoever has not.)
///
/// The recording begins with the state before the first frame that is stepped: that of a late joiner is the snapshot
/// which it was sent, and the header's `first_frame` its number. Where the session restarts from another snapshot the
/// recording ends, whole; what follows wants a recorder of its own. Errors stay, and `finish` returns them.
template <class Game, class Predictor = typename DefaultPredictor<typename Game::Input>::Type> class MatchRecorder {
 public:
  /// Session and game outlive the recorder. `block_frames`: 1 to kReplayBlockFrames, so many final ones a crash may
  /// cost; 0: a second.
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

  /// All final frames so far are with the sink: a crash costs nothing of them.
  const Result<void>& flush() {
    if (phase_ == Phase::open) keep(recorder_.flush());
    return result_;
  }
  /// Ends the file with the last confirmed frame.
  Result<void> finish() {
    if (phase_ == Phase::waiting) fail("no frame was stepped");
    if (phase_ == Phase::open) end();
    return result_;
  }
  /// The first error of all so far.
  const Result<void>& result() const { return result_; }
  /// The first that is recorded, and how many are written.
  Frame first() const { return first_; }
  Frame frames() const { return next_ - first_; }
  /// False once the session restarted, or after an error.
  bool recording() const { return phase_ == Phase::waiting || phase_ == Phase::open; }

 private:
  enum class Phase : std::uint8_t { waiting, open, ended };

  /// The rate is the session's: a game without a world has none in its header.
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
