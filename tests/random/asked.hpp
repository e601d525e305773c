// The number of random worlds that a run asks for, where it asks for other than the test's own.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <cstdlib>

namespace isostep::test {

/// The environment variable's number, or `otherwise` where it is not set.
inline std::uint64_t asked(const char* variable, std::uint64_t otherwise) {
  const char* text = std::getenv(variable);
  return text != nullptr ? std::strtoull(text, nullptr, 10) : otherwise;
}

}  // namespace isostep::test
