// The client among machines that differ: what it says of its states, and how it takes the host's again.
// SPDX-License-Identifier: MIT
#include "isostep/session/client/client_core.hpp"

namespace isostep {

bool ClientCore::resync() {
  const bool is_busy = repair_.is_under_way() || present() > current();
  if (standing_ != Standing::runs || !host_.is_connected || is_busy) return false;
  repair_.ask();
  return true;
}

bool ClientCore::take_repair(MessageKind kind, Bytes bytes) {
  if (!is_greeted()) return false;
  const Frame farthest = current() + config_.history / 2;
  if (kind == MessageKind::inquiry) {
    const Result<Frame> state = read_inquiry(bytes);
    if (!state || state.value() > farthest) return false;
    repair_.inquire(state.value());
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
  if (!repaired || repaired.value().player >= players() || repaired.value().player == own_.first()) return false;
  if (repaired.value().after > farthest) return false;
  views_.was_repaired(repaired.value().player, repaired.value().after);
  tell({.kind = SessionEvent::Kind::repaired, .player = repaired.value().player, .frame = repaired.value().after});
  return true;
}

bool ClientCore::take_statements(const Statements& statements) {
  const bool plays = own_.first() >= 0;
  const auto own = static_cast<std::size_t>(plays ? own_.first() : 0);
  const Statements::One& quoted = statements.of[own];
  const bool is_quoted = plays && quoted.is_asked && quoted.has_spoken;
  // Who quotes us wrong may quote anybody wrong.
  if (is_quoted && hashes_.has_chain(statements.frame) && quoted.chain != hashes_.chain(statements.frame)) return false;
  const Verdict verdict = views_.judge(statements, events_);
  const bool is_ours = is_quoted && (verdict.minority >> own & 1) != 0 && statements.frame > own_.base();
  // A host whose own states are wrong has none for us.
  const bool is_hosts = (verdict.minority >> kHostMachine & 1) != 0;
  if (config_.repair && is_ours && !is_hosts) static_cast<void>(resync());
  return true;
}

bool ClientCore::take_offer(const RepairOffer& offer) {
  if (!repair_.awaits_offer()) return false;
  if (offer.snapshot_size == 0 || offer.snapshot_size > config_.snapshot_cap) {
    repair_.is_refused();
    tell({.kind = SessionEvent::Kind::bad_snapshot, .frame = offer.start.frame});
    return offer.snapshot_size == 0;
  }
  repair_.take(offer);
  return true;
}

void ClientCore::tend_repair(Time now) {
  // Of who is not in the match nobody is asked, so the host's word on its states counts.
  if (config_.repair && !own_.is_open() && views_[kHostMachine].differs()) static_cast<void>(resync());
  if (!repair_.tend(streams_, current(), clock_, now)) return;
  const Frame start = repair_.offer().start.frame;
  act(RequestKind::restore, start);
  timeline_.restart(start);
  act(RequestKind::save, start);
}

void ClientCore::finish_repair(std::uint64_t hash) {
  if (!repair_.has_hash(hash)) {
    restored(false);
    return;
  }
  const HashReport& start = repair_.offer().start;
  hashes_.restart(start, hash);
  confirmed_state_ = start.frame;
  own_.is_repaired_at(start.frame);
  for (std::size_t machine = 0; machine < kMachines; ++machine) views_.was_repaired(machine, views_[machine].after);
  tell({.kind = SessionEvent::Kind::repaired,
        .player = static_cast<std::uint8_t>(own_.first()),
        .frame = repair_.after()});
}

}  // namespace isostep
