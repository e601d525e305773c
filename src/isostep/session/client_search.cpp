// A client without its host looks for the next one.
// SPDX-License-Identifier: MIT
#include "isostep/session/client_search.hpp"

namespace isostep {

HostSearch::HostSearch(const Retreat& retreat)
    : roster_(retreat.roster), election_(retreat.election), token_(retreat.token), life_(retreat.life) {
  for (int m = 0; m < retreat.roster.count; ++m) {
    if ((retreat.over >> m & 1) != 0) election_.is_over(m);
  }
}

void HostSearch::begin(Time now, bool knocks) {
  election_.begin(now, knocks && !roster_.machines[roster_.host].address.view().empty());
  is_elected_ = false;
}

Election::Step HostSearch::turn(bool may_stand, Time now) {
  const Election::Step step = election_.turn(roster_, own_machine(), may_stand, now);
  if (step == Election::Step::wins) is_elected_ = true;
  if (step == Election::Step::gives_up) next_.reset();
  return step;
}

void HostSearch::ask_next() {
  const int machine = election_.target(roster_, own_machine());
  next_.reset();
  if (machine >= 0 && machine != own_machine()) next_ = roster_.machines[machine].address;
}

void HostSearch::go_to(const Address& address, Time now) {
  next_.reset();
  if (!address.view().empty()) next_ = address;
  election_.was_sent_on(now);
}

std::optional<Address> HostSearch::poll_connect() {
  const std::optional<Address> address = next_;
  next_.reset();
  return address;
}

void HostSearch::end() {
  election_.end();
  next_.reset();
}

bool HostSearch::take_newer(const Roster& roster) {
  if (!roster.is_newer_than(roster_)) return false;
  roster_ = roster;
  election_.has_new_roster();
  return true;
}

void HostSearch::is_welcome(const Welcome& welcome) {
  token_ = welcome.token;
  life_ = welcome.life;
  election_.follow(welcome.term);
}

Succession HostSearch::hand_over(std::vector<Caller>&& callers) {
  return {roster_, own_machine(), token_, life_, election_, std::move(callers)};
}

}  // namespace isostep
