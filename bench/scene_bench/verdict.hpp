// Whether a run failed its scene, and which bar it reached.
// SPDX-License-Identifier: MIT
#pragma once

#include "race.hpp"

namespace isostep::bench {

/// Dynamic bodies whose centre is not where the scene keeps them: in the pit, above the floor, in the drum.
int count_outside(const scenes::Scene& scene, const std::vector<Place>& places);

/// Sets `failed` (the scene is lost: fallen, apart, outside, no numbers) and, for our rows, `bar`.
void judge(Row& row);

}  // namespace isostep::bench
