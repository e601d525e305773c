// The search for the next host: turns, what others say, and what they are told.
// SPDX-License-Identifier: MIT
#include "isostep/session/client/failover.hpp"

namespace isostep {

void Failover::begin(Time now, bool knocks) {
  search_.begin(now, knocks);
  log_.take_back_former();
  client_.fail(SessionEvent::Kind::seeks_host, SessionPhase::seeking);
  search_.ask_next();
}

void Failover::tend(bool may_stand, Time now) {
  client_.stats.refused += callers_.tend(client_.standing == Standing::runs && !search_.is_under_way(), now);
  if (!search_.is_under_way()) return;
  // The game sent us to a machine that is no host and does not become one: it is to find another.
  const bool has_given_up = search_.election().has_given_up();
  if (has_given_up && client_.host.is_connected && now - client_.host.heard > Callers::kGreeting) {
    leave_host();
    client_.fail(SessionEvent::Kind::lost_host, SessionPhase::lost);
  }
  switch (search_.turn(may_stand, now)) {
    case Election::Step::waits:
    case Election::Step::wins: return;
    case Election::Step::goes_on:
      leave_host();
      search_.ask_next();
      return;
    case Election::Step::calls:
      leave_host();
      callers_.call();
      return;
    case Election::Step::gives_up:
      leave_host();
      client_.fail(SessionEvent::Kind::lost_host, SessionPhase::lost);
      return;
  }
}

void Failover::end() {
  if (!search_.is_under_way()) return;
  search_.end();
  supporter_.answer_nothing();
  SessionEvent event{.kind = SessionEvent::Kind::new_host, .frame = client_.entry.welcome().start.frame};
  const std::uint32_t hosted = client_.entry.welcome().hosted;
  if (hosted != 0) event.player = static_cast<std::uint8_t>(first_of(hosted));
  client_.events.tell(event);
}

bool Failover::go_on(bool may_stand, Time now) {
  const bool is_member = client_.config.migration > 0 && search_.own_machine() >= 0 && may_stand;
  if (client_.config.seed == 0) return false;  // anybody could compute the tokens that it gives out
  if (!is_member || (client_.host.is_connected && client_.is_greeted())) return false;
  if (!search_.is_under_way()) {
    search_.begin(now, false);
    log_.take_back_former();
  }
  search_.election().force();
  return true;
}

void Failover::go_to(const Address& address, Time now) {
  leave_host();
  search_.go_to(address, now);
}

void Failover::receive_call(PeerId peer, Channel channel, Bytes bytes, Time now) {
  Caller* const caller = callers_.find(peer);
  if (caller == nullptr || channel != Channel::reliable) {
    ++client_.stats.refused;
    return;
  }
  client_.stats.bytes_in += bytes.size();
  if (!caller->messages.spend(client_.config.most_packets, now)) {
    ++client_.stats.flooded;
    return;
  }
  const Result<MessageKind> kind = message_kind(bytes);
  bool good = false;
  if (kind && kind.value() == MessageKind::hello && caller->hello.empty()) {
    good = callers_.take_hello(*caller, bytes);
  } else if (kind && kind.value() == MessageKind::farewell) {
    good = bytes.size() == 1;  // its connection ends
  } else if (kind && search_.election().has_called() && caller->machine >= 0) {
    good = take_support(*caller, kind.value(), bytes, now);
  }
  if (!good) ++client_.stats.refused;
}

bool Failover::take_support(Caller& caller, MessageKind kind, Bytes bytes, Time now) {
  if (kind == MessageKind::known) {
    const Result<Packet> packet = read_known(bytes);
    return packet && take_known(caller, packet.value());
  }
  if (kind == MessageKind::support) {
    const Result<Support> support = read_support(bytes);
    return support && callers_.take_support(caller, support.value());
  }
  if (kind == MessageKind::redirect) {
    const Result<Address> address = read_redirect(bytes);
    if (!address || address.value().view().empty()) return false;
    // Its log is of a later host than ours: we go there, and so do who asked us.
    callers_.send_on(caller, address.value());
    go_to(address.value(), now);
    return true;
  }
  if (kind != MessageKind::roster) return false;
  // A newer one: whose place is where, and what a majority is, may be otherwise there.
  const Result<Roster> roster = read_roster(bytes);
  if (!roster || !roster.value().is_of(client_.config.players)) return false;
  if (!roster.value().is_newer_than(search_.roster())) return true;
  if (!is_sealed_for(roster.value(), search_.token(), scratch_)) {
    // This machine does not support us, whether its roster is true or not.
    if (caller.voter >= 0) search_.election().went(caller.voter);
    return false;
  }
  if (search_.take_newer(roster.value())) callers_.has_new_roster();
  return true;
}

bool Failover::take_known(const Caller& caller, const Packet& packet) {
  // A host steps no frame without its inputs, and clients are ahead of it by their delay and guesses; it has lived
  // without us for as long as we waited.
  const Frame waited = static_cast<Frame>(client_.config.migration / client_.clock.period());
  const Frame most = client_.present() + waited + 2 * client_.config.most_delay + client_.config.window;
  bool is_good = true;
  for (std::uint8_t i = 0; i < packet.slice_count; ++i) {
    is_good = callers_.take_known(caller, packet.slices[i], most) && is_good;
  }
  return is_good;
}

bool Failover::receive(MessageKind kind, Bytes bytes, bool may_stand, Time now) {
  const bool seeks = search_.is_under_way();
  if (kind == MessageKind::roster && (client_.is_greeted() || seeks)) {
    const Result<Roster> roster = read_roster(bytes);
    if (!roster || !roster.value().is_of(client_.config.players)) return false;
    if (!client_.is_greeted() && !is_sealed_for(roster.value(), search_.token(), scratch_)) return false;
    if (search_.take_newer(roster.value())) callers_.has_new_roster();
    client_.stats.machines = search_.roster().count_in();
    must_enroll_ = client_.is_greeted();
    return true;
  }
  if (kind == MessageKind::candidate && seeks) {
    const Result<Candidate> candidate = read_candidate(bytes);
    if (!candidate) return false;
    supporter_.take(candidate.value(), search_.own_machine() >= 0, may_stand && !client_.config.address.view().empty());
    return true;
  }
  if (kind != MessageKind::redirect || !seeks) return false;
  const Result<Address> address = read_redirect(bytes);
  if (!address) return false;
  go_to(address.value(), now);
  return true;
}

std::optional<PeerId> Failover::write_next(std::vector<std::uint8_t>& message) {
  const PeerLink& host = client_.host;
  if (host.is_connected && client_.is_greeted() && must_enroll_) {
    must_enroll_ = false;
    write_enrolled(search_.roster().version, message);
    return host.peer;
  }
  const bool is_asked = host.is_connected;
  if (is_asked && supporter_.write_next(client_.config.address, client_.timeline.current(), message)) return host.peer;
  return callers_.write_next(message);
}

}  // namespace isostep
