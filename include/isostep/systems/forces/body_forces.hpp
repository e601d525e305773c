// BodyForces<S>: the accelerations that forces give the awake bodies, in every sub-step.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>

#include "isostep/core/instantiate.hpp"
#include "isostep/dynamics/solvers/step_context.hpp"
#include "isostep/store/events.hpp"
#include "isostep/systems/forces/record_forces.hpp"

namespace isostep {

/// Input:   the forces of commands since the last step, the force records, bodies as a sub-step finds them; the broad
///          phase for bodies that shield from explosions.
/// Output:  an acceleration for each awake body; the report's clamped_force. Explosions that ended are removed.
/// Keeps:   nothing from step to step but memory.
/// Order:   the forces of commands; the records that push, kind by kind (record_list.hpp), each kind ascending by slot,
///          but zones and waters by (priority, slot); the gravity that zones replace; the records that resist, in the
///          same order; motion that fades. The file of a kind tells what it does: Acts.
template <class S> class BodyForces {
 public:
  ISO_INLINE BodyForces(WorldState<S>& state, const BodyMap<S>& map, const Proxies<S>& proxies)
      : state_(state),
        bodies_(state, map),
        sums_(state, map, bodies_),
        zones_(state),
        resistance_(bodies_, sums_),
        wet_(state, map, zones_, bodies_),
        shields_(map, proxies, bodies_) {}
  BodyForces(const BodyForces&) = delete;  // its parts know each other
  BodyForces& operator=(const BodyForces&) = delete;

  /// Takes the forces that commands left in the state.
  void begin_step();
  /// Reports the number of bodies whose forces were cut in any sub-step.
  void end_step(StepReport& report);
  /// One per awake body, or empty.
  ISO_INLINE std::span<const Acceleration<S>> accelerations() const { return sums_.accelerations(); }
  SubstepForces<S> substeps();
  /// The pull on each awake body besides gravity at the end of the step, even if something holds the body. Contains all
  /// accelerations except those of springs and water that bear it. Empty: no pulls.
  ISO_INLINE std::span<const Acceleration<S>> pulls() const { return sums_.pulls(); }

  template <class Visit> void visit_scratch(const Visit& visit) { sums_.visit_scratch(visit); }

 private:
  bool no_records() const;
  void renew(const SolverBodies<S>& bodies, std::int32_t rate);
  void act_all();
  void resist_all();
  template <class Visit> void for_each_kind(const Visit& visit) const;
  void remove_ended();

  WorldState<S>& state_;
  SubstepBodies<S> bodies_;
  ForceSums<S> sums_;
  Zones<S> zones_;
  Resistance<S> resistance_;
  WetBodies<S> wet_;
  BlastShields<S> shields_;
  RecordForces<S> forces_ = {bodies_, sums_, zones_, resistance_, wet_, shields_};
};

#define ISO_BODY_FORCES_OF(extern, S) extern template class BodyForces<S>;
ISO_EXTERN_FOR_EACH_SCALAR(ISO_BODY_FORCES_OF)

}  // namespace isostep
