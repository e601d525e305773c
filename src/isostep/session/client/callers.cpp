// Machines that connect to a client because they have lost the host.
// SPDX-License-Identifier: MIT
#include "isostep/session/client/callers.hpp"

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
  const int voter = caller.voter;
  caller.is_connected = false;
  caller.voter = -1;
  if (voter < 0) return;
  for (const Caller& other : all_) {
    if (other.is_connected && other.voter == voter) return;  // it has come again
  }
  election_.went(voter);
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
  if (caller.voter >= 0) {
    election_.hear_term(hello.term);
    election_.came(caller.voter);
  } else if (caller.machine >= 0 && hello.life == 0) {
    election_.is_over(caller.machine);
  }
  const bool is_asked = election_.has_called() && caller.machine >= 0;
  caller.due.set(MessageKind::roster, is_asked);
  caller.due.set(MessageKind::candidate, is_asked);
}

void Callers::has_new_roster() {
  for (Caller& caller : all_) {
    if (caller.is_connected && !caller.hello.empty()) recognise(caller, read_hello(caller.hello).value());
  }
}

void Callers::call() {
  log_.note_ends();
  log_.copy_ends(told_);
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

std::optional<PeerId> Callers::write_next(std::vector<std::uint8_t>& message) {
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
      write_call(message);
    }
    return peer;
  }
  return std::nullopt;
}

void Callers::write_call(std::vector<std::uint8_t>& message) const {
  Candidate candidate;
  candidate.term = election_.term();
  candidate.log_term = election_.log_term();
  candidate.roster_term = roster_.term;
  candidate.version = roster_.version;
  log_.copy_ends(candidate.ends);
  write_candidate(candidate, message);
}

bool Callers::take_known(const Caller& caller, const InputSlice& slice, Frame most) {
  if (slice.player >= streams_.size()) return false;
  InputStream& stream = streams_[slice.player];
  if (slice.first > stream.end()) return true;  // what is missing before it did not arrive: see Supporter
  const bool is_own = own_.is_open() && own_.has(slice.player);
  const bool is_its = owns_inputs() && (roster_.machines[caller.machine].players >> slice.player & 1) != 0;
  Frame& told = told_[slice.player];
  SliceReader reader(slice);
  InputEntry entry;
  for (Frame frame = slice.first; reader.next(entry); ++frame) {
    if (frame >= most || (!entry.absent && !rules_.valid(entry.bytes))) return false;
    // Others know better than we where the host went on without us.
    const bool is_next = is_own && own_.is_open() && frame == own_.accepted(slice.player);
    if (is_next && (!owns_inputs() || entry.absent)) own_.take(slice.player, entry);
    if (is_own && own_.is_open()) continue;
    if (frame == stream.end()) {
      stream.append(entry);
    } else if (is_its && frame >= log_.noted_end(slice.player) && stream.contains(frame)) {
      stream.replace(frame, entry);
      timeline_.recheck(slice.player, frame);
    }
    if (is_its && frame >= told) told = frame + 1;
  }
  return !reader.failed();
}

bool Callers::take_support(const Caller& caller, const Support& support) {
  for (std::size_t p = 0; p < streams_.size(); ++p) {
    if (streams_[p].end() < support.ends[p]) return false;
  }
  if (caller.voter >= 0) election_.supported(caller.voter, support.term);
  return true;
}

void Callers::forget_untold() {
  if (!owns_inputs()) return;
  for (const Caller& caller : all_) {
    if (!caller.is_connected || !election_.has_won_with(caller.voter)) continue;
    for (std::size_t p = 0; p < streams_.size(); ++p) {
      const bool is_its = (roster_.machines[caller.machine].players >> p & 1) != 0;
      if (!is_its || streams_[p].end() <= told_[p]) continue;
      streams_[p].truncate(told_[p]);
      timeline_.recheck(static_cast<int>(p), told_[p]);
    }
  }
}

}  // namespace isostep
