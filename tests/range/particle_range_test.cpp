// The range contract of particles: inside ParticleLimits<S>, and whatever a game asks for, no intermediate of a step
// overflows. The engine runs here over scalars that stop the program where an exact answer does not fit.
// SPDX-License-Identifier: MIT
#include "determinism/particle_mess.hpp"

namespace isostep::test {
namespace particle_range_test {

using TrappingQ16 = Fixed<std::int32_t, 16, Overflow::trap>;
using TrappingQ32 = Fixed<std::int64_t, 32, Overflow::trap>;

template <class S> class ParticleRange : public ::testing::Test {};
using TrappingScalars = ::testing::Types<TrappingQ16, TrappingQ32>;
TYPED_TEST_SUITE(ParticleRange, TrappingScalars);

/// The slowest rate makes the longest ways, the fastest the largest 1/h.
template <class S> ParticleSettings<S> extreme_settings(std::uint32_t way) {
  constexpr std::int32_t rates[3][2] = {{10, 1}, {1000, 16}, {60, 4}};
  ParticleSettings<S> s = settings_of_way<S>(way % kParticleWays);
  s.hz = rates[way % 3][0];
  s.substeps = rates[way % 3][1];
  return s;
}
constexpr std::uint32_t kExtremes = 3 * kParticleWays;  // 3 and 15 share a factor: way / 15 turns the rates on
template <class S> ParticleSettings<S> turned_settings(std::uint32_t extreme) {
  const ParticleSettings<S> rate = extreme_settings<S>(extreme % kParticleWays + extreme / kParticleWays);
  ParticleSettings<S> s = settings_of_way<S>(extreme % kParticleWays);
  s.hz = rate.hz;
  s.substeps = rate.substeps;
  return s;
}

TYPED_TEST(ParticleRange, ALivelySceneOfEverythingSteppedEveryWay) {
  using S = TypeParam;
  for (std::uint32_t way = 0; way < kParticleWays; ++way) {
    SCOPED_TRACE(way);
    ParticleWorld<S> w(settings_of_way<S>(way));
    build_particle_mess(w);
    ParticleActivity activity;
    play_on(w, 0, 100, &activity);
    activity.expect_busy();
  }
}

TYPED_TEST(ParticleRange, WildCommands) {
  using S = TypeParam;
  std::uint32_t accepted = 0, mended = 0;
  for (std::uint32_t extreme = 0; extreme < kExtremes; ++extreme) {
    ParticleWorld<S> w(turned_settings<S>(extreme));
    for (std::uint64_t frame = 0; frame < 50; ++frame) {
      RandomCommands<S> random(w, frame * 64 + extreme, extreme % 2 == 0 ? 60 : 250);
      for (int i = 0; i < 12; ++i) accepted += apply_any(w, random.next()) ? 1u : 0u;
      mended += w.step().clean() ? 0u : 1u;
      ASSERT_EQ(broken_rule(w), "");
    }
  }
  EXPECT_GT(accepted, 5000u);
  EXPECT_GT(mended, 500u);
}

/// Everything at the end of its range at once, in a corner of the world and across it.
TYPED_TEST(ParticleRange, EveryNumberAtTheEndOfItsRange) {
  using S = TypeParam;
  using Limits = ParticleLimits<S>;
  const S edge = Limits::position(), speed = Limits::speed(), most = highest<S>();
  std::uint32_t clamped = 0, contacts = 0;
  for (std::uint32_t extreme = 0; extreme < kExtremes; ++extreme) {
    ParticleSettings<S> settings = turned_settings<S>(extreme);
    settings.gravity = {speed, -speed, speed};
    ParticleWorld<S> w(settings);
    std::vector<ParticleMaterialId> materials;
    for (int i = 0; i < 3; ++i) {
      ParticleMaterial<S> m;
      m.gravity_scale = i == 0 ? speed : i == 1 ? -speed : S(0);
      m.linear_drag = m.quadratic_drag = i == 1 ? most : S(0);
      m.radius = i == 2 ? edge : S(1);
      m.friction = S(16);
      m.restitution = S(1);
      m.collides = true;
      materials.push_back(w.add(m));
    }
    std::vector<ParticleId> ids;
    for (int i = 0; i < 12; ++i) {
      ParticleDefinition<S> d;
      const S x = i % 2 == 0 ? edge : -edge, y = i / 2 % 2 == 0 ? edge : -edge, z = i / 4 % 2 == 0 ? edge : -edge;
      d.position = i < 8 ? Vec3<S>{x, y, z} : Vec3<S>{S(i), S(0), S(0)};
      d.velocity = i % 3 == 0 ? Vec3<S>{-speed, -speed, -speed} : Vec3<S>{speed, speed, speed};
      d.mass = i % 3 == 1 ? Limits::mass() : Limits::least_mass();
      d.material = materials[static_cast<std::size_t>(i) % 3];
      ids.push_back(w.create(d));
    }
    for (std::size_t i = 0; i < 12; ++i) {
      Spring<S> spring = spring_of<S>(ids[i], i % 4 == 3 ? ParticleId{} : ids[i + 1], 0, 0);
      spring.type = static_cast<SpringType>(i % 3);
      spring.anchor = {-edge, edge, -edge};
      spring.stiffness = i < 6 ? most : S(100);
      spring.damping = i % 2 == 0 ? most : S(0);
      spring.elastic_limit = i % 3 == 2 ? S(0) : S(1);
      ASSERT_TRUE(w.add(spring));
      Link<S> link = link_of<S>(i % 2 == 0 ? LinkType::rod : LinkType::cable, ids[i], ids[(i + 5) % 12], 1);
      link.length = i % 4 == 0 ? edge : resolution<S>();
      link.restitution = S(1);
      ASSERT_TRUE(w.add(link));
      ParticleForce<S> force = force_of<S>(static_cast<ForceType>(i % 3), ids[i]);
      force.acceleration = {speed, -speed, speed};
      force.linear_drag = force.quadratic_drag = force.volume = force.density = most;
      force.surface_height = edge;
      force.max_depth = i % 2 == 0 ? edge : resolution<S>();
      ASSERT_TRUE(w.add(force));
    }
    ASSERT_TRUE(w.add(Cohesion<S>{materials[0], edge, most, edge, edge, most}));
    add_plane(w);
    Collider<S> line;
    line.type = ColliderType::line;
    line.start = {-edge, -edge, -edge};
    line.end = {edge, edge, edge};
    line.radius = edge;
    ASSERT_TRUE(w.add(line));
    for (int frame = 0; frame < 12; ++frame) {
      for (std::size_t i = 0; i < ids.size(); ++i) {
        w.apply_force(ids[i], {most, -most, most});
        if (frame % 3 == 0) w.apply_impulse(ids[i], {-most, most, -most});
        ParticleTouch<S> touch = {};
        touch.particle = ids[i];
        touch.normal.y = Unit<S>(i % 2 == 0 ? 1 : -1);
        touch.separation = i % 3 == 0 ? -edge : edge;
        const Velocity<S> pace = convert<Velocity<S>>(speed);
        touch.surface_velocity = {pace, -pace, pace};
        touch.surface_acceleration = {Limits::acceleration(), -Limits::acceleration(), S(0)};
        touch.inverse_mass = i % 3 == 1 ? resolution<InverseMass<S>>() : InverseMass<S>(1);
        touch.friction = S(16);
        touch.restitution = S(1);
        ASSERT_TRUE(w.touch(touch));
      }
      const ParticleReport report = w.step();
      clamped += report.clamped_speed + report.clamped_position;
      contacts += w.counts().contacts;
      ASSERT_EQ(broken_rule(w), "") << extreme;
    }
  }
  EXPECT_GT(clamped, 1000u);
  EXPECT_GT(contacts, 1000u);
}

TYPED_TEST(ParticleRange, ParticlesAtTheSpeedLimitCollideAndDeepOverlapsAreParted) {
  using S = TypeParam;
  const S speed = ParticleLimits<S>::speed();
  std::uint32_t begun = 0;
  for (std::uint32_t extreme = 0; extreme < kExtremes; ++extreme) {
    ParticleWorld<S> w(turned_settings<S>(extreme));
    ASSERT_TRUE(w.set(w.default_material(), ball_material<S>(4, 1, 16)));
    add_plane(w);
    for (int i = 0; i < 20; ++i) {
      ParticleDefinition<S> d;
      d.position = {S(i % 5), S(i / 5), S(i % 3)};
      d.velocity = i % 2 == 0 ? Vec3<S>{speed, -speed, speed} : Vec3<S>{-speed, speed, -speed};
      d.mass = i % 4 == 0 ? ParticleLimits<S>::mass() : ParticleLimits<S>::least_mass();
      w.create(d);
    }
    for (int frame = 0; frame < 20; ++frame) {
      w.step();
      begun += static_cast<std::uint32_t>(w.events().contact_begin.size());
      ASSERT_EQ(broken_rule(w), "");
    }
  }
  EXPECT_GT(begun, 1000u);
}

}  // namespace particle_range_test
}  // namespace isostep::test
