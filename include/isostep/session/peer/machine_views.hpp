// MachineViews: what the machines of a match say of their states: who differs from us, and whom a majority finds wrong.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/session/agreement/verdict.hpp"
#include "isostep/session/peer/events.hpp"
#include "isostep/session/timeline/hash_log.hpp"

namespace isostep {

/// In: hash chains of others, repairs, and verdicts on all. Out: who differs, as an event once. Keeps: of each machine
/// what it said until we are there, since when it agrees, and whether it is outvoted.
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
  /// Its states are others from now on.
  void was_repaired(std::size_t machine, Frame after) {
    views_[machine] = View{};
    views_[machine].after = after;
    outvoted_ &= ~(std::uint64_t{1} << machine);
  }
  /// What it said, with our states: an event where they differ now.
  std::optional<SessionEvent> compare(std::size_t machine, const HashLog& hashes);
  /// Machines, a bit each: who differs, and who has agreed since a state of this frame.
  std::uint64_t differing() const;
  std::uint64_t agreeing_since(Frame base) const;
  /// Whom a majority finds wrong, as last heard.
  bool is_outvoted(std::size_t machine) const { return (outvoted_ >> machine & 1) != 0; }
  /// Judges what all say; tells whom a majority finds wrong, each once.
  Verdict judge(const Statements& statements, EventQueue& events);

 private:
  View views_[kMachines];
  std::uint64_t outvoted_ = 0;
};

}  // namespace isostep
