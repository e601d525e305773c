// Raft's log at a client.
// SPDX-License-Identifier: MIT
#include "isostep/session/client/follower_log.hpp"

namespace isostep {

void FollowerLog::hear_final(Frame end) {
  // Later ones tell of more; and a host that follows another knows what that one made final.
  if (end == kNoFrame) told_final_ = kLastFrame + 1;
  else if (told_final_ > kLastFrame || end > told_final_) told_final_ = end;
}

void FollowerLog::copy_ends(Frame (&ends)[kMaxPlayers]) const {
  for (int p = 0; p < players(); ++p) ends[p] = final_end(p);
}

void FollowerLog::note_ends() {
  has_noted_ = true;
  copy_ends(noted_);
}

void FollowerLog::follow(const Welcome& next, std::uint32_t log_term) {
  // A machine that is the host again, in a later term, says other things than in the one before.
  const bool is_same_host = next.match == entry_.welcome().match && next.term == entry_.welcome().term;
  keeps_inputs_ = is_same_host && next.snapshot_size == 0 && !former_.are_back();
  // We know how many of our own inputs were accepted as long as our seats are open.
  if (log_term != 0 && !keeps_inputs_ && !former_.are_kept()) {
    Frame ends[kMaxPlayers] = {};
    for (int p = 0; p < players(); ++p) ends[p] = has_noted_ && !own_.has(p) ? noted_[p] : final_end(p);
    former_.keep(streams_, ends);
  }
  told_final_ = next.term == 0 ? kLastFrame + 1 : next.start.frame;
}

void FollowerLog::begin_at(Frame frame) {
  const Frame opens = entry_.welcome().opens;
  for (int p = 0; p < players(); ++p) {
    InputStream& stream = streams_[static_cast<std::size_t>(p)];
    const bool is_ours = own_.has(p);
    // Behind a new host our own inputs stay what they were, from the first that it lacks on.
    const bool is_kept =
        is_ours && !entry_.is_restoring() && stream.begin() <= frame && opens != kNoFrame && stream.end() >= opens;
    if (has_noted_ && !is_ours) stream.truncate(noted_[p]);
    const bool stays = keeps_inputs_ && stream.contains(frame) && (!is_ours || own_.accepted(p) > frame);
    if (stays && is_ours && !is_kept) stream.truncate(own_.accepted(p));
    if (!stays && !is_kept) stream.reset(frame);
    own_.accept_until(p, stays && !is_kept ? stream.end() : frame);
  }
  has_noted_ = false;
}

void FollowerLog::tend(Election& election) {
  const Welcome& welcome = entry_.welcome();
  const bool is_of_host = election.log_term() == welcome.term;
  if (is_of_host && !former_.are_kept()) return;
  if (!has_all_until(is_of_host ? former_.end() : welcome.term_start)) return;
  election.has_log_of(welcome.term);
  former_.forget();
}

bool FollowerLog::has_all_until(Frame end) const {
  for (int p = 0; p < players(); ++p) {
    if (final_end(p) < end) return false;
  }
  return true;
}

void FollowerLog::take_back_former() {
  if (!former_.are_kept()) return;
  former_.are_given_back();
  for (int p = 0; p < players(); ++p) {
    InputStream& stream = streams_[static_cast<std::size_t>(p)];
    const InputStream& former = former_.of(p);
    for (Frame frame = final_end(p); former.contains(frame); ++frame) {
      if (frame == stream.end()) {
        stream.append(former.at(frame));
      } else if (!same_input(stream.at(frame), former.at(frame))) {
        stream.replace(frame, former.at(frame));
        timeline_.recheck(p, frame);
      }
      if (is_told_by_us(p)) own_.accept_until(p, frame + 1);
    }
  }
}

}  // namespace isostep
