// Bodies for levels: what scenes and tests drop in them.
// SPDX-License-Identifier: MIT
#pragma once

#include "level.hpp"

namespace isostep::scenes {

/// Box, sphere, capsule, hull, cylinder, cone in turn, up to half a metre from its centre.
SceneBody drawn_visitor(int n, Point at, Draws& draws);

}  // namespace isostep::scenes
