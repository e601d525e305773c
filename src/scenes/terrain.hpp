// The ground of the scenes on terrain, for their judges.
// SPDX-License-Identifier: MIT
#pragma once

namespace isostep::scenes {

/// [m] Of the hills of S11, S12 and S15 over x and z.
double hill_height(double x, double z);

}  // namespace isostep::scenes
