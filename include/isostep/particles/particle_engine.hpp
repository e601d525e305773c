// ParticleEngine<S>: what stands behind ParticleWorld<S>: the state, one step's scratch, and the stages.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "isostep/core/bitset.hpp"
#include "isostep/math/softness.hpp"
#include "isostep/particles/checks.hpp"
#include "isostep/particles/constraint.hpp"
#include "isostep/particles/flight.hpp"
#include "isostep/particles/grid.hpp"
#include "isostep/particles/implicit_springs.hpp"
#include "isostep/particles/particle_state.hpp"
#include "isostep/particles/particle_world.hpp"
#include "isostep/particles/scenery.hpp"
#include "isostep/particles/solvers/worst_first.hpp"
#include "isostep/particles/stiff_spring.hpp"
#include "isostep/state/command_journal.hpp"
#include "isostep/state/leaves.hpp"

namespace isostep {

/// Pairs of particles that one search may find [1] where settings name none: 64 a particle, no fewer than 2^21 and no
/// more than kMostParticlePairs. With rows and contacts a pair takes up to 250 bytes. Beyond, a crowd is one point.
inline constexpr std::uint32_t kCrowdPairs = 1u << 21;
ISO_INLINE constexpr std::uint32_t most_pairs(std::uint32_t asked, std::uint32_t particles) {
  if (asked != 0) return asked;
  return particles < kMostParticlePairs / 64 ? max(64 * particles, kCrowdPairs) : kMostParticlePairs;
}
/// Looks at rows that one step may take [1] where settings name none: a fifth of a second, and 2048 a particle, of
/// which a pile takes 1200 in four sub-steps.
ISO_INLINE constexpr std::uint64_t most_looks(std::uint32_t asked, std::uint64_t particles) {
  return asked != 0 ? asked : (std::uint64_t{1} << 22) + 2048 * particles;
}

template <class S> class ParticleEngine {
 public:
  using V = Velocity<S>;
  using U = Unit<S>;

  using Command = ParticleCommand<S>;

  explicit ParticleEngine(const ParticleSettings<S>& settings);

  // engine_commands.inl: what a command does. Returns what it made or whether it was accepted. `journal_` runs it.
#define ISO_EXECUTE(name, Type, Result, S) Result execute(const Type& command);
  ISO_FOR_EACH_PARTICLE_COMMAND(ISO_EXECUTE, ISO_SKIP, S)
#undef ISO_EXECUTE
  template <class Record> typename detail::RecordId<Record>::Type execute(const AddRecord<Record>& command);
  template <class Record, class IdType> bool execute(const SetRecord<Record, IdType>& command);
  template <class IdType> bool execute(const RemoveRecord<IdType>& command);

  // engine_step.inl
  ParticleReport step(const ParticleStageObserver& observer);
  StageView view(std::uint32_t stage);

  // engine_leaves.inl
  static void walk_leaves(void* engine, LeafPart part, std::uint32_t stage, const LeafSink& sink);
  template <class Visit> void visit_leaves(LeafPart part, std::uint32_t stage, const Visit& visit);

  // engine_state.inl
  void load(const ParticleState<S>& from);
  std::uint64_t hash() const;
  void write_portable(Writer& writer) const;
  Result<void> read_portable(Reader& reader);

#define ISO_REGISTRY(name, Record, Id, S)          \
  auto& registry_of(Id) { return state_.name##s; } \
  const auto& registry_of(Id) const { return state_.name##s; }
  ISO_FOR_EACH_PARTICLE_COMMAND(ISO_SKIP, ISO_REGISTRY, S)
#undef ISO_REGISTRY
  ParticleMaterialId first_material() const { return state_.materials.slots().template id_of<ParticleMaterialId>(0); }
  bool holds(ParticleId particle) const { return state_.particles.holds(particle); }

  ParticleState<S> state_;
  ParticleEvents<S> events_;
  ParticleReport report_;
  CommandJournal journal_;
  const FlightKernels<S>* kernels_;

 private:
  /// What a step draws on, by slot.
  struct Scratch {
    Axes<V> displacement;               // [m] since the step began: finer than positions where S is narrow
    Axes<S> now;                        // [m] position + displacement
    Axes<S> acceleration;               // [m/s^2]
    Axes<V> came;                       // [m/s] velocity before forces
    Axes<V> before;                     // [m/s] velocity before constraints
    Axes<V> start, first_displacement;  // where a sub-step began
    Axes<S> first;                      // [m/s^2] acceleration there
    Axes<S> sum;                        // [m/s^2] weighted mean of the stages' accelerations
    Axes<V> gained;                     // [m/s] what forces added in the sub-step
    Axes<V> way;                        // [m] of the sub-step, if nothing is met
    Axes<V> mean, end;                  // [m/s] weighted mean of their velocities; the velocity after the sub-step
    Axes<V> shift;                      // [m/s] with which overlaps are pushed apart; no velocity that lasts
  };

  // engine_commands.inl
  Fault fault_of_record(const ParticleMaterial<S>& material) const { return detail::fault_of(material); }
  Fault fault_of_record(const Spring<S>& spring) const;
  Fault fault_of_record(const ParticleForce<S>& force) const;
  Fault fault_of_record(const Cohesion<S>& cohesion) const;
  Fault fault_of_record(const Link<S>& link) const;
  Fault fault_of_record(const Collider<S>& collider) const { return detail::fault_of(collider); }
  Fault fault_of_ends(ParticleId a, ParticleId b) const;
  bool is_in_use(ParticleMaterialId material) const;
  void bury_doomed();
  ParticlePush<S>& pending_push(std::uint32_t slot);
  template <class Records, class Names> void remove_naming(Records& records, const Names& names);

  // engine_forces.inl
  void add_acceleration(std::uint32_t slot, Vec3<S> a);
  void push(std::uint32_t slot, InverseMass<S> inverse_mass, Vec3<U> direction, S force);
  bool has_forces() const;
  SpringRun<S> spring_run();
  void add_forces();
  void add_force(const ParticleForce<S>& force);
  void find_cohering();
  void add_cohesion(const Cohesion<S>& cohesion, std::uint32_t i, std::uint32_t k);

  // engine_integrate.inl
  void prepare_flight();
  FlightRun<S> flight(std::uint32_t first = 0);
  void accelerate();
  void note_cut_force(std::uint32_t slot);
  void fly_free();
  void integrate();
  void arrive();
  void turn_end();
  void fly_joined();
  bool arrives() const;
  void drift_verlet();
  void arrive_verlet();
  void drift_rk4();
  void integrate_implicit();
  void count_holds();
  void prepare_springs();
  void swing_stiff_springs();
  void pull_stiff_springs();
  void swing(std::uint32_t slot, Vec3<V> way, Vec3<V> change);
  void move_on(std::uint32_t slot, Vec3<V> way);
  void keep_velocity(std::uint32_t slot, Vec3<V> velocity);
  void renew_positions();

  // engine_contacts.inl
  void find_contacts();
  bool may_meet() const;
  void find_pulls();
  S reach_of(std::uint32_t slot) const;
  void find_pairs();
  void find_pair(std::uint32_t a, std::uint32_t b, std::size_t& old);
  void find_scenery(std::uint32_t slot, std::size_t& old);
  void add_contact(std::uint32_t a, std::uint32_t b, S radius, const ParticleMaterial<S>& material, std::size_t& old);
  void add_touches();
  void add_links();
  void look();
  void look_at_link(ParticleConstraint<S>& row);
  void look_at_contact(ParticleConstraint<S>& row);
  void look_at_touch(ParticleConstraint<S>& row);
  const ParticleMaterial<S>& material_of(std::uint32_t slot) const {
    return state_.materials.all()[state_.material[slot]];
  }

  // engine_soft_step.inl
  V separating_speed(const ParticleConstraint<S>& row) const;
  V speed_of(const Axes<V>& velocity, const ParticleConstraint<S>& row) const;
  void give(ParticleConstraint<S>& row, Vec3<V> impulse);
  V closing_gain(const ParticleConstraint<S>& row) const;
  V meeting_speed(const ParticleConstraint<S>& row, V there) const;
  void note_meetings();
  bool is_shifted(const ParticleConstraint<S>& row) const;
  void push_apart(ParticleConstraint<S>& row);
  void warm_start();
  void solve(bool biased);
  void solve_normal(ParticleConstraint<S>& row, const Softness<S>& softness, bool biased);
  void solve_friction(ParticleConstraint<S>& row);
  void note_work(ParticleConstraint<S>& row, V before, V after);
  V most_bounce(const ParticleConstraint<S>& row, V speed, V wanted) const;
  void restitute();
  void move_by_constraints();

  // engine_worst_first.inl
  void integrate_velocities();
  void note_gained();
  void resolve_substep();
  bool is_touching(const ParticleConstraint<S>& row) const;
  void divide_way();
  void turn_ways(Unit<S> left);
  void place_rows();
  void spend(std::uint64_t looks);
  void resolve_rows();
  void pay_for_ways();
  std::uint32_t next_contact(Unit<S>& when) const;
  Unit<S> time_to(const ParticleConstraint<S>& row) const;
  void travel(Unit<S> share);

  // engine_leaves.inl
  template <class Visit> void visit_scratch(const Visit& visit, ParticleStage stage);

  // engine_step.inl
  void begin_step();
  /// Impulses over sub-steps; else the book's ways, which time division always takes.
  bool is_soft() const {
    return state_.settings.solver == ParticleSolver::soft_step && state_.settings.stepping == Stepping::fixed;
  }
  void solve_substeps();
  void hurry_surfaces();
  void move_surfaces();
  void soften_substep();
  void store_impulses();
  void tell_contact(const ParticleContact<S>& contact, const ParticleConstraint<S>& row);
  void finalise_particles();
  void finish_particle(std::uint32_t slot);
  void yield_springs();
  void expire_particles();

  Scratch scratch_;
  std::vector<FlightRow<S>> flight_rows_;  // by material
  Step<S> h_ = Step<S>(0);                 // [s] a sub-step
  S rate_ = S(0);                          // [1/s] 1/h
  Softness<S> contact_softness_ = Softness<S>::rigid(), link_softness_ = contact_softness_;
  static constexpr Softness<S> rigid_softness_ = Softness<S>::rigid();
  WorstFirst<S> worst_first_;
  std::uint64_t looks_left_ = 0;  // of the step's
  ImplicitSprings<S> implicit_springs_;
  SpringRows<S> spring_rows_;
  bool springs_yield_ = false;
  std::vector<OscillatorStep<S>> oscillators_;  // of the stiff springs, ascending by slot
  std::vector<std::uint32_t> holds_;            // by slot: stiff springs and constraints, 2 for more
  ParticleGrid<S> grid_;
  std::vector<std::uint32_t> slots_;         // of what collides
  std::vector<S> reaches_;                   // [m] of those
  Bitset cut_forces_;                        // slots that report_.clamped_force has counted
  std::vector<S> pulls_;                     // [m] by slot, or empty: how far springs may carry it in the step
  std::vector<std::uint64_t> cohering_;      // pairs as below, of one cohesion after the other
  std::vector<std::size_t> cohering_ends_;   // in cohering_, one a cohesion
  std::vector<std::uint64_t> pairs_;         // a << 32 | b, ascending
  std::vector<ParticleConstraint<S>> rows_;  // links by slot, then contacts by key, then touches
  std::uint32_t first_contact_ = 0, first_touch_ = 0;
  std::vector<ParticleContact<S>> old_contacts_;
  std::vector<std::uint32_t> doomed_;    // slots of particles that go
  std::vector<std::uint8_t> is_doomed_;  // by slot: 1 while they are being buried
};

}  // namespace isostep
