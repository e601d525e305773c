// SnapshotDesk: the one snapshot that the host sends, who shares it, and how far it has come with each.
// SPDX-License-Identifier: MIT
#pragma once

#include <span>

#include "isostep/session/config.hpp"
#include "isostep/session/host/guests.hpp"
#include "isostep/session/timeline/hash_log.hpp"

namespace isostep {

/// Guests that need a snapshot come in; which state is to be captured goes out, and pieces of its bytes. Whoever needs
/// another one waits until nobody needs this one.
class SnapshotDesk {
 public:
  /// `bytes`: where the game writes it.
  SnapshotDesk(const SessionConfig& config, const HashLog& hashes, const std::vector<std::uint8_t>& bytes)
      : config_(config), hashes_(hashes), bytes_(bytes) {}
  /// True: state().frame is to be captured, for these guests.
  bool serve(Guests& guests, Frame current);
  /// It was not: they need another.
  void lost(Guests& guests);
  /// Who was cut off while it arrived may come back for the rest.
  void hold_until(Frame frame) { held_until_ = frame; }
  /// For one who joins; who gets a repair, or none, has shown for long that it takes what it is sent.
  void begin(Guest& guest);
  void begin_repair(Guest& guest);
  /// Into `message`; false: none is due.
  bool next_piece(Guest& guest, Time now, std::vector<std::uint8_t>& message);

  const HashReport& state() const { return state_; }
  std::uint64_t hash() const { return hash_; }

 private:
  /// Can the snapshot that we have be sent to one more? Makes room for a newer one where that is fair.
  bool may_share(Guests& guests, Frame current);
  /// Of the same snapshot, from before it was cut off.
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
