// ParticleWorld<S>: points with mass, their forces, springs, cables, rods and contacts, stepped at a fixed rate; saved,
// loaded and hashed exactly. For scenes in which nothing turns: what does not rotate does not pay for rotation.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "isostep/core/fault.hpp"
#include "isostep/core/instantiate.hpp"
#include "isostep/core/simd.hpp"
#include "isostep/particles/particle_command.hpp"
#include "isostep/particles/particle_events.hpp"
#include "isostep/particles/particle_stages.hpp"
#include "isostep/particles/settings.hpp"
#include "isostep/state/world_base.hpp"

namespace isostep {

template <class S> struct ParticleState;
template <class S> class ParticleEngine;
template <class S> class ParticleWorld;

template <class S> struct WorldParts<ParticleWorld<S>> {
  using Settings = ParticleSettings<S>;
  using State = ParticleState<S>;
  using Engine = ParticleEngine<S>;
  using EveryCommand = EveryParticleCommand<S>;
  static constexpr std::uint32_t kStages = kParticleStages;
  static constexpr const char* kName = "particle world";
};

/// Counts of the moment, for reports.
struct ParticleCounts {
  std::uint32_t particles, pinned, springs, forces, links, colliders, contacts;  // forces: cohesions too
};

/// A world of particles over any scalar, beside World<S>. Its base has faults, recording, save, load, hash and the
/// portable form.
///
/// Mutators act at once, between steps; a refused one returns false or a null id, changes nothing and leaves its reason
/// in `fault()`. Observers of stages call none. Two worlds of one type that were given the same calls in the same order
/// have equal hashes at every tick, on every machine. `load(save(w))` brings back ids, contacts and future exactly.
///
/// Frames: right-handed, world axes fixed, y up by the default gravity. Units: kg, m, s.
template <class S> class ParticleWorld final : public WorldBase<ParticleWorld<S>> {
  ISO_REQUIRE_ENGINE(S);
  using Base = WorldBase<ParticleWorld<S>>;

 public:
  using Scalar = S;
  using EveryCommand = EveryParticleCommand<S>;

  /// Settings out of range are brought into it, and that is a fault.
  explicit ParticleWorld(const ParticleSettings<S>& settings = {}) : Base(settings) {}

  /// Selects the lanes of this world. Never changes a bit. Returns false and changes nothing if they are not available.
  bool use_simd(Simd simd);
  const char* simd_name() const;

  // Records: materials, springs, forces, cohesions, links, colliders, each by an id of its type.
#define ISO_RECORD(name, Record, Id, S)  \
  Id add(const Record& record);          \
  bool set(Id id, const Record& record); \
  bool remove(Id id);                    \
  const Record* find(Id id) const;
  ISO_FOR_EACH_PARTICLE_COMMAND(ISO_SKIP, ISO_RECORD, S)
#undef ISO_RECORD
  /// Returns the material that every world has from the beginning, and that a null id names. Particles share materials.
  ParticleMaterialId default_material() const;

  // Particles.
  ParticleId create(const ParticleDefinition<S>& definition);
  /// Destroys a particle, and the springs, forces and links that name it.
  bool destroy(ParticleId particle);
  bool place(ParticleId particle, Vec3<S> position, Vec3<S> velocity);
  /// Sets the mass. A pinned particle keeps its velocity, whatever acts on it, until `place` gives it another.
  bool set_mass(ParticleId particle, S mass, bool pinned = false);
  bool set_material(ParticleId particle, ParticleMaterialId material);
  bool set_gravity(Vec3<S> gravity);
  bool apply_force(ParticleId particle, Vec3<S> force);
  bool apply_impulse(ParticleId particle, Vec3<S> impulse);
  bool touch(const ParticleTouch<S>& touch);

  /// The mutators above are these commands, with their fields as arguments: particle_command.hpp.
#define ISO_APPLY(name, Type, Result, S) Result apply(const Type& command);
#define ISO_APPLY_RECORD(name, Record, Id, S)       \
  Id apply(const AddRecord<Record>& command);       \
  bool apply(const SetRecord<Record, Id>& command); \
  bool apply(const RemoveRecord<Id>& command);
  ISO_FOR_EACH_PARTICLE_COMMAND(ISO_APPLY, ISO_APPLY_RECORD, S)
#undef ISO_APPLY
#undef ISO_APPLY_RECORD

  // Getters of particles. A stale id gives the zero of the type that is returned.
  bool contains(ParticleId particle) const;
  Vec3<S> position(ParticleId particle) const;
  Vec3<S> velocity(ParticleId particle) const;
  /// Returns 0 for a pinned particle.
  S mass(ParticleId particle) const;
  ParticleMaterialId material(ParticleId particle) const;
  std::vector<ParticleId> particles() const;
  ParticleCounts counts() const;

  // Time.
  ParticleReport step(const ParticleStageObserver& observer = {});
  const ParticleEvents<S>& events() const;

 private:
  using Base::engine_;
};

#define ISO_PARTICLE_WORLD_OF(extern, S)             \
  extern template class WorldBase<ParticleWorld<S>>; \
  extern template class ParticleWorld<S>;
ISO_EXTERN_FOR_EACH_SCALAR(ISO_PARTICLE_WORLD_OF)

}  // namespace isostep
