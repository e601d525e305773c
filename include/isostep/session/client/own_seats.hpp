// OwnSeats: the players of a client's machine, and how far the host has accepted their inputs.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/session/peer/peer_link.hpp"
#include "isostep/session/timeline/player_set.hpp"
#include "isostep/session/timeline/timeline.hpp"

namespace isostep {

/// In: what the host says of our seats and inputs, and which machines have our states. Out: our streams, as the host
/// counts them, and whether our players may play. Keeps: which seats are ours, whether they are open, the first input
/// of each that the host lacks, and since when we have caught up.
class OwnSeats {
 public:
  OwnSeats(std::vector<InputStream>& streams, Timeline& timeline, PeerLink& host)
      : streams_(streams), timeline_(timeline), host_(host) {}

  /// Takes the seats of these players, a bit each, who come and go together. They do not play yet.
  void sit(std::uint32_t players) {
    players_ = players;
    stage_ = Stage::closed;
  }
  std::uint32_t players() const { return players_; }
  bool has(int player) const {
    return player >= 0 && player < static_cast<int>(kMaxPlayers) && (players_ >> player & 1) != 0;
  }
  /// The first of our players; -1: a spectator.
  int first() const { return first_of(players_); }
  bool is_open() const { return stage_ == Stage::open; }
  bool is_closed() const { return stage_ == Stage::closed; }
  /// begin_at: we step anew from here. is_repaired_at: a repair goes on from here, in the same match.
  void begin_at(Frame base) {
    base_ = base;
    near_since_ = 0;
  }
  void is_repaired_at(Frame base) { base_ = base; }
  /// The state with which our part of the match began.
  Frame base() const { return base_; }
  void is_near(Time now) { near_since_ = near_since_ == 0 ? now : near_since_; }
  /// Returns true if enough machines have our states. Machines, a bit each: `agreeing` have had them since base(),
  /// `differing` differ. `with_host`: players who share a machine with the host.
  bool are_vouched_for(std::uint64_t agreeing, std::uint64_t differing, std::uint32_t with_host, Time now) const;
  /// Asks the host to let us play. This holds until it answers, or the connection is another.
  void ask() { stage_ = Stage::asked; }
  void stop_asking() {
    if (stage_ == Stage::asked) stage_ = Stage::closed;
  }
  /// The frame from which on our players play.
  Frame opens() const { return opens_; }
  /// Opens our seats from `first` on. Returns false if that cannot be; `most`: [frames] beyond known inputs.
  bool open(Frame first, Frame most);
  /// Opens our seats from a frame that we have reached already.
  void go_on_from(Frame first);

  Frame accepted(int player) const { return accepted_[player]; }
  void accept_until(int player, Frame end) { accepted_[player] = end; }
  void hear_acks();
  /// Takes what the host counts as our player's first input that is not accepted: our own, or the guess if ours came
  /// too late.
  void take(int player, const InputEntry& entry);
  /// Limits `most` to states that depend on accepted inputs alone.
  Frame limit(Frame most) const;

 private:
  /// The host went on without us: cuts the inputs that it has not accepted, and closes the seats.
  void cut_out();

  enum class Stage : std::uint8_t { closed, asked, open };

  std::vector<InputStream>& streams_;
  Timeline& timeline_;
  PeerLink& host_;
  std::uint32_t players_ = 0;
  Stage stage_ = Stage::closed;
  Frame opens_ = kNoFrame, base_ = 0;
  Time near_since_ = 0;  // [us] when we first had nearly caught up; 0: not yet
  Frame accepted_[kMaxPlayers] = {};
};

}  // namespace isostep
