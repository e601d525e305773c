// The particle scenes: that each shows what it is for, against closed forms and the book's own figures.
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <string>

#include "isostep/particles/particle_state.hpp"
#include "scenes/particles/particle_game.hpp"

namespace isostep::scenes {
namespace particle_scenes_test {

struct Point {
  double x, y, z;
};
template <class S> Point point_of(Vec3<S> v) { return {to_double(v.x), to_double(v.y), to_double(v.z)}; }
double length_of(Point p) { return std::hypot(p.x, p.y, p.z); }
Point between(Point a, Point b) { return {b.x - a.x, b.y - a.y, b.z - a.z}; }
double distance_of(Point p, Point start, Point end) {
  const Point along = between(start, end), to = between(start, p);
  const double whole = along.x * along.x + along.y * along.y + along.z * along.z;
  const double part = (to.x * along.x + to.y * along.y + to.z * along.z) / whole;
  const double t = part < 0 ? 0 : part > 1 ? 1 : part;
  return length_of(between({start.x + t * along.x, start.y + t * along.y, start.z + t * along.z}, p));
}

template <class S> struct Game : ParticleGame<S> {
  explicit Game(const char* name) : ParticleGame<S>(*find_particle_scene(name)) {}

  /// `each(frame)` after every frame.
  template <class Each> void run(int frames, Each&& each) {
    for (int i = 0; i < frames && !::testing::Test::HasFatalFailure(); ++i) {
      this->advance();
      each(i);
    }
  }
  void run(int frames) {
    run(frames, [](int) {});
  }
  ParticleId id(std::uint32_t slot) const { return this->world.state().particles.template id_of<ParticleId>(slot); }
  Point at(std::uint32_t slot) const { return point_of(this->world.position(id(slot))); }
  Point velocity(std::uint32_t slot) const { return point_of(this->world.velocity(id(slot))); }
  double fastest() const {
    double speed = 0;
    for (const ParticleId particle : this->world.particles()) {
      speed = std::max(speed, length_of(point_of(this->world.velocity(particle))));
    }
    return speed;
  }
  /// The greatest length by which a cable is too long, or a rod wrong.
  double worst_link() const {
    double worst = 0;
    for (const Link<S>& link : this->world.state().links.all()) {
      const Point b = point_of(link.b ? this->world.position(link.b) : link.anchor);
      const double error = length_of(between(point_of(this->world.position(link.a)), b)) - to_double(link.length);
      worst = std::max(worst, link.type == LinkType::rod ? std::abs(error) : error);
    }
    return worst;
  }
};

template <class S> class ParticleScenes : public ::testing::Test {};
using Scalars = ::testing::Types<float, double, Q16_16, Q32_32>;
TYPED_TEST_SUITE(ParticleScenes, Scalars);

TEST(ParticleSceneList, NamesAreFoundAndDiffer) {
  std::set<std::string> names;
  for (const ParticleScene& scene : particle_scenes()) {
    EXPECT_TRUE(names.insert(scene.name).second) << scene.name;
    EXPECT_EQ(find_particle_scene(scene.name), &scene);
    EXPECT_GT(scene.frames, 0);
  }
  EXPECT_EQ(names.size(), 18u);
  EXPECT_EQ(find_particle_scene("no such"), nullptr);
}

TYPED_TEST(ParticleScenes, NoCommandIsRefusedAndNothingHasToBeMended) {
  for (const ParticleScene& scene : particle_scenes()) {
    ParticleGame<TypeParam> game(scene);
    ASSERT_EQ(game.world.fault(), Fault::none) << scene.name << ": " << describe(game.world.fault());
    const std::uint64_t first = game.world.hash();
    for (int i = 0; i < 300; ++i) {
      const ParticleReport report = game.advance();
      ASSERT_EQ(game.world.fault(), Fault::none) << scene.name << ' ' << i << ": " << describe(game.world.fault());
      ASSERT_TRUE(report.clamped_speed == 0 && report.clamped_position == 0 && report.stopped == 0 &&
                  report.unsolved == 0 && report.lost_pairs == 0)
          << scene.name << ' ' << i;
    }
    EXPECT_NE(game.world.hash(), first) << scene.name;
  }
}

TYPED_TEST(ParticleScenes, SavedAndLoadedMidwayGoOnAlike) {
  for (const ParticleScene& scene : particle_scenes()) {
    ParticleGame<TypeParam> game(scene), other(scene);
    for (int i = 0; i < 70; ++i) game.advance();
    typename ParticleWorld<TypeParam>::Snapshot middle;
    game.world.save(middle);
    std::vector<std::uint64_t> hashes;
    for (int i = 0; i < 80; ++i) {
      game.advance();
      hashes.push_back(game.world.hash());
    }
    game.world.load(middle);
    other.world.load(middle);
    for (std::size_t i = 0; i < 80; ++i) {
      game.advance();
      other.advance();
      ASSERT_EQ(game.world.hash(), hashes[i]) << scene.name << ' ' << i;
      ASSERT_EQ(other.world.hash(), hashes[i]) << scene.name << ' ' << i;
    }
  }
}

TYPED_TEST(ParticleScenes, ALogOfTheirCommandsAndStepsIsThemAgain) {
  for (const ParticleScene& scene : particle_scenes()) {
    const ParticleScript<TypeParam> script = script_of<TypeParam>(scene.id);
    ParticleWorld<TypeParam> world(script.settings), again(script.settings);
    std::vector<std::uint8_t> log;
    world.record_to(&log);
    script.build(world);
    for (int i = 0; i < (scene.id == ParticleSceneId::springs ? 260 : 40); ++i) {
      if (script.before_step != nullptr) script.before_step(world);
      world.step();
      if (script.after_step != nullptr) script.after_step(world);
      ASSERT_TRUE(again.step_recorded(log)) << scene.name << ' ' << i;
      ASSERT_EQ(again.hash(), world.hash()) << scene.name << ' ' << i;
      log.clear();
    }
  }
}

/// BOOK O1, O2: v' = k v + a with k = ln d; semi-implicit steps gain a h t / 2.
TYPED_TEST(ParticleScenes, RoundsFlyAlongTheirClosedForm) {
  const struct {
    double up, along, a, d;
  } rounds[] = {{0, 35, -1, 0.99}, {30, 40, -20, 0.99}, {0, 10, 0.6, 0.9}, {0, 100, 0, 0.99}};
  for (int kind = 0; kind < 4; ++kind) {
    Game<TypeParam> game("ballistic");
    game.run(16 * kind + 90);
    const ParticleId last = game.id(static_cast<std::uint32_t>(kind));
    ASSERT_TRUE(game.world.contains(last));
    const auto [up, along, a, d] = rounds[kind];
    const double t = 1.5, k = std::log(d), grown = (std::exp(k * t) - 1) / k;
    const double y = 1.5 + (up + a / k) * grown - a * t / k, z = along * grown;
    const Point at = point_of(game.world.position(last));
    EXPECT_EQ(at.x, 0);
    EXPECT_NEAR(at.y, y, std::abs(a) * t / 480 + 0.02) << kind;
    EXPECT_NEAR(at.z, z, 0.06) << kind;
  }
}
TYPED_TEST(ParticleScenes, ThePoolHoldsSixteenRoundsAndTheGroundTakesThem) {
  Game<TypeParam> game("ballistic");
  std::uint32_t most = 0;
  game.run(600, [&](int) {
    most = std::max(most, game.world.counts().particles);
    for (const ParticleId id : game.world.particles()) {
      EXPECT_FALSE(game.world.position(id).y < TypeParam(0));
      EXPECT_FALSE(TypeParam(200) < game.world.position(id).z);
    }
  });
  EXPECT_GT(most, 6u);
  EXPECT_LE(most, 16u);
}

TYPED_TEST(ParticleScenes, FireworksMultiplyAndDie) {
  Game<TypeParam> game("fireworks");
  std::uint32_t most = 0;
  game.run(400, [&](int) { most = std::max(most, game.world.counts().particles); });
  EXPECT_GT(most, 25u);
  EXPECT_EQ(game.world.counts().particles, 0u);
}

/// The book's own engine: 0.021 m and 0.65 m/s that never end.
TYPED_TEST(ParticleScenes, TheBridgeBearsTheLoadAndComesToRest) {
  Game<TypeParam> game("bridge");
  double worst = 0, high = -10, low = 10;
  game.run(1200, [&](int frame) {
    if (frame >= 60) worst = std::max(worst, game.worst_link());  // it is made 0.1 m too long
    if (frame == 400) high = game.at(11).y;
    low = game.at(11).y;
  });
  EXPECT_LT(worst, 0.06);
  EXPECT_NEAR(to_double(game.world.mass(game.id(11))), 11, 0.1);
  EXPECT_LT(low, high - 0.1);
  game.run(60 * 60);
  EXPECT_LT(game.worst_link(), 0.02);
  EXPECT_LT(game.fastest(), 0.05);
}
TYPED_TEST(ParticleScenes, TheWorstFirstBridgeHolds) {
  Game<TypeParam> game("worst_first");
  game.run(300);
  EXPECT_EQ(game.world.settings().solver, ParticleSolver::worst_first);
  EXPECT_LT(game.worst_link(), 0.15);
}

/// The book's own engine: 0.029 m and 0.82 m/s that never end.
TYPED_TEST(ParticleScenes, ThePlatformTipsToTheLoadAndKeepsItsShape) {
  Game<TypeParam> game("platform");
  double worst = 0;
  game.run(240, [&](int) { worst = std::max(worst, game.worst_link()); });
  EXPECT_LT(game.at(2).y, 0.05);
  EXPECT_GT(game.at(4).y, 3);
  EXPECT_LT(game.fastest(), 0.05);
  game.run(660, [&](int) { worst = std::max(worst, game.worst_link()); });
  EXPECT_GT(game.at(2).y, 2);
  EXPECT_LT(game.at(4).y, 0.05);
  EXPECT_LT(game.fastest(), 0.05);
  EXPECT_LT(worst, 0.03);
}

TYPED_TEST(ParticleScenes, TheBlobStaysInItsPlaneAndAbovePlatforms) {
  Game<TypeParam> game("blob");
  const auto& lines = game.world.state().colliders.all();
  const double start = game.at(0).y;
  std::vector<Point> before(5);
  for (std::uint32_t i = 0; i < 5; ++i) before[i] = game.at(i);
  game.run(1200, [&](int frame) {
    for (std::uint32_t i = 0; i < 5; ++i) {
      ASSERT_EQ(game.world.position(game.id(i)).z, TypeParam(0));
      ASSERT_EQ(game.world.velocity(game.id(i)).z, TypeParam(0));
      const Point at = game.at(i);
      ASSERT_LT(length_of(between(before[i], at)), 0.25) << frame;  // so nothing skips a line of radius 0.4
      before[i] = at;
      for (const Collider<TypeParam>& line : lines) {
        if (line.type != ColliderType::line) continue;
        ASSERT_GT(distance_of(at, point_of(line.start), point_of(line.end)), 0.3) << frame << ' ' << i;
      }
    }
  });
  EXPECT_LT(game.at(0).y, start - 8);  // two platforms and more
  EXPECT_GT(game.at(0).y, -4);
}

/// BOOK O22: y = a cosh(x / a), where the length fixes a.
TYPED_TEST(ParticleScenes, TheRopeHangsInACatenary) {
  Game<TypeParam> game("rope");
  game.run(900);
  double low = 0.1, high = 100;  // 2 a sinh(4 / a) falls with a
  for (int i = 0; i < 100; ++i) {
    const double a = (low + high) / 2;
    (2 * a * std::sinh(4 / a) > 10 ? low : high) = a;
  }
  const double sag = low * (std::cosh(4 / low) - 1);
  EXPECT_NEAR(6 - game.at(25).y, sag, 0.02 * sag);
  for (std::uint32_t i = 1; i < 50; ++i) {
    const double x = game.at(i).x;
    EXPECT_NEAR(game.at(i).y, 6 - sag + low * (std::cosh(x / low) - 1), 0.02 * sag + 0.02) << i;
  }
}

TYPED_TEST(ParticleScenes, TheClothHangsByItsCornersAndLiesOnTheBar) {
  Game<TypeParam> game("cloth");
  int on_bar = 0;
  game.run(300, [&](int) {
    for (const auto& begin : game.world.events().contact_begin) on_bar += begin.collider.slot == 0;
    for (std::uint32_t i = 0; i < 169; ++i) ASSERT_GT(game.at(i).y, 1) << i;  // the ground, less than the radius in
  });
  EXPECT_GT(on_bar, 5);
  EXPECT_EQ(game.at(0).y, 4);
  EXPECT_EQ(game.at(12).x, 2);
  EXPECT_LT(game.at(162).y, 2.5);
  EXPECT_LT(game.fastest(), 5);
}

TYPED_TEST(ParticleScenes, TheSoftBoxSettlesOnItsFeet) {
  Game<TypeParam> game("soft_box");
  double lowest = 10, squeezed = 10;
  game.run(600, [&](int) {
    for (std::uint32_t i = 0; i < 64; ++i) lowest = std::min(lowest, game.at(i).y);
    squeezed = std::min(squeezed, game.at(63).y - game.at(51).y);
  });
  EXPECT_GT(lowest, 0.03);
  EXPECT_LT(squeezed, 0.95);  // it gave on landing
  EXPECT_NEAR(game.at(63).y - game.at(51).y, 1, 0.05);
  EXPECT_LT(game.fastest(), 0.05);
}

TYPED_TEST(ParticleScenes, SpringsYieldExpireAndGo) {
  Game<TypeParam> game("springs");
  std::size_t yielded = 0, expired = 0, pushed = 0;
  const double limit = to_double(game.world.state().springs.all()[6].rest_length);
  game.run(300, [&](int) {
    yielded += game.world.events().yielded.size();
    expired += game.world.events().expired.size();
    pushed += game.world.events().touch_impulses.size();
  });
  EXPECT_GT(yielded, 0u);
  EXPECT_EQ(expired, 1u);
  EXPECT_EQ(pushed, 1u);
  EXPECT_GT(to_double(game.world.state().springs.all()[6].rest_length), limit + 0.1);
  EXPECT_EQ(game.world.counts().springs, 5u);
  EXPECT_EQ(game.world.counts().forces, 2u);
  EXPECT_EQ(game.world.counts().particles, 16u);
}

/// BOOK O10.
TYPED_TEST(ParticleScenes, TheCradleHandsTheBlowToTheLast) {
  Game<TypeParam> game("cradle");
  game.run(85);
  for (std::uint32_t i = 0; i < 4; ++i) EXPECT_LT(std::abs(game.velocity(i).x), 0.15) << i;
  double highest = 0;
  game.run(60, [&](int) { highest = std::max(highest, game.at(4).y); });
  EXPECT_NEAR(highest, 1, 0.05);
}

TYPED_TEST(ParticleScenes, TheBallsInThePitComeToRestApart) {
  Game<TypeParam> game("billiards");
  game.run(600);
  EXPECT_LT(game.fastest(), 0.05);
  for (std::uint32_t i = 0; i < 200; ++i) {
    const Point at = game.at(i);
    EXPECT_GT(at.y, 0.18);
    EXPECT_LT(at.y, 3);
    EXPECT_LT(std::max(std::abs(at.x), std::abs(at.z)), 1.32);
    for (std::uint32_t j = 0; j < i; ++j) EXPECT_GT(length_of(between(at, game.at(j))), 0.38) << i << ' ' << j;
  }
}

TYPED_TEST(ParticleScenes, NoBulletPassesItsWall) {
  Game<TypeParam> game("time_division");
  bool back[8] = {}, met = false;
  game.run(60, [&](int) {
    for (std::uint32_t i = 0; i < 8; ++i) {
      const double wall = to_double(game.world.state().colliders.all()[i].end.x);
      EXPECT_TRUE(back[i] || game.at(i).x < wall) << i;
      back[i] = back[i] || game.velocity(i).x < 0;
    }
    met = met || game.velocity(8).x < 0;
    EXPECT_TRUE(met || game.at(8).x < game.at(9).x);  // nor each other
  });
  for (const bool one : back) EXPECT_TRUE(one);
  EXPECT_TRUE(met);
}

TYPED_TEST(ParticleScenes, EveryIntegratorKeepsItsCloth) {
  for (const char* name : {"explicit_euler", "velocity_verlet", "rk4", "implicit_euler"}) {
    Game<TypeParam> game(name);
    EXPECT_EQ(kIntegratorNames[static_cast<std::uint32_t>(game.world.settings().integrator)], std::string(name));
    game.run(300, [&](int frame) { ASSERT_LT(game.fastest(), 12) << name << ' ' << frame; });
    EXPECT_EQ(game.at(0).y, 2) << name;
    EXPECT_LT(game.at(76).y, 0.5) << name;  // the last row's middle
    EXPECT_GT(game.at(76).y, -1) << name;
  }
}

}  // namespace particle_scenes_test
}  // namespace isostep::scenes
