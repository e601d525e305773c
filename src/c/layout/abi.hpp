// The version of the C interface.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

namespace isostep::c {

/// The number in the soname. It grows if a program that was built before cannot run: the gate in tests/c says so.
inline constexpr std::uint32_t kAbiVersion = 0;

}  // namespace isostep::c
