// SubstepBodies<S>: the awake bodies as a sub-step of forces finds them.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "isostep/core/instantiate.hpp"
#include "isostep/dynamics/solver_body.hpp"
#include "isostep/store/body_map.hpp"
#include "isostep/store/fat_box.hpp"

namespace isostep {

/// A point of a body or of the world, as a sub-step finds it.
template <class S> struct BodyEnd {
  std::uint32_t row;  // of SolverBodies; 0: does not move
  Vec3<S> at;         // [m] world
  Vec3<S> arm;        // [m] from the centre of mass
  Vec3<S> velocity;   // [m/s]
};

/// The clock of a sub-step.
template <class S> struct SubstepClock {
  std::uint64_t tick;               // of the step: WorldState::tick
  std::int32_t hz, rate;            // [1/s] of steps, of sub-steps
  Step<S> h;                        // [s] that it takes
  std::uint32_t substep, substeps;  // which of how many in the step

  ISO_INLINE bool is_last() const { return substep + 1 == substeps; }
  /// The number of sub-steps since tick 0.
  ISO_INLINE std::uint64_t count() const { return tick * substeps + substep; }
};

/// Input:   the state, and the rows of the solver as each sub-step begins. Row i + 1 is awake body i; 0 never moves.
/// Output:  poses, velocities and masses by row or by id, points of bodies, the clock of the sub-step.
/// Keeps:   the number of the sub-step in the step.
template <class S> class SubstepBodies {
 public:
  ISO_INLINE SubstepBodies(const WorldState<S>& state, const BodyMap<S>& map) : state_(state), map_(map) {}

  ISO_INLINE void begin_step() { substep_ = 0; }
  void begin_substep(const SolverBodies<S>& bodies, std::int32_t rate);
  ISO_INLINE void end_substep() { ++substep_; }

  ISO_INLINE const SubstepClock<S>& when() const { return clock_; }
  ISO_INLINE Vec3<S> gravity() const { return state_.settings.gravity; }

  // Getters by row, of a body unless they say otherwise.
  /// The number of rows, that of the world included.
  ISO_INLINE std::uint32_t rows() const { return static_cast<std::uint32_t>(bodies_->mass.size()); }
  /// For any row.
  ISO_INLINE bool moves(std::uint32_t row) const { return bodies_->moves(row); }
  /// Returns true if the body is dynamic and of one of those categories.
  ISO_INLINE bool is_pushed(std::uint32_t row, std::uint32_t mask) const {
    return moves(row) && (category(row) & mask) != 0;
  }
  ISO_INLINE std::uint32_t category(std::uint32_t row) const { return properties(row).filter.category; }
  ISO_INLINE const BodyState<S>& state(std::uint32_t row) const { return state_.awake.states[row - 1]; }
  ISO_INLINE const BodyProperties<S>& properties(std::uint32_t row) const { return state_.awake.properties[row - 1]; }
  /// [m] A box around all of the body but sensors, with a margin.
  ISO_INLINE Aabb<S> solid_box(std::uint32_t row) const { return detail::solid_box(map_, state(row), properties(row)); }
  /// For any row.
  ISO_INLINE const SolverMass<S>& mass(std::uint32_t row) const { return bodies_->mass[row]; }
  /// For any row.
  ISO_INLINE const MotionRow<Velocity<S>>& velocity(std::uint32_t row) const { return bodies_->velocity[row]; }
  /// Returns the point at an arm [m] from the centre of mass.
  BodyEnd<S> end_of(std::uint32_t row, Vec3<S> arm) const;

  // Getters by id. Null is the world.
  ISO_INLINE std::uint32_t row_of(BodyId body) const { return body ? map_.row_of(body.slot) : 0; }
  ISO_INLINE bool is_enabled(BodyId body) const { return !body || map_.is_enabled(body.slot); }
  /// Returns a point [m], given in the frame of any body, or of the world.
  BodyEnd<S> end_at(BodyId body, Vec3<S> local) const;
  /// Returns the centre of mass of any body.
  BodyEnd<S> centre_of(BodyId body) const;

 private:
  BodyEnd<S> end(std::uint32_t row, Vec3<S> centre, Vec3<S> arm) const;

  const WorldState<S>& state_;
  const BodyMap<S>& map_;
  const SolverBodies<S>* bodies_ = nullptr;  // of the sub-step
  SubstepClock<S> clock_ = {};
  std::uint32_t substep_ = 0;
};

#define ISO_SUBSTEP_BODIES_OF(extern, S) extern template class SubstepBodies<S>;
ISO_EXTERN_FOR_EACH_SCALAR(ISO_SUBSTEP_BODIES_OF)

}  // namespace isostep
