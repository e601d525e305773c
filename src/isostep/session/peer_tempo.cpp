// Pauses and speeds: what is announced, and when it is taken up.
// SPDX-License-Identifier: MIT
#include "isostep/session/peer_core.hpp"

namespace isostep {

void PeerCore::hear_tempo(const Tempo& tempo) {
  if (knows_tempo_ && tempo.number <= announced_.number) return;
  knows_tempo_ = true;
  announced_ = tempo;
}

void PeerCore::announce(Tempo tempo) {
  tempo.number = announced_.number + 1;
  tempo.from = current();
  // Whoever has not heard of it lacks the inputs that are not here yet, and steps no more than the window beyond them.
  if (!is_paused()) {
    for (const InputStream& stream : streams_) {
      if (tempo.from < stream.end()) tempo.from = stream.end();
    }
    tempo.from += window();
  }
  knows_tempo_ = true;
  announced_ = tempo;
}

void PeerCore::follow_tempo(Time now) {
  const bool is_new = announced_.number != tempo_.number || !announced_.same_as(tempo_);
  if (is_new && knows_tempo_ && current() >= announced_.from) {
    take_up(announced_, now);
  } else if (is_new && knows_tempo_ && is_paused()) {
    // What is announced for later says that the pause is over; the word on that was lost.
    Tempo goes_on = tempo_;
    goes_on.is_paused = false;
    take_up(goes_on, now);
  }
  if (is_paused()) clock_.start(now);
}

void PeerCore::take_up(const Tempo& tempo, Time now) {
  const Tempo before = tempo_;
  tempo_ = tempo;
  SessionEvent event{.kind = SessionEvent::Kind::paused, .player = tempo_.by, .frame = current()};
  event.speed = tempo_.speed;
  if (tempo_.speed != before.speed) {
    clock_.set_speed(tempo_.speed);
    pace_ = StepPace(clock_.nominal());
    delay_.rescale(before.speed, tempo_.speed);
    event.kind = SessionEvent::Kind::speed_changed;
    tell(event);
  }
  // What is late for a while is nobody's fault.
  delay_.disregard();
  for (RecentLeast& slack : slack_) slack = RecentLeast{};
  if (tempo_.is_paused == before.is_paused) return;
  event.kind = tempo_.is_paused ? SessionEvent::Kind::paused : SessionEvent::Kind::unpaused;
  tell(event);
  if (is_blocked_) unblocked(now);
  is_blocked_ = false;
  // The others hear of it when it has reached them, and begin then.
  if (!tempo_.is_paused) clock_.start(config_.host ? now + stats_.round_trip / 2 : now);
}

}  // namespace isostep
