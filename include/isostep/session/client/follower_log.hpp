// FollowerLog: Raft's log at a client: which inputs the host has made final, across changes of the host.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/session/agreement/election.hpp"
#include "isostep/session/client/entry.hpp"
#include "isostep/session/client/former_inputs.hpp"
#include "isostep/session/client/own_seats.hpp"

namespace isostep {

/// In: welcomes, and what a host says is final. Out: where every player's final inputs end. Keeps: the host's word on
/// that, what the host before had told, and where a candidate's log ended when it asked for others' inputs.
class FollowerLog {
 public:
  FollowerLog(std::vector<InputStream>& streams, Timeline& timeline, OwnSeats& own, const Entry& entry)
      : streams_(streams), timeline_(timeline), own_(own), entry_(entry) {}

  /// Inputs before this frame are final, as the host says; beyond kLastFrame: all that it says is.
  Frame told_final() const { return told_final_; }
  void is_final_until(Frame end) { told_final_ = end; }
  /// As a datagram says; kNoFrame: all of it.
  void hear_final(Frame end);
  /// This machine writes the player's stream: the seat is ours and open, or opens once we begin.
  bool is_told_by_us(int player) const { return own_.has(player) && (own_.is_open() || entry_.is_under_way()); }
  /// Where the inputs of `player` end that the host has made final, as far as we know.
  Frame final_end(int player) const { return is_told_by_us(player) ? own_.accepted(player) : stream(player).end(); }
  void copy_ends(Frame (&ends)[kMaxPlayers]) const;
  /// A candidate asks for inputs: what follows these ends from now on is no host's word.
  void note_ends();
  Frame noted_end(int player) const { return noted_[player]; }

  /// We go on behind this host: before its welcome is taken.
  void follow(const Welcome& next, std::uint32_t log_term);
  /// The streams, for a beginning in this state.
  void begin_at(Frame frame);
  /// Once a turn: does the log hold all that the host took over?
  void tend(Election& election);
  /// Another election is about the log of the host before, while this one has not told all: its inputs are ours again.
  void take_back_former();

 private:
  const InputStream& stream(int player) const { return streams_[static_cast<std::size_t>(player)]; }
  int players() const { return static_cast<int>(streams_.size()); }
  bool has_all_until(Frame end) const;

  std::vector<InputStream>& streams_;
  Timeline& timeline_;
  OwnSeats& own_;
  const Entry& entry_;
  Frame told_final_ = kLastFrame + 1;
  bool keeps_inputs_ = false;  // we go on with the same host, so that what it said stays said
  bool has_noted_ = false;
  Frame noted_[kMaxPlayers] = {};
  FormerInputs former_;
};

}  // namespace isostep
