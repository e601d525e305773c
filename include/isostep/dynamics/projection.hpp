// The ways in which worst_first ends overlaps: the closed list that settings, scene files and the tool speak of.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "isostep/scalar/platform.hpp"

/// Expands ISO_FOR_EACH_PROJECTION(X) to X(name): in Projection, in scene files and on the command line. Millington
/// 2007, pp. 322-328:
///   nonlinear       moves and turns, each by its inverse inertia
///   linear          moves along the normal only
///   relaxed         as nonlinear, but by half of the missing distance each time that a contact is the worst
///   velocity_based  moves bodies back along the motion that they came with, to where they touched
#define ISO_FOR_EACH_PROJECTION(X) X(nonlinear) X(linear) X(relaxed) X(velocity_based)

namespace isostep {

#define ISO_ENUMERATOR(name) name,
enum class Projection : std::uint32_t { ISO_FOR_EACH_PROJECTION(ISO_ENUMERATOR) };
#undef ISO_ENUMERATOR

#define ISO_NAME(name) #name,
inline constexpr const char* kProjectionNames[] = {ISO_FOR_EACH_PROJECTION(ISO_NAME)};
#undef ISO_NAME
inline constexpr std::uint32_t kProjections = sizeof kProjectionNames / sizeof kProjectionNames[0];

}  // namespace isostep
