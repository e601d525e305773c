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

/// The first replay that did not come out.
struct SelfcheckFailure {
  std::string recording, scalar, lanes;
  VerifyResult result{};  // the frame with both hashes, or why it was not played
};

struct SelfcheckResult {
  /// Deviations (bits of scalar/environment.hpp) of the library's arithmetic in the environment that steps run in.
  std::uint32_t engine = 0;
  /// The deviations of the calling file's flags in the calling thread's environment, likewise. The engine does not
  /// depend on them; float arithmetic of the caller's own does.
  std::uint32_t caller = 0;
  std::vector<SelfcheckPart> parts;
  std::optional<SelfcheckFailure> failure;
  const char* left_out = nullptr;  // why recordings were skipped

  /// Every scalar of the build with every set of lanes has frames that agree, and none that does not.
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

/// One line: the result, the build, what was compared and the first failure.
std::string describe(const SelfcheckResult& result);
/// "flush-float rounding", empty for 0.
std::string deviation_names(std::uint32_t deviations);

/// A file of replays/selfcheck as it was when the library was built.
struct SelfcheckRecording {
  const char* name;    // "medley"
  const char* scalar;  // ScalarTraits::kName
  Bytes file;
};

namespace detail {
/// Those of the build's scalars.
std::span<const SelfcheckRecording> selfcheck_recordings();
SelfcheckResult selfcheck(std::span<const SelfcheckRecording> recordings, std::uint32_t caller);
}  // namespace detail

/// Replays the built-in recordings in every scalar of the build with every set of lanes that the processor has, and
/// probes the floating-point environment. Half a second on a PC; allocates; safe on any thread. What is not called is
/// not linked. Of scalars added by a program it knows nothing.
ISO_INLINE SelfcheckResult selfcheck() {
  return detail::selfcheck(detail::selfcheck_recordings(), probe_environment_here());
}

}  // namespace isostep
