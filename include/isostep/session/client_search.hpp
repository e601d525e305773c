// HostSearch: a client without its host looks for the next one, or is it.
// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "isostep/session/failover.hpp"

namespace isostep {

/// In: rosters, that the host is lost, and where others send us. Out: where to connect to, and what the Election says.
/// Keeps: the roster and who we are in it, the election, and the address that is next.
class HostSearch {
 public:
  explicit HostSearch(std::uint64_t token) : token_(token) {}
  explicit HostSearch(const Retreat& retreat);

  const Roster& roster() const { return roster_; }
  Election& election() { return election_; }
  const Election& election() const { return election_; }
  std::uint64_t token() const { return token_; }
  /// Of our process, as the host numbered it; 0: it knows no host yet.
  std::uint64_t life() const { return life_; }
  /// Our place in the roster, as a voter.
  int own_machine() const { return roster_.voter_of(token_, life_); }
  bool is_under_way() const { return election_.is_under_way(); }
  bool is_elected() const { return is_under_way() && is_elected_; }
  /// The roster names somebody to ask.
  bool can_begin() const { return election_.target(roster_, own_machine()) >= 0; }

  /// `knocks`: the host spoke until now, and may live.
  void begin(Time now, bool knocks);
  Election::Step turn(bool may_stand, Time now);
  /// The machine that is to be asked now.
  void ask_next();
  /// We ask there next; an empty address is nobody's.
  void go_to(const Address& address, Time now);
  /// Each address once.
  std::optional<Address> poll_connect();
  void end();

  /// False: it is none that we did not have; true: all places are others.
  bool take_newer(const Roster& roster);
  void is_welcome(const Welcome& welcome);
  Succession hand_over(std::vector<Caller>&& callers);

 private:
  Roster roster_;
  Election election_;
  std::uint64_t token_ = 0, life_ = 0;
  bool is_elected_ = false;
  std::optional<Address> next_;
};

}  // namespace isostep
