// Machines that connect to a client because they have lost the host.
// SPDX-License-Identifier: MIT
#include "isostep/session/client_callers.hpp"

namespace isostep {
namespace {
constexpr Time kHold = kSecond * 3 / 10;  // [us] in which we should miss the host too, if it is gone
}  // namespace

bool Callers::accept(PeerId peer, Time now) {
  if (peer >= all_.size()) {
    partings_.hang_up(peer);
    return false;
  }
  Caller& caller = all_[peer];
  went(caller);
  caller = Caller{};
  caller.is_connected = true;
  caller.since = now;
  caller.messages.start(now);
  return true;
}

void Callers::went(Caller& caller) {
  caller.is_connected = false;
  if (caller.voter >= 0) election_.went(caller.voter);
  caller.voter = -1;
}

bool Callers::take_hello(Caller& caller, Bytes bytes) {
  const Result<Hello> hello = read_hello(bytes);
  if (!hello) return false;
  caller.hello.assign(bytes.begin(), bytes.end());
  recognise(caller, hello.value());
  return true;
}

void Callers::recognise(Caller& caller, const Hello& hello) {
  caller.machine = roster_.machine_of(hello.token);
  caller.voter = roster_.voter_of(hello.token, hello.life);
  election_.hear_term(hello.term);
  if (caller.voter >= 0) election_.came(caller.voter);
  else if (caller.machine >= 0 && hello.life == 0) election_.is_over(caller.machine);
  const bool is_asked = election_.has_called() && caller.machine >= 0;
  caller.due.set(MessageKind::roster, is_asked);
  caller.due.set(MessageKind::candidate, is_asked);
}

void Callers::has_new_roster() {
  for (Caller& caller : all_) {
    if (caller.is_connected && !caller.hello.empty()) recognise(caller, read_hello(caller.hello).value());
  }
}

void Callers::ask_all() {
  for (Caller& caller : all_) {
    const bool is_asked = caller.is_connected && caller.machine >= 0;
    caller.due.set(MessageKind::roster, is_asked);
    caller.due.set(MessageKind::candidate, is_asked);
  }
}

void Callers::send_on(const Caller& from, const Address& to) {
  better_ = to;
  for (Caller& caller : all_) caller.due.set(MessageKind::redirect, caller.is_connected && &caller != &from);
}

std::uint64_t Callers::tend(bool has_host, Time now) {
  std::uint64_t silent = 0;
  for (std::size_t i = 0; i < all_.size(); ++i) {
    Caller& caller = all_[i];
    if (!caller.is_connected) continue;
    if (caller.hello.empty() && now - caller.since > kGreeting) {
      went(caller);
      partings_.hang_up(static_cast<PeerId>(i));
      ++silent;
    } else if (!caller.hello.empty() && has_host && now - caller.since > kHold) {
      caller.due.add(MessageKind::redirect);
    }
  }
  return silent;
}

std::optional<PeerId> Callers::write_next(const FollowerLog& log, std::vector<std::uint8_t>& message) {
  for (std::size_t i = 0; i < all_.size(); ++i) {
    Caller& caller = all_[i];
    if (!caller.is_connected || caller.due.is_empty()) continue;
    const auto peer = static_cast<PeerId>(i);
    if (caller.due.take(MessageKind::redirect)) {
      went(caller);
      partings_.hang_up(peer);
      write_redirect(election_.is_under_way() ? better_ : roster_.machines[roster_.host].address, message);
    } else if (caller.due.take(MessageKind::roster)) {
      write_roster(roster_, message);
    } else if (caller.due.take(MessageKind::candidate)) {
      write_call(log, message);
    }
    return peer;
  }
  return std::nullopt;
}

void Callers::write_call(const FollowerLog& log, std::vector<std::uint8_t>& message) const {
  Candidate candidate;
  candidate.term = election_.term();
  candidate.log_term = election_.log_term();
  candidate.roster_term = roster_.term;
  candidate.version = roster_.version;
  log.copy_ends(candidate.ends);
  write_candidate(candidate, message);
}

std::uint32_t Callers::players_of_supporters() const {
  std::uint32_t players = 0;
  for (const Caller& caller : all_) {
    if (!caller.is_connected || !election_.has_won_with(caller.voter)) continue;
    players |= roster_.machines[caller.machine].players;
  }
  return players;
}

}  // namespace isostep
