// IslandWake<S>: wakes sleeping islands.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "isostep/core/instantiate.hpp"
#include "isostep/store/body_map.hpp"
#include "isostep/store/proxies.hpp"

namespace isostep {

/// Input:   the state, and the body or joint that is about to change.
/// Output:  the islands' bodies, contacts and joints among the awake ones, in canonical order, with sleep clocks of 0,
///          in the body map and the broad phase as well; WorldState::untold.woke.
/// Keeps:   nothing from call to call but memory.
template <class S> class IslandWake {
 public:
  ISO_INLINE IslandWake(WorldState<S>& state, BodyMap<S>& map, Proxies<S>& proxies)
      : state_(state), map_(map), proxies_(proxies) {}

  /// Wakes the island of a body, if it sleeps.
  void wake(std::uint32_t slot);
  /// Wakes islands one after another in this order, with one merge.
  void wake(std::span<const std::uint32_t> slot_list);
  void wake_all();
  /// Wakes islands that an awake moving body touches, that an awake wheel stands on, or that a fast kinematic body is
  /// about to pass through. Returns false if there are none. Woken bodies bring new pairs, so the caller updates the
  /// broad phase and calls again.
  bool wake_touched();
  /// Wakes every island and resets every body whose box meets the box of the body's parts, sensors excepted: a body
  /// that is moved, changed or removed may have held them up.
  void wake_touching(std::uint32_t slot);  // a sensor wakes nobody: it notes that the next step looks who sleeps in it
  /// Does so for a box [m] that is about to change, or has changed, except for `slot`, the body that changes.
  void wake_touching(const Aabb<S>& box, std::uint32_t slot);
  /// Wakes every island with a joint, spring, contact or wheel on a body that belongs to no island. Their boxes need
  /// not meet any more: a contact sleeps as the last step found it.
  void wake_held_by(std::uint32_t slot);
  /// Wakes every body with a wheel on that one inside the box [m]: the wheel's own body need not reach the ground.
  void wake_wheels_on(std::uint32_t slot, const Aabb<S>& box);
  /// Wakes the joint's island and resets the sleep clocks of its bodies. Returns its index among the awake joints.
  std::uint32_t wake_joint(std::uint32_t slot);
  /// Wakes a body that is about to change, and returns its state. Not for static bodies.
  BodyState<S>& wake_for_change(std::uint32_t slot);
  /// Resets the sleep clock of an awake body: it rested on something that may be gone.
  void reset_clock(std::uint32_t slot);

 private:
  /// A record of an island, to be merged into the awake ones.
  struct Record {
    std::uint64_t key;  // its place among the awake ones
    const SleepingIsland<S>* island;
    std::size_t index;
  };
  struct ByKey {
    ISO_INLINE std::uint64_t operator()(const Record& record) const { return record.key; }
  };

  bool is_sensor(std::uint32_t slot) const;
  bool may_run_over(const BodyState<S>& state, Vec3<S> way, std::uint32_t sleeper) const;
  void find_run_over(std::size_t index);
  bool is_touched(std::uint64_t pair) const;
  void start_waking(std::uint32_t island);
  void merge_woken();
  void merge_contacts();
  template <class ArrayOf, class KeyOf> std::size_t sort_records(const ArrayOf& array_of, const KeyOf& key_of);
  template <class Set, class SetOf> void merge_set(Set& into, const SetOf& set_of);

  WorldState<S>& state_;
  BodyMap<S>& map_;
  Proxies<S>& proxies_;
  std::vector<std::shared_ptr<const SleepingIsland<S>>> woken_;  // off the state's list, not yet among the awake ones
  std::vector<Record> records_, scratch_;
  std::vector<std::uint32_t> touched_;
};

#define ISO_ISLAND_WAKE_OF(extern, S) extern template class IslandWake<S>;
ISO_EXTERN_FOR_EACH_SCALAR(ISO_ISLAND_WAKE_OF)

}  // namespace isostep
