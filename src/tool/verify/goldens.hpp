// The golden hashes that this build carries.
// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <span>
#include <string>

namespace isostep::tool {

/// A file of replays/goldens as it was when the tool was built.
struct GoldenText {
  const char* name;  // "S1x5.float.txt"
  const char* text;
};
/// Ascending by name.
std::span<const GoldenText> golden_texts();

struct GoldenName {
  std::string scene, scalar;
};
/// Nothing for a name that is not "SCENE.SCALAR.txt".
std::optional<GoldenName> parse_golden_name(const std::string& name);
std::string golden_name(const std::string& scene, const std::string& scalar);

}  // namespace isostep::tool
