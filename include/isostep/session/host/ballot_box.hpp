// BallotBox: the host's part in a vote: it is opened, counted and ended here.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/session/agreement/ballot.hpp"
#include "isostep/session/host/seats.hpp"

namespace isostep {

/// In: proposals, votes and time. Out: what they do to the ballot. On `changed` the caller tells its game, and carries
/// out what has passed.
class BallotBox {
 public:
  enum class Effect : std::uint8_t { refused, same, changed };

  BallotBox(const SessionConfig& config, const Seats& seats, Ballot& ballot)
      : config_(config), seats_(seats), ballot_(ballot) {}
  Effect open(int player, const Proposal& proposal, Time now);
  /// Counts the votes of a machine with these players, a bit each.
  Effect count(const Votes& votes, std::uint32_t players, Time now);
  /// Removes voters who are gone, and ends a vote after its time.
  Effect tend(Time now);
  /// Returns true, once, if all must be told how the vote stands.
  bool must_tell(Time now);

 private:
  Effect changed(Time now);

  const SessionConfig& config_;
  const Seats& seats_;
  Ballot& ballot_;
  bool is_told_ = true;
  Time told_at_ = 0;                       // [us]
  Time until_ = 0;                         // [us]
  std::uint32_t ballots_ = 0;              // how many there were
  Time may_propose_at_[kMaxPlayers] = {};  // [us]
};

}  // namespace isostep
