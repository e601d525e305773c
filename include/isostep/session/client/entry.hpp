// Entry: how a client comes from the host's welcome to the state from which it goes on.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/session/client/snapshot_arrival.hpp"

namespace isostep {

/// In: the welcome, arrived pieces, and the hash of the state. Out: what a hello says of our state, and when and where
/// the game begins. Keeps: the welcome, the stage, and whether the game is in a state of the match.
class Entry {
 public:
  Entry(SnapshotArrival& arrival, bool is_spoiled) : arrival_(arrival), is_spoiled_(is_spoiled) {}

  const Welcome& welcome() const { return welcome_; }
  bool is_under_way() const { return stage_ != Stage::none; }
  /// Returns true if we enter by a state of the host's, not from one that we have.
  bool is_restoring() const { return is_under_way() && stage_ != Stage::goes_on; }
  /// Returns true if all is there, so that the next plan begins.
  bool is_due() const { return stage_ == Stage::is_whole || stage_ == Stage::goes_on; }
  /// Returns true if a snapshot was bad, so that the game may be in no state of this match.
  bool is_spoiled() const { return is_spoiled_; }
  bool is_restored_by(Frame state) const { return is_restoring() && state == welcome_.start.frame; }

  void describe(const HashReport& settled, Hello& hello) const {
    hello.have = is_spoiled_ ? HashReport{0, 0} : settled;
    if (arrival_.start().frame == kNoFrame) return;
    hello.partial = arrival_.start();
    hello.partial_size = arrival_.progress().arrived;
  }
  /// Returns true if the welcome fits what we have. Without a snapshot we go on only from the state that our hello
  /// named, for others may be gone. Pieces continue ours, or begin anew.
  bool fits(const Welcome& welcome, const HashReport& settled) const {
    const bool has_start = welcome.start.frame == settled.frame && welcome.start.chain == settled.chain;
    const bool fits = welcome.snapshot_from == 0 || arrival_.goes_on(welcome.start, welcome.snapshot_from);
    return fits && (welcome.snapshot_size > 0 || (has_start && !is_spoiled_));
  }
  void begin(const Welcome& welcome) {
    welcome_ = welcome;
    opened_ = kNoFrame;
    const bool restores = welcome.snapshot_size > 0;
    arrival_.begin(restores ? welcome.start : HashReport{}, welcome.snapshot_size, welcome.snapshot_from);
    const bool is_due = welcome.snapshot_from == welcome.snapshot_size;
    stage_ = !restores ? Stage::goes_on : is_due ? Stage::is_whole : Stage::arrives;
  }
  void has_pieces() {
    if (stage_ == Stage::arrives && arrival_.is_whole()) stage_ = Stage::is_whole;
  }
  /// Returns true if the requests of the last turn were not carried out.
  bool must_restore_again() const { return stage_ == Stage::restores; }
  /// Keeps the frame from which our players play, which the host told in the meantime. kNoFrame: it has not.
  void keep_opened(Frame first) { opened_ = first; }
  Frame opened() const { return opened_; }
  void was_begun() { stage_ = is_restoring() ? Stage::restores : Stage::none; }
  /// Takes the hash of the restored state. Returns false if it is not the host's.
  bool has_hash(std::uint64_t hash) {
    if (hash != welcome_.hash) return false;
    stage_ = Stage::none;
    is_spoiled_ = false;
    arrival_.forget();
    return true;
  }
  void leave() { stage_ = Stage::none; }
  void spoil() {
    leave();
    is_spoiled_ = true;
    arrival_.forget();
  }

 private:
  enum class Stage : std::uint8_t {
    none,
    arrives,   // the snapshot's pieces
    is_whole,  // restore it next
    goes_on,   // or go on next from the state that we have
    restores   // the game was given the state, and its hash is not known yet
  };

  SnapshotArrival& arrival_;
  Welcome welcome_;
  Stage stage_ = Stage::none;
  Frame opened_ = kNoFrame;
  bool is_spoiled_;
};

}  // namespace isostep
