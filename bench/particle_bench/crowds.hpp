// The worlds of the particle benchmark, for any scalar.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "isostep/particles/bodies/cloth.hpp"
#include "isostep/particles/particle_world.hpp"

namespace isostep::bench {

template <class S> Vec3<S> at(double x, double y, double z) {
  return {from_double<S>(x), from_double<S>(y), from_double<S>(z)};
}
template <class S>
ParticleId put(ParticleWorld<S>& world, Vec3<S> position, Vec3<S> velocity = Vec3<S>::zero(),
               ParticleMaterialId material = {}) {
  ParticleDefinition<S> particle;
  particle.position = position;
  particle.velocity = velocity;
  particle.material = material;
  return world.create(particle);
}

/// `count` free particles that fly all over with drag, of which nobody leaves the smallest world.
template <class S> ParticleWorld<S> make_flight(int count, double linear_drag, double quadratic_drag) {
  ParticleWorld<S> world;
  ParticleMaterial<S> dragged;
  dragged.damping = from_double<S>(0.9);
  dragged.linear_drag = from_double<S>(linear_drag);
  dragged.quadratic_drag = from_double<S>(quadratic_drag);
  const ParticleMaterialId material = world.add(dragged);
  for (int i = 0; i < count; ++i) {
    put(world, at<S>(i % 50, i / 50 % 50, i / 2500 % 50), at<S>(i % 7 - 3, i % 11, i % 5 - 2), material);
  }
  return world;
}

/// A cloth of side x side particles a decimetre apart, held at two corners, falls from where it lies level.
template <class S> ParticleWorld<S> make_cloth(std::uint32_t side) {
  ParticleWorld<S> world;
  const S width = from_double<S>(0.1 * (side - 1));
  ClothDefinition<S> cloth;
  cloth.corner = Vec3<S>::zero();
  cloth.across = {width, S(0), S(0)};
  cloth.down = {S(0), S(0), width};
  cloth.columns = cloth.rows = side;
  cloth.mass = from_double<S>(0.0625 * side * side);
  build(world, cloth);
  return world;
}

/// `count` balls that fall into a pit and lie there.
template <class S> ParticleWorld<S> make_pile(int count) {
  ParticleWorld<S> world;
  ParticleMaterial<S> ball;
  ball.radius = from_double<S>(0.25);
  ball.friction = from_double<S>(0.5);
  ball.collides = true;
  const ParticleMaterialId material = world.add(ball);
  world.add(Collider<S>{});
  for (int wall = 0; wall < 4; ++wall) {
    Collider<S> plane;
    const auto sign = Unit<S>(wall % 2 == 0 ? 1 : -1), none = Unit<S>(0);
    plane.normal = wall < 2 ? Vec3<Unit<S>>{sign, none, none} : Vec3<Unit<S>>{none, none, sign};
    plane.offset = S(-4);
    world.add(plane);
  }
  for (int i = 0; i < count; ++i) {
    const double layer = i / 196 % 2 * 0.2;  // layers lie in each other's dents, none of them quite even
    const double aside = layer + i % 101 * 7919 % 101 * 0.0002, away = layer + i % 103 * 7919 % 103 * 0.0002;
    put(world, at<S>(i % 14 * 0.55 - 3.7 + aside, 0.4 + i / 196 * 0.5, i / 14 % 14 * 0.55 - 3.7 + away),
        Vec3<S>::zero(), material);
  }
  return world;
}

}  // namespace isostep::bench
