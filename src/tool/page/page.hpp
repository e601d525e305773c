// One self-contained HTML page that plays one recording, or two side by side.
// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>

#include "divergence.hpp"
#include "recording.hpp"

namespace isostep::tool::page {

/// This build holds three.js, without which there are no pages.
bool available();
/// The way to get a build that does, in one line.
std::string how_to_get();

struct Film {
  std::string scene;
  int every = 1;  // steps from one frame to the next
  Recording run;
  Recording beside;         // no frames: alone
  double tolerance = 0.01;  // [m]
  Divergence divergence;    // where there are two
};
std::string page_of(const Film& film);

}  // namespace isostep::tool::page
