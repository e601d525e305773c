// What a client hears of states, and what follows from that.
// SPDX-License-Identifier: MIT
#include "isostep/session/client/comparison.hpp"

namespace isostep {

bool Comparison::resync() {
  const bool runs = client_.standing == Standing::runs && client_.host.is_connected;
  if (!runs || repair_.is_busy(client_.timeline.current())) return false;
  repair_.ask();
  return true;
}

bool Comparison::receive(MessageKind kind, Bytes bytes) {
  if (!client_.is_greeted()) return false;
  switch (kind) {
    case MessageKind::inquiry: {
      const Result<Frame> state = read_inquiry(bytes);
      if (!state || state.value() > client_.timeline.current() + client_.config.history / 2) return false;
      repair_.inquire(state.value());
      return true;
    }
    case MessageKind::statements: {
      const Result<Statements> statements = read_statements(bytes);
      return statements && take_statements(statements.value());
    }
    case MessageKind::offer: {
      const Result<RepairOffer> offer = read_offer(bytes);
      return offer && take_offer(offer.value());
    }
    case MessageKind::repaired: {
      const Result<Repaired> repaired = read_repaired(bytes);
      return repaired && take_repaired(repaired.value());
    }
    default: return false;
  }
}

bool Comparison::take_repaired(const Repaired& repaired) {
  if (repaired.player >= client_.config.players || repaired.player == client_.own.first()) return false;
  if (repaired.after > client_.timeline.current() + client_.config.history / 2) return false;
  views_.was_repaired(repaired.player, repaired.after);
  client_.events.tell({.kind = SessionEvent::Kind::repaired, .player = repaired.player, .frame = repaired.after});
  return true;
}

bool Comparison::take_statements(const Statements& statements) {
  for (std::size_t machine = static_cast<std::size_t>(client_.config.players); machine < kMachines; ++machine) {
    if (machine != kHostMachine && statements.of[machine].is_asked) return false;
  }
  const bool plays = client_.own.first() >= 0;
  const auto own = static_cast<std::size_t>(plays ? client_.own.first() : 0);
  const Statements::One& quoted = statements.of[own];
  const bool is_quoted = plays && quoted.is_asked && quoted.has_spoken;
  // Who quotes us wrong may quote anybody wrong.
  if (is_quoted && hashes_.has_chain(statements.frame) && quoted.chain != hashes_.chain(statements.frame)) return false;
  const Verdict verdict = views_.judge(statements, client_.events);
  const bool is_ours = is_quoted && (verdict.minority >> own & 1) != 0 && statements.frame > client_.own.base();
  // A host whose own states are wrong has none for us.
  const bool is_hosts = (verdict.minority >> kHostMachine & 1) != 0;
  if (client_.config.repair && is_ours && !is_hosts) static_cast<void>(resync());
  return true;
}

bool Comparison::take_offer(const RepairOffer& offer) {
  if (!repair_.awaits_offer()) return false;
  if (offer.snapshot_size == 0 || offer.snapshot_size > client_.config.snapshot_cap) {
    repair_.is_refused();
    client_.events.tell({.kind = SessionEvent::Kind::bad_snapshot, .frame = offer.start.frame});
    return offer.snapshot_size == 0;
  }
  repair_.take(offer);
  return true;
}

}  // namespace isostep
