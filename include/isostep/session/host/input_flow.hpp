// InputFlow: which inputs the host sends to a guest, how many at once, and who acknowledges them.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/session/host/seats.hpp"
#include "isostep/session/peer/datagrams.hpp"
#include "isostep/session/timeline/input_stream.hpp"

namespace isostep {

/// In: what a guest has acknowledged. Out: what the next datagram brings. It keeps its figures in the Guest.
class InputFlow {
 public:
  InputFlow(const SessionConfig& config, const Seats& seats, const std::vector<InputStream>& streams)
      : config_(config), seats_(seats), streams_(streams) {}
  /// The end of this player's inputs that the guest is sent; 0: none are.
  Frame until(int player, const Guest& guest) const;
  SendEnds ends(const Guest& guest) const {
    SendEnds ends;
    for (int p = 0; p < config_.players; ++p) ends.of[p] = until(p, guest);
    return ends;
  }
  /// The most frames of each player in the next datagram; 0: none is due.
  Frame most_frames(const Guest& guest, Time now) const;
  void was_sent(Guest& guest, std::size_t bytes, Time now) const;
  /// Returns false if the guest has acknowledged nothing for too long.
  bool tend(Guest& guest, Time now) const;
  bool acknowledges(const Guest& guest, Time now) const;
  /// Notes the players whose inputs are held back from the guest in the frame `current`.
  void note_held_back(Guest& guest, Frame current) const;
  /// Returns true if they were held back lately. Then what the guest reports on them speaks of its own inputs.
  static bool was_held_back(const Guest& guest, int player, Frame current) {
    return current < guest.held_back_until[player];
  }
  /// Inputs of absent players are final before this frame.
  Frame horizon(Frame current) const { return seats_.hosted() == 0 ? current + 1 : end(first_of(seats_.hosted())); }
  /// Limits `ahead` [frames] to a quarter of the log: what lies ahead of us displaces what others may still lack.
  Frame bounded(Frame ahead) const { return ahead < config_.history / 4 ? ahead : config_.history / 4; }

 private:
  Frame end(int player) const { return streams_[static_cast<std::size_t>(player)].end(); }
  /// The end of the others' inputs that are shown to the guest.
  Frame shown_until(const Guest& guest) const;
  bool lacks_inputs(const Guest& guest) const;
  /// Returns true if the guest has acknowledged the first datagram of its last period. A far spectator is sent more
  /// only then, so it costs at most four times what it acknowledges, and kStalledRate; a player's inputs are urgent.
  bool has_first(const Guest& guest) const;

  const SessionConfig& config_;
  const Seats& seats_;
  const std::vector<InputStream>& streams_;
};

}  // namespace isostep
