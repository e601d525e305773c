// MatchRecorder: records a session's confirmed inputs and state hashes, for SessionMode::replay and for archives.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/session/replay_core.hpp"
#include "isostep/session/session.hpp"
#include "isostep/state/record.hpp"

namespace isostep {

/// An observer of drive(). A match is its first state and the inputs since: a few kilobytes a minute, played again by
/// whoever has the game. (SessionRecorder records the world's commands instead, for whoever has not.)
template <class Game, class Predictor = typename DefaultPredictor<typename Game::Input>::Type> class MatchRecorder {
 public:
  /// The session outlives the recorder.
  MatchRecorder(const Session<Game, Predictor>& session, ReplaySink sink) : session_(session), recorder_(sink) {}

  /// Before the first frame; `game` is in its first state.
  Result<void> begin(const Game& game) { return keep(recorder_.begin(game, session_.config().identity)); }
  Result<void> finish() { return keep(recorder_.finish()); }
  /// The first error of all so far.
  const Result<void>& result() const { return result_; }

  void confirmed(Frame frame, std::uint64_t hash) {
    using Codec = InputCodec<typename Game::Input>;
    const int players = session_.config().players;
    InputEntry entries[kMaxPlayers];
    std::uint8_t bytes[kMaxPlayers][kInputCap];
    for (int p = 0; p < players; ++p) {
      const bool absent = session_.status(frame, p) == InputStatus::disconnected;
      const std::size_t size = absent ? 0 : Codec::encode(session_.input(frame, p), bytes[p]);
      entries[p] = {absent, Bytes(bytes[p], size)};
    }
    write_match_frame(std::span<const InputEntry>(entries, static_cast<std::size_t>(players)), frame_);
    static_cast<void>(keep(recorder_.frame(frame_, hash)));
  }
  /// A match joined late has no beginning here.
  void restarted(Frame) {
    static_cast<void>(keep(Error{ErrorCode::invalid, "the session was joined while the match ran", "match recorder"}));
  }

 private:
  Result<void> keep(const Result<void>& result) {
    if (result_.ok() && !result.ok()) result_ = result;
    return result;
  }

  const Session<Game, Predictor>& session_;
  Recorder<Game> recorder_;
  Result<void> result_;
  std::vector<std::uint8_t> frame_;
};

}  // namespace isostep
