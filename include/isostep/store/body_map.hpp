// BodyMap<S>: where the bodies of a state lie.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "isostep/core/instantiate.hpp"
#include "isostep/store/body_poses.hpp"
#include "isostep/store/joint_map.hpp"
#include "isostep/store/location.hpp"
#include "isostep/store/shape_map.hpp"
#include "isostep/store/state.hpp"

namespace isostep {

/// BodyMap finds the record of a body by its slot, in O(1). It is a cache: all of it follows from the state. Code that
/// meets a body also needs its shape and its joints, so their maps are part of it.
/// Input:   the state, and calls from whatever moves bodies between its arrays.
/// Output:  locations, and the records that lie there.
/// Keeps:   a location for each slot; how many contacts and joints of sleeping islands name a body.
template <class S> class BodyMap {
 public:
  ISO_INLINE explicit BodyMap(WorldState<S>& state) : shapes(state), joints(state), state_(state) {}

  ShapeMap<S> shapes;
  JointMap<S> joints;

  // Locations, by slot.
  ISO_INLINE std::size_t slot_count() const { return locations_.size(); }
  ISO_INLINE Location location(std::uint32_t slot) const { return locations_[slot]; }
  /// Returns the body's row in SolverBodies: 0, which nothing moves, unless the body is awake.
  ISO_INLINE std::uint32_t row_of(std::uint32_t slot) const {
    if (slot == kNoBody) return 0;
    const Location at = locations_[slot];
    return at.set == Location::kAwake ? at.index + 1 : 0;
  }
  /// Returns how many contacts and joints of sleeping islands name the body.
  ISO_INLINE std::uint32_t names(std::uint32_t slot) const { return names_[slot]; }
  /// Returns true if the body takes part. A disabled one lies among the static ones. kNoBody, the world, takes part.
  ISO_INLINE bool is_enabled(std::uint32_t slot) const {
    if (slot == kNoBody || locations_[slot].set != Location::kStatic) return true;
    return isostep::is_enabled(state_.static_bodies.properties(locations_[slot].index));
  }
  /// Returns true if both bodies of a joint take part. If not, the joint holds nothing.
  ISO_INLINE bool is_enabled(const JointProperties<S>& joint) const {
    return is_enabled(joint.body_a) && is_enabled(joint.body_b);
  }

  // Records. Those by id are null for an id that names nothing.
  ISO_INLINE const BodyState<S>& state_at(Location at) const {
    if (at.set == Location::kAwake) return state_.awake.states[at.index];
    if (at.set == Location::kStatic) return state_.static_bodies.state(at.index);
    return state_.sleeping[at.set]->bodies.states[at.index];
  }
  ISO_INLINE const BodyProperties<S>& properties_at(Location at) const {
    if (at.set == Location::kAwake) return state_.awake.properties[at.index];
    if (at.set == Location::kStatic) return state_.static_bodies.properties(at.index);
    return state_.sleeping[at.set]->bodies.properties[at.index];
  }
  const BodyState<S>* state_of(BodyId body) const;
  const BodyProperties<S>* properties_of(BodyId body) const;
  /// Returns the records of a body that does not sleep, for writing.
  BodyState<S>& change_state(std::uint32_t slot);
  BodyProperties<S>& change_properties(std::uint32_t slot);
  /// Returns true if one of two bodies is dynamic: others do not push each other.
  ISO_INLINE bool is_pushed(std::uint32_t slot_a, std::uint32_t slot_b) const {
    return properties_at(location(slot_a)).type == BodyType::dynamic ||
           properties_at(location(slot_b)).type == BodyType::dynamic;
  }
  Pose<S> origin_pose_at(std::uint32_t slot) const;
  /// Returns the pose of the centre of mass; for kNoBody that of the world itself.
  ISO_INLINE Pose<S> centre_pose_at(std::uint32_t slot) const {
    if (slot == kNoBody) return Pose<S>::identity();
    const BodyState<S>& state = state_at(locations_[slot]);
    return {state.centre, state.orientation};
  }

  // Changes. `set` is the array's name in a Location.
  /// Puts a body among the static or the awake ones.
  void insert(const BodyState<S>& state, const BodyProperties<S>& body);
  /// Erases a body that does not sleep.
  void erase(std::uint32_t slot);
  /// Renews the locations of an array's records from index `from` on, which have moved.
  void relabel(const BodySet<S>& bodies, std::uint32_t set, std::size_t from);
  ISO_INLINE void place(std::uint32_t slot, Location at) { locations_[slot] = at; }
  /// Counts how often an island's contacts and joints name bodies. `by`: 1 when it falls asleep; -1 modulo 2^32 when it
  /// wakes.
  void count_names(const SleepingIsland<S>& island, std::uint32_t by);
  /// Renews the locations of the bodies on a page of StaticBodies from row `from` on, which have moved.
  void relabel_static(std::size_t page, std::size_t from = 0);
  /// Makes room for every slot that the state has handed out.
  void make_room();

  template <class Visit> void visit_scratch(const Visit& visit) {
    visit("locations", std::span(locations_.data(), state_.body_slots.entries().size()));
    joints.visit_scratch(visit);
  }

 private:
  Location locate(BodyId body) const;

  WorldState<S>& state_;
  std::vector<Location> locations_;
  std::vector<std::uint32_t> names_;  // by body slot
};

#define ISO_BODY_MAP_OF(extern, S) extern template class BodyMap<S>;
ISO_EXTERN_FOR_EACH_SCALAR(ISO_BODY_MAP_OF)

}  // namespace isostep
