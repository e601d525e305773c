// All differences of two states of worlds, by name.
// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>

#include "isostep/core/scalars.hpp"
#include "isostep/particles/particle_state.hpp"
#include "isostep/state/diff.hpp"
#include "isostep/store/state.hpp"

namespace isostep::tool {

/// All differences of two states of one kind of world, in the order in which the state hash takes them; rows by whose
/// they are, for others may be awake in each. Compiled for the states of worlds.
template <class State> void diff_states(const State& a, const State& b, DiffReport& report);

/// The owner of an index of an awake array: "body slot 17", "body slots 3 and 9"; empty for other paths.
template <class S> std::string owner_of(const WorldState<S>& state, std::string_view path);
/// The owner in a particle world: arrays of particles are by slot; empty for paths that say so themselves.
template <class S> std::string owner_of(const ParticleState<S>& state, std::string_view path);

}  // namespace isostep::tool
