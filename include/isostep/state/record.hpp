// Recorder: a ReplayWriter that takes states from the simulation itself, and inputs, of any kind, from the caller.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "isostep/state/concepts.hpp"
#include "isostep/state/replay_format.hpp"

namespace isostep {

/// Call begin; for every frame step the simulation and pass its input and hash; then finish. Without `finish` the file
/// is truncated, and its whole blocks still play.
template <PortableState Sim> class Recorder {
 public:
  /// `block_frames`: see ReplayWriter.
  ISO_INLINE explicit Recorder(ReplaySink sink, std::uint32_t block_frames = 0) : writer_(sink, block_frames) {}

  ISO_INLINE Result<void> begin(const Sim& sim, const ReplayHeader& header) {
    return writer_.begin(header, portable(sim), sim.hash());
  }
  ISO_INLINE Result<void> frame(Bytes input, std::uint64_t hash) { return writer_.frame(input, hash); }
  /// Writes a keyframe, which is a state to seek to: that of `sim` after the last frame.
  ISO_INLINE Result<void> keyframe(const Sim& sim) { return writer_.keyframe(portable(sim), sim.hash()); }
  /// Passes all frames so far to the sink: they survive a crash.
  ISO_INLINE Result<void> flush() { return writer_.flush(); }
  ISO_INLINE Result<void> finish() { return writer_.finish(); }

  ISO_INLINE ReplayWriter& writer() { return writer_; }

 private:
  ISO_INLINE Bytes portable(const Sim& sim) {
    bytes_.clear();
    Writer writer(bytes_);
    sim.write_portable(writer);
    return bytes_;
  }

  ReplayWriter writer_;
  std::vector<std::uint8_t> bytes_;
};

}  // namespace isostep
