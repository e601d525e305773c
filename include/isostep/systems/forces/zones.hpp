// Zones<S>: where in the world which zones and waters act, and what hides them.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <tuple>

#include "isostep/core/instantiate.hpp"
#include "isostep/store/state.hpp"
#include "isostep/systems/forces/force_sums.hpp"
#include "isostep/systems/forces/record_ranks.hpp"

namespace isostep {

/// Input:   the records of a step; points, and categories of bodies.
/// Output:  records in the order in which they act; whether one of higher priority hides a zone or a water at a point;
///          the wind there; the world's gravity, removed where a zone replaces it.
/// Keeps:   nothing from step to step but memory.
template <class S> class Zones {
 public:
  ISO_INLINE explicit Zones(const WorldState<S>& state) : state_(state) {}

  /// Ranks records. Called before the first sub-step of a step.
  void rank();
  ISO_INLINE std::size_t water_count() const { return std::get<RecordRanks<Water<S>>>(ranks_).size(); }
  /// Visits each existing record, ascending by slot, or by (priority, slot) for a kind with priorities.
  template <class Record, class IdType, class Visit>
  void for_each(const Registry<Record, IdType>& registry, const Visit& visit) const;
  /// Visits the records of a kind with priorities in reverse order.
  template <class Record, class IdType, class Visit>
  void for_each_down(const Registry<Record, IdType>& registry, const Visit& visit) const;

  /// Returns true if a zone of higher priority replaces this effect of a ForceZone there, for bodies of that category.
  bool is_hidden(std::uint32_t effect, std::int32_t priority, std::uint32_t category, Vec3<S> point) const;
  /// Returns true if a DampingZone of higher priority replaces those of that priority there.
  bool is_undamped(std::int32_t priority, std::uint32_t category, Vec3<S> point) const;
  /// Returns true if a zone or a higher water keeps water of that priority away there.
  bool is_dry(std::int32_t priority, std::uint32_t category, Vec3<S> point) const;
  /// [m/s] The wind at a point.
  Vec3<S> wind_at(Vec3<S> point) const;
  /// Removes the world's gravity from bodies for which a zone replaces it. Gravity ranks below all zones.
  void replace_gravity(const SubstepBodies<S>& bodies, ForceSums<S>& sums) const;

 private:
  bool replaces_gravity(std::uint32_t category, Vec3<S> point) const;

  const WorldState<S>& state_;
  /// A kind that has a priority must be among these, or it does not compile.
  std::tuple<RecordRanks<ForceZone<S>>, RecordRanks<DampingZone<S>>, RecordRanks<Water<S>>> ranks_;
};

#define ISO_ZONES_OF(extern, S) extern template class Zones<S>;
ISO_EXTERN_FOR_EACH_SCALAR(ISO_ZONES_OF)

}  // namespace isostep
