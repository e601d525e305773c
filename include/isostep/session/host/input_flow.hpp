// InputFlow: which inputs the host sends to a guest, how many at once, and who acknowledges them.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/session/host/seats.hpp"
#include "isostep/session/peer/datagrams.hpp"
#include "isostep/session/timeline/input_stream.hpp"

namespace isostep {

/// What a guest has acknowledged comes in; what the next datagram brings goes out. It keeps its figures in the Guest.
class InputFlow {
 public:
  InputFlow(const SessionConfig& config, const Seats& seats, const std::vector<InputStream>& streams)
      : config_(config), seats_(seats), streams_(streams) {}
  /// Inputs of this player travel to it before this frame; 0: none.
  Frame until(int player, const Guest& guest) const;
  SendEnds ends(const Guest& guest) const {
    SendEnds ends;
    for (int p = 0; p < config_.players; ++p) ends.of[p] = until(p, guest);
    return ends;
  }
  /// How many frames of each player the next datagram may bring; 0: none is due.
  Frame most_frames(const Guest& guest, Time now) const;
  void was_sent(Guest& guest, std::size_t bytes, Time now) const;
  /// False: it acknowledges nothing for too long.
  bool tend(Guest& guest, Time now) const;
  bool acknowledges(const Guest& guest, Time now) const;
  /// The frame `current` is not shown all that others do in it.
  void note_held_back(Guest& guest, Frame current) const;
  /// Lately: then what it says of that player's inputs speaks of its own.
  static bool was_held_back(const Guest& guest, int player, Frame current) {
    return current < guest.held_back_until[player];
  }
  /// Inputs of absent players are final up to here.
  Frame horizon(Frame current) const { return seats_.hosted() == 0 ? current + 1 : end(first_of(seats_.hosted())); }
  /// [frames] What lies ahead of us takes the place of what others may still lack: of a short log little.
  Frame bounded(Frame ahead) const { return ahead < config_.history / 4 ? ahead : config_.history / 4; }

 private:
  Frame end(int player) const { return streams_[static_cast<std::size_t>(player)].end(); }
  /// Inputs of others before this frame are shown to it.
  Frame shown_until(const Guest& guest) const;
  bool lacks_inputs(const Guest& guest) const;
  /// It has acknowledged all of the datagram with which a period began. A spectator that is far behind is sent more
  /// only then, and costs no more than four times what it acknowledges and kStalledRate; a player's inputs are urgent.
  bool has_first(const Guest& guest) const;

  const SessionConfig& config_;
  const Seats& seats_;
  const std::vector<InputStream>& streams_;
};

}  // namespace isostep
