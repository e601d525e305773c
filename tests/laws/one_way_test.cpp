// Laws of OneWay: who is let through, from where, and who is stopped. What passes: one_way_passes_test.cpp.
// SPDX-License-Identifier: MIT

#include <algorithm>

#include "built.hpp"
#include "isostep/geometry/baked/surface_blob.hpp"
#include "laws/exact_rollback.hpp"

namespace isostep::test {
namespace one_way_test {

template <class S> class OneWays : public ::testing::Test {
 protected:
  BodyId platform(D3 at, D3 half = {4, 0.125, 4}, BodyType type = BodyType::static_) {
    BodyDefinition<S> d = still<S>(add_box(w, half.x, half.y, half.z), at);
    d.type = type;
    return w.create(d);
  }
  OneWayId open(BodyId body, D3 axis = {0, 1, 0}) {
    OneWay<S> record;
    record.body = body;
    record.axis = {num<Unit<S>>(axis.x), num<Unit<S>>(axis.y), num<Unit<S>>(axis.z)};
    const OneWayId id = w.add(record);
    EXPECT_TRUE(id) << describe(w.fault());
    return id;
  }
  BodyId ball(D3 at, D3 velocity = {0, 0, 0}) { return w.create(moving<S>(add_ball(w, 0.25), at, velocity)); }
  std::size_t ghosts() const { return w.state().records->ghosts.slot_map().template ids<GhostId>().size(); }
  D3 at(BodyId body) const { return real(w.center_of_mass(body)); }

  World<S> w{settings<S>()};
};
TYPED_TEST_SUITE(OneWays, AllScalars);

/// A floor of twelve boxes side by side, or a height field, without a thickness.
template <class S> ShapeId wide_floor(World<S>& w, bool field) {
  if (field) {
    constexpr std::uint32_t kPlaces = 9;
    const std::vector<double> heights(kPlaces * kPlaces, 0.0);
    const std::vector<BlobRef> blobs = {height_field_blob({kPlaces, kPlaces, 2}, heights, {}).value()};
    Child<S> child = {primitive_of(HeightField<S>{1}), Pose<S>::identity()};
    child.pose.position = vec<S>(-8, 0, -8);
    return w.add_shape(std::span<const Child<S>>(&child, 1), std::span<const BlobRef>(blobs));
  }
  std::vector<Child<S>> parts;
  for (int i = 0; i < 12; ++i) parts.push_back(part_at(primitive_of(Box<S>{vec<S>(0.5, 0.125, 4)}), {i - 5.5, 0, 0}));
  return w.add_shape(std::span<const Child<S>>(parts));
}

TYPED_TEST(OneWays, may_be_compounds_and_surfaces) {
  using S = TypeParam;
  for (const bool field : {false, true}) {
    this->w = World<S>(settings<S>());
    World<S> alone(settings<S>());
    this->open(this->w.create(still<S>(wide_floor(this->w, field), {0, 3, 0})));
    std::vector<BodyId> ours, theirs;
    for (int i = 0; i < 10; ++i) {
      for (World<S>* const world : {&this->w, &alone}) {
        const ShapeId shape = i % 2 == 0 ? add_ball(*world, 0.25) : add_box(*world, 0.25, 0.25, 0.25);
        (world == &alone ? theirs : ours)
            .push_back(world->create(moving<S>(shape, {i - 4.75, 1, 0.3 * i}, {0.25, 8 + 0.5 * i, 0})));
      }
    }
    std::vector<std::uint8_t> above(ours.size(), 0);
    for (int frame = 0; frame < 180; ++frame) {
      this->w.step();
      alone.step();
      for (std::size_t i = 0; i < ours.size(); ++i) {
        if (this->at(ours[i]).y > 3.6) above[i] = 1;
        if (above[i] != 0) continue;
        ASSERT_EQ(this->w.velocity(ours[i]), alone.velocity(theirs[i])) << field << i << ", step " << frame;
      }
    }
    run(this->w, 120);
    for (std::size_t i = 0; i < ours.size(); ++i) {
      EXPECT_EQ(above[i], 1u) << field << i;
      EXPECT_GT(this->at(ours[i]).y, 3.2) << field << i;
    }
  }
}

TYPED_TEST(OneWays, hold_what_falls_rolls_and_rests_on_them_as_if_they_were_solid) {
  using S = TypeParam;
  World<S> solid(settings<S>());
  const auto build = [](World<S>& world) {
    const BodyId floor = world.create(still<S>(add_box(world, 4, 0.25, 4), {0, -0.25, 0}));
    for (int i = 0; i < 4; ++i)
      world.create(moving<S>(add_box(world, 0.25, 0.25, 0.25), {0, 0.5 + 0.75 * i, 0.01 * i}));
    world.create(moving<S>(add_ball(world, 0.25), {-2, 1, 1}, {2, -3, 0}));
    return floor;
  };
  build(solid);
  this->open(build(this->w));
  for (int i = 0; i < 300; ++i) {
    this->w.step();
    solid.step();
  }
  const std::vector<BodyId> ours = this->w.bodies(), theirs = solid.bodies();
  for (std::size_t i = 0; i < ours.size(); ++i)
    EXPECT_EQ(this->w.pose(ours[i]).position, solid.pose(theirs[i]).position) << i;
  EXPECT_EQ(this->ghosts(), 0u);
}

TYPED_TEST(OneWays, let_in_from_the_side_and_out_again) {
  const BodyId body = this->platform({0, 3, 0}, {1, 0.5, 1});
  this->open(body);
  const BodyId crossing = this->ball({-2, 3, 0}, {6, 0, 0});
  double most = 0;
  std::size_t seen = 0;
  for (int i = 0; i < 60; ++i) {
    this->w.step();
    seen = std::max(seen, this->ghosts());
    most = std::max(most, this->at(crossing).x);
  }
  EXPECT_EQ(seen, 1u);
  EXPECT_GT(most, 1.5);
  EXPECT_NEAR(to_double(this->w.velocity(crossing).x), 6, 1e-3);
  EXPECT_EQ(this->ghosts(), 0u);
}

// At any speed, so that it meets the seam at any depth.
TYPED_TEST(OneWays, boxes_slide_onto_one_from_the_floor_beside_it) {
  using S = TypeParam;
  constexpr int kBoxes = 100;
  BodyDefinition<S> d = still<S>(add_box(this->w, 2, 0.25, 60), {-2, -0.25, 0});
  d.material.friction = S(0);
  this->w.create(d);
  d.position = vec<S>(2, -0.25, 0);
  this->open(this->w.create(d));
  const ShapeId box = add_box(this->w, 0.25, 0.25, 0.25);
  std::vector<BodyId> all;
  for (int i = 0; i < kBoxes; ++i)
    all.push_back(this->w.create(moving<S>(box, {-0.75, 0.25, i - 50.0}, {1 + 0.0137 * i, 0, 0})));
  for (int i = 0; i < 90; ++i) {
    this->w.step();
    ASSERT_EQ(this->ghosts(), 0u) << i;
  }
  for (int i = 0; i < kBoxes; ++i) {
    const D3 at = this->at(all[static_cast<std::size_t>(i)]);
    EXPECT_NEAR(at.y, 0.25, 0.01) << i;
    EXPECT_NEAR(at.x, -0.75 + 1.5 * (1 + 0.0137 * i), 0.05) << i;
  }
}

TYPED_TEST(OneWays, stop_fast_bodies_from_one_side_alone) {
  using S = TypeParam;
  this->w.set_gravity(Vec3<S>::zero());
  this->open(this->platform({0, 0, 0}, {20, 0.03125, 20}));
  std::vector<BodyId> down, up;
  const double fast = pick<S>(100, 100, 50, 100);
  for (int i = 0; i < 20; ++i) {
    const double x = i - 10, gap = 0.5 + 0.07 * i;
    down.push_back(this->ball({x, gap, -3}, {0, -fast, 0}));
    up.push_back(this->ball({x, -gap, 3}, {0, fast, 0}));
  }
  run(this->w, 30);
  for (int i = 0; i < 20; ++i) {
    const auto at = static_cast<std::size_t>(i);
    EXPECT_GT(this->at(down[at]).y, 0.2) << i;
    EXPECT_NEAR(this->at(up[at]).y, -0.5 - 0.07 * i + fast / 2, 0.05) << i;
    EXPECT_EQ(to_double(this->w.velocity(up[at]).y), fast) << i;
  }
}

TYPED_TEST(OneWays, have_an_axis_in_the_frame_of_their_body) {
  using S = TypeParam;
  this->w.set_gravity(Vec3<S>::zero());
  BodyDefinition<S> d = still<S>(add_box(this->w, 2, 0.125, 2));
  d.orientation = turn<S>({0, 0, 1}, -kPi / 2);  // its y is the world's x
  const BodyId valve = this->w.create(d);
  this->open(valve);
  const BodyId through = this->ball({-1, 0, 0}, {3, 0, 0}), stopped = this->ball({1, 0, 1}, {-3, 0, 0});
  run(this->w, 60);
  EXPECT_NEAR(this->at(through).x, 2, 0.01);
  EXPECT_GT(this->at(stopped).x, 0.3);
}

TYPED_TEST(OneWays, a_lift_takes_along_what_it_meets_from_below) {
  using S = TypeParam;
  const BodyId lift = this->platform({0, 0, 0}, {2, 0.125, 2}, BodyType::kinematic);
  this->open(lift);
  ASSERT_TRUE(this->w.set_velocity(lift, vec<S>(0, 2, 0), Vec3<S>::zero()));
  const BodyId rider = this->ball({0, 1, 0});
  run(this->w, 120);
  EXPECT_NEAR(this->at(rider).y, 4 + 0.125 + 0.25, 0.02);
  ASSERT_TRUE(this->w.set_velocity(lift, vec<S>(0, -2, 0), Vec3<S>::zero()));
  run(this->w, 60);
  EXPECT_NEAR(this->at(rider).y, 2 + 0.125 + 0.25, 0.02);
}

/// A character on the ground below a platform whose top is at 2.625 m.
template <class S> struct Hero {
  Hero(World<S>& in, BodyId body, double skin) : w(in), stands(0.75 + skin) {
    CharacterSettings<S> hero;
    hero.body = body;
    hero.skin = num<S>(skin);
    id = w.add(hero);
    EXPECT_TRUE(id) << describe(w.fault());
  }
  double height() const { return to_double(w.pose(w.find(id)->body).position.y) - stands; }
  void ask(D3 move, double jump) { EXPECT_TRUE(w.set_input(id, {vec<S>(move), num<S>(jump)})) << describe(w.fault()); }
  /// Returns how high it came in so many steps [m].
  double jump(double speed, int steps) {
    ask({0, 0, 0}, speed);
    double top = 0;
    for (int i = 0; i < steps; ++i) {
      w.step();
      top = std::max(top, height());
    }
    return top;
  }

  World<S>& w;
  double stands;  // [m] of its origin above its feet
  CharacterId id;
};

// With a skin beyond the 2 cm at which contacts begin, too: a ghost lasts for as long as it is in there.
TYPED_TEST(OneWays, a_character_jumps_up_through_stands_and_drops_through) {
  using S = TypeParam;
  for (const double skin : {1.0 / 64, 0.125}) {
    this->w = World<S>(settings<S>());
    add_ground(this->w);
    const BodyId platform = this->platform({0, 2.5, 0}, {3, 0.125, 3});
    this->open(platform);
    BodyDefinition<S> d = still<S>(this->w.add_shape(Capsule<S>{num<S>(0.25), num<S>(0.5)}), {0, 0.75 + skin, 0});
    d.type = BodyType::kinematic;
    d.allow_sleep = false;
    const BodyId body = this->w.create(d);
    Hero<S> hero(this->w, body, skin);
    run(this->w, 3);
    EXPECT_NEAR(hero.jump(6.5, 120), 2.11, 0.1) << "its head is in, its feet are not above";
    EXPECT_NEAR(hero.height(), 0, 0.01);
    ASSERT_EQ(this->w.state(hero.id)->footing, Footing::floor);
    EXPECT_NEAR(hero.jump(8, 120), 3.2, 0.1);
    EXPECT_NEAR(hero.height(), 2.625, 0.01);
    EXPECT_EQ(this->w.state(hero.id)->footing, Footing::floor);
    EXPECT_EQ(this->w.state(hero.id)->ground, platform);
    EXPECT_EQ(this->w.state(hero.id)->stuck, 0u);
    hero.ask({1, 0, 0}, 0);
    for (int i = 0; i < 60; ++i) {
      this->w.step();
      ASSERT_NEAR(hero.height(), 2.625, 0.01) << i;
    }
    EXPECT_TRUE(this->w.add(Ghost<S>{body, platform})) << describe(this->w.fault());
    run(this->w, 90);
    EXPECT_NEAR(hero.height(), 0, 0.01) << skin;
    EXPECT_EQ(this->ghosts(), 0u);
  }
}

TYPED_TEST(OneWays, keep_what_sleeps_on_them_and_are_refused_with_bad_numbers) {
  using S = TypeParam;
  const BodyId platform = this->platform({0, 0, 0});
  const OneWayId id = this->open(platform);
  const BodyId box = this->w.create(moving<S>(add_box(this->w, 0.25, 0.25, 0.25), {0, 0.375, 0}));
  ASSERT_TRUE(settle(this->w));
  ASSERT_TRUE(this->w.wake(box));
  run(this->w, 60);
  EXPECT_NEAR(this->at(box).y, 0.375, 0.01);
  ASSERT_TRUE(settle(this->w));
  OneWay<S> record = *this->w.find(id);
  record.least_cosine = num<S>(0.75);
  ASSERT_TRUE(this->w.set(id, record));
  EXPECT_EQ(this->w.counts().awake, 1u);
  const std::uint64_t before = this->w.hash();
  const auto refused = [&](OneWay<S> bad, Fault fault, const char* field) {
    EXPECT_FALSE(this->w.set(id, bad));
    EXPECT_EQ(this->w.fault(), fault) << field;
    EXPECT_STREQ(this->w.fault().field, field);
    EXPECT_EQ(this->w.hash(), before) << field;
  };
  record.axis = {Unit<S>(0), num<Unit<S>>(0.5), Unit<S>(0)};
  refused(record, Fault::bad_argument, "axis");
  record.axis = {Unit<S>(0), Unit<S>(1), Unit<S>(0)};
  for (const double cosine : {0.0, -0.5, 1.5}) {
    record.least_cosine = num<S>(cosine);
    refused(record, Fault::bad_argument, "least_cosine");
  }
  if constexpr (!kIsFixed<S>) {
    record.least_cosine = num<S>(NAN);
    refused(record, Fault::not_finite, "least_cosine");
  }
  EXPECT_FALSE(this->w.add(OneWay<S>{platform})) << "it has one";
  EXPECT_STREQ(this->w.fault().field, "body");
  ASSERT_TRUE(this->w.remove(id));
  run(this->w, 60);
  EXPECT_NEAR(this->at(box).y, 0.375, 0.01) << "solid to all again";
}

TYPED_TEST(OneWays, are_rolled_back_while_bodies_are_inside) {
  using S = TypeParam;
  for (const SolverName solver : kBuiltSolvers) {
    Settings<S> s = settings<S>();
    s.solver = solver;
    this->w = World<S>(s);
    add_ground(this->w);
    this->open(this->platform({0, 1.75, 0}));
    for (int i = 0; i < 8; ++i) this->ball({0.75 * i - 3, 0.25, 0}, {0, 5 + 0.25 * i, 0});
    std::size_t inside = 0;
    expect_exact_rollback(this->w, 60, [&](World<S>& world, int frame) {
      if (frame == 30) inside = world.state().records->ghosts.slot_map().template ids<GhostId>().size();
    });
    EXPECT_GT(inside, 0u);
  }
}

TYPED_TEST(OneWays, what_is_fast_passes_from_the_side_and_is_stopped_from_above) {
  using S = TypeParam;
  this->w.set_gravity(Vec3<S>::zero());
  this->open(this->platform({4, 0, 0}, {0.0625, 2, 2}));
  for (const double speed : {3.0, 20.0, 50.0}) {
    const BodyId across = this->ball({0, 0, 0}, {speed, 0, 0}),
                 down = this->ball({4, 2 + speed / 20, 0}, {0, -speed, 0});
    ASSERT_TRUE(this->w.set_filter(across, {1, ~0u, 5}));
    const int steps = static_cast<int>(480 / speed);
    run(this->w, steps);
    EXPECT_NEAR(this->at(across).x, speed * steps / 60, 0.02) << speed;
    EXPECT_GT(this->at(down).y, 2) << speed;
    this->w.destroy(across);
    this->w.destroy(down);
  }
}

}  // namespace one_way_test
}  // namespace isostep::test
