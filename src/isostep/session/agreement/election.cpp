// An election: whom to ask, when to call for support, and when it is won.
// SPDX-License-Identifier: MIT
#include "isostep/session/agreement/election.hpp"

#include <bit>

namespace isostep {
namespace {

constexpr Time kAttempt = kSecond;        // [us] for a candidate: two and a half round trips of the longest lines
constexpr Time kForOthers = kSecond / 4;  // [us] that who has a majority waits for the rest of it
constexpr Time kSearch = 10 * kSecond;    // [us] until nobody is left
constexpr Time kBrokenOff = kSecond / 4;  // [us] until the next attempt, when a candidate ends the connection
constexpr Time kKnock = kSecond * 3 / 4;  // [us] for a host that lives to take us back: a round trip of long lines

}  // namespace

void Election::begin(Time now, bool knocks) {
  end();
  is_under_way_ = true;
  knocks_ = knocks;
  since_ = now;
  until_ = now + (knocks ? kKnock : kAttempt);
}

void Election::end() {
  is_under_way_ = has_given_up_ = is_forced_ = knocks_ = false;
  attempt_ = 0;
  supports_ = 0;
  withdraw();
}

void Election::was_turned_away(Time now) {
  if (is_under_way_ && until_ > now + kBrokenOff) until_ = now + kBrokenOff;
}

void Election::was_sent_on(Time now) {
  until_ = now + kAttempt;
  withdraw();
}

void Election::has_new_roster() {
  came_ = over_ = supports_ = 0;
  withdraw();
}

bool Election::is_eligible(const Roster& roster, int machine) {
  const Roster::Machine& its = roster.machines[machine];
  return machine != roster.host && its.is_in && its.players != 0 && !its.address.view().empty();
}

int Election::target(const Roster& roster, int own) const {
  if (knocks_) return roster.host;
  std::uint32_t count = 0;
  for (int m = 0; m < roster.count; ++m) count += is_eligible(roster, m) ? 1 : 0;
  const bool asks_host =
      own == roster.host || (roster.count > 0 && !roster.machines[roster.host].address.view().empty());
  const std::uint32_t all = count + (asks_host ? 1 : 0);
  if (all == 0) return -1;
  std::uint32_t n = attempt_ % all;
  if (n == count) return roster.host;
  for (int m = 0;; ++m) {
    if (is_eligible(roster, m) && n-- == 0) return m;
  }
}

Election::Step Election::turn(const Roster& roster, int own, bool may_stand, Time now) {
  if (!is_under_way_) return Step::waits;
  const std::uint64_t here = bit(own) | came_;
  // One of two machines has the casting vote and made frames final alone: the other never goes on without it.
  const std::uint64_t over = own == roster.casting || std::popcount(roster.voters()) > 2 ? over_ : 0;
  if (called_ == 0) {
    const bool is_quorum = may_stand && own >= 0 && (is_forced_ || roster.is_quorum(here, over));
    if (!is_quorum) {
      quorum_at_ = 0;
      return go_on(roster, own, now);
    }
    if (quorum_at_ == 0) quorum_at_ = now;
    const std::uint64_t all = roster.voters() & ~(over_ | (std::uint64_t{1} << roster.host));
    if ((here & all) != all && now - quorum_at_ < kForOthers) return Step::waits;
    called_ = promised_ = (promised_ > heard_ ? promised_ : heard_) + 1;
    called_at_ = now;
    supports_ = bit(own);
    return Step::calls;
  }
  if (!may_stand || own < 0) {
    called_ = 0;
    return go_on(roster, own, now);
  }
  const bool have_all = (came_ & ~supports_) == 0 || now - called_at_ >= kForOthers;
  if ((is_forced_ || roster.is_quorum(supports_, over)) && have_all) {
    won_with_ = supports_;
    return Step::wins;
  }
  if (now - called_at_ < kAttempt) return Step::waits;
  withdraw();
  return go_on(roster, own, now);
}

Election::Step Election::go_on(const Roster& roster, int own, Time now) {
  if (has_given_up_) return Step::waits;
  if (now - since_ > kSearch) {
    has_given_up_ = true;
    return Step::gives_up;
  }
  // The others come later than who notices first.
  const Time more = target(roster, own) == own ? kAttempt / 2 : 0;
  if (now < until_ + more) return Step::waits;
  if (knocks_) knocks_ = false;
  else ++attempt_;
  until_ = now + kAttempt;
  return Step::goes_on;
}

bool Election::give_support(const Candidate& candidate) {
  if (candidate.term <= promised_ || !can_be(candidate.term) || candidate.log_term < log_term_) return false;
  promised_ = candidate.term;
  supports_ = 0;  // given for an earlier term
  withdraw();
  return true;
}

}  // namespace isostep
