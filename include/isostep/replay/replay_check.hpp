// check_replay: whether any recording comes out here, by the world and the scalar that its header names. Needs none of
// the code of the game that was recorded.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "isostep/core/simd_choice.hpp"
#include "isostep/state/verify.hpp"

namespace isostep {

struct ReplayCheck {
  Simd simd = Simd::best;                        // or the widest narrower lanes; never changes a bit
  VerifySpan span = {};                          // the frames that are played
  std::vector<std::uint8_t>* reached = nullptr;  // gets the portable state after the last frame, where all are verified
};

struct CheckedReplay {
  std::string scene, scalar;  // empty where the file does not tell
  const char* lanes = "";     // that stepped it; empty: nothing did
  VerifyResult result{};
  const char* left_out = nullptr;  // the method that this build lacks for it; it is incompatible then
};

/// Refuses a file of another behaviour version, as it does one in which any other required field differs.
CheckedReplay check_replay(Bytes file, const ReplayCheck& checks = {});

}  // namespace isostep
