// The client on its way into the match: the connection, the host's answer, snapshots, the seat.
// SPDX-License-Identifier: MIT
#include <bit>
#include <cstring>

#include "isostep/session/client_core.hpp"

namespace isostep {

namespace {

constexpr Frame kBeforeBlock = 2;  // [frames] of a rollback window that are kept free of lateness that is usual
// By what we run later our own inputs come later, and our delay grows by as much. Beyond a third of what it may grow
// by, the others are asked to wait as well, so that a very bad line does not use up all delay there is.
constexpr Frame kLagShare = 3;
/// [us] for the other machines to vouch for our states: some reports of each, with losses on the longest lines.
constexpr Time kVouching = 5 * kSecond;

}  // namespace

InputDelay::Settings ClientCore::lag_settings(const SessionConfig& config) {
  const Frame most = (config.most_delay - config.least_delay) / kLagShare;
  const bool rolls_back = config.mode == SessionMode::rollback && config.window > kBeforeBlock;
  return {.start = 0, .least = 0, .most = most, .wanted_slack = rolls_back ? kBeforeBlock - config.window : 0};
}

ClientCore::ClientCore(const SessionConfig& config, const InputRules& rules)
    : PeerCore(config, rules), token_(config.token), lag_(lag_settings(config)) {
  if (config.migration > 0) failover_.callers.resize(static_cast<std::size_t>(config.max_peers + config.max_strangers));
}

void ClientCore::connected(PeerId host, Time now) {
  if (host_.is_connected && host_.peer != host) leave_host();  // of two that were asked for, the later
  host_ = PeerLink{};
  host_.peer = host;
  host_.connect(now);
  must_greet_ = true;
  must_ask_ = must_propose_ = false;
  votes_ = Votes{};
  end_ballot();
  forget_announced();
  is_greeted_ = must_ready_ = asked_ready_ = false;
  repair_ = Repair{};
  inquired_ = kNoFrame;
  runs_ = is_restoring_ = must_begin_ = false;  // the greeting names the state that we go on from
  if (phase_ == SessionPhase::lost || phase_ == SessionPhase::refused) phase_ = SessionPhase::waiting;
}

void ClientCore::disconnected(PeerId peer, Time now) {
  if (peer < failover_.callers.size()) went(failover_.callers[peer]);
  if (!host_.is_connected || peer != host_.peer) return;
  host_.is_connected = false;
  lose(now, now - host_.heard <= config_.migration / 2);
}

void ClientCore::leave_host() {
  // A host is told that we do not leave the match: it would count on us as one of those who did. So is a candidate that
  // we may have made the host.
  if (host_.is_connected && (is_greeted_ || failover_.seeks())) farewells_.push_back(host_.peer);
  else if (host_.is_connected) hang_up(host_.peer);
  host_.is_connected = false;
}

void ClientCore::lose(Time now, bool knocks) {
  leave_host();
  runs_ = false;
  const bool seeks = failover_.seeks() && !failover_.election.has_given_up();
  if (seeks) failover_.election.was_turned_away(now);
  if (phase_ == SessionPhase::refused || seeks) return;
  if (can_fail_over()) seek(now, knocks);
  else fail(SessionEvent::Kind::lost_host, SessionPhase::lost);
}

void ClientCore::fail(SessionEvent::Kind kind, SessionPhase phase) {
  phase_ = phase;
  tell_of(kind);
}

void ClientCore::receive(PeerId host, Channel channel, Bytes bytes, Time now) {
  if (!host_.is_connected || host != host_.peer) {
    take_call(host, channel, bytes, now);
    return;
  }
  if (channel == Channel::datagram) {
    Packet packet;
    if (!accept_datagram(host_, bytes, now, packet)) return;
    if (!is_greeted_ || packet.header.match != welcome_.match) {
      ++stats_.refused;
      return;
    }
    host_.heard = now;
    if (is_restoring_) host_.set_clock(packet.header, now);
    if (!is_restoring_ && !must_begin_) take_packet(packet, now);
    return;
  }
  // A snapshot's pieces come as fast as the transport brings them.
  const Result<MessageKind> kind = message_kind(bytes);
  if (kind && kind.value() == MessageKind::piece) {
    stats_.bytes_in += bytes.size();
  } else if (!accept_message(host_, bytes, now)) {
    return;
  }
  take_message(kind.value(), bytes, now);
}

void ClientCore::take_message(MessageKind kind, Bytes bytes, Time now) {
  bool good = false;
  if (kind == MessageKind::welcome) {
    if (const Result<Welcome> welcome = read_welcome(bytes)) {
      good = true;
      take_welcome(welcome.value(), now);
    }
  } else if (kind == MessageKind::refuse) {
    if (const Result<Refusal> refusal = read_refusal(bytes)) {
      good = true;
      SessionEvent event{.kind = SessionEvent::Kind::refused};
      event.field = refusal.value();
      tell(event);
      phase_ = SessionPhase::refused;
      runs_ = is_greeted_ = false;
      failover_.election.end();
    }
  } else if (kind == MessageKind::piece && (is_restoring_ || repair_.stage == Repair::Stage::receives)) {
    if (const Result<Piece> piece = read_piece(bytes)) {
      good = true;
      take_piece(piece.value());
    }
  } else if (kind == MessageKind::open && is_greeted_ && player_ >= 0) {
    if (const Result<Frame> first = read_open(bytes)) {
      good = true;
      if (is_restoring_ || must_begin_) {
        opened_ = first.value();  // once we are there
      } else {
        open(first.value());
      }
    }
  }
  if (kind == MessageKind::ballot && is_greeted_) {
    if (const Result<Ballot> ballot = read_ballot(bytes)) {
      good = true;
      ballot_ = ballot.value();
      tell_ballot();
    }
  }
  if (!good) good = take_failover(kind, bytes, now) || take_repair(kind, bytes);
  if (good) {
    host_.heard = now;
  } else {
    ++stats_.refused;
  }
}

void ClientCore::take_welcome(const Welcome& welcome, Time now) {
  // Without a snapshot we go on from the state that our greeting named, and from no other: others may be gone.
  const HashReport have = hashes_.settled();
  const bool has_start = welcome.start.frame == have.frame && welcome.start.chain == have.chain && !is_spoiled_;
  // Pieces go on where those end that we have, or begin anew.
  const bool goes_on = welcome.snapshot_from == portable_.size() && welcome.start.frame == partial_.frame &&
                       welcome.start.chain == partial_.chain;
  const bool fits = (welcome.snapshot_from == 0 || goes_on) && welcome.players == players() &&
                    welcome.snapshot_size <= config_.snapshot_cap &&
                    std::popcount(welcome.seated()) == (config_.mode == SessionMode::spectator ? 0 : seats_wished());
  if (welcome.term != 0 && !failover_.election.may_follow(welcome.term)) {
    // We support another, or did: whoever is the host of an earlier term learns by our hello that it is over.
    leave_host();
    lose(now, false);
    return;
  }
  if (!fits || (welcome.snapshot_size == 0 && !has_start)) {
    runs_ = is_greeted_ = is_restoring_ = must_begin_ = false;
    failover_.election.end();
    leave_host();
    fail(SessionEvent::Kind::refused, SessionPhase::refused);
    return;
  }
  // A machine that is the host again, in a later term, says other things than in the one before.
  const bool is_same_host = welcome.match == welcome_.match && welcome.term == welcome_.term;
  keeps_inputs_ = is_same_host && welcome.snapshot_size == 0 && !former_.are_back();
  // We know how many of our own inputs were accepted as long as our seats are open.
  if (failover_.election.log_term() != 0 && !keeps_inputs_ && !former_.are_kept()) {
    Frame ends[kMaxPlayers] = {};
    for (int p = 0; p < players(); ++p) ends[p] = failover_.has_asked && !is_own(p) ? failover_.ends[p] : final_end(p);
    former_.keep(streams_, ends);
  }
  welcome_ = welcome;
  is_greeted_ = true;
  runs_ = is_open_ = asked_ready_ = must_ready_ = false;
  repair_ = Repair{};
  player_ = welcome.player == 0xff ? -1 : welcome.player;
  own_ = welcome.seated();
  token_ = welcome.token;
  failover_.life = welcome.life;
  failover_.election.follow(welcome.term);
  told_final_ = welcome.term == 0 ? kLastFrame + 1 : welcome.start.frame;
  opened_ = kNoFrame;
  stop_seeking();
  phase_ = SessionPhase::joining;
  told_ = welcome.snapshot_from;
  is_restoring_ = welcome.snapshot_size > 0;
  must_begin_ = told_ == welcome.snapshot_size;
  partial_ = is_restoring_ ? welcome.start : HashReport{};
  if (told_ == 0) portable_.clear();
}

void ClientCore::take_piece(const Piece& piece) {
  // Memory grows with what has come, not with what was promised.
  if (piece.offset != portable_.size() || piece.bytes.size() > welcome_.snapshot_size - portable_.size()) {
    ++stats_.refused;
    return;
  }
  portable_.insert(portable_.end(), piece.bytes.begin(), piece.bytes.end());
  must_begin_ = is_restoring_ && portable_.size() == welcome_.snapshot_size;
}

void ClientCore::restored(bool ok) {
  if (ok) return;
  is_restoring_ = runs_ = is_greeted_ = false;
  repair_ = Repair{};
  is_spoiled_ = true;
  leave_host();
  partial_ = HashReport{};
  fail(SessionEvent::Kind::bad_snapshot, SessionPhase::refused);
}

void ClientCore::hash_known(Frame state, std::uint64_t hash) {
  if (is_restoring_ && has_start_ && state == welcome_.start.frame) {
    if (hash != welcome_.hash) {
      restored(false);
      return;
    }
    is_restoring_ = is_spoiled_ = false;
    partial_ = HashReport{};
    hashes_.restart(welcome_.start, hash);
    confirmed_state_ = state;
    return;
  }
  if (repair_.stage == Repair::Stage::restores && state == repair_.offer.start.frame) {
    finish_repair(hash);
    return;
  }
  if (!is_spoiled_) PeerCore::hash_known(state, hash);
}

void ClientCore::begin_at(const HashReport& start) {
  const Frame frame = start.frame;
  if (is_restoring_) {
    act(RequestKind::restore, frame);
    timeline_.restart(frame);
    act(RequestKind::save, frame);
  } else {
    go_back(frame);
  }
  base_ = frame;
  near_since_ = 0;
  for (int p = 0; p < players(); ++p) {
    InputStream& stream = streams_[static_cast<std::size_t>(p)];
    // Behind a new host our own inputs stay what they were, from the first that it lacks on.
    const bool is_kept = is_own(p) && !is_restoring_ && stream.begin() <= frame && welcome_.opens != kNoFrame &&
                         stream.end() >= welcome_.opens;
    if (failover_.has_asked && !is_own(p)) stream.truncate(failover_.ends[p]);
    const bool stays = keeps_inputs_ && stream.contains(frame) && (!is_own(p) || accepted_[p] > frame);
    if (stays && is_own(p) && !is_kept) stream.truncate(accepted_[p]);
    if (!stays && !is_kept) stream.reset(frame);
    accepted_[p] = stays && !is_kept ? stream.end() : frame;
  }
  failover_.has_asked = false;
  for (std::size_t machine = 0; machine < kMachines; ++machine) was_repaired(machine, kNoFrame);
  clock_.forget_lean();
  lag_ = InputDelay(lag_settings(config_));
  is_far_ = knows_way_ = false;
  if (opened_ != kNoFrame) open(opened_);
  if (welcome_.opens == kNoFrame) return;
  // What was ours before is told to us, and compared: see take_own.
  is_open_ = true;
  opens_ = welcome_.opens;
  for (int p = 0; p < players(); ++p) {
    if (is_own(p)) host_.acked[p] = accepted_[p];
  }
}

void ClientCore::open(Frame first) {
  asked_ready_ = false;  // where the host has closed the seats again before this came, we ask once more
  bool is_next = !is_open_;
  for (int p = 0; p < players(); ++p) {
    const Frame end = streams_[static_cast<std::size_t>(p)].end();
    is_next = is_next && (!is_own(p) || (first >= end && first <= end + config_.history / 2));
  }
  if (!is_next) {
    ++stats_.refused;
    return;
  }
  for (int p = 0; p < players(); ++p) {
    if (!is_own(p)) continue;
    streams_[static_cast<std::size_t>(p)].append_absent_until(first);
    accepted_[p] = host_.acked[p] = first;
  }
  is_open_ = true;
  opens_ = first;
}

bool ClientCore::is_vouched_for(Time now) const {
  // Until the host says that nobody plays for us, inputs of ours from before are still on their way.
  for (int p = 0; p < players(); ++p) {
    const InputStream& stream = streams_[static_cast<std::size_t>(p)];
    if (is_own(p) && (stream.end() == stream.begin() || !stream.last().absent)) return false;
  }
  const auto agrees = [&](std::size_t machine) {
    return !views_[machine].differs() && views_[machine].agreed >= base_ ? 1 : 0;
  };
  int needed = 1, agreeing = agrees(kHostMachine), differing = views_[kHostMachine].differs() ? 1 : 0;
  for (int p = 0; p < players(); ++p) {
    if (((welcome_.hosted | own_) >> p & 1) != 0) continue;
    if (!streams_[static_cast<std::size_t>(p)].last().absent) needed = 2;
    agreeing += agrees(static_cast<std::size_t>(p));
    differing += views_[p].differs() ? 1 : 0;
  }
  if (agreeing >= needed && agreeing > differing) return true;
  // Who says nothing, or what is not so, does not keep us out for ever: then the host's word alone counts.
  return near_since_ != 0 && now - near_since_ > kVouching && agrees(kHostMachine) > 0;
}

}  // namespace isostep
