// What a relay sends its leaves: messages, snapshots for who comes late, datagrams.
// SPDX-License-Identifier: MIT
#include "isostep/session/client/relay_core.hpp"

namespace isostep {
namespace {

constexpr Time kStalled = kSecond / 2;       // [us] without anything new acknowledged: then less is sent,
constexpr Time kStalledEvery = kSecond / 6;  // a datagram of 1200 bytes at most; and
constexpr Time kProbeEvery = kSecond / 4;    // a frame, to who has acknowledged nothing yet

}  // namespace

void RelayCore::collect_snapshot() {
  if (!is_captured_ || awaits_capture()) return;
  is_captured_ = false;
  snapshot_bytes_.swap(portable_);
  portable_.clear();
}

void RelayCore::capture_lost() {
  is_captured_ = false;
  for (Leaf& leaf : leaves_) {
    const bool waits = leaf.stage == Leaf::Stage::receives_snapshot && leaf.start.frame == snapshot_.frame;
    if (waits) leaf.stage = Leaf::Stage::needs_snapshot;
  }
  snapshot_ = HashReport{};
}

bool RelayCore::may_share_snapshot() const {
  if (snapshot_.frame == kNoFrame) return false;
  const Frame age = hashes_.settled().frame - snapshot_.frame;
  // One of this second serves everybody: who comes again and again costs no more than that.
  if (age >= 0 && age <= config_.hz) return true;
  bool in_use = false;
  for (const Leaf& leaf : leaves_) in_use = in_use || leaf.stage == Leaf::Stage::receives_snapshot;
  return in_use && age >= 0 && age <= config_.history / 4;
}

void RelayCore::serve_snapshots() {
  if (!may_show()) return;
  const auto waits = [&](const Leaf& leaf) {
    return leaf.stage == Leaf::Stage::needs_snapshot && leaf.state_from <= hashes_.settled().frame;
  };
  bool can_share = may_share_snapshot(), in_use = false, needs_newer = false;
  for (const Leaf& leaf : leaves_) {
    in_use = in_use || leaf.stage == Leaf::Stage::receives_snapshot;
    needs_newer = needs_newer || (waits(leaf) && (!can_share || leaf.state_from > snapshot_.frame));
  }
  if (needs_newer && !in_use) {
    can_share = true;
    snapshot_ = hashes_.settled();
    snapshot_hash_ = hashes_.hash(snapshot_.frame);
    is_captured_ = true;
    act(RequestKind::capture, snapshot_.frame);
  }
  for (Leaf& leaf : leaves_) {
    if (!can_share || !waits(leaf) || leaf.state_from > snapshot_.frame) continue;
    leaf.stage = Leaf::Stage::receives_snapshot;
    leaf.start = snapshot_;
    leaf.transfer = SnapshotTransfer{};
  }
}

bool RelayCore::lacks_inputs(const Leaf& leaf) const {
  const SendEnds ends = shown_ends();
  for (int p = 0; p < players(); ++p) {
    if (leaf.acked[p] < ends.of[p]) return true;
  }
  return false;
}

bool RelayCore::acknowledges(const Leaf& leaf, Time now) const {
  const Time last = leaf.acked_at > leaf.had_all_at ? leaf.acked_at : leaf.had_all_at;
  return leaf.acked_at != 0 && now - last <= kStalled;
}

Frame RelayCore::most_frames(const Leaf& leaf, Time now) const {
  if (!lacks_inputs(leaf) || acknowledges(leaf, now)) return kSliceFrames;
  if (now < leaf.more_at || !leaf.has_spoken) return 0;
  return leaf.acked_at == 0 ? 1 : kSliceFrames;
}

std::optional<Outgoing> RelayCore::poll_send(Time now) {
  collect_snapshot();
  if (std::optional<Outgoing> out = ClientCore::poll_send(now)) return out;
  for (std::size_t i = 0; i < leaves_.size(); ++i) {
    Leaf& leaf = leaves_[next_leaf_];
    next_leaf_ = (next_leaf_ + 1) % leaves_.size();
    if (!leaf.is_connected) continue;
    if (std::optional<Outgoing> out = next_message(leaf, now)) {
      next_leaf_ = out->peer;  // all of its messages, in order
      return out;
    }
    if (std::optional<Outgoing> out = next_datagram(leaf, now)) return out;
  }
  return std::nullopt;
}

Outgoing RelayCore::message_to(const Leaf& leaf) {
  stats_.bytes_out += message_.size();
  return {leaf.peer, Channel::reliable, message_};
}

void RelayCore::write_welcome_of(Leaf& leaf) {
  leaf.must_welcome = false;
  Welcome welcome;
  welcome.match = leaf.match;
  welcome.players = static_cast<std::uint8_t>(players());
  welcome.hosted = hosted();
  welcome.start = leaf.start;
  if (leaf.stage == Leaf::Stage::receives_snapshot) {
    leaf.transfer.begin(0, static_cast<std::uint32_t>(snapshot_bytes_.size()));
    welcome.hash = snapshot_hash_;
    welcome.snapshot_size = leaf.transfer.progress().size;
  }
  write_welcome(welcome, message_);
}

std::optional<Outgoing> RelayCore::next_message(Leaf& leaf, Time now) {
  using LeafStage = Leaf::Stage;
  if (leaf.stage == LeafStage::refused && !leaf.must_close) {
    leaf.must_close = true;
    write_refusal(leaf.refusal, message_);
    return message_to(leaf);
  }
  if (leaf.must_close) {
    const PeerId peer = leaf.peer;
    clear(leaf);
    return Outgoing{peer, Channel::reliable, {}, true};
  }
  const bool receives = leaf.stage == LeafStage::receives_snapshot;
  if (receives && awaits_capture()) return std::nullopt;
  if (receives && snapshot_bytes_.empty()) {  // the game has no portable form
    refuse_leaf(leaf, "snapshot", "needed", "none");
    return next_message(leaf, now);
  }
  if (leaf.must_welcome && (receives || leaf.stage == LeafStage::live)) {
    write_welcome_of(leaf);
    return message_to(leaf);
  }
  if (receives) return next_piece(leaf, now);
  return std::nullopt;
}

std::optional<Outgoing> RelayCore::next_piece(Leaf& leaf, Time now) {
  const std::uint32_t size = leaf.transfer.next_piece(now);
  if (size == 0) return std::nullopt;
  const std::uint32_t offset = leaf.transfer.sent();
  write_piece({offset, Bytes(snapshot_bytes_).subspan(offset, size)}, message_);
  leaf.transfer.was_sent(size, now);
  return message_to(leaf);
}

std::optional<Outgoing> RelayCore::next_datagram(Leaf& leaf, Time now) {
  const bool receives = leaf.stage == Leaf::Stage::receives_snapshot;
  if (leaf.stage != Leaf::Stage::live && !(receives && leaf.transfer.is_answered())) return std::nullopt;
  const Frame most = receives ? 0 : most_frames(leaf, now);
  if ((most == 0 && !receives) || !leaf.may_send(current(), clock_.period(), now)) return std::nullopt;
  PacketHeader header;
  header.match = leaf.match;
  header.started = has_begun();
  header.stretch = static_cast<std::uint8_t>(stats_.stretch);
  header.slowest = static_cast<std::uint8_t>(news_.slowest());
  header.waits_for = news_.waits_for();
  header.tempo = tempos_.announced();
  if (told_final() <= kLastFrame) header.final_end = told_final();
  if (leaf.figures_left > 0 && !receives) {
    header.figured = static_cast<std::uint8_t>(--leaf.figures_left);
    header.figures = stats_.players[header.figured];
  }
  leaf.more_at = now + (leaf.acked_at == 0 ? kProbeEvery : kStalledEvery);
  return Outgoing{leaf.peer, Channel::datagram, datagrams_.compose(leaf, header, shown_ends(), present(), most, now)};
}

}  // namespace isostep
