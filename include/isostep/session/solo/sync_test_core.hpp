// SyncTestCore: one machine plays all players; every frame is guessed wrong, rolled back, stepped again and compared.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/session/pace/frame_clock.hpp"
#include "isostep/session/peer/session_core.hpp"

namespace isostep {

/// The session learns every input `window` frames late, so it first steps the frames in between on guesses, as in a
/// match. Then it steps the newest `window` frames again with the same inputs, shown as confirmed: the hashes must be
/// the same. A difference means that something shapes the future and is not saved, that a step is no function of state
/// and inputs, or that the game looks at which inputs are guesses. For games with a portable form it also flips bits of
/// every new state: the hash must change.
class SyncTestCore : public SessionCore {
 public:
  SyncTestCore(const SessionConfig& config, const InputRules& rules);

  bool add_local_input(int player, Bytes input) override;
  bool wants_input(int player) const override;
  Time wait(Time now) const override { return clock_.until_due(now); }
  void unhashed(Frame state, std::size_t byte) override;

 protected:
  void plan(Time now) override;
  void hash_known(Frame state, std::uint64_t hash) override;

 private:
  void step_from(Frame frame, Frame end, bool as_confirmed);

  struct StateHash {
    Frame state = kNoFrame;
    std::uint64_t hash = 0;
  };
  StateHash& hash_of(Frame state) { return hashes_[static_cast<std::size_t>(state) % hashes_.size()]; }

  FrameClock clock_;
  std::vector<InputStream> said_;   // what the players did
  std::vector<InputStream> known_;  // what the session has been told, late
  std::vector<StateHash> hashes_;
  Frame settled_ = 0, limit_ = 0;
  bool asked_start_ = false, differs_ = false, unhashed_ = false;
};

}  // namespace isostep
