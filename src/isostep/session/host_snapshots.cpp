// The host's snapshot: when it is taken, who shares it, and how it reaches who needs it.
// SPDX-License-Identifier: MIT
#include "isostep/session/host_core.hpp"

namespace isostep {

SnapshotProgress HostCore::snapshot_progress(PeerId peer) const {
  const bool receives = peer < guests_.size() && receives_snapshot(guests_[peer]);
  return receives ? guests_[peer].transfer.progress() : SnapshotProgress{};
}

void HostCore::serve_snapshots() {
  bool wanted = false;
  for (const Guest& guest : guests()) wanted = wanted || needs_snapshot(guest);
  if (!wanted) return;
  if (!may_share_snapshot()) {
    for (const Guest& guest : guests()) {
      if (receives_snapshot(guest)) return;
    }
    // A state that is final: the present one may rest on guesses.
    snapshot_ = hashes_.settled();
    snapshot_hash_ = hashes_.hash(snapshot_.frame);
    held_until_ = 0;
    act(RequestKind::capture, snapshot_.frame);
  }
  for (Guest& guest : guests()) {
    if (guest.repair.stage == RepairService::Stage::needs) {
      guest.repair.stage = RepairService::Stage::receives;
      guest.repair.must_offer = true;
      guest.transfer = SnapshotTransfer{};
    }
    if (guest.stage != Guest::Stage::needs_snapshot) continue;
    guest.stage = Guest::Stage::receives_snapshot;
    guest.start = snapshot_.frame;
    guest.transfer = SnapshotTransfer{};
  }
}

void HostCore::capture_lost() {
  snapshot_ = HashReport{};
  for (Guest& guest : guests()) {
    if (guest.stage == Guest::Stage::receives_snapshot) guest.stage = Guest::Stage::needs_snapshot;
    if (guest.repair.stage == RepairService::Stage::receives) guest.repair.stage = RepairService::Stage::needs;
  }
}

bool HostCore::may_share_snapshot() {
  if (snapshot_.frame == kNoFrame) return false;
  // One of this second serves everybody: who comes again and again costs no more than that.
  const Frame age = hashes_.settled().frame - snapshot_.frame;
  if (age <= bounded(config_.hz)) return true;
  bool in_use = current() < held_until_;
  for (const Guest& guest : guests()) {
    const bool has_some = guest.stage == Guest::Stage::needs_snapshot && has_part(guest);
    in_use = in_use || has_some || receives_snapshot(guest);
  }
  // Half of the log is for its way to the last who shares it.
  if (age <= config_.history / 2) return in_use;
  for (Guest& guest : guests()) {
    // At this pace the inputs since are gone before it has arrived: that must not keep others out.
    const SnapshotProgress has = guest.transfer.progress();
    const bool is_slow = std::uint64_t{has.arrived} * static_cast<std::uint64_t>(config_.history) <
                         std::uint64_t{has.size} * static_cast<std::uint64_t>(age);
    if (guest.stage == Guest::Stage::receives_snapshot && is_slow) guest.must_close = true;
    if (guest.repair.stage == RepairService::Stage::receives && is_slow) end_repair(guest);
  }
  return false;
}

void HostCore::begin_transfer(Guest& guest) {
  const auto size = static_cast<std::uint32_t>(portable_.size());
  guest.transfer.begin(has_part(guest) && guest.partial_size <= size ? guest.partial_size : 0, size);
}

std::optional<Outgoing> HostCore::next_piece(Guest& guest, Time now) {
  const std::uint32_t size = guest.transfer.next_piece(now);
  if (size == 0) return std::nullopt;
  const std::uint32_t offset = guest.transfer.sent();
  write_piece({offset, Bytes(portable_).subspan(offset, size)}, message_);
  guest.transfer.was_sent(size, now);
  stats_.bytes_out += message_.size();
  return Outgoing{guest.peer, Channel::reliable, message_};
}

void HostCore::measure(Guest& guest, const PacketHeader& header, Time now) {
  const std::uint16_t trip = static_cast<std::uint16_t>(static_cast<std::uint16_t>(now / 1000) - header.echo);
  if (header.has_echo) guest.transfer.measured(Time{trip} * 1000, now);
}

void HostCore::take_progress(Guest& guest, Bytes message, Time now) {
  const Result<std::uint32_t> arrived = read_progress(message);
  if (!arrived || !guest.transfer.has_arrived(arrived.value())) {
    ++stats_.refused;
    return;
  }
  guest.heard = now;
  if (!guest.transfer.is_complete()) return;
  if (guest.stage == Guest::Stage::live) has_repair(guest, now);
  else go_live(guest, guest.start);
}

}  // namespace isostep
