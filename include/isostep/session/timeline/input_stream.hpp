// InputStream: one player's inputs by frame, as a ring of the newest frames: what was said, or that nobody was there.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "isostep/core/bytes.hpp"
#include "isostep/session/timeline/frame.hpp"

namespace isostep {

/// The input of one player in one frame.
struct InputEntry {
  bool absent;  // nobody plays: the game sees InputStatus::disconnected and a neutral input
  Bytes bytes;  // empty when absent
};
ISO_INLINE bool same_input(const InputEntry& a, const InputEntry& b) {
  if (a.absent != b.absent || a.bytes.size() != b.bytes.size()) return false;
  for (std::size_t i = 0; i < a.bytes.size(); ++i) {
    if (a.bytes[i] != b.bytes[i]) return false;
  }
  return true;
}

/// Frames begin() .. end() - 1 are known; end() is the first that is missing. Allocates only when constructed.
class InputStream {
 public:
  /// Keeps the newest `capacity` frames, with inputs of at most `input_cap` bytes.
  InputStream(Frame capacity, std::size_t input_cap);

  /// Forgets all inputs. The next one is that of frame `first`.
  void reset(Frame first);
  Frame begin() const { return begin_; }
  Frame end() const { return end_; }
  bool contains(Frame frame) const { return frame >= begin_ && frame < end_; }

  /// Appends the input of frame end() and may drop the oldest. Returns false and does nothing if it is too long.
  bool append(const InputEntry& entry);
  void append_absent_until(Frame end);
  /// Forgets the inputs from frame `end` on.
  void truncate(Frame end);
  /// Replaces the input of a contained frame. Returns false and does nothing if it is too long.
  bool replace(Frame frame, const InputEntry& entry);
  /// Returns the input of a contained frame.
  InputEntry at(Frame frame) const;
  /// Returns true if a contained frame has the same input as the frame before, which is contained as well.
  bool repeats(Frame frame) const { return frame > begin_ && repeats_[slot(frame)] != 0; }
  /// Returns the newest input; absent if there is none.
  InputEntry last() const;

 private:
  std::size_t slot(Frame frame) const { return static_cast<std::size_t>(frame % capacity_); }
  void note_repeat(Frame frame);

  Frame capacity_;
  std::size_t input_cap_;
  Frame begin_ = 0, end_ = 0;
  std::vector<std::uint16_t> sizes_;  // of the slot's input; kAbsent when nobody was there
  std::vector<std::uint8_t> bytes_, repeats_;
};

/// Returns the first frame of which some player's input is missing.
inline Frame known_end(const std::vector<InputStream>& streams) {
  Frame end = streams[0].end();
  for (const InputStream& stream : streams) end = stream.end() < end ? stream.end() : end;
  return end;
}

}  // namespace isostep
