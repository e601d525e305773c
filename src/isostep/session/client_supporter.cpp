// A client that has lost its host answers the candidate to which it is connected.
// SPDX-License-Identifier: MIT
#include "isostep/session/client_supporter.hpp"

namespace isostep {

void Supporter::take(const Candidate& candidate, bool is_member, bool may_call) {
  Roster theirs;
  theirs.term = candidate.roster_term;
  theirs.version = candidate.version;
  candidate_ = candidate;
  const bool is_older = roster_.is_newer_than(theirs);
  due_.set(MessageKind::roster, is_older);
  // Its log is of an earlier host than ours.
  due_.set(MessageKind::redirect, is_member && may_call && candidate.log_term < election_.log_term());
  const bool supports = !is_older && is_member && can_complete(candidate) && election_.give_support(candidate);
  due_.set(MessageKind::support, supports);
}

bool Supporter::can_complete(const Candidate& candidate) const {
  for (int p = 0; p < players(); ++p) {
    const bool lacks = candidate.ends[p] < log_.final_end(p);
    if (lacks && candidate.ends[p] < stream(p).begin()) return false;
  }
  return true;
}

bool Supporter::write_next(const Address& own, Frame current, std::vector<std::uint8_t>& message) {
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

bool Supporter::write_missing(Frame current, std::vector<std::uint8_t>& message) {
  PacketHeader header;
  header.frame = current;
  std::uint8_t buffer[kDatagramCap];
  PacketWriter writer(header, buffer);
  Frame added = 0;
  for (int p = 0; p < players(); ++p) {
    Frame& end = candidate_.ends[p];
    const bool tells_all = log_.is_told_by_us(p) && roster_.settings.deadline == 0;  // see Candidacy
    const Frame left = (tells_all ? stream(p).end() : log_.final_end(p)) - end,
                most = left < kSliceFrames ? left : kSliceFrames;
    if (most <= 0) continue;
    const Frame count = writer.add_slice(static_cast<std::uint8_t>(p), stream(p), end, most);
    end += count;
    added += count;
  }
  if (added > 0) write_known(writer.bytes(), message);
  return added > 0;
}

}  // namespace isostep
