// break_bodies: pieces in place of the bodies that a step broke, as commands.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "isostep/core/instantiate.hpp"
#include "isostep/world/world.hpp"

namespace isostep {

struct BreakReport {
  std::uint32_t broken = 0;   // bodies that pieces took the place of
  std::uint32_t pieces = 0;   // of them all
  std::uint32_t whole = 0;    // marked bodies that could not be broken: too small, or of a shape that does not break
  std::uint32_t expired = 0;  // bodies whose time was over
};

/// Breaks bodies. For each Breakable record of an enabled body, in order: a marked body is destroyed and its pieces are
/// created, moving on as it did (shatter()); one that expired is destroyed. Call it once a frame, after the step or
/// before the next. All of it follows from the state, by commands: recordings play without it, and after a load it does
/// the same again. Pieces have the record's numbers with depth less one, break_impulse by their share of the mass, and
/// `expires` where they are lighter than small_mass; their shapes are their own, and go with them. Those that can
/// neither break nor expire have no record. A body that cannot be broken keeps its record, without the mark.
/// Cost:   some 0.7 ms a body, for the hulls of its pieces. `most` bodies are tried in a call, those beyond keep their
///         marks for the next: a blow at a hundred bodies takes a few frames more, and none of them is late.
/// Seeds:  the record's, the body's id and the tick.
template <class S> BreakReport break_bodies(World<S>& world, std::uint32_t most = 0xffffffffu);

#define ISO_BREAKING_OF(extern, S) extern template BreakReport break_bodies<S>(World<S>&, std::uint32_t);
ISO_EXTERN_FOR_EACH_SCALAR(ISO_BREAKING_OF)

}  // namespace isostep
