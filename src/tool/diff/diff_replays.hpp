// The common part of both ways of comparing replays: whether two can be compared at all, and what was recorded of those
// that play alike.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "tool/common/recorded_file.hpp"

namespace isostep::tool {

inline constexpr char kCommandsDiffer[] = "  the commands or steps of this frame differ\n";

/// Returns false after a line on stdout that says what differs.
bool are_comparable(const RecordedWorld& a, const RecordedWorld& b);

/// Reports recorded hashes that differ though both play alike here: at least one was recorded by something that behaves
/// otherwise. Returns an exit status.
int report_recorded(std::uint64_t frame, std::uint64_t a, std::uint64_t b, std::uint64_t here);

/// The recorded hashes of replays that play alike for so many frames agree as well, those of one replay twice with what
/// is played here. False after a line on stdout that says where they do not.
bool are_recorded_alike(const Input& a, const Input& b, std::uint64_t frames);

}  // namespace isostep::tool
