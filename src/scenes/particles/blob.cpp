// The book's blob on its ten platforms, steered by a script.
// SPDX-License-Identifier: MIT
#include "isostep/particles/bodies/blob.hpp"

#include "isostep/core/random.hpp"
#include "isostep/scalar/math.hpp"
#include "particle_scene.hpp"
#include "words.hpp"

namespace isostep::scenes::particle_scripts {
namespace {

constexpr std::uint64_t kBlobSeed = 3;
constexpr int kPlatforms = 10;

template <class S> Vec3<S> shaken(Pcg32& random, int x, int y) {
  const S dx = uniform(random, S(-2), S(2));
  return {S(x) + dx, S(y) + uniform(random, S(-2), S(2)), S(0)};
}
/// Source:  Millington, ch. 8.3; its blob demo. Every second platform is to the right; all slope towards the middle.
template <class S> void build_blob(ParticleWorld<S>& world) {
  Pcg32 random = Pcg32::seeded(kBlobSeed);
  Vec3<S> middle = {S(0), S(0), S(0)};
  for (int i = 0; i < kPlatforms; ++i) {
    const int left = i % 2 * 10 - 5;
    const Vec3<S> start = shaken<S>(random, left, 4 * i + (i % 2 == 0 ? 2 : 0));
    const Vec3<S> end = shaken<S>(random, left + 10, 4 * i + (i % 2 == 0 ? 0 : 2));
    add_line(world, start, end, S(0));
    middle = (start + end) * S(0.5);
  }
  add_ground(world, S(-4));
  BlobDefinition<S> d;
  d.centre = middle + Vec3<S>{S(0), S(2), S(0)};
  d.flat = true;
  d.material.gravity_scale = S(0.4);
  build(world, d);
}

/// -1 or 1 along x: down the platform beneath a point, or back to the middle where there is none. 0 on the way down to
/// a platform, so that nothing clings to the edge of the last.
template <class S> int downhill(const ParticleWorld<S>& world, Vec3<S> at) {
  int way = at.x < S(5) ? 1 : -1;
  S highest = S(-4);
  for (const Collider<S>& line : world.state().colliders.all()) {
    if (line.type != ColliderType::line || at.x < line.start.x || line.end.x < at.x) continue;
    const Unit<S> share = divide_to<Unit<S>>(at.x - line.start.x, line.end.x - line.start.x);
    const S height = line.start.y + (line.end.y - line.start.y) * share;
    if (at.y < height || height < highest) continue;
    highest = height;
    way = height < at.y - S(2) ? 0 : line.start.y < line.end.y ? -1 : 1;
  }
  return way;
}

/// The head is pushed downhill, but each eighth second the other way, and floats where at least two others are near.
template <class S> void steer_blob(ParticleWorld<S>& world) {
  const ParticleId head = particle_at(world, 0);
  const Vec3<S> at = world.position(head);
  int near = 0;
  for (const ParticleId particle : world.particles()) {
    const Vec3<S> away = world.position(particle) - at;
    if (particle != head && length(away) < S(1)) ++near;
  }
  const std::uint64_t second = world.tick() / static_cast<std::uint64_t>(world.settings().hz);
  const int push = downhill(world, at) * (second % 8 == 7 ? -10 : 10);  // [N]
  const int lift = 4 * (near < 2 ? near : 2);                           // [N]
  world.apply_force(head, {S(push), S(lift), S(0)});
}

}  // namespace

template <class S> ParticleScript<S> blob() {
  ParticleScript<S> script = {{}, build_blob<S>, steer_blob<S>, nullptr};
  script.settings.gravity = {S(0), S(-9.81), S(0)};
  return script;
}

#define ISO_INSTANTIATE(S) template ParticleScript<S> blob();
ISO_FOR_EACH_SCALAR(ISO_INSTANTIATE)
#undef ISO_INSTANTIATE

}  // namespace isostep::scenes::particle_scripts
