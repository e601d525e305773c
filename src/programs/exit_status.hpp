// The exit status of our programs.
// SPDX-License-Identifier: MIT
#pragma once

namespace isostep {

/// sysexits.h. Who verifies has its own before: 0 verified, 1 diverged, 2 incompatible, 3 truncated, 4 corrupt,
/// 5 stopped by a limit.
namespace exit_status {
inline constexpr int kOk = 0;
inline constexpr int kDifferent = 1;
inline constexpr int kUsage = 64;
inline constexpr int kNoInput = 66;
inline constexpr int kUnavailable = 69;
inline constexpr int kSoftware = 70;
inline constexpr int kOutput = 74;
inline constexpr int kInterrupted = 130;
}  // namespace exit_status

}  // namespace isostep
