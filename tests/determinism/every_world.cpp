// Steps bodies by every solver and particles by several, in every scalar that is built, and prints the hash of all
// frames. To be linked, compiled and run in ways that must not show:
//   every_world            the hashes
//   every_world sine       a hash of the C library's sines instead
//   every_world address    where the system put a block of memory.
// SPDX-License-Identifier: MIT
#include <cinttypes>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <memory>

#include "isostep/core/instantiate.hpp"
#include "isostep/particles/particle_world.hpp"
#include "isostep/state/hash.hpp"
#include "isostep/world/world.hpp"

namespace {

using namespace isostep;

constexpr int kFrames = 36;

/// A number of so many thousandths, rounded as the scalar does. One product a call, out of line: what a careless
/// compiler makes of a user's own sums is the user's.
template <class S> [[gnu::noinline]] S number(int thousandths) { return S(thousandths) * S(0.001); }
template <class S> Vec3<S> place(int x, int y, int z) { return {number<S>(x), number<S>(y), number<S>(z)}; }

/// A pile of every shape, a chain of every joint and a figure of balls on joints, with numbers that no format holds
/// exactly.
template <class S> void build(World<S>& world) {
  const ShapeId ground = world.add_shape(HalfSpace<S>{{Unit<S>(0), Unit<S>(1), Unit<S>(0)}, S(0)});
  const ShapeId shapes[] = {world.add_shape(Box{{0.5, 0.4, 0.3}}), world.add_shape(Sphere{0.4}),
                            world.add_shape(Capsule{0.3, 0.3})};
  world.create({.shape = ground});
  const auto add = [&](int shape, Vec3<S> at) {
    BodyDefinition<S> body;
    body.type = BodyType::dynamic;
    body.shape = shapes[shape];
    body.position = at;
    body.angular_velocity = {S(0.3), S(shape), S(0.1)};
    if (shape == 1) body.material.restitution = S(0.4);
    return world.create(body);
  };
  for (int i = 0; i < 12; ++i) add(i % 3, place<S>(i % 4 * 700, 900 + i * 300, i % 3 * 600));
  const auto join = [&](JointType type, BodyId a, BodyId b, Vec3<S> at) {
    JointProperties<S> joint = world.joint_at(type, a, b, {at, Quat<Unit<S>>::identity()});
    if (type == JointType::distance) joint.upper = S(0.2);
    if (type == JointType::hinge) {
      joint.flags = joint_flag::kMotor;
      joint.motor_speed = S(0.7);
      joint.max_force = S(1.1);
    }
    world.create(joint);
  };
  BodyId last;
  for (int i = 0; i < static_cast<int>(kJointTypes); ++i) {
    const BodyId link = add(i % 3, place<S>(-6000, 5000 - i * 900, i * 200));
    join(static_cast<JointType>(i), last, link, place<S>(-6000, 5400 - i * 900, i * 200));
    last = link;
  }
  const BodyId trunk = add(2, place<S>(6000, 2000, 0));
  for (const int side : {700, -700}) {
    join(JointType::ball, trunk, add(1, place<S>(6000 + side, 2300, 0)), place<S>(6000 + side / 2, 2100, 0));
  }
}

/// Balls that fall on a plane, a net of springs between pinned ends, a rope with rods in it, and what coheres.
template <class S> void build(ParticleWorld<S>& world) {
  ParticleMaterial<S> material;
  material.radius = S(0.2);
  material.restitution = S(0.3);
  material.friction = S(0.4);
  material.collides = true;
  const ParticleMaterialId balls = world.add(material);
  const auto add = [&](Vec3<S> at, bool pinned, ParticleMaterialId made_of) {
    ParticleDefinition<S> particle;
    particle.position = at;
    particle.velocity = pinned ? Vec3<S>::zero() : Vec3<S>{S(0.1), S(-0.3), S(0.2)};
    particle.mass = S(0.7);
    particle.pinned = pinned;
    particle.material = made_of;
    return world.create(particle);
  };
  world.add(Collider<S>{});
  for (int i = 0; i < 10; ++i) add(place<S>(i % 3 * 300, 500 + i * 350, i % 2 * 100), false, balls);
  ParticleId last, rope;
  for (int i = 0; i < 8; ++i) {
    const ParticleId next = add(place<S>(i * 500 - 6000, 3000, 0), i % 7 == 0, world.default_material());
    Spring<S> spring;
    spring.a = next;
    spring.b = last;
    spring.anchor = {S(-6), S(3.4), S(0)};
    spring.stiffness = S(41);
    spring.damping = S(0.6);
    spring.rest_length = S(0.3);
    world.add(spring);
    last = next;
    const ParticleId bead = add(place<S>(i * 400 + 4000, 3000, 0), i == 0, balls);
    if (i > 0) world.add(Link<S>{i % 3 == 0 ? LinkType::rod : LinkType::cable, rope, bead, {}, S(0.4), S(0.1)});
    rope = bead;
  }
  Cohesion<S> cohesion;
  cohesion.material = balls;
  cohesion.repel_distance = S(0.3);
  cohesion.repel_force = S(5);
  cohesion.attract_start = S(0.4);
  cohesion.attract_end = S(0.9);
  cohesion.attract_force = S(3);
  world.add(cohesion);
}

/// Runs a world. Returns whether something went on.
template <class W> bool run(const char* scalar, const char* way, W& world) {
  HashCombiner frames;
  std::uint64_t same = 0, last = world.hash();
  for (int frame = 0; frame < kFrames; ++frame) {
    world.step();
    same += world.hash() == last ? 1u : 0u;
    last = world.hash();
    frames.add(last);
  }
  std::printf("%s %s %016" PRIx64 " contacts %u\n", scalar, way, frames.value(), world.counts().contacts);
  return same == 0 && world.counts().contacts > 2;
}

template <class S> bool run_all() {
  bool ran = true;
  for (std::uint32_t i = 0; i < kSolvers; ++i) {
    if (left_out(SolverName{i}) != nullptr) continue;
    Settings<S> settings;
    settings.substeps = 4;
    settings.solver = static_cast<SolverName>(i);
    World<S> world(settings);
    build(world);
    ran = run(ScalarTraits<S>::kName, kSolverNames[i], world) && ran;
  }
  for (std::uint32_t i = 0; i < 6; ++i) {
    ParticleSettings<S> settings;
    settings.integrator = static_cast<Integrator>(i % kIntegrators);
    settings.solver = i % 2 == 0 ? ParticleSolver::soft_step : ParticleSolver::worst_first;
    settings.stepping = i == 5 ? Stepping::time_division : Stepping::fixed;
    ParticleWorld<S> world(settings);
    build(world);
    ran = run(ScalarTraits<S>::kName, kIntegratorNames[i % kIntegrators], world) && ran;
  }
  return ran;
}

void print_sines() {
  HashCombiner sines;
  for (int i = 0; i < 20000; ++i) {
    const volatile double x = i * 0.37;
    const double sine = std::sin(x);
    std::uint64_t bits;
    std::memcpy(&bits, &sine, sizeof bits);
    sines.add(bits);
  }
  std::printf("sine %016" PRIx64 "\n", sines.value());
}

}  // namespace

int main(int count, char** arguments) {
  if (count > 1 && std::strcmp(arguments[1], "sine") == 0) {
    print_sines();
    return 0;
  }
  if (count > 1 && std::strcmp(arguments[1], "address") == 0) {
    const std::unique_ptr<char[]> block(new char[1 << 20]);
    std::printf("%p\n", static_cast<void*>(block.get()));
    return 0;
  }
  bool ran = true;
#define ISO_RUN(S) ran = run_all<S>() && ran;
  ISO_FOR_EACH_SCALAR(ISO_RUN)
#undef ISO_RUN
  return ran ? 0 : 1;
}
