// IslandSleep<S>: puts islands of bodies at rest to sleep.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "isostep/core/disjoint_sets.hpp"
#include "isostep/core/instantiate.hpp"
#include "isostep/dynamics/belt.hpp"
#include "isostep/dynamics/solver_body.hpp"
#include "isostep/store/body_map.hpp"
#include "isostep/store/proxies.hpp"

namespace isostep {

/// Input:   the state after a step: awake bodies with their sleep clocks, contacts and joints; their centres' poses as
///          the step began.
/// Output:  sleep clocks; islands whose bodies have all rested for half a second, moved from the awake arrays to
///          WorldState::sleeping, in the body map and the broad phase as well; the ids of their bodies.
/// Keeps:   nothing from step to step but memory.
template <class S> class IslandSleep {
 public:
  ISO_INLINE IslandSleep(WorldState<S>& state, BodyMap<S>& map, Proxies<S>& proxies)
      : state_(state), map_(map), proxies_(proxies) {}

  /// Appends to `fell_asleep`. `start`: the pose of each awake body as the step began. Bodies that touch one of `belts`
  /// stay awake; null: there are none. `pulls`: the accelerations of each awake body besides gravity, or empty.
  void update(std::vector<BodyId>& fell_asleep, std::span<const Pose<S>> start, const Belts<S>* belts = nullptr,
              std::span<const Acceleration<S>> pulls = {});

  /// Puts the island of an awake dynamic body to sleep at once, and drops its pending forces. The next step reports it.
  /// Returns false, with no change, if one of its bodies may not sleep.
  bool put_to_sleep(std::uint32_t slot);

 private:
  std::uint32_t delay() const;
  void update_clocks(std::span<const Pose<S>> start, std::span<const Acceleration<S>> pulls);
  void stop_clocks_of_carried(const Belts<S>* belts);
  const Material<S>& surface_of(const BodyProperties<S>& body, std::uint32_t slot, std::uint32_t leaf) const;
  void stop_clocks_of_motors();
  void stop_clocks_by_forces();
  void make_room();
  bool some_body_is_ready() const;

  bool is_dynamic(std::uint32_t slot) const;
  void find_islands();
  void find_island_clocks();
  template <class Visit> void for_each_wheel_on_ground(const Visit& visit) const;
  void tie_coupled(const Coupling<S>& coupling);
  bool mark_ready_islands();

  void move_marked_islands(std::vector<BodyId>& fell_asleep);
  SleepingIsland<S>* island_of(std::size_t index);
  SleepingIsland<S>* island_of_either(std::uint32_t slot_a, std::uint32_t slot_b);
  void move_contacts();
  void move_joints();
  void move_bodies(std::vector<BodyId>& fell_asleep);
  void list_islands();

  WorldState<S>& state_;
  BodyMap<S>& map_;
  Proxies<S>& proxies_;
  DisjointSets islands_;              // of indices of awake bodies
  std::vector<std::uint32_t> clock_;  // by island: the least of its bodies', then 1 if it falls asleep and 0 if not
  std::vector<std::shared_ptr<SleepingIsland<S>>> asleep_;  // by island
};

#define ISO_ISLAND_SLEEP_OF(extern, S) extern template class IslandSleep<S>;
ISO_EXTERN_FOR_EACH_SCALAR(ISO_ISLAND_SLEEP_OF)

}  // namespace isostep
