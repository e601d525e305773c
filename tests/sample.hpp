// A test tries a sample of a sweep, or the whole where the environment says ISOSTEP_WHOLE=1, as `./isostep test --full`
// does. A sample has fewer seeds, frames or rows, and the same bounds.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdlib>
#include <string_view>

namespace isostep::test {

inline bool wants_whole() {
  const char* text = std::getenv("ISOSTEP_WHOLE");
  return text != nullptr && std::string_view(text) == "1";
}

template <class T> T sampled(T whole, T sample) { return wants_whole() ? whole : sample; }

/// A quarter of a sweep may meet half of the `most` known faults of the whole: few scatter.
inline int known_in_quarter(int most) { return sampled(most, (most + 1) / 2); }

}  // namespace isostep::test
