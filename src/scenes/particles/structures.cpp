// Rods and cables under a load that walks: the book's rope bridge and its platform.
// SPDX-License-Identifier: MIT
#include "isostep/particles/bodies/bridge.hpp"
#include "isostep/particles/bodies/platform.hpp"
#include "particle_scene.hpp"
#include "words.hpp"

namespace isostep::scenes::particle_scripts {
namespace {

template <class S> inline constexpr S kNode = S(1);   // [kg] a particle by itself
template <class S> inline constexpr S kLoad = S(10);  // [kg]

/// The share done / whole, with done <= whole.
template <class S> Unit<S> share_of(std::uint64_t done, std::uint64_t whole) {
  return divide_to<Unit<S>>(S(static_cast<std::int32_t>(done)), S(static_cast<std::int32_t>(whole)));
}
/// The load on four particles, by where it is between them: (0, 0) on the first, (1, 0) on the second, (0, 1) on the
/// third.
template <class S>
void put_load(ParticleWorld<S>& world, const std::uint32_t (&slots)[4], Unit<S> along, Unit<S> across) {
  const S second = kLoad<S> * along, first = kLoad<S> - second;
  const S loads[4] = {first - first * across, second - second * across, first * across, second * across};
  for (int i = 0; i < 4; ++i) world.set_mass(particle_at(world, slots[i]), kNode<S> + loads[i]);
}

// ---- bridge

constexpr std::uint32_t kColumns = 6;
constexpr std::uint32_t kCrossing = 20;  // [s]

template <class S> ParticleMaterialId wood(ParticleWorld<S>& world, S friction) {
  ParticleMaterial<S> material;
  material.damping = S(0.9);
  material.friction = friction;
  material.restitution = S(0.2);
  return world.add(material);
}
template <class S> void build_bridge(ParticleWorld<S>& world) {
  BridgeDefinition<S> d;
  d.columns = kColumns;
  d.mass = kNode<S>;
  d.material = wood(world, S(0));
  build(world, d);
  add_ground(world);
}
/// A load walks from particle 0 to the opposite corner, where it stays.
template <class S> void walk_bridge(ParticleWorld<S>& world) {
  const std::uint64_t whole = steps_of(world, kCrossing), done = world.tick();
  if (done > whole) return;
  const std::uint64_t spans = kColumns - 1, way = done * spans;
  const std::uint64_t span = done < whole ? way / whole : spans - 1;
  const auto i = static_cast<std::uint32_t>(2 * span);
  if (i > 0) {  // off those behind
    world.set_mass(particle_at(world, i - 2), kNode<S>);
    world.set_mass(particle_at(world, i - 1), kNode<S>);
  }
  put_load<S>(world, {i, i + 2, i + 1, i + 3}, share_of<S>(way - span * whole, whole), share_of<S>(done, whole));
}

// ---- platform

/// [s] The load's time on the left end, and on the way to the right end, where it stays for good.
constexpr std::uint32_t kOnTheLeft = 4, kToTheRight = 4;

template <class S> void build_platform(ParticleWorld<S>& world) {
  PlatformDefinition<S> d;
  d.mass = kNode<S>;
  d.material = wood(world, S(0.9));
  build(world, d);
  add_ground(world);
}
template <class S> void walk_platform(ParticleWorld<S>& world) {
  const std::uint64_t begin = steps_of(world, kOnTheLeft), whole = steps_of(world, kToTheRight);
  if (world.tick() > begin + whole) return;
  const std::uint64_t done = world.tick() < begin ? 0 : world.tick() - begin;
  put_load<S>(world, {2, 4, 3, 5}, share_of<S>(done, whole), Unit<S>(0.25));
}

}  // namespace

template <class S> ParticleScript<S> bridge(ParticleSolver solver) {
  ParticleScript<S> script = {{}, build_bridge<S>, walk_bridge<S>, nullptr};
  script.settings.gravity = {S(0), S(-9.81), S(0)};
  script.settings.solver = solver;
  return script;
}
template <class S> ParticleScript<S> platform() {
  ParticleScript<S> script = {{}, build_platform<S>, walk_platform<S>, nullptr};
  script.settings.gravity = {S(0), S(-9.81), S(0)};
  return script;
}

#define ISO_INSTANTIATE(S)                           \
  template ParticleScript<S> bridge(ParticleSolver); \
  template ParticleScript<S> platform();
ISO_FOR_EACH_SCALAR(ISO_INSTANTIATE)
#undef ISO_INSTANTIATE

}  // namespace isostep::scenes::particle_scripts
