// Inquiry: the host asks machines that differ what they have, and closes that with what each of them said.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/session/agreement/verdict.hpp"
#include "isostep/session/host/guests.hpp"
#include "isostep/session/host/seats.hpp"

namespace isostep {

/// Who differs and what each says comes in; the statements of all go out. It asks when the machines that differ from
/// it, or those that could judge them, are not those of the last time. Machines are a bit each.
class Inquiry {
 public:
  explicit Inquiry(const Seats& seats) : seats_(seats) {}
  /// True: it is over, and statements() are complete. `own`: the newest final state, and its chain.
  bool tend(Guests& guests, std::uint64_t differing, const HashReport& own, Time now);
  /// False: nobody asked that. `difference`: how the machine was found to differ; of kNoFrame: not.
  bool take(int player, const Statement& statement, const HashReport& difference);
  /// Its states are others from now on.
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
