// BodyForces<S>: the accelerations that forces give the awake bodies, in every sub-step.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "isostep/core/bitset.hpp"
#include "isostep/core/instantiate.hpp"
#include "isostep/dynamics/solvers/step_context.hpp"
#include "isostep/store/body_map.hpp"
#include "isostep/store/events.hpp"
#include "isostep/store/force_bounds.hpp"
#include "isostep/store/proxies.hpp"
#include "isostep/systems/forces/coupling_forces.hpp"
#include "isostep/systems/vehicle/wheel_forces.hpp"

namespace isostep {

/// Input:   what commands asked for since the last step, the force records, bodies as a sub-step finds them; the broad
///          phase for what shields from explosions.
/// Output:  an acceleration for each awake body; the report's clamped_force. Explosions that ended are removed, and the
///          records of wheels written.
/// Keeps:   nothing from step to step but memory.
/// Order:   what commands asked for, then the records kind by kind (record_list.hpp), each kind ascending by slot, but
///          zones and waters by (priority, slot), then wheels, then couplings.
template <class S> class BodyForces {
 public:
  ISO_INLINE BodyForces(WorldState<S>& state, const BodyMap<S>& map, const Proxies<S>& proxies)
      : state_(state), map_(map), proxies_(proxies), wheels_(state, map, proxies), couplings_(state, map) {}

  /// Takes what commands left in the state.
  void begin_step();
  /// Bodies of which forces were cut, in any sub-step.
  void end_step(StepReport& report);
  /// By awake body, or empty.
  ISO_INLINE std::span<const Acceleration<S>> accelerations() const { return accelerations_; }
  SubstepForces<S> substeps();
  /// The pull at each awake body beside gravity, as the step ends, whether something holds it or not: all but what
  /// springs, water, wheels and couplings bear. Empty: nothing.
  ISO_INLINE std::span<const Acceleration<S>> pulls() const { return pulls_; }

  template <class Visit> void visit_scratch(const Visit& visit) { visit("accelerations", accelerations_); }

 private:
  using U = Unit<S>;
  /// A point of a body, or of the world, as a sub-step finds it.
  struct End {
    std::uint32_t row;  // of SolverBodies; 0: does not move
    Vec3<S> at;         // [m] world
    Vec3<S> arm;        // [m] from the centre of mass
    Vec3<S> velocity;   // [m/s]
  };

  /// The plane of a water, for a point.
  struct Surface {
    Vec3<U> normal;
    S depth;           // [m] of the point below it, along the normal
    Vec3<S> velocity;  // [m/s] of the water there
  };
  /// [1/s] What the zones that a body is in slow it by.
  struct Damping {
    S linear, angular;
  };
  /// What a body displaces.
  struct Wet {
    S mass;       // [kg] of water
    Vec3<S> arm;  // [m] its middle from the body's centre of mass
    std::uint32_t row;
    const Water<S>* water;
    Vec3<S> flow;  // [m/s] of the water there
  };
  static constexpr std::uint32_t kMostParts = 1024;  // of a body's mass, for what resists its motion

  ISO_INLINE bool no_records() const {
    const RecordStore<S>& records = *state_.records;
    bool none = !wheels_.any() && !couplings_.any();
    RecordStore<S>::members([&]<class Record, class IdType>(const char*, const Registry<Record, IdType>& registry)
                                ISO_INLINE_LAMBDA { none = none && !(acts<Record>() && !registry.all().empty()); },
                            records);
    return none;
  }
  void renew(const SolverBodies<S>& bodies, std::int32_t rate);
  ISO_INLINE bool is_last() const { return substep_ + 1 == substeps_; }
  /// A kind acts in a sub-step if it has an `act` here.
  template <class Record> static constexpr bool acts() {
    return requires(BodyForces & forces, const Record& record) { forces.act(record); };
  }
  template <class Record, class IdType> void act_all(const Registry<Record, IdType>& registry);
  template <class Act> void bear(const Act& act);
  void act(const ForceZone<S>& zone);
  void act_in_place_of_gravity();
  bool replaces_gravity(std::uint32_t category, Vec3<S> point) const;
  template <class Zones> void rank(const Zones& zones, std::vector<std::uint64_t>& ranks);
  void rank_zones();
  bool is_hidden(std::uint32_t effect, std::int32_t priority, std::uint32_t category, Vec3<S> point) const;
  void act(const Attractor<S>& attractor);
  void act(const BodySpring<S>& spring);
  void act(const Thruster<S>& thruster);
  void act(const BuoyancyPoint<S>& buoyancy);
  void act(const Explosion<S>& explosion);
  void act(const Water<S>& water);
  void act(const BodyDrag<S>&) {}  // these resist
  void act(const AeroSurface<S>&) {}
  void act(const DampingZone<S>&) {}

  End end_at(BodyId body, Vec3<S> local) const;
  Vec3<S> wind_at(Vec3<S> point) const;
  void accelerate(std::uint32_t row, Vec3<S> acceleration);
  void push(std::uint32_t row, Vec3<S> force, Vec3<S> arm);
  void push(const End& end, Vec3<S> force) { push(end.row, force, end.arm); }
  void push(const VelocityChange<S>& change);
  void note_cut(std::uint32_t row, bool cut);
  bool is_pushed(std::uint32_t row, std::uint32_t mask) const;
  Mat3<S> give_of(const End& end, const Mat3<U>& axes) const;
  Vec3<S> settled(const End& end, const Mat3<U>& axes, const Mat3<S>& tensor, Vec3<S> velocity) const;

  template <class Registry, class Visit> void for_each_taken(const Registry& registry, const Visit& visit) const;
  template <class Record, class Visit>
  void for_each_ranked(std::span<const std::uint64_t> ranks, const std::vector<Record>& all, const Visit& visit) const;
  // resisting_forces.inl
  void resist_all();
  void resist(const BodyDrag<S>& drag);
  void resist(const AeroSurface<S>& surface);
  void gather_damping();
  void resist_damping(std::uint32_t row);
  S mass_part(std::uint32_t row) const;
  Vec3<S> next_velocity(std::uint32_t row) const;
  Vec3<S> next_angular_velocity(std::uint32_t row) const;
  S slowed(std::uint32_t row, S rate) const;
  void slow_turning(std::uint32_t row, Vec3<S> way, S rate);
  // explosion_forces.inl
  Vec3<S> exposed_point(std::uint32_t row, Vec3<S> from) const;
  bool is_shielded(Vec3<S> from, Vec3<S> to) const;
  S blast(const Explosion<S>& explosion, S t, S distance, S fleeing, S above, S aside) const;
  void remove_ended();
  // water_forces.inl
  Surface surface_at(const Water<S>& water, Vec3<S> at) const;
  Wet wet_part(std::uint32_t row, S density, const Surface& surface) const;
  void resist(const Wet& wet);
  bool is_dry(std::uint32_t row, std::int32_t priority, Vec3<S> point) const;
  bool is_under_water(std::uint32_t row, Vec3<S> point, Vec3<S>& velocity) const;

  WorldState<S>& state_;
  const BodyMap<S>& map_;
  const Proxies<S>& proxies_;
  WheelForces<S> wheels_;
  CouplingForces<S> couplings_;
  // Of ForceZones, DampingZones and Waters, ascending by (priority, slot).
  std::vector<std::uint64_t> zone_ranks_, damping_ranks_, water_ranks_, rank_scratch_;
  std::vector<Acceleration<S>> asked_, steady_, accelerations_;  // by commands; of what pushes, too; of all
  std::vector<Acceleration<S>> before_, pulls_;                  // of all, before one that bears acts; without those
  std::vector<Wet> wet_;
  std::vector<Damping> damping_;          // by awake body; empty without DampingZones
  std::vector<std::uint32_t> resisting_;  // by awake body: how many forces resist its motion
  Bitset cut_;                            // awake bodies
  std::uint32_t cut_count_ = 0;
  const SolverBodies<S>* bodies_ = nullptr;   // of the sub-step
  std::int32_t rate_ = 1;                     // [1/s] of sub-steps
  Step<S> h_ = {};                            // [s] it takes
  std::uint32_t substep_ = 0, substeps_ = 1;  // which of how many in a step
};

#define ISO_EXTERN(S) extern template class BodyForces<S>;
ISO_FOR_EACH_SCALAR(ISO_EXTERN)
#undef ISO_EXTERN

}  // namespace isostep
