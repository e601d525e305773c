// StateLoader<S>: replaces the state by another one.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "isostep/core/instantiate.hpp"
#include "isostep/store/body_map.hpp"
#include "isostep/store/proxies.hpp"

namespace isostep {

/// Input:   the state to take, of the same settings or read from a file.
/// Output:  that state; the body map and the broad phase renewed where it differs.
/// Keeps:   nothing from call to call but memory.
/// Cost:    time for what is awake in either state, for the islands that only one of them has at their place, and for
///          the pages of static bodies that differ.
template <class S> class StateLoader {
 public:
  ISO_INLINE StateLoader(WorldState<S>& state, BodyMap<S>& map, Proxies<S>& proxies)
      : state_(state), map_(map), proxies_(proxies) {}

  void load(const WorldState<S>& from);

 private:
  void find_differences(const WorldState<S>& from);
  void forget_places();
  void forget(const BodySet<S>& bodies);
  void forget(const JointSet<S>& joints);
  void renew_places();
  void place(const BodySet<S>& bodies, bool awake);

  WorldState<S>& state_;
  BodyMap<S>& map_;
  Proxies<S>& proxies_;
  std::vector<std::uint32_t> other_islands_;  // indices at which the two states differ
  std::vector<std::uint32_t> other_pages_;    // likewise, of static bodies
  std::vector<std::uint32_t> forgotten_;      // slots of bodies
};

#define ISO_STATE_LOADER_OF(extern, S) extern template class StateLoader<S>;
ISO_EXTERN_FOR_EACH_SCALAR(ISO_STATE_LOADER_OF)

}  // namespace isostep
