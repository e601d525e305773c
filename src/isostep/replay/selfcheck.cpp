// The self-check: recordings replayed in every scalar with every set of lanes, and the result as a line.
// SPDX-License-Identifier: MIT
#include "isostep/replay/selfcheck.hpp"

#include "isostep/core/version.hpp"
#include "isostep/replay/replay_check.hpp"
#include "isostep/scalar/environment.hpp"
#include "isostep/world/world.hpp"

namespace isostep {
namespace {

constexpr Simd kLanes[] = {Simd::scalar, Simd::sse2, Simd::avx2, Simd::avx512, Simd::neon, Simd::wasm};

void tell(const SelfcheckRecording& recording, const SelfcheckPart& part, const VerifyResult& played,
          SelfcheckFailure& failure) {
  failure.recording = recording.name;
  failure.scalar = part.scalar;
  failure.lanes = part.lanes;
  failure.result = played;
}

/// All of a scalar with the lanes of one set.
void replay_all(std::span<const SelfcheckRecording> recordings, Simd simd, SelfcheckPart& part,
                SelfcheckResult& result) {
  for (const SelfcheckRecording& recording : recordings) {
    if (std::string_view(recording.scalar) != part.scalar) continue;
    const CheckedReplay checked = check_replay(recording.file, {.simd = simd});
    if (checked.left_out != nullptr) {
      part.skipped += 1;
      result.left_out = checked.left_out;
      continue;
    }
    part.recordings += 1;
    if (checked.result.outcome == VerifyOutcome::verified) {
      part.frames += checked.result.frames;
      continue;
    }
    part.failed += 1;
    if (!result.failure) tell(recording, part, checked.result, result.failure.emplace());
  }
}

template <class S> void replay_in(std::span<const SelfcheckRecording> recordings, SelfcheckResult& result) {
  for (const Simd simd : kLanes) {
    World<S> world;
    if (!world.use_simd(simd)) continue;
    SelfcheckPart part = {ScalarTraits<S>::kName, world.simd_name(), 0, 0, 0, 0};
    replay_all(recordings, simd, part, result);
    result.parts.push_back(part);
  }
}

std::uint32_t engine_deviations() {
  return pin_floats([&] { return probe_environment(); });
}

void add_word(std::string& words, const char* word) {
  const std::string whole = std::string(" ").append(word).append(" ");
  if (std::string(" ").append(words).append(" ").find(whole) != std::string::npos) return;
  if (!words.empty()) words += ' ';
  words += word;
}

/// "1200 frames of 24 replays agree: float double by scalar sse2"
std::string compared_text(const SelfcheckResult& result) {
  std::string scalars, lanes, without;
  std::uint32_t replays = 0, failed = 0, skipped = 0;
  for (const SelfcheckPart& part : result.parts) {
    add_word(part.recordings > 0 ? scalars : without, part.scalar);
    add_word(lanes, part.lanes);
    replays += part.recordings;
    failed += part.failed;
    skipped += part.skipped;
  }
  std::string text = std::to_string(result.frames()) + " frames of " + std::to_string(replays) + " replays agree";
  if (replays > 0) text += ": " + scalars + " by " + lanes;
  if (failed > 0) text += "; " + std::to_string(failed) + " replays do not";
  if (skipped > 0) text += "; " + std::to_string(skipped) + " replays skipped: " + result.left_out;
  if (!without.empty()) text += "; no replays of " + without;
  return text;
}

}  // namespace

namespace detail {

SelfcheckResult selfcheck(std::span<const SelfcheckRecording> recordings, std::uint32_t caller) {
  SelfcheckResult result;
  result.engine = engine_deviations();
  result.caller = caller;
#define ISO_REPLAY_IN(S) replay_in<S>(recordings, result);
  ISO_FOR_EACH_SCALAR(ISO_REPLAY_IN)
#undef ISO_REPLAY_IN
  return result;
}

}  // namespace detail

std::string deviation_names(std::uint32_t deviations) {
  std::string names;
  for (int i = 0; i < kDeviationCount; ++i) {
    if ((deviations >> i & 1u) != 0) add_word(names, kDeviationNames[i]);
  }
  return names;
}

std::string describe(const SelfcheckResult& result) {
  std::string text = result.sound() ? "sound: isostep " : "NOT SOUND: isostep ";
  text += std::string(kVersionText) + ", " + compiler_name() + ", " + architecture_name() + ", behaviour ";
  text += ShortText<16>().append_hex(behaviour_version()).view();
  text += "; " + compared_text(result);
  if (result.failure) {
    const SelfcheckFailure& first = *result.failure;
    text += "; " + first.recording + " in " + first.scalar + " by " + first.lanes + ": " + describe(first.result);
  }
  if (result.engine != 0) text += "; the engine's arithmetic: " + deviation_names(result.engine);
  if (result.caller != 0) text += "; the caller's own arithmetic: " + deviation_names(result.caller);
  return text;
}

}  // namespace isostep
