// Supporter: a client without a host votes for the candidate to which it is connected.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/session/client/follower_log.hpp"
#include "isostep/session/protocol/message.hpp"
#include "isostep/session/protocol/outbox.hpp"

namespace isostep {

/// Raft's voter. In: the candidate's request. Out: our roster, a redirect to us, inputs that the candidate lacks, and
/// our support. Keeps: the request, and which answers are due.
class Supporter {
 public:
  Supporter(const Roster& roster, Election& election, const std::vector<InputStream>& streams, const FollowerLog& log)
      : roster_(roster), election_(election), streams_(streams), log_(log) {}

  /// `is_member`: we have a vote; `may_call`: others can reach us, and we may be the host.
  void take(const Candidate& candidate, bool is_member, bool may_call) {
    Roster theirs;
    theirs.term = candidate.roster_term;
    theirs.version = candidate.version;
    candidate_ = candidate;
    const bool is_older = roster_.is_newer_than(theirs);
    due_.set(MessageKind::roster, is_older);
    // Its log is of an earlier host than ours.
    due_.set(MessageKind::redirect, is_member && may_call && candidate.log_term < election_.log_term());
    const bool supports = !is_older && is_member && can_complete() && election_.give_support(candidate);
    due_.set(MessageKind::support, supports);
  }
  void answer_nothing() { due_ = Outbox<MessageKind>{}; }
  bool write_next(const Address& own, Frame current, std::vector<std::uint8_t>& message) {
    if (due_.is_empty()) return false;
    if (due_.take(MessageKind::roster)) {
      write_roster(roster_, message);
    } else if (due_.take(MessageKind::redirect)) {
      write_redirect(own, message);
    } else if (!write_missing(current, message)) {
      due_.drop(MessageKind::support);
      Support support;
      support.term = candidate_.term;
      log_.copy_ends(support.ends);
      write_support(support, message);
    }
    return true;
  }

 private:
  /// Returns true if we can send all final inputs that the candidate lacks.
  bool can_complete() const {
    for (std::size_t p = 0; p < streams_.size(); ++p) {
      const Frame end = candidate_.ends[p];
      if (end < log_.final_end(static_cast<int>(p)) && end < streams_[p].begin()) return false;
    }
    return true;
  }
  /// Writes inputs that the candidate lacks. Returns false if it has all that we have.
  bool write_missing(Frame current, std::vector<std::uint8_t>& message) {
    PacketHeader header;
    header.frame = current;
    std::uint8_t buffer[kDatagramCap];
    PacketWriter writer(header, buffer);
    Frame added = 0;
    for (std::size_t p = 0; p < streams_.size(); ++p) {
      const auto player = static_cast<std::uint8_t>(p);
      const bool tells_all = log_.is_told_by_us(player) && roster_.settings.deadline == 0;  // see Callers
      const Frame left = (tells_all ? streams_[p].end() : log_.final_end(player)) - candidate_.ends[p];
      if (left <= 0) continue;
      const Frame most = left < kSliceFrames ? left : kSliceFrames;
      const Frame count = writer.add_slice(player, streams_[p], candidate_.ends[p], most);
      candidate_.ends[p] += count;
      added += count;
    }
    if (added > 0) write_known(writer.bytes(), message);
    return added > 0;
  }

  const Roster& roster_;
  Election& election_;
  const std::vector<InputStream>& streams_;
  const FollowerLog& log_;
  Candidate candidate_;
  Outbox<MessageKind> due_;
};

}  // namespace isostep
