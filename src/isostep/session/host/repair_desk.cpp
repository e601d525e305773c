// What guests say of their states and repairs.
// SPDX-License-Identifier: MIT
#include "isostep/session/host/repair_desk.hpp"

namespace isostep {
namespace {

constexpr Time kBetweenRepairs = 10 * kSecond;  // [us] of one client, whose machine may go wrong again and again

}  // namespace

bool RepairDesk::receive(Guest& guest, MessageKind kind, Bytes message) {
  using Stage = RepairService::Stage;
  if (kind == MessageKind::repaired) return take_repaired(guest, message);
  if (kind == MessageKind::statement) {
    const Result<Statement> statement = read_statement(message);
    return statement && guest.player >= 0 &&
           inquiry_.take(guest.player, statement.value(), views_[guest.player].difference);
  }
  if (kind != MessageKind::resync) return false;
  // What it has received may have been too long on its way.
  const bool is_free = guest.repair.stage == Stage::none || guest.repair.stage == Stage::restores;
  if (!is_free || !host_.has_begun || message.size() != 1) return false;
  guest.repair.stage = Stage::waits;
  return true;
}

void RepairDesk::has_arrived(Guest& guest, Time now) {
  guest.repair.stage = RepairService::Stage::restores;
  guest.repair.next = now + kBetweenRepairs;
}

bool RepairDesk::take_repaired(Guest& guest, Bytes message) {
  if (guest.repair.stage != RepairService::Stage::restores) return false;
  const Result<Repaired> repaired = read_repaired(message);
  // Nobody has had final states that we have not: it would have us ignore what it says from now on.
  if (!repaired || repaired.value().after > known_end(streams_)) return false;
  guest.repair.stage = RepairService::Stage::none;
  if (guest.player < 0) return true;
  const auto player = static_cast<std::uint8_t>(guest.player);
  views_.was_repaired(player, repaired.value().after);
  inquiry_.forget(player);
  guest.report = HashReport{};
  for (Guest& other : host_.guests) {
    if (&other == &guest || !other.is_live()) continue;
    other.repair.tells |= std::uint32_t{1} << player;
    other.due.add(Due::repaired);
  }
  host_.events.tell({.kind = SessionEvent::Kind::repaired, .player = player, .frame = repaired.value().after});
  return true;
}

}  // namespace isostep
