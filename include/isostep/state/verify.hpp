// verify: does a simulation that starts where a replay starts and gets its inputs pass through the same states?
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "isostep/state/concepts.hpp"
#include "isostep/state/replay_format.hpp"

namespace isostep {

/// The order is that of the tool's exit codes.
enum class VerifyOutcome : std::uint8_t { verified, diverged, incompatible, truncated, corrupt, stopped };

struct VerifyResult {
  enum class Where : std::uint8_t { start, frame, keyframe };

  VerifyOutcome outcome;
  Where where;           // diverged: at the initial state, after a frame, or a stored keyframe is not the state
  std::uint64_t frames;  // verified: compared; else the frame that diverged, or the first that is missing or not played
  std::uint64_t expected;   // diverged: the replay's hash
  std::uint64_t actual;     // diverged: ours
  std::size_t offset;       // truncated, corrupt: the place in the file [bytes]
  HeaderMismatch mismatch;  // incompatible
  Error error;              // truncated, corrupt
};

inline constexpr std::uint64_t kAllFrames = ~std::uint64_t{0};

/// The part of a replay that is played.
struct VerifySpan {
  std::uint64_t first = 0;           // frames before it
  std::uint64_t count = kAllFrames;  // at most
  Bytes state = {};  // portable, after `first` frames; empty: the replay's own start, where `first` is 0
  /// Called before every frame. False: the caller stops verify, for lack of time or whatever it counts.
  bool (*go_on)(void* user) = nullptr;
  void* user = nullptr;
};

/// Returns 0 verified, 1 diverged, 2 incompatible, 3 truncated, 4 corrupt, 5 stopped by its caller.
int exit_code(VerifyOutcome outcome);
/// "DIVERGED at frame 17: 0123456789abcdef in the replay, fedcba9876543210 here"
std::string describe(const VerifyResult& result);

namespace detail {
/// Returns the file's own verdict before any simulation runs; `verified` if nothing speaks against it.
VerifyResult verify_file(const ReplayReader& replay);
/// Returns the result when all `compared` frames agreed.
VerifyResult verify_end(const ReplayReader& replay, std::uint64_t compared);
VerifyResult too_short(const ReplayReader& replay);
VerifyResult stopped(std::uint64_t frames);
VerifyResult diverged(VerifyResult::Where where, std::uint64_t frames, std::uint64_t expected, std::uint64_t actual);
VerifyResult corrupt(std::uint64_t frames, std::size_t offset, const Error& error);
VerifyResult incompatible(const HeaderMismatch& mismatch);
bool same_bytes(Bytes a, Bytes b);

/// Makes `sim` the span's start. Returns `verified` if that can be read.
template <ReplayableSimulation Sim>
ISO_INLINE VerifyResult read_start(const ReplayReader& replay, Sim& sim, const VerifySpan& span) {
  const bool own = span.state.empty();
  Reader reader(own ? replay.state() : span.state);
  Result<void> read = sim.read_portable(reader);
  if (read) {
    reader.expect_end();
    read = reader.result(own ? "INIT" : "state");
  }
  if (!read) return corrupt(span.first, (own ? replay.state_offset() : 0) + reader.offset(), read.error());
  return {};
}

/// `sim` is at the span's start, which must be the replay's state there. Steps through the frames that the reader
/// holds. A keyframe must equal the reached state byte for byte.
template <ReplayableSimulation Sim>
ISO_INLINE VerifyResult verify_frames(const ReplayReader& replay, Sim& sim, const VerifySpan& span) {
  const std::uint64_t expected = span.first == 0 ? replay.state_hash() : replay.frame(span.first - 1).hash;
  const std::uint64_t begun = sim.hash();
  if (begun != expected) return diverged(VerifyResult::Where::start, span.first, expected, begun);

  const std::uint64_t left = replay.frame_count() - span.first;
  const std::uint64_t count = left < span.count ? left : span.count;
  std::vector<std::uint8_t> written;
  std::size_t next_key = 0;
  const std::vector<ReplayKeyframe>& keys = replay.keyframes();
  while (next_key < keys.size() && keys[next_key].frames < span.first) ++next_key;
  for (std::uint64_t i = span.first;; ++i) {
    for (; next_key < keys.size() && keys[next_key].frames == i; ++next_key) {
      const std::uint64_t hash = sim.hash();
      written.clear();
      Writer writer(written);
      sim.write_portable(writer);
      if (keys[next_key].hash != hash || !same_bytes(keys[next_key].state, written)) {
        return diverged(VerifyResult::Where::keyframe, i, keys[next_key].hash, hash);
      }
    }
    if (i == span.first + count) return verify_end(replay, count);
    if (span.go_on != nullptr && !span.go_on(span.user)) return stopped(i);
    const ReplayFrame frame = replay.frame(i);
    const Result<void> stepped = sim.step_recorded(frame.input);
    if (!stepped) return corrupt(i, replay.offset_of(frame.input), stepped.error());
    const std::uint64_t hash = sim.hash();
    if (hash != frame.hash) return diverged(VerifyResult::Where::frame, i, frame.hash, hash);
  }
}
}  // namespace detail

/// `check_header(header)` returns a HeaderMismatch; with an empty key the replay is accepted. The former state of `sim`
/// does not matter. A damaged file is never stepped. A cut one is, as far as it goes, and may turn out to diverge.
template <ReplayableSimulation Sim, class Check>
requires requires(Check& check_header, const ReplayHeader& header) { HeaderMismatch(check_header(header)); }
ISO_INLINE VerifyResult verify_replay(const ReplayReader& replay, Sim& sim, Check&& check_header,
                                      const VerifySpan& span = {}) {
  const VerifyResult file = detail::verify_file(replay);
  if (file.outcome != VerifyOutcome::verified) return file;
  if (replay.has_header()) {
    const HeaderMismatch mismatch = check_header(replay.header());
    if (!mismatch.key.empty()) return detail::incompatible(mismatch);
  }
  if (!replay.has_state()) return detail::verify_end(replay, 0);
  if (span.first > replay.frame_count()) return detail::too_short(replay);
  const VerifyResult start = detail::read_start(replay, sim, span);
  return start.outcome == VerifyOutcome::verified ? detail::verify_frames(replay, sim, span) : start;
}

/// Accepts a file that has the same required fields as `here`.
struct SameHeader {
  const ReplayHeader& here;
  ISO_INLINE HeaderMismatch operator()(const ReplayHeader& file) const { return compare_headers(file, here); }
};

}  // namespace isostep
