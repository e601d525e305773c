// Votes as events.
// SPDX-License-Identifier: MIT
#include "isostep/session/peer/events.hpp"

namespace isostep {

SessionEvent event_of(const Ballot& ballot, Frame current) {
  using Kind = SessionEvent::Kind;
  const bool is_open = ballot.outcome == Ballot::Outcome::open;
  const bool has_passed = ballot.outcome == Ballot::Outcome::passed;
  SessionEvent event{.kind = is_open ? Kind::vote : has_passed ? Kind::vote_passed : Kind::vote_failed};
  event.player = ballot.by;
  event.frame = current;
  event.ballot = ballot;
  return event;
}

void end_ballot(Ballot& ballot, Frame current, EventQueue& events) {
  const bool was_open = ballot.is_open();
  ballot.outcome = Ballot::Outcome::failed;
  if (was_open) events.tell(event_of(ballot, current));
  ballot = Ballot{};
}

}  // namespace isostep
