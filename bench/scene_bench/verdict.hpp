// The verdict on a run: whether it failed its scene, and which bar it reached.
// SPDX-License-Identifier: MIT
#pragma once

#include "race.hpp"

namespace isostep::bench {

/// Sets `failed` (the scene is lost: fallen, apart, outside, no numbers) and, for our rows, `bar`.
void judge(Row& row);

}  // namespace isostep::bench
