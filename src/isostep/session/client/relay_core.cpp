// The relay: who comes to it, what it hears of its leaves, and when it puts one out.
// SPDX-License-Identifier: MIT
#include "isostep/session/client/relay_core.hpp"

namespace isostep {
namespace {

constexpr Time kTellLeaves = kSecond;         // [us] as the host
constexpr Time kBetweenStates = 5 * kSecond;  // [us] a snapshot costs us more than it costs to ask for one

}  // namespace

RelayCore::RelayCore(const SessionConfig& config, const InputRules& rules)
    : ClientCore(config, rules), leaves_(static_cast<std::size_t>(config.max_peers + config.max_strangers)) {
  for (std::size_t i = 0; i < leaves_.size(); ++i) leaves_[i].peer = static_cast<PeerId>(i);
}

RelayCore::Leaf* RelayCore::leaf_of(PeerId peer) {
  return peer < leaves_.size() && leaves_[peer].is_connected ? &leaves_[peer] : nullptr;
}

void RelayCore::clear(Leaf& leaf) {
  const PeerId peer = leaf.peer;
  leaf = Leaf{};
  leaf.peer = peer;
}

void RelayCore::connected(PeerId host, Time now) {
  if (Leaf* leaf = leaf_of(host)) clear(*leaf);
  ClientCore::connected(host, now);
}

void RelayCore::accepted(PeerId peer, Time now) {
  if (peer >= leaves_.size() || is_host(peer)) {
    ++stats_.refused;
    return;
  }
  clear(leaves_[peer]);
  leaves_[peer].connect(now);
}

void RelayCore::disconnected(PeerId peer, Time now) {
  if (Leaf* leaf = leaf_of(peer)) clear(*leaf);
  else ClientCore::disconnected(peer, now);
}

SnapshotProgress RelayCore::snapshot_progress(PeerId peer) const {
  const bool receives = peer < leaves_.size() && leaves_[peer].stage == Leaf::Stage::receives_snapshot;
  return receives ? leaves_[peer].transfer.progress() : ClientCore::snapshot_progress(peer);
}

SendEnds RelayCore::shown_ends() const {
  SendEnds ends;
  const Frame shown = config_.broadcast_delay == 0 ? kLastFrame : known_end(streams_) - config_.broadcast_delay;
  for (int p = 0; p < players(); ++p) {
    const Frame end = streams_[static_cast<std::size_t>(p)].end();
    ends.of[p] = shown < end ? shown : end;
  }
  return ends;
}

void RelayCore::receive(PeerId peer, Channel channel, Bytes bytes, Time now) {
  collect_snapshot();
  Leaf* leaf = leaf_of(peer);
  if (leaf == nullptr) {
    ClientCore::receive(peer, channel, bytes, now);
    return;
  }
  if (channel != Channel::datagram) {
    if (datagrams_.accept_message(*leaf, bytes, now)) take_message(*leaf, bytes, now);
    return;
  }
  Packet packet;
  if (!datagrams_.accept(*leaf, bytes, now, packet)) return;
  const bool is_in = leaf->stage == Leaf::Stage::live || leaf->stage == Leaf::Stage::receives_snapshot;
  if (!is_in || packet.header.match != leaf->match) {
    ++stats_.refused;
    return;
  }
  take_packet(*leaf, packet, now);
}

void RelayCore::take_packet(Leaf& leaf, const Packet& packet, Time now) {
  if (leaf.stage == Leaf::Stage::receives_snapshot) {  // datagrams only measure the line
    leaf.set_clock(packet.header, now);
    const auto trip = static_cast<std::uint16_t>(static_cast<std::uint16_t>(now / 1000) - packet.header.echo);
    if (packet.header.has_echo) leaf.transfer.measured(Time{trip} * 1000, now);
    return;
  }
  leaf.heard = now;
  leaf.has_spoken = true;
  datagrams_.take_header(leaf, packet.header, shown_ends(), is_after_pause(now), now);
  if (packet.slice_count > 0) ++stats_.refused;  // it has no player
}

void RelayCore::take_message(Leaf& leaf, Bytes bytes, Time now) {
  const MessageKind kind = message_kind(bytes).value();
  if (kind == MessageKind::hello && leaf.stage == Leaf::Stage::connected) {
    leaf.heard = now;
    greet(leaf, bytes);
    return;
  }
  if (kind == MessageKind::progress && leaf.stage == Leaf::Stage::receives_snapshot) {
    const Result<std::uint32_t> arrived = read_progress(bytes);
    if (arrived && leaf.transfer.has_arrived(arrived.value())) {
      leaf.heard = now;
      if (leaf.transfer.is_complete()) go_live(leaf);
      return;
    }
  }
  if (kind == MessageKind::resync && leaf.stage == Leaf::Stage::live && bytes.size() == 1) {
    leaf.wants_state = true;
    return;
  }
  if (kind == MessageKind::farewell) return;  // its connection ends
  ++stats_.refused;
}

void RelayCore::refuse_leaf(Leaf& leaf, std::string_view key, std::string_view theirs, std::string_view ours) {
  leaf.refusal = {ShortText<kReplayKeyCap>(key), ShortText<kReplayValueCap>(theirs), ShortText<kReplayValueCap>(ours)};
  leaf.stage = Leaf::Stage::refused;
  ++stats_.refused;
}

void RelayCore::greet(Leaf& leaf, Bytes message) {
  const Result<Hello> hello = read_hello(message);
  if (!hello) return refuse_leaf(leaf, hello.error().place.view(), "unreadable", hello.error().message.view());
  const HeaderMismatch mismatch = compare_headers(hello.value().identity, config_.identity);
  if (!mismatch.key.empty()) {
    return refuse_leaf(leaf, mismatch.key.view(), mismatch.in_file.view(), mismatch.here.view());
  }
  if (!hello.value().spectator) return refuse_leaf(leaf, "relay", "a player", "spectators only");
  int served = 0;
  for (const Leaf& other : leaves_) {
    served += other.stage != Leaf::Stage::connected && other.stage != Leaf::Stage::refused ? 1 : 0;
  }
  if (served >= config_.max_peers) return refuse_leaf(leaf, "spectators", "one more", "no room");
  leaf.have = hello.value().have;
  leaf.stage = Leaf::Stage::applies;
}

bool RelayCore::may_show() const {
  return is_settled_in() && hashes_.settled().frame <= known_end(streams_) - config_.broadcast_delay;
}

void RelayCore::let_in(Leaf& leaf) {
  const Frame have = leaf.have.frame;
  // A leaf may be ahead of us, of another relay: it is compared once we are there.
  const bool is_ahead = have > hashes_.settled().frame && have <= known_end(streams_);
  bool has_inputs = is_ahead || (hashes_.has_chain(have) && hashes_.chain(have) == leaf.have.chain);
  has_inputs = has_inputs && current() - have <= config_.most_replayed;
  for (const InputStream& stream : streams_) has_inputs = has_inputs && stream.begin() <= have;
  leaf.match = match();
  leaf.must_welcome = true;
  leaf.stage = Leaf::Stage::needs_snapshot;
  if (!has_inputs) return;
  leaf.start = leaf.have;
  go_live(leaf);
}

void RelayCore::go_live(Leaf& leaf) {
  leaf.stage = Leaf::Stage::live;
  for (int p = 0; p < players(); ++p) leaf.acked[p] = leaf.burst_end[p] = leaf.start.frame;
  leaf.had_all_at = leaf.heard;
  leaf.acked_at = leaf.more_at = 0;
  leaf.has_spoken = leaf.has_more = false;
}

void RelayCore::ask_for_state(Leaf& leaf) {
  leaf.stage = Leaf::Stage::needs_snapshot;
  leaf.must_welcome = true;
  leaf.wants_state = false;
  const SendEnds sent = shown_ends();
  for (int p = 0; p < players(); ++p) {
    if (sent.of[p] > leaf.state_from) leaf.state_from = sent.of[p];
  }
}

void RelayCore::before_steps(Time now) {
  collect_snapshot();
  ClientCore::before_steps(now);
  const bool tells = now >= figures_at_;
  if (tells) figures_at_ = now + kTellLeaves;
  for (Leaf& leaf : leaves_) {
    if (!leaf.is_connected) continue;
    ++stats_.peers;
    tend(leaf, now);
    if (tells && leaf.stage == Leaf::Stage::live) leaf.figures_left = acknowledges(leaf, now) ? players() : 0;
  }
}

void RelayCore::tend(Leaf& leaf, Time now) {
  using LeafStage = Leaf::Stage;
  if (leaf.stage == LeafStage::applies || leaf.stage == LeafStage::needs_snapshot) leaf.heard = now;  // it waits for us
  if (now - leaf.heard > config_.silence) leaf.must_close = true;
  if (!is_settled_in()) return;
  if (leaf.stage == LeafStage::applies) let_in(leaf);
  if (leaf.stage != LeafStage::live && leaf.stage != LeafStage::receives_snapshot &&
      leaf.stage != LeafStage::needs_snapshot)
    return;
  if (leaf.match != match()) leaf.must_close = true;  // we serve another match now: it greets again
  bool lags = false;                                  // inputs that it lacks have fallen out of the log
  for (int p = 0; p < players(); ++p) {
    const Frame lacks = leaf.stage == LeafStage::live ? leaf.acked[p] : leaf.start.frame;
    lags = lags || lacks < streams_[static_cast<std::size_t>(p)].begin();
  }
  if (leaf.stage == LeafStage::needs_snapshot) return;
  if (leaf.stage == LeafStage::receives_snapshot) {
    leaf.must_close = leaf.must_close || lags;
    return;
  }
  if (lags || (leaf.wants_state && now >= leaf.state_at)) {
    leaf.state_at = now + kBetweenStates;
    ask_for_state(leaf);
    return;
  }
  const bool lacks = lacks_inputs(leaf);
  if (!lacks) leaf.had_all_at = now;
  const Time last = leaf.acked_at > leaf.had_all_at ? leaf.acked_at : leaf.had_all_at;
  if (!lacks || now - last <= config_.silence) return;
  ++stats_.put_out;
  leaf.must_close = true;
}

}  // namespace isostep
