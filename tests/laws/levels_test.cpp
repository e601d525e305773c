// Levels: rays, bodies, bullets and ragdolls visit every part of them, and none gets under the surface.
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>

#include "isostep/world/world.hpp"
#include "level_solid.hpp"
#include "sample.hpp"
#include "scenes/build.hpp"
#include "scenes/levels/level_bodies.hpp"
#include "scenes/measure.hpp"
#include "scenes/named.hpp"
#include "scenes/ragdolls.hpp"

namespace isostep::scenes {
namespace levels_test {

using V = Vec3<double>;
using Kind = LevelSpot::Kind;

struct Town {
  static Level level() { return town_level(); }
};
struct Yard {
  static Level level() { return yard_level(); }
};
template <class S_, class Place_> struct Case {
  using S = S_;
  using Place = Place_;
};

V in(Point p) { return {p.x, p.y, p.z}; }
Point out(V v) { return {v.x, v.y, v.z}; }

template <class C> class LevelLaws : public ::testing::Test {
 protected:
  using S = typename C::S;
  static constexpr bool kNarrow = std::is_same_v<S, Q16_16>;

  LevelLaws() : level_(C::Place::level()), solid_(level_.scene), scene_(level_.scene) {}

  static Vec3<S> vec(V v) { return {from_double<S>(v.x), from_double<S>(v.y), from_double<S>(v.z)}; }
  std::vector<LevelSpot> spots(std::initializer_list<Kind> kinds) const {
    std::vector<LevelSpot> found;
    for (const LevelSpot& spot : level_.spots) {
      for (const Kind kind : kinds) {
        if (spot.kind == kind) found.push_back(spot);
      }
    }
    return found;
  }
  /// The parts to stand on; of a sample every third, other ones in each scalar.
  std::vector<LevelSpot> some_tops() const {
    std::vector<LevelSpot> tops = spots({Kind::top}), some;
    const std::size_t scalar = std::is_same_v<S, double> ? 1 : std::is_same_v<S, Q32_32> ? 2 : 0;
    for (std::size_t i = 0; i < tops.size(); ++i) {
      if (test::wants_whole() || i % 3 == scalar) some.push_back(tops[i]);
    }
    return some;
  }
  /// Visitors pass each other: what they do is between them and the level.
  void add(SceneBody body) {
    body.group = 1;
    scene_.bodies.push_back(std::move(body));
  }
  std::size_t fixed() const { return level_.scene.bodies.size(); }
  void start() {
    scene_.allow_sleep = false;
    world_ = World<S>(settings_of<S>(scene_));
    built_ = build(scene_, world_);
  }
  V place(std::size_t body) const { return in_double(world_.center_of_mass(built_.bodies[body])); }
  V velocity(std::size_t body) const { return in_double(world_.velocity(built_.bodies[body])); }
  /// Nobody's centre is in anything solid, and nobody has fallen off.
  void expect_all_outside(int frame) const {
    for (std::size_t i = fixed(); i < built_.bodies.size(); ++i) {
      const V p = place(i);
      ASSERT_FALSE(solid_.holds(p)) << "frame " << frame << ": body " << i << " at " << p.x << " " << p.y << " " << p.z;
      ASSERT_GT(p.y, -4) << "frame " << frame << ": body " << i;
    }
  }

  /// Expects that limbs, thinner than what they move in a step, do not stay inside: they may dip in and must come out.
  void expect_none_stays_inside(int frame) {
    inside_.resize(built_.bodies.size());
    for (std::size_t i = fixed(); i < built_.bodies.size(); ++i) {
      const V p = place(i);
      inside_[i] = solid_.holds(p) ? inside_[i] + 1 : 0;
      ASSERT_LT(inside_[i], 10) << "frame " << frame << ": body " << i << " at " << p.x << " " << p.y << " " << p.z;
      ASSERT_GT(p.y, -4) << "frame " << frame << ": body " << i;
    }
  }

  Level level_;
  LevelSolid solid_;
  Scene scene_;  // the level, and who visits it
  World<S> world_;
  Built<S> built_;
  std::vector<int> inside_;  // frames in a row
};

using Cases = ::testing::Types<Case<float, Town>, Case<double, Town>, Case<Q16_16, Town>, Case<Q32_32, Town>,
                               Case<float, Yard>, Case<double, Yard>, Case<Q16_16, Yard>, Case<Q32_32, Yard>>;
TYPED_TEST_SUITE(LevelLaws, Cases);

/// The oracle itself: under each part there is something, and nothing above it.
TYPED_TEST(LevelLaws, are_solid_under_every_part) {
  for (const LevelSpot& spot : this->spots({Kind::top, Kind::wall})) {
    EXPECT_TRUE(this->solid_.holds(in(spot.at) - in(spot.outward) * 0.015625)) << spot.name;
    EXPECT_FALSE(this->solid_.holds(in(spot.at) + in(spot.outward) * 0.015625)) << spot.name;
  }
}

TYPED_TEST(LevelLaws, a_ray_meets_every_part_where_it_is) {
  this->start();
  int seen = 0;
  for (const LevelSpot& spot : this->spots({Kind::top, Kind::wall})) {
    const V at = in(spot.at), way = spot.kind == Kind::top ? V{0, -1, 0} : in(spot.outward) * -1.0;
    const auto hit = this->world_.cast_ray(this->vec(at - way * 0.9375), this->vec(way * 1.25));
    ASSERT_TRUE(hit) << spot.name;
    EXPECT_LT(length(in_double(hit->point) - at), 1.0 / 512) << spot.name;
    EXPECT_GT(dot(in_double(hit->normal), in(spot.outward)), 0.9995) << spot.name;
    EXPECT_EQ(hit->material, spot.material < 0 ? 0 : spot.material) << spot.name;
    ++seen;
  }
  EXPECT_GE(seen, 80);
  int open = 0;
  for (const LevelSpot& spot : this->spots({Kind::doorway})) {
    const V way = in(spot.outward), across = {way.z, 0, -way.x};
    for (const double side : {-0.5, 0.0, 0.5}) {
      const V from = in(spot.at) + V{0, 1, 0} + across * side - way * 1.25;
      EXPECT_FALSE(this->world_.cast_ray(this->vec(from), this->vec(way * 2.5))) << spot.name;
      ++open;
    }
    const V beside = in(spot.at) + V{0, 1, 0} + across * 1.25 - way * 1.25;
    EXPECT_TRUE(this->world_.cast_ray(this->vec(beside), this->vec(way * 2.5))) << spot.name;
  }
  EXPECT_GE(open, 9);
}

/// Six shapes on each.
TYPED_TEST(LevelLaws, what_is_dropped_on_a_part_stays_on_it_or_slides_off) {
  constexpr int kFrames = 180, kShapes = 6;
  Draws draws(11);
  for (const LevelSpot& spot : this->some_tops()) {
    for (int n = 0; n < kShapes; ++n) this->add(drawn_visitor(n, {spot.at.x, spot.at.y + 0.875, spot.at.z}, draws));
  }
  this->start();
  const std::size_t end = this->built_.bodies.size();
  std::vector<V> from;
  for (std::size_t i = this->fixed(); i < end; ++i) from.push_back(this->place(i));
  const double energy = measure_energy(this->world_).total();
  for (int frame = 1; frame <= kFrames; ++frame) {
    this->world_.step();
    if (frame % 10 == 0) this->expect_all_outside(frame);
    if (this->HasFatalFailure()) return;
  }
  std::size_t lower = 0, still = 0;
  for (std::size_t i = this->fixed(); i < end; ++i) {
    lower += this->place(i).y < from[i - this->fixed()].y ? 1 : 0;
    still += length(this->velocity(i)) < 0.05 ? 1 : 0;
  }
  EXPECT_EQ(lower, from.size());
  EXPECT_GT(still, from.size() / 3);
  EXPECT_LT(measure_energy(this->world_).total(), energy);
}

TYPED_TEST(LevelLaws, a_bullet_passes_no_part) {
  constexpr int kFrames = 10;
  const double speed = this->kNarrow ? 60 : 120;
  const std::vector<LevelSpot> spots = this->spots({Kind::top, Kind::wall});
  for (const LevelSpot& spot : spots) {
    SceneBody bullet = body_of(sphere_part(0.05), out(in(spot.at) + in(spot.outward) * 0.9));
    bullet.velocity = vector_of(out(in(spot.outward) * -speed));
    bullet.mass = 0.25;
    this->add(bullet);
  }
  this->start();
  std::size_t stopped = 0;
  for (int frame = 1; frame <= kFrames; ++frame) {
    this->world_.step();
    this->expect_all_outside(frame);
    for (std::size_t n = 0; n < spots.size(); ++n) {
      const V p = this->place(this->fixed() + n);
      ASSERT_GT(dot(p - in(spots[n].at), in(spots[n].outward)), 0) << spots[n].name;
    }
  }
  for (std::size_t n = 0; n < spots.size(); ++n)
    stopped += length(this->velocity(this->fixed() + n)) < 0.1 * speed ? 1 : 0;
  EXPECT_EQ(stopped, spots.size());
}

/// From both sides.
TYPED_TEST(LevelLaws, a_body_goes_through_every_doorway) {
  const std::vector<LevelSpot> doorways = this->spots({Kind::doorway});
  for (const LevelSpot& doorway : doorways) {
    for (const double side : {1.0, -1.0}) {
      SceneBody body = body_of(box_part({0.3, 0.6, 0.3}), out(in(doorway.at) + in(doorway.outward) * (1.25 * side)));
      body.position[1] = doorway.at.y + 0.65;
      body.velocity = vector_of(out(in(doorway.outward) * (-5 * side)));
      body.friction = 0;
      this->add(body);
    }
  }
  this->start();
  for (int frame = 1; frame <= 36; ++frame) this->world_.step();
  this->expect_all_outside(36);
  int through = 0;
  for (std::size_t n = 0; n < doorways.size(); ++n) {
    for (const double side : {1.0, -1.0}) {
      const V p = this->place(this->fixed() + 2 * n + (side < 0 ? 1 : 0));
      EXPECT_LT(side * dot(p - in(doorways[n].at), in(doorways[n].outward)), -1.0) << doorways[n].name;
      ++through;
    }
  }
  EXPECT_GE(through, 6);
}

/// Not Q16.16: ragdolls are beyond its ratios.
template <class C> class RagdollLevels : public LevelLaws<C> {};
using WideCases = ::testing::Types<Case<float, Town>, Case<double, Town>, Case<Q32_32, Town>, Case<float, Yard>,
                                   Case<double, Yard>, Case<Q32_32, Yard>>;
TYPED_TEST_SUITE(RagdollLevels, WideCases);

TYPED_TEST(RagdollLevels, a_ragdoll_on_every_part_neither_falls_through_nor_explodes) {
  constexpr int kFrames = 120;
  // [m/s]; [m] at an impact, which holds back the part that has it; [m] not longer than a moment.
  constexpr double kFastest = 30, kTorn = 0.5, kApart = 0.05;
  constexpr int kMoment = 90;  // [frames]
  int n = 0;
  const std::vector<LevelSpot> tops = this->some_tops();
  for (const LevelSpot& spot : tops)
    add_ragdoll(this->scene_, {spot.at.x, spot.at.y + 1.25, spot.at.z}, 0.05 * (n++ % 7 - 3), true);
  for (std::size_t i = this->fixed(); i < this->scene_.bodies.size(); ++i) this->scene_.bodies[i].group = 1;
  this->start();
  const std::size_t joints = this->built_.joints.size() / tops.size();
  double energy = measure_energy(this->world_).total(), torn = 0, fastest = 0;
  std::string where;  // the worst is
  std::vector<int> apart(this->built_.joints.size());
  for (int frame = 1; frame <= kFrames; ++frame) {
    this->world_.step();
    for (std::size_t i = 0; i < this->built_.joints.size(); ++i) {
      const double error = to_double(this->world_.joint_error(this->built_.joints[i]));
      apart[i] = error > kApart ? apart[i] + 1 : 0;
      ASSERT_LT(apart[i], kMoment) << tops[i / joints].name << " in frame " << frame;
      if (error <= torn) continue;
      torn = error;
      where = tops[i / joints].name + " in frame " + std::to_string(frame);
    }
    this->expect_none_stays_inside(frame);
    if (this->HasFatalFailure()) return;
    if (frame % 5 != 0) continue;
    for (std::size_t i = this->fixed(); i < this->built_.bodies.size(); ++i)
      fastest = std::max(fastest, length(this->velocity(i)));
    const double now = measure_energy(this->world_).total();
    EXPECT_LT(now, energy + 0.001 * std::fabs(energy)) << "frame " << frame;
    energy = now;
  }
  EXPECT_GT(fastest, 3);
  EXPECT_LT(fastest, kFastest);
  EXPECT_LT(torn, kTorn) << where;
  EXPECT_GT(torn, 0);
}

}  // namespace levels_test
}  // namespace isostep::scenes
