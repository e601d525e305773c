// What the machines of a match say of their states: who differs from us, and whom a majority finds wrong.
// SPDX-License-Identifier: MIT
#include "isostep/session/peer_core.hpp"

namespace isostep {

void PeerCore::take_hash(std::size_t reporter, const HashReport& report) {
  View& view = views_[reporter];
  // The earliest one waits until we are there: one that claims a frame which never comes keeps no others out.
  const bool is_earlier = view.pending.frame == kNoFrame || report.frame < view.pending.frame;
  if (is_earlier && report.frame > view.agreed && report.frame > view.after) view.pending = report;
}

void PeerCore::compare(std::size_t reporter) {
  View& view = views_[reporter];
  const HashReport report = view.pending;
  if (report.frame == kNoFrame || report.frame > hashes_.settled().frame) return;
  view.pending.frame = kNoFrame;
  if (!hashes_.has_chain(report.frame) || view.differs()) return;
  if (hashes_.chain(report.frame) == report.chain) {
    view.agreed = report.frame;
    return;
  }
  view.difference = report;
  SessionEvent event{.kind = SessionEvent::Kind::desync};
  event.player = reporter < kMaxPlayers ? static_cast<std::uint8_t>(reporter) : 0xff;
  event.frame = report.frame;
  event.agreed = view.agreed > view.after ? view.agreed : view.after;
  event.ours = hashes_.chain(report.frame);
  event.theirs = report.chain;
  tell(event);
}

void PeerCore::was_repaired(std::size_t machine, Frame after) {
  views_[machine] = View{};
  views_[machine].after = after;
  outvoted_ &= ~(std::uint64_t{1} << machine);
}

Verdict PeerCore::tell_verdict(const Statements& statements) {
  const Verdict verdict = judge(statements);
  SessionEvent event{.kind = SessionEvent::Kind::undecided, .frame = statements.frame};
  if (!verdict.is_decided) tell(event);
  event.kind = SessionEvent::Kind::outvoted;
  event.theirs = verdict.chain;
  for (std::size_t m = 0; m < kMachines; ++m) {
    if ((verdict.minority >> m & 1) == 0 || is_outvoted(m)) continue;
    event.player = m == kHostMachine ? 0xff : static_cast<std::uint8_t>(m);
    event.ours = statements.of[m].chain;
    tell(event);
  }
  if (verdict.is_decided) outvoted_ = verdict.minority;
  return verdict;
}

}  // namespace isostep
