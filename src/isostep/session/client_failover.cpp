// A client without its host: it looks for the next one, supports it, or becomes it.
// SPDX-License-Identifier: MIT
#include <bit>

#include "isostep/session/client_core.hpp"
#include "isostep/session/host_core.hpp"

namespace isostep {
namespace {

constexpr Time kAttempt = kSecond;        // [us] for a candidate: two and a half round trips of the longest lines
constexpr Time kForOthers = kSecond / 4;  // [us] that who has a majority waits for the rest of it
constexpr Time kSearch = 10 * kSecond;    // [us] until nobody is left
constexpr Time kGreeting = 2 * kSecond;   // [us] from the connection to the hello, as at a host
constexpr Time kHold = kSecond * 3 / 10;  // [us] in which we should miss the host too, if it is gone

}  // namespace

ClientCore::ClientCore(PeerCore&& host, Retreat&& retreat, Time now)
    : PeerCore(std::move(host)),
      hang_ups_(std::move(retreat.guests)),
      token_(retreat.token),
      is_spoiled_(retreat.is_outvoted),
      lag_(lag_settings(config_)) {
  config_.host = false;
  failover_.roster = retreat.roster;
  failover_.callers.resize(static_cast<std::size_t>(config_.max_peers + config_.max_strangers));
  if (retreat.players == 0) {
    config_.mode = SessionMode::spectator;
  } else {
    player_ = std::countr_zero(retreat.players);
    own_ = retreat.players;
    is_open_ = true;
    opens_ = 0;
    for (int p = 0; p < players(); ++p) accepted_[p] = streams_[static_cast<std::size_t>(p)].end();
  }
  seek(now);
}

void ClientCore::seek(Time now) {
  failover_.seeks = true;
  failover_.since = now;
  failover_.attempt = 0;
  fail(SessionEvent::Kind::seeks_host, SessionPhase::seeking);
  begin_attempt(now);
}

void ClientCore::begin_attempt(Time now) {
  const int machine = failover_.candidate_at(failover_.attempt);
  const bool is_own = machine == own_machine();
  failover_.until = now + kAttempt;
  failover_.is_candidate = is_own && is_open_ && !is_outvoted(static_cast<std::size_t>(player_));
  for (int p = 0; p < players(); ++p) failover_.ends[p] = failover_.told[p] = final_end(p);
  failover_.elected_at = 0;
  failover_.must_support = failover_.must_tell_roster = false;
  failover_.must_connect = !is_own && machine >= 0;
  if (machine >= 0) failover_.target = failover_.roster.machines[machine].address;
  for (Caller& caller : failover_.callers) {
    caller.supports = false;
    caller.must_tell_roster = caller.must_ask = failover_.is_candidate && caller.machine >= 0;
  }
}

void ClientCore::seek_on(Time now) {
  if (now - failover_.since > kSearch) {
    failover_.seeks = failover_.is_candidate = failover_.must_connect = false;
    leave_host();
    fail(SessionEvent::Kind::lost_host, SessionPhase::lost);
    return;
  }
  if (failover_.is_candidate) {
    const Roster& roster = failover_.roster;
    std::uint64_t group = std::uint64_t{1} << own_machine(), all = 0;
    for (const Caller& caller : failover_.callers) {
      if (caller.is_connected && caller.supports) group |= std::uint64_t{1} << caller.machine;
    }
    for (int m = 0; m < roster.count; ++m) {
      if (roster.machines[m].is_in && m != roster.host) all |= std::uint64_t{1} << m;
    }
    if (!roster.is_majority(group)) failover_.elected_at = 0;
    else if (failover_.elected_at == 0) failover_.elected_at = now;
    const bool waits = (group & all) != all && now - failover_.elected_at < kForOthers;
    failover_.is_elected = failover_.elected_at != 0 && !waits;
    if (failover_.elected_at != 0) return;
  }
  // The others come later than who notices first.
  if (now < failover_.until + (failover_.is_candidate ? kAttempt / 2 : 0)) return;
  leave_host();
  ++failover_.attempt;
  begin_attempt(now);
}

void ClientCore::stop_seeking() {
  if (!failover_.seeks) return;
  failover_.seeks = failover_.is_candidate = failover_.must_connect = false;
  failover_.must_support = failover_.must_tell_roster = false;
  SessionEvent event{.kind = SessionEvent::Kind::new_host, .frame = welcome_.start.frame};
  if (welcome_.hosted != 0) event.player = static_cast<std::uint8_t>(std::countr_zero(welcome_.hosted));
  tell(event);
}

std::optional<Address> ClientCore::poll_connect() {
  if (!failover_.must_connect) return std::nullopt;
  failover_.must_connect = false;
  return failover_.target;
}

std::unique_ptr<SessionCore> ClientCore::succeed(Time now) {
  if (!failover_.seeks || !failover_.is_elected) return nullptr;
  forget_untold();
  Succession succession{failover_.roster, own_machine(), token_, std::move(failover_.callers)};
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
  caller = Caller{};
  caller.is_connected = true;
  caller.since = now;
  caller.messages.start(now);
}

void ClientCore::tend_callers(Time now) {
  for (std::size_t i = 0; i < failover_.callers.size(); ++i) {
    Caller& caller = failover_.callers[i];
    if (!caller.is_connected) continue;
    if (caller.hello.empty()) {
      if (now - caller.since <= kGreeting) continue;
      caller.is_connected = false;
      hang_up(static_cast<PeerId>(i));
      ++stats_.refused;
    } else if (runs_ && !failover_.seeks && now - caller.since > kHold) {
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
      caller->machine = failover_.roster.machine_of(hello.value().token);
      caller->must_tell_roster = caller->must_ask = failover_.is_candidate && caller->machine >= 0;
    }
  } else if (kind && failover_.is_candidate && caller->machine >= 0) {
    good = take_support(*caller, kind.value(), bytes);
  }
  if (!good) ++stats_.refused;
}

// --- what is said ---

bool ClientCore::take_failover(MessageKind kind, Bytes bytes, Time now) {
  if (kind == MessageKind::roster && (is_greeted_ || failover_.seeks)) {
    const Result<Roster> roster = read_roster(bytes);
    if (!roster) return false;
    if (!is_greeted_ && !is_sealed_for(roster.value(), token_, message_)) return false;
    const bool is_newer = roster.value().version > failover_.roster.version || (is_greeted_ && failover_.is_roster_old);
    if (is_newer) failover_.roster = roster.value();
    stats_.machines = failover_.roster.count_in();
    if (is_greeted_) failover_.is_roster_old = false;
    failover_.must_enroll = is_greeted_;
    return true;
  }
  if (kind == MessageKind::candidate && failover_.seeks) {
    const Result<Candidate> candidate = read_candidate(bytes);
    if (!candidate) return false;
    failover_.candidate = candidate.value();
    failover_.must_support = own_machine() >= 0;
    failover_.must_tell_roster = candidate.value().version < failover_.roster.version;
    return true;
  }
  if (kind != MessageKind::redirect || !failover_.seeks) return false;
  const Result<Address> address = read_redirect(bytes);
  if (!address) return false;
  leave_host();
  failover_.target = address.value();
  failover_.must_connect = !address.value().view().empty();
  failover_.until = now + kAttempt;
  return true;
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
  if (host_.is_connected && failover_.must_support) return next_for_candidate();
  return next_for_caller();
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
    if (end < stream.begin()) continue;  // it needs a snapshot, and cannot be the host for us
    const Frame left = (is_local(p) && owns_inputs() ? stream.end() : final_end(p)) - end,
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
  if (write_missing()) return written(host_.peer);
  failover_.must_support = false;
  write_support(failover_.roster.version, message_);
  return written(host_.peer);
}

std::optional<Outgoing> ClientCore::next_for_caller() {
  for (std::size_t i = 0; i < failover_.callers.size(); ++i) {
    Caller& caller = failover_.callers[i];
    if (!caller.is_connected) continue;
    if (caller.must_redirect) {
      caller.is_connected = false;
      hang_up(static_cast<PeerId>(i));
      write_redirect(failover_.roster.machines[failover_.roster.host].address, message_);
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
    candidate.version = failover_.roster.version;
    for (int p = 0; p < players(); ++p) candidate.ends[p] = final_end(p);
    write_candidate(candidate, message_);
    return written(static_cast<PeerId>(i));
  }
  return std::nullopt;
}

}  // namespace isostep
