// The scripts of scenes: world commands alone between frames, chosen from the tick and the world's state.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/world/world.hpp"
#include "scene.hpp"

namespace isostep::scenes {

/// Call before every step: the script, and the pieces of what broke. Remembers nothing: after a load it does the same.
template <class S> void before_step(Script script, World<S>& world);

#define ISO_EXTERN(S) extern template void before_step<S>(Script, World<S>&);
ISO_FOR_EACH_SCALAR(ISO_EXTERN)
#undef ISO_EXTERN

}  // namespace isostep::scenes
