// selfcheck: does this build compute, on this machine, what the library's recordings say? What a game asks at start.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "isostep/core/bytes.hpp"
#include "isostep/scalar/environment.hpp"
#include "isostep/state/verify.hpp"

namespace isostep {

/// The recordings of one scalar, replayed with one set of lanes.
struct SelfcheckPart {
  const char* scalar;        // ScalarTraits::kName
  const char* lanes;         // World::simd_name()
  std::uint32_t recordings;  // replayed; 0: the library carries none of this scalar
  std::uint32_t failed;      // of these
  std::uint32_t skipped;     // not replayed: of a method that the build leaves out
  std::uint64_t frames;      // whose hashes were computed again and agreed
};

/// The first replay that failed.
struct SelfcheckFailure {
  std::string recording, scalar, lanes;
  VerifyResult result{};  // the frame with both hashes, or why it was not played
};

struct SelfcheckResult {
  /// Deviations (bits of scalar/environment.hpp) of the library's arithmetic in the environment that steps run in.
  std::uint32_t engine = 0;
  /// Deviations, likewise, of the calling file's flags in the calling thread's environment. The engine does not depend
  /// on them; float arithmetic of the caller's own does.
  std::uint32_t caller = 0;
  std::vector<SelfcheckPart> parts;
  std::optional<SelfcheckFailure> failure;
  const char* left_out = nullptr;  // why recordings were skipped

  /// Returns true if all parts have frames that agree, no replay failed, and the engine's arithmetic is sound.
  ISO_INLINE bool sound() const {
    bool compared = !parts.empty();
    for (const SelfcheckPart& part : parts) compared = compared && part.frames > 0;
    return compared && engine == 0 && !failure;
  }
  ISO_INLINE std::uint64_t frames() const {
    std::uint64_t sum = 0;
    for (const SelfcheckPart& part : parts) sum += part.frames;
    return sum;
  }
};

/// Returns one line: the result, the build, what was compared and the first failure.
std::string describe(const SelfcheckResult& result);
/// Returns "flush-float rounding", for example; empty for 0.
std::string deviation_names(std::uint32_t deviations);

/// A file of replays/selfcheck as it was when the library was built.
struct SelfcheckRecording {
  const char* name;    // "medley"
  const char* scalar;  // ScalarTraits::kName
  Bytes file;
};

namespace detail {
/// Returns the recordings of the build's scalars.
std::span<const SelfcheckRecording> selfcheck_recordings();
SelfcheckResult selfcheck(std::span<const SelfcheckRecording> recordings, std::uint32_t caller);
}  // namespace detail

/// Replays the built-in recordings in every scalar of the build with every set of lanes that the processor has, and
/// probes the floating-point environment. It takes half a second on a PC, allocates, and is safe on any thread. If it
/// is not called, it is not linked. It knows nothing of scalars that a program adds.
ISO_INLINE SelfcheckResult selfcheck() {
  return detail::selfcheck(detail::selfcheck_recordings(), probe_environment_here());
}

}  // namespace isostep
