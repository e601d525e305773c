// Checking one file: a replay of any game, or a golden list of hashes.
// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "isostep/world/replay_check.hpp"

namespace isostep::tool {

struct CheckedFile : CheckedReplay {
  std::string path = {};
  std::string missing = {};  // why the file could not be read; empty: it was
  std::string limit = {};    // what stopped it, if anything did
};
/// 0..5 as `verify` exits, or 66.
int status_of(const CheckedFile& file);
std::string text_of(const CheckedFile& file);

/// The named scene again, as many frames as there are lines.
CheckedFile check_golden(const std::string& name, std::string_view text, Simd simd = Simd::best,
                         const VerifySpan& span = {});
/// That, or a replay, by the path's end. Of the span `go_on` counts.
CheckedFile check_file(const std::string& path, const VerifySpan& span = {});

}  // namespace isostep::tool
