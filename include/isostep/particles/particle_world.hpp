// ParticleWorld<S>: points with mass, their forces, springs, cables, rods and contacts, stepped at a fixed rate; saved,
// loaded and hashed exactly. For scenes in which nothing turns: what does not rotate does not pay for rotation.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "isostep/core/fault.hpp"
#include "isostep/core/instantiate.hpp"
#include "isostep/core/simd.hpp"
#include "isostep/particles/particle_command.hpp"
#include "isostep/particles/particle_events.hpp"
#include "isostep/particles/particle_stages.hpp"
#include "isostep/particles/settings.hpp"
#include "isostep/state/archive.hpp"

namespace isostep {

template <class S> struct ParticleState;
template <class S> class ParticleEngine;

/// Counts of the moment, for reports.
struct ParticleCounts {
  std::uint32_t particles, pinned, springs, forces, links, colliders, contacts;  // forces: cohesions too
};

/// A world of particles over any scalar, beside World<S>.
///
/// Mutators act at once, between steps; a refused one returns false or a null id, changes nothing and leaves its reason
/// in `fault()`. Observers of stages call none. Two worlds of one type that were given the same calls in the same order
/// have equal hashes at every tick, on every machine. `load(save(w))` brings back ids, contacts and future exactly.
///
/// Frames: right-handed, world axes fixed, y up by the default gravity. Units: kg, m, s.
template <class S> class ParticleWorld final {
  ISO_REQUIRE_ENGINE(S);

 public:
  using Scalar = S;
  using Command = ParticleCommand<S>;
  using State = ParticleState<S>;

  explicit ParticleWorld(const ParticleSettings<S>& settings = {});
  ~ParticleWorld();
  /// `other` is empty then, with its settings, and as usable as a new one. Recording and tracing end, as for World.
  ParticleWorld(ParticleWorld&& other) noexcept;
  ParticleWorld& operator=(ParticleWorld&& other) noexcept;

  const ParticleSettings<S>& settings() const;
  std::uint64_t tick() const;
  /// Lanes for this world. Never changes a bit; false and no change where this processor or build lacks them.
  bool use_simd(Simd simd);
  const char* simd_name() const;

  // What is registered: materials, springs, forces, cohesions, links, colliders, each by an id of its type.
#define ISO_RECORD(name, Record, Id, S)  \
  Id add(const Record& record);          \
  bool set(Id id, const Record& record); \
  bool remove(Id id);                    \
  const Record* find(Id id) const;
  ISO_FOR_EACH_PARTICLE_COMMAND(ISO_SKIP, ISO_RECORD, S)
#undef ISO_RECORD
  /// Materials are shared by the particles that name them. Every world has one from birth, which a null id names.
  ParticleMaterialId default_material() const;

  // Particles.
  ParticleId create(const ParticleDefinition<S>& definition);
  /// With it go the springs, forces and links that name it.
  bool destroy(ParticleId particle);
  bool place(ParticleId particle, Vec3<S> position, Vec3<S> velocity);
  /// A pinned particle goes on at the velocity that it has, whatever acts on it, until `place` gives it another.
  bool set_mass(ParticleId particle, S mass, bool pinned = false);
  bool set_material(ParticleId particle, ParticleMaterialId material);
  bool set_gravity(Vec3<S> gravity);
  bool apply_force(ParticleId particle, Vec3<S> force);
  bool apply_impulse(ParticleId particle, Vec3<S> impulse);
  bool touch(const ParticleTouch<S>& touch);

  /// Every mutator above is one of these with its fields as arguments: particle_command.hpp.
#define ISO_APPLY(name, Type, Result, S) Result apply(const Type& command);
#define ISO_APPLY_RECORD(name, Record, Id, S)       \
  Id apply(const AddRecord<Record>& command);       \
  bool apply(const SetRecord<Record, Id>& command); \
  bool apply(const RemoveRecord<Id>& command);
  ISO_FOR_EACH_PARTICLE_COMMAND(ISO_APPLY, ISO_APPLY_RECORD, S)
#undef ISO_APPLY
#undef ISO_APPLY_RECORD
  /// Any of them, as recorded ones are.
  bool apply(const ParticleCommand<S>& command);
  /// Why the last call was refused: the rule and the call; `describe` makes a sentence of it. Commands clear it.
  const FaultReport& fault() const;
  /// Of the first call that was refused since the world was made or told to forget: refusals come in chains.
  const FaultReport& first_fault() const;
  void forget_faults();
  /// A callback for every refused call from now on; one without a function ends that.
  void set_fault_handler(const FaultHandler& handler);
  /// From now on every accepted command and every step is appended to `log` (null: to nothing). The caller clears it
  /// every frame. Loading keeps it.
  void record_to(std::vector<std::uint8_t>* log);
  bool records_to(const std::vector<std::uint8_t>* log) const;
  /// From now on every step appends the state's hash as it begins and after each stage (null: to nothing).
  void trace_to(std::vector<std::uint64_t>* hashes);
  /// How often the world was loaded or read.
  std::uint64_t loads() const;

  // What particles are like. A stale id gives the zero of the type that is returned.
  bool contains(ParticleId particle) const;
  Vec3<S> position(ParticleId particle) const;
  Vec3<S> velocity(ParticleId particle) const;
  /// 0 where pinned.
  S mass(ParticleId particle) const;
  ParticleMaterialId material(ParticleId particle) const;
  std::vector<ParticleId> particles() const;
  ParticleCounts counts() const;

  // Time.
  ParticleReport step(const ParticleStageObserver& observer = {});
  const ParticleEvents<S>& events() const;

  // State.
  class Snapshot {
   public:
    Snapshot();
    ~Snapshot();
    Snapshot(Snapshot&& other) noexcept;
    Snapshot& operator=(Snapshot&& other) noexcept;
    /// Size of what it holds for itself [bytes]; records that only commands change are shared until one of them does.
    std::size_t bytes() const;

   private:
    friend class ParticleWorld;
    std::unique_ptr<ParticleState<S>> state_;
  };
  void save(Snapshot& to) const;
  /// A snapshot that was moved from holds nothing, and loading it does nothing; one never saved to is an empty world.
  void load(const Snapshot& from);
  std::uint64_t hash() const;
  void write_portable(Writer& writer) const;
  Result<void> read_portable(Reader& reader);
  /// A frame's commands and steps as `record_to` wrote them.
  /// `stepper` takes the steps in the place of `step`, if one is given.
  Result<void> step_recorded(Bytes input, const Stepper& stepper = {});

  /// The arrays behind the world, for tools that compare, describe and measure: see particle_state.hpp.
  const ParticleState<S>& state() const;
  /// The same field by field, by name: what an observer of stages is given, without what a stage leaves.
  StageView state_fields() const;

 private:
  std::unique_ptr<ParticleEngine<S>> engine_;
};

#define ISO_EXTERN(S) extern template class ParticleWorld<S>;
ISO_FOR_EACH_SCALAR(ISO_EXTERN)
#undef ISO_EXTERN

}  // namespace isostep
