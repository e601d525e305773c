// Inquiry: the host asks machines that differ what they have, and closes that with what each of them said.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/session/agreement/verdict.hpp"
#include "isostep/session/host/guests.hpp"
#include "isostep/session/host/seats.hpp"

namespace isostep {

/// In: machines that differ, and their statements. Out: the statements of all. It asks when other machines differ than
/// the last time, or others could judge them. Machines are a bit each.
class Inquiry {
 public:
  explicit Inquiry(const Seats& seats) : seats_(seats) {}
  /// Returns true when an inquiry is over and statements() are complete. `own`: the newest final state and its chain.
  bool tend(Guests& guests, std::uint64_t differing, const HashReport& own, Time now);
  /// Returns false if nobody asked for it. `difference`: how the machine was found to differ; kNoFrame: it was not.
  bool take(int player, const Statement& statement, const HashReport& difference);
  /// Forgets that the player differed, because its states are others from now on.
  void forget(int player) { differing_ &= ~(std::uint64_t{1} << player); }
  const Statements& statements() const { return statements_; }

 private:
  void open(Guests& guests, const HashReport& own, Time now);
  bool is_complete() const;
  void close(Guests& guests);

  const Seats& seats_;
  Statements statements_;
  bool is_open_ = false;
  Time until_ = 0;                           // [us] when it ends with the statements that came
  Time next_ = 0;                            // [us] no other begins before
  std::uint64_t differing_ = 0, asked_ = 0;  // machines of the last one
};

}  // namespace isostep
