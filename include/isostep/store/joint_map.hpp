// JointMap<S>: where the joints of a state lie.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "isostep/core/instantiate.hpp"
#include "isostep/store/location.hpp"
#include "isostep/store/state.hpp"

namespace isostep {

/// JointMap finds the record of a joint by its slot, in O(1). It is a cache: all of it follows from the state.
/// Input:   the state, and calls from whatever moves joints between its arrays.
/// Output:  locations, and the records that lie there.
/// Keeps:   a location for each slot.
template <class S> class JointMap {
 public:
  ISO_INLINE explicit JointMap(WorldState<S>& state) : state_(state) {}

  ISO_INLINE Location location(std::uint32_t slot) const { return locations_[slot]; }
  /// Returns null for an id that names nothing.
  const JointProperties<S>* properties_of(JointId joint) const;

  // Changes. `set` is the array's name in a Location.
  /// Puts a joint among the awake ones.
  void insert(const JointState<S>& state, const JointProperties<S>& joint);
  /// Erases an awake joint.
  void erase(std::uint32_t slot);
  /// Renews the locations of an array's records from index `from` on, which have moved.
  void relabel(const JointSet<S>& joints, std::uint32_t set, std::size_t from);
  ISO_INLINE void place(std::uint32_t slot, Location at) { locations_[slot] = at; }
  /// Makes room for every slot that the state has handed out.
  void make_room();

  template <class Visit> void visit_scratch(const Visit& visit) {
    visit("joint_locations", std::span(locations_.data(), state_.joint_slots.entries().size()));
  }

 private:
  WorldState<S>& state_;
  std::vector<Location> locations_;
};

#define ISO_JOINT_MAP_OF(extern, S) extern template class JointMap<S>;
ISO_EXTERN_FOR_EACH_SCALAR(ISO_JOINT_MAP_OF)

}  // namespace isostep
