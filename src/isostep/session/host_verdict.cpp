// The host among machines that differ: it asks all of them, tells everybody what was said, and serves repairs.
// SPDX-License-Identifier: MIT
#include "isostep/session/host_core.hpp"

namespace isostep {
namespace {

/// [us] until who has not answered is counted as silent: a round trip of the longest lines, and some losses.
constexpr Time kAnswer = kSecond;
constexpr Time kBetweenInquiries = kSecond;     // [us] of liars that come and go
constexpr Time kBetweenRepairs = 10 * kSecond;  // [us] of one client, whose machine may go wrong again and again
constexpr Time kFarewell = kSecond / 4;         // [us] in which all hear why the host gives way

}  // namespace

void HostCore::tend_inquiry(Time now) {
  if (inquiry_.is_open) {
    bool is_complete = true;
    for (int p = 0; p < players(); ++p) {
      const Statements::One& one = inquiry_.statements.of[p];
      is_complete = is_complete && (!one.is_asked || one.has_spoken || seats_[p].link < 0);
    }
    if (is_complete || now >= inquiry_.until) conclude_inquiry(now);
    return;
  }
  bool differs = false;
  for (int p = 0; p < players(); ++p) differs = differs || views_[p].differs();
  if (!differs) return;
  std::uint64_t differing = 0, asked = 0;
  for (const Guest& guest : guests()) {
    if (!is_in_match(guest)) continue;
    asked |= std::uint64_t{1} << guest.player;
    if (views_[guest.player].differs()) differing |= std::uint64_t{1} << guest.player;
  }
  const bool is_new = (differing & ~inquiry_.differing) != 0 || asked != inquiry_.asked;
  if (differing == 0 || !is_new || now < inquiry_.next) return;
  inquiry_.differing = differing;
  inquiry_.asked = asked;
  open_inquiry(now);
}

void HostCore::open_inquiry(Time now) {
  inquiry_.is_open = true;
  inquiry_.until = now + kAnswer;
  inquiry_.next = now + kBetweenInquiries;
  // The chain of the newest state tells of all before it, and everybody who plays has it or soon will.
  const HashReport own = hashes_.settled();
  inquiry_.statements = Statements{};
  inquiry_.statements.frame = own.frame;
  inquiry_.statements.of[kHostMachine] = {true, true, own.chain};
  for (Guest& guest : guests()) {
    guest.must_inquire = is_in_match(guest);
    if (guest.must_inquire) inquiry_.statements.of[guest.player].is_asked = true;
  }
}

void HostCore::conclude_inquiry(Time now) {
  inquiry_.is_open = false;
  const Statements::One* const said = inquiry_.statements.of;
  for (int p = 0; p < players(); ++p) {
    if (said[p].has_spoken && said[p].chain != said[kHostMachine].chain) inquiry_.differing |= std::uint64_t{1} << p;
  }
  for (Guest& guest : guests()) {
    guest.must_inquire = false;
    guest.must_tell_statements = guest.stage == Guest::Stage::live;
  }
  const Verdict verdict = tell_verdict(inquiry_.statements);
  const bool is_ours = (verdict.minority >> kHostMachine & 1) != 0;
  if (is_ours && config_.repair && could_others(verdict.minority)) steps_down_at_ = now + kFarewell;
}

bool HostCore::could_others(std::uint64_t unfit) const {
  std::uint64_t others = 0;
  bool has_candidate = false;
  for (int m = 0; m < roster_.count; ++m) {
    const Roster::Machine& machine = roster_.machines[m];
    if (m == roster_.host || !machine.is_in || machine.players == 0) continue;
    others |= std::uint64_t{1} << m;
    const bool is_right = (unfit >> std::countr_zero(machine.players) & 1) == 0;
    has_candidate = has_candidate || (is_right && !machine.address.view().empty());
  }
  return has_candidate && roster_.is_majority(others);
}

bool HostCore::take_repair(Guest& guest, MessageKind kind, Bytes bytes) {
  const bool has_whole = guest.repair.stage == RepairService::Stage::restores;
  if (guest.stage != Guest::Stage::live) return false;
  if (kind == MessageKind::statement) return take_statement(guest, bytes);
  if (kind == MessageKind::resync) {
    // What it has received may have been too long on its way.
    const bool is_free = guest.repair.stage == RepairService::Stage::none || has_whole;
    if (!is_free || !started_ || bytes.size() != 1) return false;
    guest.repair.stage = RepairService::Stage::waits;
    return true;
  }
  if (kind != MessageKind::repaired || !has_whole) return false;
  const Result<Repaired> repaired = read_repaired(bytes);
  // Nobody has had final states that we have not: it would have us ignore what it says from now on.
  if (!repaired || repaired.value().after > known_end()) return false;
  guest.repair.stage = RepairService::Stage::none;
  if (guest.player < 0) return true;
  const auto player = static_cast<std::uint8_t>(guest.player);
  was_repaired(player, repaired.value().after);
  inquiry_.differing &= ~(std::uint64_t{1} << player);
  guest.report = HashReport{};
  for (Guest& other : guests()) {
    if (&other != &guest && other.stage == Guest::Stage::live) other.repair.tells |= std::uint32_t{1} << player;
  }
  tell({.kind = SessionEvent::Kind::repaired, .player = player, .frame = repaired.value().after});
  return true;
}

bool HostCore::take_statement(const Guest& guest, Bytes bytes) {
  const Result<Statement> read = read_statement(bytes);
  if (!read || guest.player < 0) return false;
  const Statement& statement = read.value();
  Statements::One& one = inquiry_.statements.of[guest.player];
  if (!inquiry_.is_open || statement.frame != inquiry_.statements.frame || !one.is_asked || one.has_spoken)
    return false;
  if (!statement.is_known) {
    one = {};
    return true;
  }
  one.has_spoken = true;
  one.chain = statement.chain;
  // A chain that differed never comes to be the same again: of two words the one that gives it away counts.
  const View& view = views_[guest.player];
  if (view.differs() && one.chain == inquiry_.statements.of[kHostMachine].chain) one.chain = view.difference.chain;
  return true;
}

void HostCore::tend_repair(Guest& guest, Time now) {
  const bool waits = guest.repair.stage == RepairService::Stage::waits && now >= guest.repair.next;
  if (waits) guest.repair.stage = RepairService::Stage::needs;
}

void HostCore::has_repair(Guest& guest, Time now) {
  guest.repair.stage = RepairService::Stage::restores;
  guest.repair.next = now + kBetweenRepairs;
}

void HostCore::end_repair(Guest& guest) {
  guest.repair.stage = RepairService::Stage::none;
  guest.repair.must_offer = true;
}

std::optional<Outgoing> HostCore::next_repair_message(Guest& guest, Time now) {
  if (guest.stage != Guest::Stage::live) return std::nullopt;
  const auto message = [&] {
    stats_.bytes_out += message_.size();
    return Outgoing{guest.peer, Channel::reliable, message_};
  };
  if (guest.must_inquire) {
    guest.must_inquire = false;
    write_inquiry(inquiry_.statements.frame, message_);
    return message();
  }
  if (guest.must_tell_statements) {
    guest.must_tell_statements = false;
    write_statements(inquiry_.statements, message_);
    return message();
  }
  if (guest.repair.tells != 0) {
    const int player = std::countr_zero(guest.repair.tells);
    guest.repair.tells &= guest.repair.tells - 1;
    write_repaired({static_cast<std::uint8_t>(player), views_[player].after}, message_);
    return message();
  }
  const bool serves = guest.repair.stage == RepairService::Stage::receives;
  if (guest.repair.must_offer && awaits_capture()) return std::nullopt;
  if (guest.repair.must_offer) {
    guest.repair.must_offer = false;
    const auto size = static_cast<std::uint32_t>(serves ? portable_.size() : 0);
    guest.transfer.begin_at_once(size);
    if (size == 0) guest.repair.stage = RepairService::Stage::none;
    write_offer({snapshot_, snapshot_hash_, size}, message_);
    return message();
  }
  return serves ? next_piece(guest, now) : std::nullopt;
}

}  // namespace isostep
