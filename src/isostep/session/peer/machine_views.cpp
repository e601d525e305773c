// What the machines of a match say of their states.
// SPDX-License-Identifier: MIT
#include "isostep/session/peer/machine_views.hpp"

namespace isostep {

std::optional<SessionEvent> MachineViews::compare(std::size_t machine, const HashLog& hashes) {
  View& view = views_[machine];
  const HashReport report = view.pending;
  if (report.frame == kNoFrame || report.frame > hashes.settled().frame) return std::nullopt;
  view.pending.frame = kNoFrame;
  if (!hashes.has_chain(report.frame) || view.differs()) return std::nullopt;
  if (hashes.chain(report.frame) == report.chain) {
    view.agreed = report.frame;
    return std::nullopt;
  }
  view.difference = report;
  SessionEvent event{.kind = SessionEvent::Kind::desync};
  event.player = machine < kMaxPlayers ? static_cast<std::uint8_t>(machine) : 0xff;
  event.frame = report.frame;
  event.agreed = view.agreed > view.after ? view.agreed : view.after;
  event.ours = hashes.chain(report.frame);
  event.theirs = report.chain;
  return event;
}

Verdict MachineViews::judge(const Statements& statements, EventQueue& events) {
  const Verdict verdict = isostep::judge(statements);
  SessionEvent event{.kind = SessionEvent::Kind::undecided, .frame = statements.frame};
  if (!verdict.is_decided) events.tell(event);
  event.kind = SessionEvent::Kind::outvoted;
  event.theirs = verdict.chain;
  const std::uint64_t news = verdict.minority & ~outvoted_;
  if (verdict.is_decided) outvoted_ = verdict.minority;
  for (std::size_t m = 0; m < kMachines; ++m) {
    if ((news >> m & 1) == 0) continue;
    event.player = m == kHostMachine ? 0xff : static_cast<std::uint8_t>(m);
    event.ours = statements.of[m].chain;
    events.tell(event);
  }
  return verdict;
}

std::uint64_t MachineViews::differing() const {
  std::uint64_t machines = 0;
  for (std::size_t m = 0; m < kMachines; ++m) machines |= std::uint64_t{views_[m].differs()} << m;
  return machines;
}

std::uint64_t MachineViews::agreeing_since(Frame base) const {
  std::uint64_t machines = 0;
  for (std::size_t m = 0; m < kMachines; ++m) machines |= std::uint64_t{views_[m].agreed >= base} << m;
  return machines & ~differing();
}

}  // namespace isostep
