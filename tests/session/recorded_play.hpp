// Replays of matches, tested: a recorder on a machine of a VirtualMatch, and a session that plays a file.
// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "isostep/session/observers/match_recorder.hpp"
#include "session/virtual_match.hpp"

namespace isostep::test {

template <class Game> struct Played {
  Frame first = kNoFrame;
  std::vector<std::uint64_t> hashes;
  std::vector<SessionEvent> events;
  SessionPhase phase = SessionPhase::waiting;
  bool heard(SessionEvent::Kind kind) const {
    for (const SessionEvent& event : events) {
      if (event.kind == kind) return true;
    }
    return false;
  }
  void confirmed(Frame frame, std::uint64_t hash) {
    if (hashes.empty()) first = frame;
    if (frame == first + static_cast<Frame>(hashes.size())) hashes.push_back(hash);
  }
};
/// Records what a machine of the match confirms, until `end`.
template <class Game> struct MachineRecorder {
  MachineRecorder(Machine<Game>& machine, std::vector<std::uint8_t>& file, Frame end = kLastFrame,
                  std::uint32_t block_frames = 0)
      : recorder(machine.session, *machine.game, sink_to(file), block_frames) {
    machine.will_step = [this](Frame frame) { recorder.before_step(frame); };
    machine.went_back = [this](Frame frame) { recorder.rolled_back(frame); };
    machine.restarts_at = [this](Frame frame) { recorder.restarted(frame); };
    machine.was_confirmed = [this, end](Frame frame, std::uint64_t hash) {
      if (frame < end) recorder.confirmed(frame, hash);
    };
  }
  MatchRecorder<Game> recorder;
};
template <class Game> Played<Game> play(const SessionConfig& recorded, Bytes file, Game game) {
  SessionConfig config = recorded;
  config.mode = SessionMode::replay;
  Session<Game> session(config, file);
  Played<Game> played;
  for (Time now = 0; now < 300 * kSecond && session.phase() != SessionPhase::over; now += 17000) {
    drive(session, game, now, played);
  }
  while (const std::optional<SessionEvent> event = session.poll_event()) played.events.push_back(*event);
  played.phase = session.phase();
  return played;
}

}  // namespace isostep::test
