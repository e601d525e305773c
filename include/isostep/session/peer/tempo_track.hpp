// TempoTrack: the pauses and speeds that are announced, and which of them is in force.
// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "isostep/session/pace/tempo.hpp"
#include "isostep/session/timeline/input_stream.hpp"

namespace isostep {

/// In: the host's announcements. Out: the one to take up now. Keeps: the newest, and the one in force.
class TempoTrack {
 public:
  const Tempo& announced() const { return announced_; }
  const Tempo& in_force() const { return in_force_; }
  /// Takes an announcement if it is newer than the last, or the first one of a new host.
  void hear(const Tempo& tempo) {
    if (is_known_ && tempo.number <= announced_.number) return;
    is_known_ = true;
    announced_ = tempo;
  }
  void forget() { is_known_ = false; }
  /// We are the host now: our announcements continue the earlier numbers.
  void take_over() { is_known_ = true; }
  /// Host: announces a tempo for the first frame that nobody can have stepped before hearing of it.
  void announce(Tempo tempo, Frame current, const std::vector<InputStream>& streams, Frame window) {
    Frame from = current;
    // Who has not heard of it lacks the inputs that are not here yet, and steps no more than the window beyond them.
    if (!in_force_.is_paused) {
      for (const InputStream& stream : streams) from = from < stream.end() ? stream.end() : from;
      from += window;
    }
    tempo.number = announced_.number + 1;
    tempo.from = from;
    is_known_ = true;
    announced_ = tempo;
  }
  std::optional<Tempo> due_at(Frame current) const {
    const bool is_new = announced_.number != in_force_.number || !announced_.same_as(in_force_);
    if (!is_new || !is_known_) return std::nullopt;
    if (current >= announced_.from) return announced_;
    if (!in_force_.is_paused) return std::nullopt;
    // What is announced for later says that the pause is over; the word on that was lost.
    Tempo goes_on = in_force_;
    goes_on.is_paused = false;
    return goes_on;
  }
  void take_up(const Tempo& tempo) { in_force_ = tempo; }

 private:
  Tempo announced_, in_force_;
  bool is_known_ = false;
};

}  // namespace isostep
