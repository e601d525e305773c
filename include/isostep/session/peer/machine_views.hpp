// MachineViews: what the machines of a match say of their states: who differs from us, and whom a majority finds wrong.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/session/agreement/verdict.hpp"
#include "isostep/session/peer/events.hpp"
#include "isostep/session/timeline/hash_log.hpp"

namespace isostep {

/// In: hash chains of others, repairs, and verdicts. Out: an event, once, for a machine that differs. Keeps for each
/// machine: its report until we reach that state, the newest state that agreed, and whether it is outvoted.
class MachineViews {
 public:
  struct View {
    HashReport pending;
    Frame agreed = kNoFrame;
    HashReport difference;   // the first that was not ours; kNoFrame: none
    Frame after = kNoFrame;  // what it says of states up to this one was of before its repair
    bool differs() const { return difference.frame != kNoFrame; }
  };
  const View& operator[](std::size_t machine) const { return views_[machine]; }
  void hear(std::size_t machine, const HashReport& report) {
    View& view = views_[machine];
    // The earliest one waits until we are there: one that claims a frame which never comes keeps no others out.
    const bool is_earlier = view.pending.frame == kNoFrame || report.frame < view.pending.frame;
    if (is_earlier && report.frame > view.agreed && report.frame > view.after) view.pending = report;
  }
  /// Forgets what the machine said: its reports on states up to `after` predate its repair.
  void was_repaired(std::size_t machine, Frame after) {
    views_[machine] = View{};
    views_[machine].after = after;
    outvoted_ &= ~(std::uint64_t{1} << machine);
  }
  /// Compares the machine's report with our states. Returns an event if they differ for the first time.
  std::optional<SessionEvent> compare(std::size_t machine, const HashLog& hashes);
  /// Machines, a bit each: those that differ, and those that agreed in a state of frame `base` or later.
  std::uint64_t differing() const;
  std::uint64_t agreeing_since(Frame base) const;
  /// Returns true if the last verdict put the machine in the minority.
  bool is_outvoted(std::size_t machine) const { return (outvoted_ >> machine & 1) != 0; }
  /// Judges what all say. Reports each machine that a majority finds wrong, once.
  Verdict judge(const Statements& statements, EventQueue& events);

 private:
  View views_[kMachines];
  std::uint64_t outvoted_ = 0;
};

}  // namespace isostep
