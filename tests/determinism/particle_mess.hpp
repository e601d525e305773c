// A busy scene of particles and a hail of random commands, for the tests of determinism: every force, every bond, every
// kind of contact.
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <ostream>

#include "unit/particles/random_commands.hpp"

namespace isostep::test {

/// A way to step, by number: every integrator, both solvers, time division.
constexpr std::uint32_t kParticleWays = 15;
template <class S> ParticleSettings<S> settings_of_way(std::uint32_t way) {
  ParticleSettings<S> s = particle_settings<S>(-10, way % 2 == 0 ? 4 : 2);
  s.integrator = static_cast<Integrator>(way % 5);
  s.solver = way / 5 > 0 ? ParticleSolver::worst_first : ParticleSolver::soft_step;
  s.stepping = way / 5 == 2 ? Stepping::time_division : Stepping::fixed;
  return s;
}

/// The ids that the scene needs again every frame.
struct ParticleMess {
  std::vector<ParticleId> balls, tossed;
  ParticleId swing;
};

/// Balls on two planes and a rail, a net that tears, a rope, a bridge of rods, a blob, a raft, a pendulum on a stiff
/// spring, and what flies with drag.
template <class S> ParticleMess build_particle_mess(ParticleWorld<S>& w) {
  ParticleMess m;
  Chance chance(7);
  const auto point = [&](D3 at, const ParticleMaterialId material, bool pinned = false) {
    const double mass = chance.in(0.5, 2);
    ParticleDefinition<S> d = particle_at<S>(at, chance.point(1), mass);
    d.material = material;
    d.pinned = pinned;
    if (pinned) d.velocity = Vec3<S>::zero();
    return w.create(d);
  };
  const auto link = [&](LinkType type, ParticleId a, ParticleId b, double length) {
    EXPECT_TRUE(w.add(link_of<S>(type, a, b, length))) << describe(w.fault());
  };

  const ParticleMaterialId balls = w.add(ball_material<S>(0.25, 0.25, 0.5));
  ParticleMaterial<S> material;
  material.damping = num<S>(0.75);
  const ParticleMaterialId cloth = w.add(material);
  material = {};
  material.linear_drag = num<S>(0.0625);
  material.quadratic_drag = num<S>(0.03125);
  material.gravity_scale = num<S>(0.5);
  const ParticleMaterialId feather = w.add(material);
  material = ball_material<S>(0.125);
  const ParticleMaterialId goo = w.add(material);

  add_plane(w);
  Collider<S> slope;
  slope.normal = {num<Unit<S>>(0.6), num<Unit<S>>(0.8), Unit<S>(0)};
  slope.offset = num<S>(-2);
  EXPECT_TRUE(w.add(slope));
  Collider<S> rail;
  rail.type = ColliderType::line;
  rail.start = vec<S>(-2, 1, 0.25);
  rail.end = vec<S>(2, 1.25, 0);
  rail.radius = num<S>(0.125);
  EXPECT_TRUE(w.add(rail));

  for (int i = 0; i < 24; ++i) m.balls.push_back(point({chance.in(-1, 1), 2 + 0.375 * i, chance.in(-1, 1)}, balls));
  for (int i = 0; i < 15; ++i) m.tossed.push_back(point({0.5 * i, 6, -4}, feather));

  std::vector<ParticleId> net;
  for (int i = 0; i < 25; ++i) net.push_back(point({0.5 * (i % 5) - 5, 4, 0.5 * (i / 5)}, cloth, i == 0 || i == 4));
  for (int i = 0; i < 25; ++i) {
    for (const int next : {1, 5}) {
      if (next == 1 ? i % 5 == 4 : i >= 20) continue;
      Spring<S> s = spring_of<S>(net[i], net[i + next], 60, 0.5);
      s.damping = num<S>(0.5);
      s.type = i % 3 == 0 ? SpringType::bungee : SpringType::spring;
      s.elastic_limit = num<S>(i % 2 == 0 ? 0.25 : 0);
      EXPECT_TRUE(w.add(s));
    }
  }
  Spring<S> stiff = spring_of<S>(point({5, 4, 3}, cloth), {}, 20000, 0);
  stiff.type = SpringType::stiff;
  stiff.damping = S(2);
  stiff.anchor = vec<S>(5, 5, 3);
  EXPECT_TRUE(w.add(stiff));

  ParticleId last = m.swing = w.create(pinned_at<S>({3, 6, 2}, {0.25, 0, 0}));
  for (int i = 0; i < 6; ++i) {
    const ParticleId next = point({3 + 0.5 * (i + 1), 6, 2}, balls);
    link(LinkType::cable, last, next, 0.625);
    last = next;
  }
  last = {};
  for (int i = 0; i < 6; ++i) {
    const ParticleId next = point({1.0 * i, 3, -2}, goo, i == 5);
    if (last) link(LinkType::rod, last, next, 1);
    if (i == 2 || i == 4) w.add(spring_of<S>(next, {}, 30, 1));
    last = next;
  }
  for (int i = 0; i < 8; ++i) point({-3 + 0.25 * (i % 2), 1 + 0.25 * (i / 2 % 2), 2 + 0.25 * (i / 4)}, goo);
  EXPECT_TRUE(w.add(Cohesion<S>{goo, num<S>(0.25), S(30), num<S>(0.375), S(1), S(20)}));

  for (const ParticleId id : {m.balls[3], m.balls[4]}) {
    ParticleForce<S> f = force_of<S>(ForceType::buoyancy, id);
    f.volume = num<S>(0.5);
    f.density = S(8);
    f.surface_height = S(1);
    EXPECT_TRUE(w.add(f));
    f.type = ForceType::drag;
    f.linear_drag = S(1);
    f.quadratic_drag = num<S>(0.25);
    EXPECT_TRUE(w.add(f));
  }
  ParticleForce<S> lift = force_of<S>(ForceType::gravity, m.tossed[0]);
  lift.acceleration = vec<S>(0, 4, 1);
  EXPECT_TRUE(w.add(lift));
  return m;
}

/// The activity that a scene must show for equal hashes to mean something.
struct ParticleActivity {
  std::uint32_t contacts = 0, begins = 0, expired = 0, yielded = 0, touched = 0, accepted = 0, refused = 0, links = 0;
  std::uint32_t stopped = 0;

  template <class S> void watch(const ParticleWorld<S>& w, const ParticleReport& report) {
    const ParticleCounts counts = w.counts();
    contacts = std::max(contacts, counts.contacts);
    links = std::max(links, counts.links);
    begins += static_cast<std::uint32_t>(w.events().contact_begin.size());
    expired += static_cast<std::uint32_t>(w.events().expired.size());
    yielded += static_cast<std::uint32_t>(w.events().yielded.size());
    touched += static_cast<std::uint32_t>(w.events().touch_impulses.size());
    stopped += report.stopped;
  }
  /// Expects what some hundred frames and more do.
  void expect_busy() const {
    EXPECT_GT(contacts, 12u);
    EXPECT_GT(links, 8u);
    EXPECT_GT(begins, 40u);
    EXPECT_GT(expired, 8u);
    EXPECT_GT(yielded, 3u);
    EXPECT_GT(touched, 12u);
    EXPECT_GT(accepted, 200u);
    EXPECT_GT(refused, 5u);
    EXPECT_EQ(stopped, 0u) << "a lively scene, not an explosion";
  }
};

/// A frame of the hail: its commands, a step, the hash. A function of the world's state and the frame's number alone.
template <class S> std::uint64_t play(ParticleWorld<S>& w, std::uint64_t frame, ParticleActivity* activity = nullptr) {
  RandomCommands<S> random(w, frame * 1000003 + 17, 0);
  const std::uint32_t count = random.chance().below(8);
  for (std::uint32_t i = 0; i < count; ++i) {
    const bool taken = apply_any(w, random.next());
    if (activity != nullptr) ++(taken ? activity->accepted : activity->refused);
  }
  const ParticleReport report = w.step();
  if (activity != nullptr) activity->watch(w, report);
  return w.hash();
}

template <class S>
std::vector<std::uint64_t> play_on(ParticleWorld<S>& w, std::uint64_t from, std::uint64_t count,
                                   ParticleActivity* activity = nullptr) {
  std::vector<std::uint64_t> hashes;
  for (std::uint64_t f = from; f < from + count; ++f) hashes.push_back(play(w, f, activity));
  return hashes;
}

}  // namespace isostep::test
