// Pauses and speeds: what is announced, and when it is taken up.
// SPDX-License-Identifier: MIT
#include "isostep/session/peer/peer_core.hpp"

namespace isostep {

void PeerCore::announce(Tempo tempo) {
  Frame from = current();
  // Whoever has not heard of it lacks the inputs that are not here yet, and steps no more than the window beyond them.
  if (!is_paused()) {
    for (const InputStream& stream : streams_) from = from < stream.end() ? stream.end() : from;
    from += window();
  }
  tempos_.announce(tempo, from);
}

void PeerCore::follow_tempo(Time now) {
  if (const std::optional<Tempo> due = tempos_.due_at(current())) take_up(*due, now);
  if (is_paused()) clock_.start(now);
}

void PeerCore::take_up(const Tempo& tempo, Time now) {
  const Tempo before = tempos_.in_force();
  tempos_.take_up(tempo);
  SessionEvent event{.kind = SessionEvent::Kind::paused, .player = tempo.by, .frame = current()};
  event.speed = tempo.speed;
  if (tempo.speed != before.speed) {
    clock_.set_speed(tempo.speed);
    pace_ = StepPace(clock_.nominal());
    delay_.rescale(before.speed, tempo.speed);
    event.kind = SessionEvent::Kind::speed_changed;
    tell(event);
  }
  // What is late for a while is nobody's fault.
  delay_.disregard();
  for (RecentLeast& slack : slack_) slack = RecentLeast{};
  if (tempo.is_paused == before.is_paused) return;
  event.kind = tempo.is_paused ? SessionEvent::Kind::paused : SessionEvent::Kind::unpaused;
  tell(event);
  if (is_blocked_) unblocked(now);
  is_blocked_ = false;
  // The others hear of it when it has reached them, and begin then.
  if (!tempo.is_paused) clock_.start(config_.host ? now + stats_.round_trip / 2 : now);
}

}  // namespace isostep
