// Timeline: with which inputs every frame was stepped, and where that has turned out to be wrong.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "isostep/session/timeline/input_codec.hpp"
#include "isostep/session/timeline/input_stream.hpp"
#include "isostep/state/concepts.hpp"

namespace isostep {

/// Holds the inputs with which the frames before current() were stepped. Unknown inputs are predicted. When an input
/// becomes known and differs, first_wrong() returns the frame from which to step again.
class Timeline {
 public:
  /// Keeps the newest `kept` frames.
  Timeline(int players, Frame kept, const InputRules& rules);

  Frame current() const { return current_; }
  /// Begins anew: nothing is stepped yet, and the next frame is `current`.
  void restart(Frame current);
  /// Compares inputs that became known since the last call. Returns the first mispredicted frame, or current().
  Frame first_wrong(const std::vector<InputStream>& streams);
  /// The player's stream was cut at `end`: its inputs from there on are compared again.
  void recheck(int player, Frame end);

  /// Fixes the inputs of frame current() and goes on to the next.
  void step(const std::vector<InputStream>& streams);
  /// Takes the inputs of the past frames from `frame` on from the streams again.
  void step_again(Frame frame, const std::vector<InputStream>& streams);

  /// The input with which a frame was stepped. `bytes` is Input{} if the player was absent.
  struct Used {
    InputStatus status;
    Bytes bytes;
  };
  Used used(Frame frame, int player) const;

 private:
  struct Cell {
    InputStatus status;
    std::uint16_t size;
  };
  std::size_t index(Frame frame, int player) const {
    return static_cast<std::size_t>(frame % kept_) * static_cast<std::size_t>(players_) +
           static_cast<std::size_t>(player);
  }
  void fill(Frame frame, int player, const InputStream& stream);
  bool was_right(Frame frame, int player, const InputEntry& entry) const;

  int players_;
  Frame kept_;
  InputRules rules_;
  Frame current_ = 0;
  Frame checked_[kMaxPlayers] = {};  // first frame whose input has not been compared
  std::vector<Cell> cells_;
  std::vector<std::uint8_t> bytes_;
};

}  // namespace isostep
