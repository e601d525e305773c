// Candidacy: a client that would follow its host completes its log by what its supporters know.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/session/client_log.hpp"

namespace isostep {

/// In: inputs that others know. Out: the streams, with those. Keeps: how far the players' own machines have told us
/// theirs. A player's machine knows all inputs that the host can have had of it, and its word counts more than
/// another's; but with a deadline the host plays what none of them said.
class Candidacy {
 public:
  Candidacy(const Roster& roster, std::vector<InputStream>& streams, Timeline& timeline, const InputRules& rules,
            OwnSeats& own, FollowerLog& log)
      : roster_(roster), streams_(streams), timeline_(timeline), rules_(rules), own_(own), log_(log) {}

  /// We ask for support.
  void begin() {
    log_.note_ends();
    log_.copy_ends(told_);
  }
  /// As the machine of these players says, a bit each. False: it cannot be, as no input from frame `most` on can.
  bool take(const InputSlice& slice, std::uint32_t its_players, Frame most);
  /// Inputs of these players, whose machines support us, which only others know.
  void forget_untold(std::uint32_t players);

 private:
  bool owns_inputs() const { return roster_.settings.deadline == 0; }

  const Roster& roster_;
  std::vector<InputStream>& streams_;
  Timeline& timeline_;
  const InputRules& rules_;
  OwnSeats& own_;
  FollowerLog& log_;
  Frame told_[kMaxPlayers] = {};
};

}  // namespace isostep
