// What host and client do alike about time: pauses, how early inputs come, and the pace of all.
// SPDX-License-Identifier: MIT
#include "isostep/session/peer/peer_core.hpp"

namespace isostep {
namespace {

// Between turns: a display of 30 Hz takes 33 ms, and a game that misses one of its pictures is not a hitch yet.
constexpr Time kPause = 50000;           // [us]
constexpr Time kPausePeriods = 3;        // of slow matches: [frames]
constexpr Time kForgiven = 5 * kSecond;  // [us] who pauses more often than that has to cover it by its delay

}  // namespace

bool PeerCore::is_after_pause(Time now) const {
  const Time periods = kPausePeriods * clock_.nominal();
  const Time steps = pace_.steps() > 1 ? static_cast<Time>(pace_.steps()) : 1;  // a turn of many takes its time
  const Time again = static_cast<Time>(stepped_again_) * clock_.period();       // and so does a rollback
  return has_turned_ && now - last_turn_ > steps * (periods > kPause ? periods : kPause) + again;
}
void PeerCore::forgive_own_pause(Time now) {
  if (now < forgiven_until_) return;
  forgiven_until_ = now + kForgiven;
  delay_.disregard();
}

void PeerCore::go_at_pace_of(int player, int stretch) {
  const bool was_slow = stats_.stretch > 0, is_slow = stretch > 0;
  stats_.stretch = stretch;
  clock_.stretch(stretch);
  if (was_slow == is_slow && (!is_slow || player == slowest_)) return;
  slowest_ = player;
  if (is_slow) tell_of(SessionEvent::Kind::slowed_by, player);
  else tell_of(SessionEvent::Kind::full_speed);
}

void PeerCore::tell_of(SessionEvent::Kind kind, int player) {
  SessionEvent event{.kind = kind};
  event.player = static_cast<std::uint8_t>(player);
  event.frame = current();
  tell(event);
}

void PeerCore::tell_started() {
  if (is_start_told_) return;
  is_start_told_ = true;
  tell_of(SessionEvent::Kind::started);
}

void PeerCore::stands_for(std::uint32_t players) {
  if (stands_ && players == waits_for_) return;
  stands_ = true;
  waits_for_ = players;
  SessionEvent event{.kind = SessionEvent::Kind::waiting_for};
  event.players = players;
  event.frame = current();
  tell(event);
}

void PeerCore::goes_on() {
  if (!stands_) return;
  stands_ = false;
  tell_of(SessionEvent::Kind::resumed);
}

void PeerCore::note_arrival(int player, Frame end, Time now) {
  if (is_after_pause(now)) return;
  Frame slack = end - present();
  // Who holds us up is late by all that we wait; the others may be waiting as we are.
  if (is_blocked_ && end == known_end()) slack -= clock_.overdue(now);
  slack_[player].add(slack < -127 ? -127 : slack);
}

}  // namespace isostep
