// FollowerLog: Raft's log at a client: which inputs the host has made final, across changes of the host.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/session/agreement/election.hpp"
#include "isostep/session/client/entry.hpp"
#include "isostep/session/client/former_inputs.hpp"
#include "isostep/session/client/own_seats.hpp"

namespace isostep {

/// In: welcomes, and which inputs a host calls final. Out: the end of each player's final inputs. Keeps: the host's
/// word on that, what the host before had told, and where our log ended when we asked for inputs as a candidate.
class FollowerLog {
 public:
  FollowerLog(std::vector<InputStream>& streams, Timeline& timeline, OwnSeats& own, const Entry& entry)
      : streams_(streams), timeline_(timeline), own_(own), entry_(entry) {}

  /// The host calls inputs before this frame final. Beyond kLastFrame: all inputs that it sends are final.
  Frame told_final() const { return told_final_; }
  void is_final_until(Frame end) { told_final_ = end; }
  /// Takes the end of final inputs from a datagram; kNoFrame: all are.
  void hear_final(Frame end);
  /// Returns true if this machine writes the player's stream: the seat is ours and open, or opens once we begin.
  bool is_told_by_us(int player) const { return own_.has(player) && (own_.is_open() || entry_.is_under_way()); }
  /// The end of the inputs of `player` that the host has made final, as far as we know.
  Frame final_end(int player) const { return is_told_by_us(player) ? own_.accepted(player) : stream(player).end(); }
  void copy_ends(Frame (&ends)[kMaxPlayers]) const;
  /// Notes the ends as we ask for inputs as a candidate: what follows them is no host's word.
  void note_ends();
  Frame noted_end(int player) const { return noted_[player]; }

  /// Prepares to go on behind this host. Call it before its welcome is taken.
  void follow(const Welcome& next, std::uint32_t log_term);
  /// Prepares the streams to begin in the state `frame`.
  void begin_at(Frame frame);
  /// Call it once per turn. Tells the election when the log holds all that the host took over.
  void tend(Election& election);
  /// This host is lost before it told all: the inputs of the host before are ours again, for the next election.
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
