// Laws of characters in levels drawn at random: lifts, platforms, doors, one-way floors, crates and a car at once.
// SPDX-License-Identifier: MIT

#include <algorithm>

#include "random/dice.hpp"
#include "unit/world/worlds.hpp"

namespace isostep::test {
namespace character_levels_test {

constexpr double kRadius = 0.3, kHalf = 0.6, kSkin = 1.0 / 64;  // [m] of a character
constexpr double kMiddle = kRadius + kHalf;                     // [m] of a character above its foot
constexpr double kRoom = 8;                                     // [m] half of the arena's inner side
constexpr double kWalk = 3, kJump = 4;                          // [m/s]
constexpr double kTop = 4;                                      // [m] that anything stands on

/// A walled arena. All of it follows from the seed, the state and the frame.
template <class S> class Level {
 public:
  Level(std::uint64_t seed, bool driven) : w(settings<S>()), seed_(seed) {
    Dice dice(seed * 77 + 5);
    add(BodyType::static_, {kRoom + 1, 0.5, kRoom + 1}, {0, -0.5, 0});
    for (const double side : {-1.0, 1.0}) {
      add(BodyType::static_, {0.25, 6, kRoom + 1}, {side * (kRoom + 0.25), 6, 0});
      add(BodyType::static_, {kRoom + 1, 6, 0.25}, {0, 6, side * (kRoom + 0.25)});
    }
    for (int i = 0; i < 4; ++i) {
      const double x = dice.in(-6, 6), z = dice.in(-6, 6), half = dice.in(0.5, 1.5), high = dice.in(0.1, 0.6);
      add(BodyType::static_, {half, high, 1}, {x, high, z});
    }
    if (driven) add_movers(dice);
    for (int i = 0; i < 8; ++i) {
      const double x = dice.in(-6, 6), y = dice.in(1, 3), z = dice.in(-6, 6), half = dice.in(0.2, 0.5);
      crates.push_back(add(BodyType::dynamic, {half, half, half}, {x, y, z}));
      EXPECT_TRUE(w.set_mass(crates.back(), {.mass = num<S>(dice.in(2, 200))}));
    }
    capsule_ = w.add_shape(Capsule<S>{num<S>(kRadius), num<S>(kHalf)});
    for (int i = 0; i < 12; ++i) add_walker({(i % 4 - 1.5) * 3, 4 + i / 4 * 0.1, (i / 4 - 1) * 4.0});
  }

  /// A frame of any world that began as this one.
  void play(World<S>& world, int frame) const {
    for (std::size_t k = 0; k < walkers.size(); ++k) {
      Dice dice(seed_ * 1009 + static_cast<std::uint64_t>(frame / 30) * 131 + k);
      const double x = dice.in(-kWalk, kWalk), z = dice.in(-kWalk, kWalk);
      CharacterInput<S> input;
      input.move = vec<S>(x, 0, z);
      input.jump = num<S>(dice.one_in(3) && frame % 30 == 0 ? kJump : 0);
      EXPECT_TRUE(world.set_input(walkers[k], input)) << describe(world.fault());
    }
    turn_movers(world, frame);
    world.step();
  }
  D3 foot(CharacterId id) const { return real(w.pose(w.find(id)->body).position) - D3{0, kMiddle, 0}; }

  World<S> w;
  std::vector<CharacterId> walkers;
  std::vector<BodyId> crates;

 private:
  BodyId add(BodyType type, D3 half, D3 at) {
    BodyDefinition<S> d = moving<S>(add_box(w, half.x, half.y, half.z), at);
    d.type = type;
    const BodyId body = w.create(d);
    EXPECT_TRUE(body) << describe(w.fault());
    return body;
  }
  void add_walker(D3 foot) {
    BodyDefinition<S> d = moving<S>(capsule_, foot + D3{0, kMiddle + kSkin, 0});
    d.type = BodyType::kinematic;
    d.allow_sleep = false;
    CharacterSettings<S> c;
    c.body = w.create(d);
    walkers.push_back(w.add(c));
    EXPECT_TRUE(walkers.back()) << describe(w.fault());
  }
  void add_movers(Dice& dice) {
    lift_ = add(BodyType::kinematic, {1.25, 0.125, 1.25}, {dice.in(-5, 5), 0.5, -5});
    ferry_ = add(BodyType::kinematic, {1.25, 0.125, 1.25}, {0, dice.in(0.5, 1.5), 5});
    door_ = add(BodyType::kinematic, {1.5, 1, 0.125}, {dice.in(-2, 2), 1.125, 0});
    const double x = dice.in(-4, 4), z = dice.in(-3, 3);
    const BodyId floor = add(BodyType::static_, {2, 0.125, 1.5}, {x, 2, z});
    EXPECT_TRUE(w.add(OneWay<S>{floor}));
    add_car({dice.in(-3, 3), 1, 2});
  }
  void add_car(D3 at) {
    BodyDefinition<S> d = moving<S>(add_box(w, 0.75, 0.25, 1.25), at);
    d.mass = S(400);
    d.allow_sleep = false;
    VehicleSettings<S> vehicle;
    vehicle.body = w.create(d);
    vehicle.engine_torque = S(300);
    car_ = w.add(vehicle);
    for (int i = 0; i < 4; ++i) {
      WheelSettings<S> wheel;
      wheel.body = vehicle.body;
      wheel.hard_point = vec<S>(i % 2 == 0 ? 0.6 : -0.6, 0, i < 2 ? 0.9 : -0.9);
      wheel.stiffness = S(10000);
      wheel.damping = S(800);
      wheel.drive_share = S(0.25);
      wheel.steer_angle = num<S>(i < 2 ? 0.5 : 0);
      EXPECT_TRUE(w.add(wheel)) << describe(w.fault());
    }
    crates.push_back(vehicle.body);
  }
  void turn_movers(World<S>& world, int frame) const {
    if (!lift_) return;
    const double way = frame / 90 % 2 == 0 ? 1 : -1;
    world.set_velocity(lift_, vec<S>(0, 1.5 * way, 0), Vec3<S>::zero());
    world.set_velocity(ferry_, vec<S>((frame / 60 + 1) / 2 % 2 == 0 ? 3 : -3, 0, 0), Vec3<S>::zero());
    world.set_velocity(door_, Vec3<S>::zero(), vec<S>(0, 1.25 * way, 0));
    VehicleInput<S> input;
    input.throttle = num<S>(frame / 120 % 2 == 0 ? 1 : -1);
    input.steer = num<S>(0.5 * way);
    EXPECT_TRUE(world.set_input(car_, input)) << describe(world.fault());
  }

  std::uint64_t seed_;
  ShapeId capsule_;
  BodyId lift_, ferry_, door_;
  VehicleId car_;
};

template <class S> class CharacterLevels : public ::testing::Test {};
TYPED_TEST_SUITE(CharacterLevels, AllScalars);

/// What is squeezed may enter what squeezes it, but passes neither a wall nor the floor.
TYPED_TEST(CharacterLevels, keep_everybody_between_their_walls_whatever_moves_in_them) {
  using S = TypeParam;
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    Level<S> level(seed, true);
    double farthest = 0, lowest = 1, highest = 0;
    int floor = 0, frames = 0;
    for (int frame = 0; frame < 300; ++frame) {
      level.play(level.w, frame);
      for (const CharacterId id : level.walkers) {
        const D3 foot = level.foot(id);
        farthest = std::max({farthest, std::fabs(foot.x), std::fabs(foot.z)});
        lowest = std::min(lowest, foot.y);
        highest = std::max(highest, foot.y);
        floor += level.w.state(id)->footing == Footing::floor;
        ++frames;
      }
    }
    EXPECT_LT(farthest, kRoom - kRadius) << seed;
    EXPECT_GT(lowest, -kSkin) << seed;
    EXPECT_LT(highest, kTop + 1.5 + kJump * kJump / 20 + kSkin) << seed;  // nobody is thrown
    EXPECT_GT(farthest, kRoom - kRadius - 0.1) << seed;                   // they did come to a wall
    EXPECT_GT(floor, frames / 2) << seed;
  }
}

/// Who pushes with a force until the crate is as fast as the walker gives a crate no more than the walker's speed, and
/// what falls no more than its height gives it. Crates weigh a fortieth of a walker or more: what is lighter and tips
/// under its edge is flicked away by the weight of who stands there.
TYPED_TEST(CharacterLevels, give_crates_no_more_speed_than_walkers_have) {
  using S = TypeParam;
  const double fall = std::sqrt(2 * 10 * kTop), walk = kWalk * std::sqrt(2);
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    Level<S> level(seed, false);
    double fastest = 0, across = 0, moved = 0;
    std::vector<D3> start;
    for (const BodyId crate : level.crates) start.push_back(real(level.w.center_of_mass(crate)));
    for (int frame = 0; frame < 300; ++frame) {
      level.play(level.w, frame);
      for (const BodyId crate : level.crates) {
        const D3 v = real(level.w.velocity(crate));
        fastest = std::max(fastest, length(v));
        if (frame > 90) across = std::max(across, length({v.x, 0, v.z}));
      }
    }
    for (std::size_t i = 0; i < start.size(); ++i)
      moved = std::max(moved, length(real(level.w.center_of_mass(level.crates[i])) - start[i]));
    EXPECT_LT(fastest, fall + walk) << seed;
    EXPECT_LT(across, walk + 1) << seed;
    EXPECT_GT(moved, 1) << seed;  // they were pushed about
  }
}

TYPED_TEST(CharacterLevels, go_on_from_a_snapshot_as_if_nothing_had_been_saved) {
  using S = TypeParam;
  Level<S> level(4, true);
  for (int frame = 0; frame < 120; ++frame) level.play(level.w, frame);
  typename World<S>::Snapshot middle;
  level.w.save(middle);
  World<S> other(settings<S>());
  ASSERT_TRUE(other.load(middle));
  for (int frame = 120; frame < 180; ++frame) {
    level.play(level.w, frame);
    level.play(other, frame);
    ASSERT_EQ(level.w.hash(), other.hash()) << frame;
  }
}

/// Two groups face each other across x = 0. All look before anybody moves, so neither side goes first.
TYPED_TEST(CharacterLevels, mirrored_starts_have_mirrored_ends) {
  using S = TypeParam;
  World<S> w(settings<S>());
  add_ground(w);
  const ShapeId wall = add_box(w, 6, 1, 0.25), capsule = w.add_shape(Capsule<S>{num<S>(kRadius), num<S>(kHalf)});
  w.create(still<S>(wall, {0, 1, 1.75}));
  w.create(still<S>(wall, {0, 1, -1.75}));
  std::vector<CharacterId> walkers[2];
  for (int k = 0; k < 6; ++k) {
    for (const int side : {0, 1}) {
      const double x = (side == 0 ? 1 : -1) * (1 + k / 2 * 0.75), z = k % 2 * 1.25 - 0.5;
      BodyDefinition<S> d = moving<S>(capsule, {x, kMiddle + kSkin, z});
      d.type = BodyType::kinematic;
      CharacterSettings<S> c;
      c.body = w.create(d);
      walkers[side].push_back(w.add(c));
      ASSERT_TRUE(walkers[side].back());
      const Vec3<S> move = vec<S>(side == 0 ? -2 : 2, 0, k % 2 == 0 ? 0.25 : -0.25);
      ASSERT_TRUE(w.set_input(walkers[side].back(), {move}));
    }
  }
  double nearest = 10;
  for (int frame = 0; frame < 180; ++frame) {
    w.step();
    for (std::size_t k = 0; k < walkers[0].size(); ++k) {
      const D3 right = real(w.pose(w.find(walkers[0][k])->body).position),
               left = real(w.pose(w.find(walkers[1][k])->body).position);
      ASSERT_NEAR(right.x, -left.x, 1e-3) << frame << " " << k;
      ASSERT_NEAR(right.y, left.y, 1e-3) << frame << " " << k;
      ASSERT_NEAR(right.z, left.z, 1e-3) << frame << " " << k;
      nearest = std::min(nearest, length(right - left));
    }
  }
  EXPECT_LT(nearest, 2 * kRadius + 0.1);  // they met
  EXPECT_GT(nearest, 2 * kRadius - kSkin);
}

}  // namespace character_levels_test
}  // namespace isostep::test
