// A recording played stage by stage, whatever its world: the hash of what every stage left, and the fields behind one
// of them. What two builds that part are compared by.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "isostep/core/result.hpp"
#include "isostep/core/simd.hpp"
#include "isostep/state/fields.hpp"
#include "isostep/state/verify.hpp"

namespace isostep {

/// The name in place of a stage's for what came before a step's first one, and in the end after the last step.
inline constexpr char kCommandsStage[] = "commands";

struct StagePoint {
  std::uint64_t frame = 0;
  std::uint32_t step = 1;  // of the frame, from 1; one more than it has: when all are over
  std::string stage;       // by name, or kCommandsStage

  friend ISO_INLINE bool operator==(const StagePoint& a, const StagePoint& b) {
    return a.frame == b.frame && a.step == b.step && a.stage == b.stage;
  }
};
/// "12" or, of a frame with several steps, "12.2"; false for anything else.
bool read_stage_step(std::string_view text, StagePoint& point);

/// One bit of one field is turned right after the stage.
struct StageFault {
  StagePoint at;
  std::string path;
  std::uint32_t bit = 0;
  bool heals = false;  // turned back once it has been looked at: an index may be changed, too
};
/// "FRAME[.STEP]:STAGE:PATH:BIT"
bool read_stage_fault(std::string_view text, StageFault& fault);

struct StagedReplay {
  Simd simd = Simd::best;             // changes neither a bit nor what is looked at
  std::uint64_t frames = kAllFrames;  // at most
  const StageFault* fault = nullptr;  // or none
};

/// `hash` is StageView's.
struct TracedStage {
  std::uint64_t frame;
  std::uint32_t step;
  const char* stage;
  std::uint64_t hash;
};
struct TraceSink {
  void (*stage)(void* user, const TracedStage& traced);
  void* user;
};

/// Every stage of every step, and the end of every frame. A recording that is cut off is played as far as it goes. What
/// it says of its behaviour version does not matter, nor do its hashes: `invalid` is a fault that was not injected, all
/// else is the file's.
Result<void> trace_stages(const ReplayReader& replay, const StagedReplay& how, const TraceSink& sink);

/// Visits the fields at one point; `invalid` when the recording has not got it.
Result<void> visit_stage(const ReplayReader& replay, const StagedReplay& how, const StagePoint& at,
                         const FieldSink& sink);

}  // namespace isostep
