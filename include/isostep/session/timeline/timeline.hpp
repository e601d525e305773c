// Timeline: with which inputs every frame was stepped, and where that has turned out to be wrong.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "isostep/session/timeline/input_codec.hpp"
#include "isostep/session/timeline/input_stream.hpp"
#include "isostep/state/concepts.hpp"

namespace isostep {

/// Frames before current() have been stepped. What is not known is predicted; when it becomes known and is otherwise,
/// first_wrong() says from where to step again.
class Timeline {
 public:
  /// Remembers so many frames.
  Timeline(int players, Frame kept, const InputRules& rules);

  Frame current() const { return current_; }
  /// Nothing is stepped yet; the next frame is `current`.
  void restart(Frame current);
  /// Compares what has become known since the last call. At most current(): then all is well so far.
  Frame first_wrong(const std::vector<InputStream>& streams);
  /// The stream was cut at `end`: what was compared from there on must be compared again.
  void recheck(int player, Frame end);

  /// Fixes the inputs of frame current() and goes on to the next.
  void step(const std::vector<InputStream>& streams);
  /// The inputs of past frames from `frame` on are taken anew, up to current().
  void step_again(Frame frame, const std::vector<InputStream>& streams);

  /// With what a frame was stepped; the bytes are Input{} for who was absent.
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
