// The host's snapshot: when it is taken, who shares it, and how it reaches who needs it.
// SPDX-License-Identifier: MIT
#include "isostep/session/host/snapshot_desk.hpp"

namespace isostep {

bool SnapshotDesk::serve(Guests& guests, Frame current) {
  bool is_wanted = false;
  for (const Guest& guest : guests) is_wanted = is_wanted || guest.needs_snapshot();
  if (!is_wanted) return false;
  const bool is_new = !may_share(guests, current);
  if (is_new) {
    for (const Guest& guest : guests) {
      if (guest.receives_snapshot()) return false;
    }
    // A state that is final: the present one may rest on guesses.
    state_ = hashes_.settled();
    hash_ = hashes_.hash(state_.frame);
    held_until_ = 0;
  }
  for (Guest& guest : guests) {
    if (guest.repair.stage == RepairService::Stage::needs) {
      guest.repair.stage = RepairService::Stage::receives;
      guest.due.add(Due::offer);
      guest.transfer = SnapshotTransfer{};
    }
    if (guest.stage != Guest::Stage::needs_snapshot) continue;
    guest.stage = Guest::Stage::receives_snapshot;
    guest.start = state_.frame;
    guest.transfer = SnapshotTransfer{};
  }
  return is_new;
}

void SnapshotDesk::lost(Guests& guests) {
  state_ = HashReport{};
  for (Guest& guest : guests) {
    if (guest.stage == Guest::Stage::receives_snapshot) guest.stage = Guest::Stage::needs_snapshot;
    if (guest.repair.stage != RepairService::Stage::receives) continue;
    guest.repair.stage = RepairService::Stage::needs;
    guest.due.drop(Due::offer);  // it is due with the next one
  }
}

bool SnapshotDesk::may_share(Guests& guests, Frame current) {
  if (state_.frame == kNoFrame) return false;
  // One of this second serves everybody: who comes again and again costs no more than that. Of a short log less.
  const Frame age = hashes_.settled().frame - state_.frame;
  if (age <= (config_.hz < config_.history / 4 ? config_.hz : config_.history / 4)) return true;
  bool in_use = current < held_until_;
  for (const Guest& guest : guests) {
    const bool has_some = guest.stage == Guest::Stage::needs_snapshot && has_part(guest);
    in_use = in_use || has_some || guest.receives_snapshot();
  }
  // Half of the log is for its way to the last who shares it.
  if (age <= config_.history / 2) return in_use;
  for (Guest& guest : guests) {
    // At this pace the inputs since are gone before it has arrived: that must not keep others out.
    const SnapshotProgress has = guest.transfer.progress();
    const bool is_slow = std::uint64_t{has.arrived} * static_cast<std::uint64_t>(config_.history) <
                         std::uint64_t{has.size} * static_cast<std::uint64_t>(age);
    if (guest.stage == Guest::Stage::receives_snapshot && is_slow) guest.due.add(Due::close);
    if (guest.repair.stage != RepairService::Stage::receives || !is_slow) continue;
    guest.repair.stage = RepairService::Stage::none;
    guest.due.add(Due::offer);
  }
  return false;
}

void SnapshotDesk::begin(Guest& guest) {
  const auto size = static_cast<std::uint32_t>(bytes_.size());
  guest.transfer.begin(has_part(guest) && guest.partial_size <= size ? guest.partial_size : 0, size);
}

void SnapshotDesk::begin_repair(Guest& guest) {
  const bool is_served = guest.repair.stage == RepairService::Stage::receives && !bytes_.empty();
  guest.transfer.begin_at_once(is_served ? static_cast<std::uint32_t>(bytes_.size()) : 0);
  if (!is_served) guest.repair.stage = RepairService::Stage::none;
}

bool SnapshotDesk::next_piece(Guest& guest, Time now, std::vector<std::uint8_t>& message) {
  const std::uint32_t size = guest.transfer.next_piece(now);
  if (size == 0) return false;
  const std::uint32_t offset = guest.transfer.sent();
  write_piece({offset, Bytes(bytes_).subspan(offset, size)}, message);
  guest.transfer.was_sent(size, now);
  return true;
}

}  // namespace isostep
