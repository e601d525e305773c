// A client without its host: it looks for the next one, supports it, or becomes it.
// SPDX-License-Identifier: MIT
#include <bit>

#include "isostep/session/client_core.hpp"
#include "isostep/session/host_core.hpp"

namespace isostep {
namespace {

constexpr Time kGreeting = 2 * kSecond;   // [us] from the connection to the hello, as at a host
constexpr Time kHold = kSecond * 3 / 10;  // [us] in which we should miss the host too, if it is gone

}  // namespace

ClientCore::ClientCore(PeerCore&& host, Retreat&& retreat, Time now)
    : PeerCore(std::move(host)),
      farewells_(std::move(retreat.guests)),
      token_(retreat.token),
      is_spoiled_(retreat.is_outvoted),
      lag_(lag_settings(config_)) {
  config_.host = false;
  failover_.roster = retreat.roster;
  failover_.election = retreat.election;
  failover_.life = retreat.life;
  failover_.callers.resize(static_cast<std::size_t>(config_.max_peers + config_.max_strangers));
  for (int m = 0; m < retreat.roster.count; ++m) {
    if ((retreat.over >> m & 1) != 0) failover_.election.is_over(m);
  }
  if (retreat.players == 0) {
    config_.mode = SessionMode::spectator;
  } else {
    player_ = std::countr_zero(retreat.players);
    own_ = retreat.players;
    is_open_ = true;
    opens_ = 0;
    for (int p = 0; p < players(); ++p) accepted_[p] = streams_[static_cast<std::size_t>(p)].end();
  }
  told_final_ = hashes_.settled().frame;
  seek(now, false);
}

int ClientCore::own_machine() const { return failover_.roster.voter_of(token_, failover_.life); }

bool ClientCore::may_stand() const {
  const bool has_state = has_start_ && !is_restoring_ && !must_begin_ && !is_spoiled_;
  return player_ >= 0 && has_state && !is_outvoted(static_cast<std::size_t>(player_));
}

void ClientCore::seek(Time now, bool knocks) {
  failover_.election.begin(now, knocks && !failover_.roster.machines[failover_.roster.host].address.view().empty());
  failover_.is_elected = false;
  take_back_former();
  fail(SessionEvent::Kind::seeks_host, SessionPhase::seeking);
  begin_attempt();
}

void ClientCore::begin_attempt() {
  const int machine = failover_.election.target(failover_.roster, own_machine());
  failover_.answer_nothing();
  failover_.must_connect = machine != own_machine() && machine >= 0;
  if (machine >= 0) failover_.target = failover_.roster.machines[machine].address;
}

void ClientCore::seek_on(Time now) {
  // The game sent us to a machine that is no host and does not become one: it is to find another.
  const bool is_stuck = failover_.election.has_given_up() && host_.is_connected && now - host_.heard > kGreeting;
  if (is_stuck) {
    leave_host();
    fail(SessionEvent::Kind::lost_host, SessionPhase::lost);
  }
  switch (failover_.election.turn(failover_.roster, own_machine(), may_stand(), now)) {
    case Election::Step::waits: return;
    case Election::Step::goes_on:
      leave_host();
      begin_attempt();
      return;
    case Election::Step::calls:
      leave_host();
      failover_.has_asked = true;
      for (int p = 0; p < players(); ++p) failover_.ends[p] = failover_.told[p] = final_end(p);
      for (Caller& caller : failover_.callers) {
        caller.must_tell_roster = caller.must_ask = caller.is_connected && caller.machine >= 0;
      }
      return;
    case Election::Step::wins: failover_.is_elected = true; return;
    case Election::Step::gives_up:
      failover_.must_connect = false;
      leave_host();
      fail(SessionEvent::Kind::lost_host, SessionPhase::lost);
      return;
  }
}

void ClientCore::stop_seeking() {
  if (!failover_.seeks()) return;
  failover_.election.end();
  failover_.must_connect = false;
  failover_.answer_nothing();
  SessionEvent event{.kind = SessionEvent::Kind::new_host, .frame = welcome_.start.frame};
  if (welcome_.hosted != 0) event.player = static_cast<std::uint8_t>(std::countr_zero(welcome_.hosted));
  tell(event);
}

bool ClientCore::go_on(Time now) {
  const bool is_member = config_.migration > 0 && own_machine() >= 0 && may_stand();
  if (host_.is_connected && is_greeted_) return false;
  if (!is_member) return false;
  if (!failover_.seeks()) {
    failover_.election.begin(now, false);
    take_back_former();
  }
  failover_.election.force();
  return true;
}

std::optional<Address> ClientCore::poll_connect() {
  if (!failover_.must_connect) return std::nullopt;
  failover_.must_connect = false;
  return failover_.target;
}

std::unique_ptr<SessionCore> ClientCore::succeed(Time now) {
  if (!failover_.seeks() || !failover_.is_elected) return nullptr;
  forget_untold();
  Succession succession{failover_.roster, own_machine(),      token_,
                        failover_.life,   failover_.election, std::move(failover_.callers)};
  return std::make_unique<HostCore>(std::move(*this), std::move(succession), now);
}

// --- who connects to us ---

void ClientCore::accepted(PeerId peer, Time now) {
  if (peer >= failover_.callers.size()) {
    hang_up(peer);
    ++stats_.refused;
    return;
  }
  Caller& caller = failover_.callers[peer];
  went(caller);
  caller = Caller{};
  caller.is_connected = true;
  caller.since = now;
  caller.messages.start(now);
}

void ClientCore::went(Caller& caller) {
  caller.is_connected = false;
  if (caller.voter >= 0) failover_.election.went(caller.voter);
  caller.voter = -1;
}

void ClientCore::recognise(Caller& caller, const Hello& hello) {
  Election& election = failover_.election;
  caller.machine = failover_.roster.machine_of(hello.token);
  caller.voter = failover_.roster.voter_of(hello.token, hello.life);
  election.hear_term(hello.term);
  if (caller.voter >= 0) election.came(caller.voter);
  else if (caller.machine >= 0 && hello.life == 0) election.is_over(caller.machine);
  caller.must_tell_roster = caller.must_ask = election.has_called() && caller.machine >= 0;
}

void ClientCore::has_new_roster() {
  failover_.election.has_new_roster();
  for (Caller& caller : failover_.callers) {
    if (!caller.is_connected || caller.hello.empty()) continue;
    recognise(caller, read_hello(caller.hello).value());
  }
}

void ClientCore::tend_callers(Time now) {
  for (std::size_t i = 0; i < failover_.callers.size(); ++i) {
    Caller& caller = failover_.callers[i];
    if (!caller.is_connected) continue;
    if (caller.hello.empty()) {
      if (now - caller.since <= kGreeting) continue;
      went(caller);
      hang_up(static_cast<PeerId>(i));
      ++stats_.refused;
    } else if (runs_ && !failover_.seeks() && now - caller.since > kHold) {
      caller.must_redirect = true;
    }
  }
}

void ClientCore::take_call(PeerId peer, Channel channel, Bytes bytes, Time now) {
  const bool is_caller = peer < failover_.callers.size() && failover_.callers[peer].is_connected;
  Caller* caller = is_caller ? &failover_.callers[peer] : nullptr;
  if (caller == nullptr || channel != Channel::reliable) {
    ++stats_.refused;
    return;
  }
  stats_.bytes_in += bytes.size();
  if (!caller->messages.spend(config_.most_packets, now)) {
    ++stats_.flooded;
    return;
  }
  const Result<MessageKind> kind = message_kind(bytes);
  bool good = false;
  if (kind && kind.value() == MessageKind::hello && caller->hello.empty()) {
    if (const Result<Hello> hello = read_hello(bytes)) {
      good = true;
      caller->hello.assign(bytes.begin(), bytes.end());
      recognise(*caller, hello.value());
    }
  } else if (kind && kind.value() == MessageKind::farewell) {
    good = bytes.size() == 1;  // its connection ends
  } else if (kind && failover_.election.has_called() && caller->machine >= 0) {
    good = take_support(*caller, kind.value(), bytes, now);
  }
  if (!good) ++stats_.refused;
}

// --- what is said ---

bool ClientCore::take_failover(MessageKind kind, Bytes bytes, Time now) {
  const bool seeks = failover_.seeks();
  if (kind == MessageKind::roster && (is_greeted_ || seeks)) {
    const Result<Roster> roster = read_roster(bytes);
    if (!roster) return false;
    if (!is_greeted_ && !is_sealed_for(roster.value(), token_, message_)) return false;
    if (roster.value().is_newer_than(failover_.roster)) {
      failover_.roster = roster.value();
      has_new_roster();
    }
    stats_.machines = failover_.roster.count_in();
    failover_.must_enroll = is_greeted_;
    return true;
  }
  if (kind == MessageKind::farewell && is_greeted_ && bytes.size() == 1) {
    leave_host();
    lose(now, false);
    return true;
  }
  if (kind == MessageKind::candidate && seeks) {
    const Result<Candidate> candidate = read_candidate(bytes);
    if (!candidate) return false;
    Roster theirs;
    theirs.term = candidate.value().roster_term;
    theirs.version = candidate.value().version;
    failover_.candidate = candidate.value();
    failover_.must_tell_roster = failover_.roster.is_newer_than(theirs);
    failover_.must_call_here = own_machine() >= 0 && may_stand() && !config_.address.view().empty() &&
                               candidate.value().log_term < failover_.election.log_term();
    failover_.must_support = !failover_.must_tell_roster && own_machine() >= 0 && can_complete(candidate.value()) &&
                             failover_.election.give_support(candidate.value());
    return true;
  }
  if (kind != MessageKind::redirect || !seeks) return false;
  const Result<Address> address = read_redirect(bytes);
  if (!address) return false;
  go_to(address.value(), now);
  return true;
}

void ClientCore::go_to(const Address& address, Time now) {
  leave_host();
  failover_.target = address;
  failover_.must_connect = !address.view().empty();
  failover_.election.was_sent_on(now);
}

std::optional<Outgoing> ClientCore::written(PeerId to) {
  stats_.bytes_out += message_.size();
  return Outgoing{to, Channel::reliable, message_};
}

std::optional<Outgoing> ClientCore::next_failover_message() {
  if (host_.is_connected && is_greeted_ && failover_.must_enroll) {
    failover_.must_enroll = false;
    write_enrolled(failover_.roster.version, message_);
    return written(host_.peer);
  }
  const bool answers = failover_.must_support || failover_.must_tell_roster || failover_.must_call_here;
  if (host_.is_connected && answers) return next_for_candidate();
  return next_for_caller();
}

bool ClientCore::can_complete(const Candidate& candidate) const {
  for (int p = 0; p < players(); ++p) {
    const bool lacks = candidate.ends[p] < final_end(p);
    if (lacks && candidate.ends[p] < streams_[static_cast<std::size_t>(p)].begin()) return false;
  }
  return true;
}

bool ClientCore::write_missing() {
  PacketHeader header;
  header.frame = current();
  std::uint8_t buffer[kDatagramCap];
  PacketWriter writer(header, buffer);
  Frame added = 0;
  for (int p = 0; p < players(); ++p) {
    const InputStream& stream = streams_[static_cast<std::size_t>(p)];
    Frame& end = failover_.candidate.ends[p];
    const Frame left = (is_told_by_us(p) && owns_inputs() ? stream.end() : final_end(p)) - end,
                most = left < kSliceFrames ? left : kSliceFrames;
    if (most <= 0) continue;
    const Frame count = writer.add_slice(static_cast<std::uint8_t>(p), stream, end, most);
    end += count;
    added += count;
  }
  if (added > 0) write_known(writer.bytes(), message_);
  return added > 0;
}

std::optional<Outgoing> ClientCore::next_for_candidate() {
  if (failover_.must_tell_roster) {
    failover_.must_tell_roster = false;
    write_roster(failover_.roster, message_);
    return written(host_.peer);
  }
  if (failover_.must_call_here) {
    failover_.must_call_here = false;
    write_redirect(config_.address, message_);
    return written(host_.peer);
  }
  if (write_missing()) return written(host_.peer);
  failover_.must_support = false;
  Support support;
  support.term = failover_.candidate.term;
  for (int p = 0; p < players(); ++p) support.ends[p] = final_end(p);
  write_support(support, message_);
  return written(host_.peer);
}

std::optional<Outgoing> ClientCore::next_for_caller() {
  for (std::size_t i = 0; i < failover_.callers.size(); ++i) {
    Caller& caller = failover_.callers[i];
    if (!caller.is_connected) continue;
    if (caller.must_redirect) {
      went(caller);
      hang_up(static_cast<PeerId>(i));
      const Roster::Machine& host = failover_.roster.machines[failover_.roster.host];
      write_redirect(failover_.seeks() ? failover_.better : host.address, message_);
      return written(static_cast<PeerId>(i));
    }
    if (caller.must_tell_roster) {
      caller.must_tell_roster = false;
      write_roster(failover_.roster, message_);
      return written(static_cast<PeerId>(i));
    }
    if (!caller.must_ask) continue;
    caller.must_ask = false;
    Candidate candidate;
    candidate.term = failover_.election.term();
    candidate.log_term = failover_.election.log_term();
    candidate.roster_term = failover_.roster.term;
    candidate.version = failover_.roster.version;
    for (int p = 0; p < players(); ++p) candidate.ends[p] = final_end(p);
    write_candidate(candidate, message_);
    return written(static_cast<PeerId>(i));
  }
  return std::nullopt;
}

}  // namespace isostep
