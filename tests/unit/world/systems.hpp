// The common part of the tests of systems: a state with its caches, without a world around it.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/store/body_map.hpp"
#include "isostep/store/proxies.hpp"
#include "isostep/store/state_loader.hpp"
#include "isostep/systems/sleep/island_wake.hpp"
#include "unit/world/worlds.hpp"

namespace isostep::test {

/// The scalars are a float and a fixed point: systems hold no code of one scalar alone.
using SystemScalars = ::testing::Types<float, Q32_32>;

template <class S> struct Systems {
  explicit Systems(const World<S>& world) { loader.load(world.state()); }

  void find_pairs() { proxies.update(state.contacts, static_cast<std::size_t>(state.settings.most_pairs)); }
  BodyState<S>& awake(BodyId body) { return state.awake.states[map.location(body.slot).index]; }
  bool is_asleep(BodyId body) const { return map.location(body.slot).is_asleep(); }

  WorldState<S> state;
  BodyMap<S> map{state};
  Proxies<S> proxies{state.shapes};
  StateLoader<S> loader{state, map, proxies};
  IslandWake<S> wake{state, map, proxies};
};

}  // namespace isostep::test
