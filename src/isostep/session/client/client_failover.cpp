// A client without its host: it looks for the next one, supports it, or becomes it.
// SPDX-License-Identifier: MIT
#include "isostep/session/client/client_core.hpp"
#include "isostep/session/peer/succession.hpp"

namespace isostep {

std::unique_ptr<SessionCore> become_client(PeerCore&& host, Retreat&& retreat, Time now) {
  return std::make_unique<ClientCore>(std::move(host), std::move(retreat), now);
}

ClientCore::ClientCore(PeerCore&& host, Retreat&& retreat, Time now)
    : PeerCore(std::move(host)),
      partings_(std::move(retreat.guests)),
      entry_(arrival_, retreat.is_outvoted),
      search_(retreat) {
  config_.host = false;
  callers_.make_room(static_cast<std::size_t>(config_.max_peers + config_.max_strangers));
  if (retreat.players == 0) {
    config_.mode = SessionMode::spectator;
  } else {
    own_.sit(retreat.players);
    for (int p = 0; p < players(); ++p) own_.accept_until(p, streams_[static_cast<std::size_t>(p)].end());
    own_.go_on_from(0);
  }
  log_.is_final_until(hashes_.settled().frame);
  seek(now, false);
}

bool ClientCore::may_stand() const {
  const bool has_state = has_start_ && !entry_.is_under_way() && !entry_.is_spoiled();
  return own_.first() >= 0 && has_state && !views_.is_outvoted(static_cast<std::size_t>(own_.first()));
}

void ClientCore::seek(Time now, bool knocks) {
  search_.begin(now, knocks);
  log_.take_back_former();
  fail(SessionEvent::Kind::seeks_host, SessionPhase::seeking);
  ask_next();
}

void ClientCore::ask_next() {
  supporter_.answer_nothing();
  search_.ask_next();
}

void ClientCore::seek_on(Time now) {
  // The game sent us to a machine that is no host and does not become one: it is to find another.
  const bool has_given_up = search_.election().has_given_up();
  if (has_given_up && host_.is_connected && now - host_.heard > Callers::kGreeting) {
    leave_host();
    fail(SessionEvent::Kind::lost_host, SessionPhase::lost);
  }
  switch (search_.turn(may_stand(), now)) {
    case Election::Step::waits:
    case Election::Step::wins: return;
    case Election::Step::goes_on:
      leave_host();
      ask_next();
      return;
    case Election::Step::calls:
      leave_host();
      callers_.call();
      return;
    case Election::Step::gives_up:
      leave_host();
      fail(SessionEvent::Kind::lost_host, SessionPhase::lost);
      return;
  }
}

void ClientCore::stop_seeking() {
  if (!search_.is_under_way()) return;
  search_.end();
  supporter_.answer_nothing();
  SessionEvent event{.kind = SessionEvent::Kind::new_host, .frame = entry_.welcome().start.frame};
  if (hosted() != 0) event.player = static_cast<std::uint8_t>(first_of(hosted()));
  tell(event);
}

bool ClientCore::go_on(Time now) {
  const bool is_member = config_.migration > 0 && search_.own_machine() >= 0 && may_stand();
  if (!is_member || (host_.is_connected && is_greeted())) return false;
  if (!search_.is_under_way()) {
    search_.begin(now, false);
    log_.take_back_former();
  }
  search_.election().force();
  return true;
}

std::unique_ptr<SessionCore> ClientCore::succeed(Time now) {
  if (!search_.is_elected()) return nullptr;
  callers_.forget_untold();
  Succession succession = search_.hand_over(callers_.hand_over());
  return become_host(std::move(*this), std::move(succession), now);
}

void ClientCore::go_to(const Address& address, Time now) {
  leave_host();
  search_.go_to(address, now);
}

// --- who connects to us ---

void ClientCore::accepted(PeerId peer, Time now) {
  if (!callers_.accept(peer, now)) ++stats_.refused;
}

void ClientCore::take_call(PeerId peer, Channel channel, Bytes bytes, Time now) {
  Caller* const caller = callers_.find(peer);
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
    good = callers_.take_hello(*caller, bytes);
  } else if (kind && kind.value() == MessageKind::farewell) {
    good = bytes.size() == 1;  // its connection ends
  } else if (kind && search_.election().has_called() && caller->machine >= 0) {
    good = take_support(*caller, kind.value(), bytes, now);
  }
  if (!good) ++stats_.refused;
}

bool ClientCore::take_support(Caller& caller, MessageKind kind, Bytes bytes, Time now) {
  if (kind == MessageKind::known) {
    const Result<Packet> packet = read_known(bytes);
    if (!packet) return false;
    // A host steps no frame without its inputs, and clients are ahead of it by their delay and guesses; it has lived
    // without us for as long as we waited.
    const Frame waited = static_cast<Frame>(config_.migration / clock_.period());
    const Frame most = present() + waited + 2 * config_.most_delay + config_.window;
    bool is_good = true;
    for (std::uint8_t i = 0; i < packet.value().slice_count; ++i) {
      is_good = callers_.take_known(caller, packet.value().slices[i], most) && is_good;
    }
    return is_good;
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
  if (!roster || !roster.value().is_newer_than(search_.roster())) return roster.ok();
  if (!is_sealed_for(roster.value(), token(), message_)) {
    // This machine does not support us, whether its roster is true or not.
    if (caller.voter >= 0) search_.election().went(caller.voter);
    return false;
  }
  if (search_.take_newer(roster.value())) callers_.has_new_roster();
  return true;
}

// --- what the host says, or who would follow it ---

bool ClientCore::take_failover(MessageKind kind, Bytes bytes, Time now) {
  const bool seeks = search_.is_under_way();
  if (kind == MessageKind::roster && (is_greeted() || seeks)) {
    const Result<Roster> roster = read_roster(bytes);
    if (!roster || (!is_greeted() && !is_sealed_for(roster.value(), token(), message_))) return false;
    if (search_.take_newer(roster.value())) callers_.has_new_roster();
    stats_.machines = search_.roster().count_in();
    due_.set(MessageKind::enrolled, is_greeted());
    return true;
  }
  if (kind == MessageKind::farewell && is_greeted() && bytes.size() == 1) {
    leave_host();
    lose(now, false);
    return true;
  }
  if (kind == MessageKind::candidate && seeks) {
    const Result<Candidate> candidate = read_candidate(bytes);
    if (!candidate) return false;
    supporter_.take(candidate.value(), search_.own_machine() >= 0, may_stand() && !config_.address.view().empty());
    return true;
  }
  if (kind != MessageKind::redirect || !seeks) return false;
  const Result<Address> address = read_redirect(bytes);
  if (!address) return false;
  go_to(address.value(), now);
  return true;
}

}  // namespace isostep
