// Bodies of particle_world.hpp: the facade over ParticleEngine, and the recording of commands.
// SPDX-License-Identifier: MIT
#pragma once

#include <utility>
#include <variant>

#include "isostep/particles/engine_commands.inl"
#include "isostep/particles/engine_contacts.inl"
#include "isostep/particles/engine_forces.inl"
#include "isostep/particles/engine_integrate.inl"
#include "isostep/particles/engine_soft_step.inl"
#include "isostep/particles/engine_state.inl"
#include "isostep/particles/engine_step.inl"
#include "isostep/particles/engine_worst_first.inl"
#include "isostep/state/tape.hpp"

namespace isostep {

/// Settings out of range are brought to the nearest that is in range, and that is a fault.
template <class S>
ParticleEngine<S>::ParticleEngine(const ParticleSettings<S>& settings) : kernels_(flight_kernels<S>(Simd::best)) {
  state_.settings = settings;
  ParticleSettings<S>& s = state_.settings;
  s.hz = clamp(s.hz, 10, 1000);
  s.substeps = clamp(s.substeps, 1, min(64, kMaxParticleRate / s.hz));
  const S limit = ParticleLimits<S>::speed();
  for (int axis = 0; axis < 3; ++axis) {
    const S g = s.gravity[axis];
    s.gravity[axis] = is_finite(g) ? clamp(g, -limit, limit) : S(0);
  }
  if (static_cast<std::uint32_t>(s.integrator) >= kIntegrators) s.integrator = Integrator::semi_implicit_euler;
  if (static_cast<std::uint32_t>(s.solver) >= kParticleSolvers) s.solver = ParticleSolver::soft_step;
  if (static_cast<std::uint32_t>(s.stepping) >= kSteppings) s.stepping = Stepping::fixed;
  s.pairs = min(s.pairs, kMostParticlePairs);
  if (s.hz != settings.hz || s.substeps != settings.substeps || !(s.gravity == settings.gravity) ||
      s.integrator != settings.integrator || s.solver != settings.solver || s.stepping != settings.stepping ||
      s.pairs != settings.pairs) {
    fault_ = Fault::out_of_range;
  }
  state_.materials.add(ParticleMaterial<S>{});
}

template <class S>
ParticleWorld<S>::ParticleWorld(const ParticleSettings<S>& settings)
    : engine_(std::make_unique<ParticleEngine<S>>(settings)) {}
template <class S> ParticleWorld<S>::~ParticleWorld() = default;
template <class S> ParticleWorld<S>::ParticleWorld(ParticleWorld&& other) noexcept : engine_(std::move(other.engine_)) {
  other.engine_ = std::make_unique<ParticleEngine<S>>(engine_->state_.settings);
}
template <class S> auto ParticleWorld<S>::operator=(ParticleWorld&& other) noexcept -> ParticleWorld& {
  if (this == &other) return *this;
  engine_ = std::move(other.engine_);
  other.engine_ = std::make_unique<ParticleEngine<S>>(engine_->state_.settings);
  return *this;
}

template <class S> const ParticleSettings<S>& ParticleWorld<S>::settings() const { return engine_->state_.settings; }
template <class S> std::uint64_t ParticleWorld<S>::tick() const { return engine_->state_.tick; }
template <class S> bool ParticleWorld<S>::use_simd(Simd simd) {
  const FlightKernels<S>* kernels = flight_kernels<S>(simd);
  if (kernels == nullptr) return false;
  engine_->kernels_ = kernels;
  return true;
}
template <class S> const char* ParticleWorld<S>::simd_name() const { return engine_->kernels_->name; }

namespace detail {
/// Executes under a pinned float environment and, when accepted, records.
template <class S, class C> auto run(ParticleEngine<S>& engine, const C& command) {
  const FloatEnvironment environment;
  engine.fault_ = Fault::none;
  const auto result = engine.execute(command);
  if (static_cast<bool>(result) && engine.tape_ != nullptr) {
    Writer writer(*engine.tape_);
    write_command<ParticleCommand<S>>(writer, command);
  }
  return result;
}
}  // namespace detail

template <class S> ParticleMaterialId ParticleWorld<S>::default_material() const { return engine_->first_material(); }
template <class S> ParticleId ParticleWorld<S>::create(const ParticleDefinition<S>& definition) {
  return detail::run(*engine_, CreateParticle<S>{definition});
}
template <class S> bool ParticleWorld<S>::destroy(ParticleId particle) {
  return detail::run(*engine_, DestroyParticle{particle});
}
template <class S> bool ParticleWorld<S>::set_motion(ParticleId particle, Vec3<S> position, Vec3<S> velocity) {
  return detail::run(*engine_, SetParticleMotion<S>{particle, position, velocity});
}
template <class S> bool ParticleWorld<S>::set_mass(ParticleId particle, S mass, bool pinned) {
  return detail::run(*engine_, SetParticleMass<S>{particle, mass, pinned});
}
template <class S> bool ParticleWorld<S>::set_material(ParticleId particle, ParticleMaterialId material) {
  return detail::run(*engine_, SetParticleMaterial{particle, material});
}
template <class S> bool ParticleWorld<S>::set_gravity(Vec3<S> gravity) {
  return detail::run(*engine_, SetParticleGravity<S>{gravity});
}
template <class S> bool ParticleWorld<S>::apply_force(ParticleId particle, Vec3<S> force) {
  return detail::run(*engine_, PushParticle<S>{particle, force});
}
template <class S> bool ParticleWorld<S>::apply_impulse(ParticleId particle, Vec3<S> impulse) {
  return detail::run(*engine_, KickParticle<S>{particle, impulse});
}
template <class S> bool ParticleWorld<S>::touch(const ParticleTouch<S>& touch) {
  return detail::run(*engine_, TouchParticle<S>{touch});
}

template <class S> ParticleMaterialId ParticleWorld<S>::add(const ParticleMaterial<S>& material) {
  return detail::run(*engine_, AddRecord<ParticleMaterial<S>>{material});
}
template <class S> bool ParticleWorld<S>::set(ParticleMaterialId id, const ParticleMaterial<S>& material) {
  return detail::run(*engine_, SetRecord<ParticleMaterial<S>, ParticleMaterialId>{id, material});
}
template <class S> bool ParticleWorld<S>::remove(ParticleMaterialId id) {
  return detail::run(*engine_, RemoveRecord<ParticleMaterialId>{id});
}
template <class S> const ParticleMaterial<S>* ParticleWorld<S>::find(ParticleMaterialId id) const {
  return engine_->state_.materials.find(id);
}
template <class S> SpringId ParticleWorld<S>::add(const Spring<S>& spring) {
  return detail::run(*engine_, AddRecord<Spring<S>>{spring});
}
template <class S> bool ParticleWorld<S>::set(SpringId id, const Spring<S>& spring) {
  return detail::run(*engine_, SetRecord<Spring<S>, SpringId>{id, spring});
}
template <class S> bool ParticleWorld<S>::remove(SpringId id) {
  return detail::run(*engine_, RemoveRecord<SpringId>{id});
}
template <class S> const Spring<S>* ParticleWorld<S>::find(SpringId id) const {
  return engine_->state_.springs.find(id);
}
template <class S> ForceId ParticleWorld<S>::add(const ParticleForce<S>& force) {
  return detail::run(*engine_, AddRecord<ParticleForce<S>>{force});
}
template <class S> bool ParticleWorld<S>::set(ForceId id, const ParticleForce<S>& force) {
  return detail::run(*engine_, SetRecord<ParticleForce<S>, ForceId>{id, force});
}
template <class S> bool ParticleWorld<S>::remove(ForceId id) {
  return detail::run(*engine_, RemoveRecord<ForceId>{id});
}
template <class S> const ParticleForce<S>* ParticleWorld<S>::find(ForceId id) const {
  return engine_->state_.forces.find(id);
}
template <class S> CohesionId ParticleWorld<S>::add(const Cohesion<S>& cohesion) {
  return detail::run(*engine_, AddRecord<Cohesion<S>>{cohesion});
}
template <class S> bool ParticleWorld<S>::set(CohesionId id, const Cohesion<S>& cohesion) {
  return detail::run(*engine_, SetRecord<Cohesion<S>, CohesionId>{id, cohesion});
}
template <class S> bool ParticleWorld<S>::remove(CohesionId id) {
  return detail::run(*engine_, RemoveRecord<CohesionId>{id});
}
template <class S> const Cohesion<S>* ParticleWorld<S>::find(CohesionId id) const {
  return engine_->state_.cohesions.find(id);
}
template <class S> LinkId ParticleWorld<S>::add(const Link<S>& link) {
  return detail::run(*engine_, AddRecord<Link<S>>{link});
}
template <class S> bool ParticleWorld<S>::set(LinkId id, const Link<S>& link) {
  return detail::run(*engine_, SetRecord<Link<S>, LinkId>{id, link});
}
template <class S> bool ParticleWorld<S>::remove(LinkId id) { return detail::run(*engine_, RemoveRecord<LinkId>{id}); }
template <class S> const Link<S>* ParticleWorld<S>::find(LinkId id) const { return engine_->state_.links.find(id); }
template <class S> ColliderId ParticleWorld<S>::add(const Collider<S>& collider) {
  return detail::run(*engine_, AddRecord<Collider<S>>{collider});
}
template <class S> bool ParticleWorld<S>::set(ColliderId id, const Collider<S>& collider) {
  return detail::run(*engine_, SetRecord<Collider<S>, ColliderId>{id, collider});
}
template <class S> bool ParticleWorld<S>::remove(ColliderId id) {
  return detail::run(*engine_, RemoveRecord<ColliderId>{id});
}
template <class S> const Collider<S>* ParticleWorld<S>::find(ColliderId id) const {
  return engine_->state_.colliders.find(id);
}

template <class S> bool ParticleWorld<S>::apply(const ParticleCommand<S>& command) {
  return std::visit([&](const auto& c) { return static_cast<bool>(detail::run(*engine_, c)); }, command);
}
template <class S> Fault ParticleWorld<S>::fault() const { return engine_->fault_; }
template <class S> void ParticleWorld<S>::record_to(std::vector<std::uint8_t>* tape) { engine_->tape_ = tape; }
template <class S> bool ParticleWorld<S>::records_to(const std::vector<std::uint8_t>* tape) const {
  return engine_->tape_ == tape;
}
template <class S> void ParticleWorld<S>::trace_to(std::vector<std::uint64_t>* hashes) { engine_->trace_ = hashes; }
template <class S> std::uint64_t ParticleWorld<S>::loads() const { return engine_->loads_; }

template <class S> bool ParticleWorld<S>::contains(ParticleId particle) const { return engine_->holds(particle); }
template <class S> Vec3<S> ParticleWorld<S>::position(ParticleId particle) const {
  return contains(particle) ? engine_->state_.position[particle.slot] : Vec3<S>::zero();
}
template <class S> Vec3<S> ParticleWorld<S>::velocity(ParticleId particle) const {
  return contains(particle) ? convert<S>(engine_->state_.velocity[particle.slot]) : Vec3<S>::zero();
}
template <class S> S ParticleWorld<S>::mass(ParticleId particle) const {
  const FloatEnvironment environment;
  const InverseMass<S> w = contains(particle) ? engine_->state_.inverse_mass[particle.slot] : InverseMass<S>(0);
  return InverseMass<S>(0) < w ? divide_to<S>(S(1), w) : S(0);
}
template <class S> ParticleMaterialId ParticleWorld<S>::material(ParticleId particle) const {
  if (!contains(particle)) return {};
  return engine_->state_.materials.slots().template id_of<ParticleMaterialId>(engine_->state_.material[particle.slot]);
}
template <class S> std::vector<ParticleId> ParticleWorld<S>::particles() const {
  std::vector<ParticleId> ids;
  const SlotMap& slots = engine_->state_.particles;
  for (std::uint32_t slot = 0; slot < slots.entries().size(); ++slot) {
    if (slots.is_taken(slot)) ids.push_back(slots.id_of<ParticleId>(slot));
  }
  return ids;
}
template <class S> ParticleCounts ParticleWorld<S>::counts() const {
  const ParticleState<S>& state = engine_->state_;
  const auto taken = [](const SlotMap& slots) {
    std::uint32_t count = 0;
    for (std::uint32_t slot = 0; slot < slots.entries().size(); ++slot) count += slots.is_taken(slot) ? 1u : 0u;
    return count;
  };
  ParticleCounts counts = {};
  counts.particles = taken(state.particles);
  for (std::uint32_t slot = 0; slot < state.material.size(); ++slot) {
    counts.pinned += state.particles.is_taken(slot) && state.inverse_mass[slot] == InverseMass<S>(0) ? 1u : 0u;
  }
  counts.springs = taken(state.springs.slots());
  counts.forces = taken(state.forces.slots()) + taken(state.cohesions.slots());
  counts.links = taken(state.links.slots());
  counts.colliders = taken(state.colliders.slots());
  counts.contacts = static_cast<std::uint32_t>(state.contacts.size());
  return counts;
}

template <class S> ParticleReport ParticleWorld<S>::step(const ParticleStageObserver& observer) {
  if (engine_->tape_ != nullptr) engine_->tape_->push_back(kStepMarker);
  return engine_->step(observer);
}
template <class S> const ParticleEvents<S>& ParticleWorld<S>::events() const { return engine_->events_; }

template <class S> ParticleWorld<S>::Snapshot::Snapshot() : state_(std::make_unique<ParticleState<S>>()) {
  state_->materials.add(ParticleMaterial<S>{});
}
template <class S> ParticleWorld<S>::Snapshot::~Snapshot() = default;
template <class S> ParticleWorld<S>::Snapshot::Snapshot(Snapshot&& other) noexcept = default;
template <class S> auto ParticleWorld<S>::Snapshot::operator=(Snapshot&& other) noexcept -> Snapshot& = default;
template <class S> std::size_t ParticleWorld<S>::Snapshot::bytes() const {
  if (state_ == nullptr) return 0;  // moved from
  detail::StateSize arrays;
  ParticleState<S>::members(arrays, std::as_const(*state_));
  return sizeof(ParticleState<S>) + arrays.value();
}
template <class S> void ParticleWorld<S>::save(Snapshot& to) const {
  if (to.state_ == nullptr) to.state_ = std::make_unique<ParticleState<S>>();  // moved from: as good as new
  *to.state_ = engine_->state_;
}
template <class S> void ParticleWorld<S>::load(const Snapshot& from) {
  if (from.state_ != nullptr) engine_->load(*from.state_);
}
template <class S> std::uint64_t ParticleWorld<S>::hash() const { return engine_->hash(); }
template <class S> void ParticleWorld<S>::write_portable(Writer& writer) const { engine_->write_portable(writer); }
template <class S> Result<void> ParticleWorld<S>::read_portable(Reader& reader) {
  const FloatEnvironment environment;
  return engine_->read_portable(reader);
}
template <class S> Result<void> ParticleWorld<S>::step_recorded(Bytes input) {
  return play_tape<ParticleCommand<S>>(
      input, [&](const ParticleCommand<S>& command) { return apply(command); }, [&] { step(); });
}
template <class S> const ParticleState<S>& ParticleWorld<S>::state() const { return engine_->state_; }
template <class S> StageView ParticleWorld<S>::leaves() const { return engine_->view(kParticleStages); }

}  // namespace isostep
