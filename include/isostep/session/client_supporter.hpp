// Supporter: a client that has lost its host answers the candidate to which it is connected.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/session/client_due.hpp"
#include "isostep/session/client_log.hpp"

namespace isostep {

/// In: what the candidate asks. Out: our roster, a call to come here instead, inputs that it lacks, and our support.
/// Keeps: its call, and which answers are due.
class Supporter {
 public:
  Supporter(const Roster& roster, Election& election, const std::vector<InputStream>& streams, const FollowerLog& log)
      : roster_(roster), election_(election), streams_(streams), log_(log) {}

  /// `is_member`: we have a vote; `may_call`: others can reach us, and we may be the host.
  void take(const Candidate& candidate, bool is_member, bool may_call);
  void answer_nothing() { due_ = DueMessages{}; }
  bool write_next(const Address& own, Frame current, std::vector<std::uint8_t>& message);

 private:
  const InputStream& stream(int player) const { return streams_[static_cast<std::size_t>(player)]; }
  int players() const { return static_cast<int>(streams_.size()); }
  /// It lacks nothing that we know to be final, or only what we still have.
  bool can_complete(const Candidate& candidate) const;
  /// False: it has all that we have.
  bool write_missing(Frame current, std::vector<std::uint8_t>& message);

  const Roster& roster_;
  Election& election_;
  const std::vector<InputStream>& streams_;
  const FollowerLog& log_;
  Candidate candidate_;
  DueMessages due_;
};

}  // namespace isostep
