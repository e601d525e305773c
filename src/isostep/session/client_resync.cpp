// The client among machines that differ: what it says of its states, and how it takes the host's again.
// SPDX-License-Identifier: MIT
#include "isostep/session/client_core.hpp"

namespace isostep {

bool ClientCore::resync() {
  const bool is_busy = repair_.stage != Repair::Stage::none || present() > current();
  if (!runs_ || is_restoring_ || !host_.is_connected || is_busy) return false;
  repair_.stage = Repair::Stage::asks;
  return true;
}

bool ClientCore::take_repair(MessageKind kind, Bytes bytes) {
  if (!is_greeted_) return false;
  const Frame farthest = current() + config_.history / 2;
  if (kind == MessageKind::inquiry) {
    const Result<Frame> state = read_inquiry(bytes);
    if (!state || state.value() > farthest) return false;
    inquired_ = state.value();
    return true;
  }
  if (kind == MessageKind::statements) {
    const Result<Statements> statements = read_statements(bytes);
    return statements && take_statements(statements.value());
  }
  if (kind == MessageKind::offer) {
    const Result<RepairOffer> offer = read_offer(bytes);
    return offer && take_offer(offer.value());
  }
  if (kind != MessageKind::repaired) return false;
  const Result<Repaired> repaired = read_repaired(bytes);
  if (!repaired || repaired.value().player >= players() || repaired.value().player == player_) return false;
  if (repaired.value().after > farthest) return false;
  was_repaired(repaired.value().player, repaired.value().after);
  tell({.kind = SessionEvent::Kind::repaired, .player = repaired.value().player, .frame = repaired.value().after});
  return true;
}

bool ClientCore::take_statements(const Statements& statements) {
  const auto own = static_cast<std::size_t>(player_ < 0 ? 0 : player_);
  const Statements::One& quoted = statements.of[own];
  const bool is_quoted = player_ >= 0 && quoted.is_asked && quoted.has_spoken;
  // Who quotes us wrong may quote anybody wrong.
  if (is_quoted && hashes_.has_chain(statements.frame) && quoted.chain != hashes_.chain(statements.frame)) return false;
  const Verdict verdict = tell_verdict(statements);
  const bool is_ours = is_quoted && (verdict.minority >> own & 1) != 0 && statements.frame > base_;
  // A host whose own states are wrong has none for us.
  const bool is_hosts = (verdict.minority >> kHostMachine & 1) != 0;
  if (config_.repair && is_ours && !is_hosts) static_cast<void>(resync());
  return true;
}

bool ClientCore::take_offer(const RepairOffer& offer) {
  if (repair_.stage != Repair::Stage::waits && repair_.stage != Repair::Stage::receives) return false;
  if (offer.snapshot_size == 0 || offer.snapshot_size > config_.snapshot_cap) {
    repair_.stage = Repair::Stage::none;
    tell({.kind = SessionEvent::Kind::bad_snapshot, .frame = offer.start.frame});
    return offer.snapshot_size == 0;
  }
  repair_.stage = Repair::Stage::receives;
  repair_.offer = offer;
  welcome_.snapshot_size = offer.snapshot_size;
  portable_.clear();
  told_ = 0;
  return true;
}

void ClientCore::tend_repair(Time now) {
  // Of who is not in the match nobody is asked, so the host's word on its states counts.
  if (config_.repair && !is_open_ && views_[kHostMachine].differs()) static_cast<void>(resync());
  while (present() > current() && clock_.is_due(now)) {
    ++repair_.present;
    clock_.stepped(now);
  }
  const Frame start = repair_.offer.start.frame;
  const bool is_whole = repair_.stage == Repair::Stage::receives && portable_.size() == repair_.offer.snapshot_size;
  if (is_whole && current() >= start) {
    for (const InputStream& stream : streams_) {
      if (stream.begin() <= start) continue;
      repair_.stage = Repair::Stage::asks;  // it was too long on its way: another
      return;
    }
    repair_.stage = Repair::Stage::restores;
    repair_.after = hashes_.settled().frame;
    repair_.present = current();
  }
  // Which it still is where the requests of the last turn were not carried out.
  if (repair_.stage != Repair::Stage::restores) return;
  act(RequestKind::restore, start);
  timeline_.restart(start);
  act(RequestKind::save, start);
}

void ClientCore::finish_repair(std::uint64_t hash) {
  const HashReport& start = repair_.offer.start;
  if (hash != repair_.offer.hash) {
    restored(false);
    return;
  }
  repair_.stage = Repair::Stage::none;
  repair_.must_tell = true;
  hashes_.restart(start, hash);
  confirmed_state_ = base_ = start.frame;
  for (std::size_t machine = 0; machine < kMachines; ++machine) was_repaired(machine, views_[machine].after);
  tell({.kind = SessionEvent::Kind::repaired, .player = static_cast<std::uint8_t>(player_), .frame = repair_.after});
}

std::optional<Outgoing> ClientCore::next_repair_message() {
  if (inquired_ != kNoFrame && hashes_.settled().frame >= inquired_) {
    const bool is_known = hashes_.has_chain(inquired_);
    write_statement({inquired_, is_known, is_known ? hashes_.chain(inquired_) : 0}, message_);
    inquired_ = kNoFrame;
    return written(host_.peer);
  }
  if (repair_.stage == Repair::Stage::asks) {
    repair_.stage = Repair::Stage::waits;
    write_resync(message_);
    return written(host_.peer);
  }
  const bool is_told = told_ >= portable_.size();  // how much has arrived: first things first
  if (!repair_.must_tell || !is_told) return std::nullopt;
  repair_.must_tell = false;
  write_repaired({0xff, repair_.after}, message_);
  return written(host_.peer);
}

}  // namespace isostep
