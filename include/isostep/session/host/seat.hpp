// Seat: what the host knows of one player's place, whether somebody sits there or not.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/session/pace/stall_budget.hpp"

namespace isostep {

struct Seat {
  bool is_taken = false;
  int link = -1;  // the PeerId of its guest; -1: its player is away, or the host's
  std::uint64_t token = 0;
  std::uint64_t proof = 0;
  std::uint64_t life = 0;  // of its player's process: see Roster
  Time left_at = 0;        // [us] when it hung up; 0: it did not, or was cut off
  /// The proof of the token with which its player came back. It may not have read the new one: the connection may end.
  std::uint64_t former_proof = 0;
  bool is_kept = false;                  // it was played on, and its player knows a token: it is reserved for that
  Time idle = 0;                         // [us] since it was open, or else taken, in turns of ours
  bool is_open = false;                  // inputs are awaited
  StallBudget lost;                      // time that others waited for it
  Time shut_until = 0;                   // [us] its player watches
  Frame replaced = 0, replaced_end = 0;  // inputs from .. until, of which its player does not know yet; 0: none
  bool is_late = false;                  // the newest input was replaced
  Frame late_end = 0;                    // of the inputs that came after they were replaced: what follows the newest
  StallBudget replaced_for;              // time in which its inputs were replaced though it was heard
  std::uint32_t replaced_told = 0;       // inputs, of stats().players
  Time tells_replaced_at = 0;            // [us] not before
};

}  // namespace isostep
