// The ground of the scenes on terrain, for their judges and for scenes of other files.
// SPDX-License-Identifier: MIT
#pragma once

#include "scene.hpp"

namespace isostep::scenes {

/// [m] The height of the hills of S11, S12 and S15 over x and z.
double hill_height(double x, double z);
/// [m] The height of the hills at the low corner of the cell over x and z.
double hill_corner(double x, double z);
/// The mesh of them, and nothing else.
Scene hills();

}  // namespace isostep::scenes
