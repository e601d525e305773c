// Building and measuring a plan's particles in every scalar.
// SPDX-License-Identifier: MIT
#include "particle_run.hpp"

#include <algorithm>

#include "isostep/dynamics/settings.hpp"
#include "isostep/particles/particle_state.hpp"
#include "isostep/particles/scenery.hpp"

namespace isostep::tool::lab {
namespace {

template <class T> T enter(double number) {
  T value{};
  TextError error = TextError::none;
  if (scenes::Number(number).read(value, error)) return value;
  throw scenes::SceneError("", to_text(number) + " is out of range for " + ScalarTraits<T>::kName);
}
template <class T> Vec3<T> enter(Vec3<double> v) {
  const T x = enter<T>(v.x);
  const T y = enter<T>(v.y);
  return {x, y, enter<T>(v.z)};
}

template <class Id, class S> Id expect(Id id, const ParticleWorld<S>& world, const char* what) {
  if (!id) throw scenes::SceneError("", std::string("a ") + what + " is refused: " + describe(world.fault()));
  return id;
}

template <class S> ParticleSettings<S> settings_of(const ParticlePlan& plan, const LabPoint& point) {
  ParticleSettings<S> settings;
  settings.hz = point.hz;
  settings.substeps = point.substeps;
  settings.gravity = enter<S>(plan.gravity);
  if (point.substeps < 1 || point.substeps > 64 || point.hz * point.substeps > kMaxParticleRate)
    throw scenes::SceneError("", "more than " + std::to_string(kMaxParticleRate) + " sub-steps a second");
  for (std::uint32_t i = 0; i < kParticleSolvers; ++i) {
    settings.solver = static_cast<ParticleSolver>(i);
    if (point.solver == kParticleSolverNames[i]) return settings;
  }
  throw scenes::SceneError("", "particles have no solver " + point.solver);
}

/// A ball that may touch others.
struct Ball {
  Vec3<double> centre;
  double radius;
  bool collides;
};

scenes::Overlap summary(const std::vector<double>& depths) {
  scenes::Overlap overlap;
  overlap.pairs = static_cast<std::uint32_t>(depths.size());
  for (const double depth : depths) {
    overlap.worst = std::max(overlap.worst, depth);
    overlap.mean += depth / static_cast<double>(depths.size());
  }
  return overlap;
}

}  // namespace

template <class S>
ParticleRun<S>::ParticleRun(const Subject& subject, const LabPoint& point)
    : plan_(subject.particles.model), world_(settings_of<S>(plan_, point)) {
  if (world_.fault() != Fault::none) throw scenes::SceneError("", describe(world_.fault()));
  add_particles();
  add_rods();
  add_scenery();
}

template <class S> void ParticleRun<S>::add_particles() {
  std::vector<ParticleMaterialId> materials;
  for (const ParticlePlan::Material& material : plan_.materials) {
    ParticleMaterial<S> m;
    m.gravity_scale = enter<S>(material.gravity_scale);
    m.damping = enter<S>(material.damping);
    m.radius = enter<S>(material.radius);
    m.friction = enter<S>(material.friction);
    m.restitution = enter<S>(material.restitution);
    m.collides = material.collides;
    materials.push_back(expect(world_.add(m), world_, "material"));
  }
  for (const ParticlePlan::Particle& particle : plan_.particles) {
    ParticleDefinition<S> d;
    d.position = enter<S>(particle.position);
    d.velocity = enter<S>(particle.velocity);
    d.mass = enter<S>(particle.mass);
    d.material = materials[particle.material];
    particles_.push_back(expect(world_.create(d), world_, "particle"));
    mass_ += particle.mass;
  }
}

template <class S> void ParticleRun<S>::add_rods() {
  for (const ParticlePlan::Rod& rod : plan_.rods) {
    Link<S> link;
    link.type = LinkType::rod;
    link.a = particles_[static_cast<std::size_t>(rod.a)];
    if (rod.b >= 0) link.b = particles_[static_cast<std::size_t>(rod.b)];
    else link.anchor = enter<S>(rod.anchor);
    link.length = enter<S>(rod.length);
    expect(world_.add(link), world_, "rod");
  }
}

template <class S> void ParticleRun<S>::add_scenery() {
  for (const ParticlePlan::Scenery& scenery : plan_.scenery) {
    Collider<S> collider;
    if (scenery.is_plane) {
      collider.normal = enter<Unit<S>>(scenery.normal);
      collider.offset = enter<S>(scenery.offset);
    } else {
      collider.type = ColliderType::line;
      collider.start = enter<S>(scenery.start);
      collider.end = enter<S>(scenery.end);
      collider.radius = enter<S>(scenery.radius);
    }
    expect(world_.add(collider), world_, "collider");
  }
}

/// The rows that worst_first leaves unresolved are an error that is measured, not a number mended.
template <class S> bool ParticleRun<S>::step() {
  ParticleReport report = world_.step();
  report.unresolved = 0;
  return !report.clean();
}

template <class S> scenes::Energy ParticleRun<S>::energy() const {
  const scenes::ParticleEnergy energy = scenes::measure_energy(world_);
  return {energy.kinetic, energy.potential, mass_};
}

/// The particles are sorted along x and swept, as the rigid measure does; pairs closer than 1 cm.
template <class S> scenes::Overlap ParticleRun<S>::overlap() const {
  constexpr double kNear = 0.01;  // [m]
  const ParticleState<S>& state = world_.state();
  std::vector<Ball> balls;
  std::vector<double> depths;
  for (std::size_t i = 0; i < particles_.size(); ++i) {
    const ParticlePlan::Material& material = plan_.materials[plan_.particles[i].material];
    const Vec3<S> centre = world_.position(particles_[i]);
    balls.push_back({scenes::in_double(centre), material.radius, material.collides});
    for (const Collider<S>& collider : state.colliders.all()) {
      const double gap = to_double(distance_to(collider, centre).distance) - material.radius;
      if (gap < kNear) depths.push_back(std::max(-gap, 0.0));
    }
  }
  const auto low = [](const Ball& ball) { return ball.centre.x - ball.radius; };
  std::stable_sort(balls.begin(), balls.end(), [&](const Ball& a, const Ball& b) { return low(a) < low(b); });
  for (std::size_t i = 0; i < balls.size(); ++i) {
    const Ball& a = balls[i];
    for (std::size_t j = i + 1; j < balls.size() && low(balls[j]) <= a.centre.x + a.radius + kNear; ++j) {
      if (!a.collides || !balls[j].collides) continue;
      const double gap = length_of(a.centre - balls[j].centre) - a.radius - balls[j].radius;
      if (gap < kNear) depths.push_back(std::max(-gap, 0.0));
    }
  }
  return summary(depths);
}

template <class S> scenes::Sight ParticleRun<S>::sight(int faults) const {
  scenes::Sight sight;
  sight.time = static_cast<double>(world_.tick()) / world_.settings().hz;
  for (const ParticlePlan::Place& place : plan_.places) {
    Vec3<double> at[2], velocity[2] = {{0, 0, 0}, {0, 0, 0}};
    for (int end = 0; end < 2; ++end) {
      at[end] = place.fixed[end];
      if (place.ends[end] < 0) continue;
      const ParticleId particle = particles_[static_cast<std::size_t>(place.ends[end])];
      at[end] = scenes::in_double(world_.position(particle));
      velocity[end] = scenes::in_double(world_.velocity(particle));
    }
    scenes::BodySight body;
    body.centre = at[0] + (at[1] - at[0]) * place.share;
    body.velocity = velocity[0] + (velocity[1] - velocity[0]) * place.share;
    body.dynamic = body.awake = place.dynamic;
    sight.bodies.push_back(body);
  }
  sight.joint_error = joint_error();
  sight.energy = energy();
  sight.faults = faults;
  return sight;
}

#define ISO_INSTANTIATE(S) template class ParticleRun<S>;
ISO_FOR_EACH_SCALAR(ISO_INSTANTIATE)
#undef ISO_INSTANTIATE

}  // namespace isostep::tool::lab
