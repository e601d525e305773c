// The replay container: a file that only grows, whose every byte is covered by a checksum, and that cannot be cut,
// extended or altered and still be complete. It knows frames of opaque input bytes and their hashes, and nothing else.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "isostep/core/bytes.hpp"
#include "isostep/core/result.hpp"
#include "isostep/state/hash.hpp"
#include "isostep/state/replay_header.hpp"

namespace isostep {

inline constexpr std::uint16_t kReplayMajor = 2;
inline constexpr std::uint16_t kReplayMinor = 0;
inline constexpr std::size_t kReplayPreambleSize = 32;  // [bytes]
/// The high bit and both line ends show at once if the file was transferred as text.
inline constexpr std::uint8_t kReplayMagic[8] = {0x89, 'I', 'S', 'O', '\r', '\n', 0x1a, '\n'};
/// Returns true if the file begins as a replay does; the rest of it may be wrong.
bool has_replay_magic(Bytes file);
inline constexpr std::uint32_t kReplayBlockFrames = 60;  // at most in a block
/// Returns a second of frames, at most one block: a crash costs no more.
constexpr std::uint32_t second_of_frames(std::uint64_t hz) {
  return hz == 0 ? 1 : hz < kReplayBlockFrames ? static_cast<std::uint32_t>(hz) : kReplayBlockFrames;
}

/// Returns a chunk type of four letters. As a little-endian u32 they stand in the file in reading order.
constexpr std::uint32_t replay_chunk_type(char a, char b, char c, char d) {
  return std::uint32_t(a) | std::uint32_t(b) << 8 | std::uint32_t(c) << 16 | std::uint32_t(d) << 24;
}
namespace replay_chunk {
inline constexpr std::uint32_t kHead = replay_chunk_type('H', 'E', 'A', 'D');
inline constexpr std::uint32_t kInit = replay_chunk_type('I', 'N', 'I', 'T');
inline constexpr std::uint32_t kInput = replay_chunk_type('I', 'N', 'P', 'T');
inline constexpr std::uint32_t kHash = replay_chunk_type('H', 'A', 'S', 'H');
inline constexpr std::uint32_t kKeyframe = replay_chunk_type('K', 'E', 'Y', 'F');
inline constexpr std::uint32_t kDone = replay_chunk_type('D', 'O', 'N', 'E');
/// This bit of a chunk's first letter lets a reader that does not know the chunk skip it.
inline constexpr std::uint32_t kAncillaryBit = 0x20;
}  // namespace replay_chunk

// Caps on payloads [bytes], checked before anything is done with a length.
inline constexpr std::uint32_t kReplayHeadCap = 4 + kReplayFieldCap * (9 + kReplayKeyCap + kReplayValueCap);
inline constexpr std::uint32_t kReplayStateCap = 1u << 28;       // a portable snapshot
inline constexpr std::uint32_t kReplayFrameInputCap = 1u << 26;  // one frame's input: a scene of 150 000 bodies
inline constexpr std::uint32_t kReplayInputCap = 1u << 27;       // one block's inputs; a fuller one ends early
inline constexpr std::uint32_t kReplayUnknownCap = 1u << 24;
std::uint32_t replay_payload_cap(std::uint32_t type);

/// Receives a replay's bytes. If `write` returns false, the recording ends with an error.
struct ReplaySink {
  bool (*write)(void* context, const std::uint8_t* bytes, std::size_t size);
  void* context;
  /// Makes what `write` holds back safe from a crash. Called after every whole block. Null: nothing is held back.
  bool (*flush)(void* context) = nullptr;
};
/// Returns a sink that appends to `out`, which must outlive the writer.
ReplaySink sink_to(std::vector<std::uint8_t>& out);

/// Writes a replay from front to back. The written bytes are a valid beginning at every moment, and at most one block
/// of frames is held back. After an error every call returns that error.
class ReplayWriter {
 public:
  /// `block_frames`: the frames of a block, 1 to kReplayBlockFrames; 0: those of a second, by the header's hz.
  explicit ReplayWriter(ReplaySink sink, std::uint32_t block_frames = 0);
  ~ReplayWriter();
  ReplayWriter(const ReplayWriter&) = delete;
  ReplayWriter& operator=(const ReplayWriter&) = delete;

  /// `state`: the portable form of the state before the first frame. `hash`: its hash.
  Result<void> begin(const ReplayHeader& header, Bytes state, std::uint64_t hash);
  /// Writes the next frame: its input, and the hash of the state after it.
  Result<void> frame(Bytes input, std::uint64_t hash);
  /// Writes the state after the last frame, for seeking. Ends the block.
  Result<void> keyframe(Bytes state, std::uint64_t hash);
  /// Writes a chunk of the caller's own, whose type begins with a lower-case letter. Ends the block.
  Result<void> ancillary(std::uint32_t type, Bytes payload);
  /// Ends the block early and flushes the sink: all frames so far survive a crash.
  Result<void> flush();
  Result<void> finish();

  std::uint64_t frame_count() const;

 private:
  enum class Phase : std::uint8_t { fresh, open, done, failed };

  Result<void> refuse(ErrorCode code, const char* message);
  Result<void> require_open();
  Result<void> put(Bytes bytes);
  Result<void> put_chunk(std::uint32_t type, Bytes payload);
  Result<void> flush_sink();

  ReplaySink sink_;
  Phase phase_;
  Error error_;
  HashStream digest_;
  std::uint64_t frame_count_;               // with those of the open block
  std::uint32_t block_cap_;                 // frames that make a block
  std::uint32_t block_frames_;              // in the open block
  std::vector<std::uint8_t> block_inputs_;  // [u32 length, bytes] per frame
  std::vector<std::uint8_t> block_hashes_;  // u64 per frame
  std::vector<std::uint8_t> scratch_;
};

enum class ReplayStatus : std::uint8_t {
  complete,     // everything is there and agrees with itself
  truncated,    // ends early, or in zeros that were never written over; whole blocks before that can be played
  corrupt,      // contradicts itself
  incompatible  // intact, but made for another reader
};

struct ReplayFrame {
  Bytes input;  // a view into the file
  std::uint64_t hash;
};
struct ReplayKeyframe {
  std::uint64_t frames;  // stepped before it
  std::uint64_t hash;
  Bytes state;
  std::size_t offset;  // of its chunk
};

/// A chunk that a reader may skip. Its meaning is known to those who know its type.
struct ReplayAncillary {
  std::uint32_t type;
  Bytes payload;
};

/// Checks a whole file once, then gives views into it. Copies nothing of the file. Its own memory is a few words per
/// block, keyframe and ancillary chunk.
/// It does not tell if the hashes are true: that takes a simulation (verify.hpp).
class ReplayReader {
 public:
  /// `file` must outlive the reader.
  explicit ReplayReader(Bytes file);
  ~ReplayReader();
  ReplayReader(const ReplayReader&) = delete;
  ReplayReader& operator=(const ReplayReader&) = delete;

  ReplayStatus status() const;
  /// [bytes] The place in the file at which a status other than `complete` was found.
  std::size_t place() const;
  /// The error of a status other than `complete`.
  const Error& error() const;

  /// These are from the whole chunks before the place of the error:
  bool has_header() const;
  bool has_state() const;
  const ReplayHeader& header() const;
  Bytes state() const;
  std::size_t state_offset() const;
  std::uint64_t state_hash() const;
  /// The number of frames in whole blocks.
  std::uint64_t frame_count() const;
  /// Returns frame i < frame_count().
  ReplayFrame frame(std::uint64_t i) const;
  const std::vector<ReplayKeyframe>& keyframes() const;
  /// The ancillary chunks in the order of the file.
  const std::vector<ReplayAncillary>& ancillaries() const;
  /// [bytes] The offset in the file of a view that this reader gave out.
  std::size_t offset_of(Bytes view) const;

 private:
  struct Chunk {
    std::uint32_t type;
    std::size_t offset;
    Bytes payload;
  };
  struct Block {
    std::uint64_t first;
    std::uint32_t count;
    const std::uint8_t* inputs;
    const std::uint8_t* hashes;
  };
  enum class Expect : std::uint8_t { head, init, inputs, hashes, end };

  bool stop(ReplayStatus status, std::size_t place, const char* message);
  bool stop_at_damage(std::size_t offset, std::size_t size, std::size_t place, const char* message);
  bool read_preamble();
  bool read_chunk(std::size_t offset, Chunk& chunk);
  bool accept(const Chunk& chunk);
  bool accept_head(const Chunk& chunk);
  bool accept_init(const Chunk& chunk);
  bool accept_inputs(const Chunk& chunk);
  bool accept_hashes(const Chunk& chunk);
  bool accept_keyframe(const Chunk& chunk);
  bool accept_done(const Chunk& chunk);

  Bytes file_;
  ReplayStatus status_;
  std::size_t place_;
  Error error_;
  Expect expect_;
  ReplayHeader header_;
  bool has_header_;
  bool has_state_;
  Bytes state_;
  std::uint64_t state_hash_;
  std::uint64_t frame_count_;
  Block open_block_;  // its inputs are read, its hashes are not
  std::vector<Block> blocks_;
  std::vector<ReplayKeyframe> keyframes_;
  std::vector<ReplayAncillary> ancillaries_;
};

}  // namespace isostep
