// Applicant: what a host's game is told of who asks to be let in.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "isostep/core/bytes.hpp"
#include "isostep/session/timeline/frame.hpp"

namespace isostep {

struct Applicant {
  /// The number of this attempt, unique in the match, so a late answer never reaches another applicant. `peer` is not
  /// enough: the transport gives its number to the next connection.
  std::uint64_t id = 0;
  PeerId peer = 0;
  bool spectator = false;
  int seat = -1;     // that it asks for, with those after it; -1: any
  int seats = 1;     // how many
  int player = -1;   // whose token it has shown, the first of a machine; -1: nobody's
  Bytes credential;  // SessionConfig::credential of the client; until the session's next call
};

}  // namespace isostep
