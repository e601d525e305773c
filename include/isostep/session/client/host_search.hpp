// HostSearch: a client without its host looks for the next one, or is it.
// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "isostep/session/agreement/failover.hpp"

namespace isostep {

/// In: rosters, the loss of the host, and redirects. Out: the address to connect to, and the Election's steps. Keeps:
/// the roster and who we are in it, the election, and the next address.
class HostSearch {
 public:
  explicit HostSearch(std::uint64_t token) : token_(token) {}
  explicit HostSearch(const Retreat& retreat)
      : roster_(retreat.roster), election_(retreat.election), token_(retreat.token), life_(retreat.life) {
    for (int m = 0; m < roster_.count; ++m) {
      if ((retreat.over >> m & 1) != 0) election_.is_over(m);
    }
  }

  const Roster& roster() const { return roster_; }
  Election& election() { return election_; }
  const Election& election() const { return election_; }
  std::uint64_t token() const { return token_; }
  /// The host's number of our process; 0: we know no host yet.
  std::uint64_t life() const { return life_; }
  /// Our index in the roster, as a voter; -1: we have no vote.
  int own_machine() const { return roster_.voter_of(token_, life_); }
  bool is_under_way() const { return election_.is_under_way(); }
  bool is_elected() const { return is_under_way() && is_elected_; }
  /// Returns true if the roster names a machine to ask.
  bool can_begin() const { return election_.target(roster_, own_machine()) >= 0; }

  /// `knocks`: the host was heard until now, and may live.
  void begin(Time now, bool knocks) {
    election_.begin(now, knocks && !roster_.machines[roster_.host].address.view().empty());
    is_elected_ = false;
  }
  Election::Step turn(bool may_stand, Time now) {
    const Election::Step step = election_.turn(roster_, own_machine(), may_stand, now);
    if (step == Election::Step::wins) is_elected_ = true;
    if (step == Election::Step::gives_up) next_.reset();
    return step;
  }
  /// Makes the machine that is asked now the next to connect to.
  void ask_next() {
    const int machine = election_.target(roster_, own_machine());
    next_.reset();
    if (machine >= 0 && machine != own_machine()) next_ = roster_.machines[machine].address;
  }
  /// Makes this address the next to connect to; if it is empty there is none.
  void go_to(const Address& address, Time now) {
    next_.reset();
    if (!address.view().empty()) next_ = address;
    election_.was_sent_on(now);
  }
  /// Returns each address once.
  std::optional<Address> poll_connect() {
    const std::optional<Address> address = next_;
    next_.reset();
    return address;
  }
  void end() {
    election_.end();
    next_.reset();
  }
  /// Takes a newer roster, in which all indices may differ. Returns false if we have it, or a newer one.
  bool take_newer(const Roster& roster) {
    if (!roster.is_newer_than(roster_)) return false;
    roster_ = roster;
    is_elected_ = false;  // by places of the former
    election_.has_new_roster();
    return true;
  }
  void is_welcome(const Welcome& welcome) {
    token_ = welcome.token;
    life_ = welcome.life;
    election_.follow(welcome.term);
  }
  Succession hand_over(std::vector<Caller>&& callers) {
    return {roster_, own_machine(), token_, life_, election_, std::move(callers)};
  }

 private:
  Roster roster_;
  Election election_;
  std::uint64_t token_ = 0, life_ = 0;
  bool is_elected_ = false;
  std::optional<Address> next_;
};

}  // namespace isostep
