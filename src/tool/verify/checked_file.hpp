// The check of a replay of any game, or of one line of golden hashes.
// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "isostep/replay/replay_check.hpp"

namespace isostep::tool {

struct CheckedFile : CheckedReplay {
  std::string path = {};
  std::string missing = {};  // why the file could not be read; empty: it was
  std::string remark = {};   // which limit stopped it, or what else there is to say
};
/// 0..5 as `verify` exits, or 66.
int status_of(const CheckedFile& file);
std::string text_of(const CheckedFile& file);

/// One thing to check: a replay, or a line of a file of goldens.
struct Checkable {
  std::string path;  // a golden's ends in ":SCENE"
  std::optional<std::string> golden = std::nullopt;
};
/// A file's one replay, or the lines of a file of goldens, by the path's end.
std::vector<Checkable> checkables_in(const std::string& path);

/// Plays the scene of the line again, as many frames as it says.
CheckedFile check_golden(std::string_view line, Simd simd = Simd::best, const VerifySpan& span = {});
/// Looks at `go_on` of the span alone.
CheckedFile check(const Checkable& what, const VerifySpan& span = {});

}  // namespace isostep::tool
