// SnapshotDesk: the one snapshot that the host sends, who shares it, and how far it has come with each.
// SPDX-License-Identifier: MIT
#pragma once

#include <span>

#include "isostep/session/config.hpp"
#include "isostep/session/host/guests.hpp"
#include "isostep/session/timeline/hash_log.hpp"

namespace isostep {

/// In: guests that need a snapshot. Out: the state to capture, and pieces of its bytes. A guest that needs another one
/// waits until nobody needs this one.
class SnapshotDesk {
 public:
  /// `bytes`: the game writes the snapshot there.
  SnapshotDesk(const SessionConfig& config, const HashLog& hashes, const std::vector<std::uint8_t>& bytes)
      : config_(config), hashes_(hashes), bytes_(bytes) {}
  /// Returns true if state().frame must be captured for these guests.
  bool serve(Guests& guests, Frame current);
  /// The capture was not carried out: its guests need another.
  void lost(Guests& guests);
  /// Holds the snapshot for a guest that was cut off while it arrived, and may come back for the rest.
  void hold_until(Frame frame) { held_until_ = frame; }
  /// begin: for a guest that joins. begin_repair: for one that has shown for long that it takes what it is sent.
  void begin(Guest& guest);
  void begin_repair(Guest& guest);
  /// Writes the next piece into `message`. Returns false if none is due.
  bool next_piece(Guest& guest, Time now, std::vector<std::uint8_t>& message);

  const HashReport& state() const { return state_; }
  std::uint64_t hash() const { return hash_; }

 private:
  /// Returns true if this snapshot can be sent to one more. Makes room for a newer one where that is fair.
  bool may_share(Guests& guests, Frame current);
  /// Returns true if it has a part of this snapshot, from before it was cut off.
  bool has_part(const Guest& guest) const {
    return guest.partial.frame == state_.frame && guest.partial.chain == state_.chain;
  }

  const SessionConfig& config_;
  const HashLog& hashes_;
  const std::vector<std::uint8_t>& bytes_;
  HashReport state_;
  std::uint64_t hash_ = 0;
  Frame held_until_ = 0;
};

}  // namespace isostep
