// ImpactFilter<S>: which bodies and parts stop a mover, and which let it pass.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>

#include "isostep/collision/continuous/shape_impact.hpp"
#include "isostep/dynamics/kind_table.hpp"
#include "isostep/dynamics/records/one_way.hpp"
#include "isostep/store/body_map.hpp"
#include "isostep/systems/continuous/mover.hpp"

namespace isostep {

/// Holds the rules of a step for fast bodies. A null table is an empty one.
template <class S> struct ImpactRules {
  const Ways<S>* ways = nullptr;                // what they let pass they do not stop
  const ResponseTable<S>* responses = nullptr;  // what does not push back, or no harder than it may, does not stop
  const GhostTable<S>* ghosts = nullptr;        // kinds that pass each other
};

/// Input:   the state; the pairs of bodies that joints keep from colliding; the rules.
/// Output:  whether a body may stop another: by filters, joints, ghosts, one-way bodies and kinds.
/// Keeps:   nothing.
/// Symbols: `index` is that of the moving body, among the awake bodies; `slot` that of the other one.
template <class S> class ImpactFilter {
 public:
  ISO_INLINE ImpactFilter(const WorldState<S>& state, const BodyMap<S>& map) : state_(state), map_(map) {}

  void begin(std::span<const std::uint64_t> joined, const ImpactRules<S>& rules);
  /// `moving`: asks about dynamic bodies except bullets, otherwise about static and kinematic bodies.
  bool may_stop(std::uint32_t index, std::uint32_t slot, bool moving) const;
  bool is_pushed_back(std::uint32_t index, const Child<S>& part, std::uint32_t slot, const Child<S>& met) const;
  /// `there`: the pose of the part's body at `fraction` of the obstacle's piece.
  bool is_passed(std::uint32_t index, const PlacedShape<S>& part, const Pose<S>& there, const PlacedShape<S>& met,
                 const Obstacle<S>& obstacle, Unit<S> fraction) const;

 private:
  bool is_let_out(std::uint32_t index, std::uint32_t slot) const;
  bool are_ghosts(std::uint32_t index, std::uint32_t slot) const;

  const WorldState<S>& state_;
  const BodyMap<S>& map_;
  std::span<const std::uint64_t> joined_;  // for one update
  ImpactRules<S> rules_;                   // null: none
};

}  // namespace isostep
