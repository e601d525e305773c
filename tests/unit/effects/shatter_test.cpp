// Bodies of pieces in worlds: what they keep of the body (oracle O27), and that rollback and recordings hold them.
// SPDX-License-Identifier: MIT
#include "isostep/fracture/shatter.hpp"

#include <string>

#include "unit/effects/fractured.hpp"
#include "unit/effects/totals.hpp"

namespace isostep::test {
namespace shatter_test {

enum class Solid { box, off_grid_box, rock };

template <class S> struct Scene {
  World<S> world{settings<S>(0)};
  GridHull solid;
  BodyId body;

  explicit Scene(Solid kind, double gravity = 0) : world(settings<S>(gravity)) {
    ShapeId shape;
    if (kind == Solid::rock) {
      solid = rock();
      shape = world.add_shape(rock_blob());
    } else {
      const Box<S> box = {kind == Solid::box ? vec<S>(0.5, 0.5, 0.5) : vec<S>(0.7, 0.45, 0.55)};
      solid = grid_box(box).value();
      shape = world.add_shape(box);
    }
    BodyDefinition<S> d = moving<S>(shape, {1, 7, -2}, {3, 1, -2});
    d.orientation = turn<S>({0.6, 0, 0.8}, 0.7);
    d.angular_velocity = vec<S>(1.5, -2, 0.75);
    d.mass = num<S>(100);
    d.user_data = 42;
    body = world.create(d);
    EXPECT_TRUE(world.contains(body));
  }
  Fracture broken(const FracturePattern& pattern) const {
    const Result<Fracture> f = fracture(solid, pattern, blow(solid, {0.1, 0.2, -0.1}, {0.2, -1, 0.1}), 11);
    EXPECT_TRUE(f.ok());
    return f.value();
  }
  std::vector<BodyId> shatter_body(const Fracture& f) {
    const std::vector<ShapeId> shapes = add_piece_shapes(world, f);
    const auto shards = shatter<S>(f, world.view(body), shapes);
    EXPECT_TRUE(shards.ok()) << (shards.ok() ? "" : std::string(shards.error().message.view()));
    std::vector<BodyId> bodies;
    world.destroy(body);
    for (const BodyDefinition<S>& shard : shards.value()) bodies.push_back(world.create(shard));
    EXPECT_EQ(world.first_fault().fault, Fault::none) << describe(world.first_fault());
    return bodies;
  }
};

template <class S> class Shatter : public ::testing::Test {};
TYPED_TEST_SUITE(Shatter, AllScalars);

TYPED_TEST(Shatter, keeps_mass_centre_momentum_and_angular_momentum) {
  using S = TypeParam;
  const double bound = pick<S>(1e-5, 1e-12, 1e-3, 1e-8);
  for (const Solid kind : {Solid::box, Solid::off_grid_box, Solid::rock}) {
    for (const NamedPattern& p : patterns()) {
      Scene<S> scene(kind);
      Total before, after;
      const D3 about = real(scene.world.center_of_mass(scene.body));
      add_body(before, scene.world, scene.body, about);
      const std::vector<BodyId> bodies = scene.shatter_body(scene.broken(p.pattern));
      EXPECT_GE(bodies.size(), 8u);
      for (const BodyId b : bodies) add_body(after, scene.world, b, about);
      EXPECT_NEAR(after.mass / before.mass, 1, bound) << p.name;
      EXPECT_LT(length(after.centre() - before.centre()), bound) << p.name;
      EXPECT_LT(relative(after.momentum, before.momentum), bound) << p.name;
      EXPECT_LT(relative(after.angular, before.angular), bound) << p.name;
    }
  }
}

/// A body that no closed form knows: its part is moved and turned in its frame, and its inertia is the user's.
TYPED_TEST(Shatter, keeps_them_for_parts_with_a_pose_and_for_a_users_inertia) {
  using S = TypeParam;
  const double bound = pick<S>(1e-5, 1e-12, 1e-3, 1e-8);
  for (const bool users : {false, true}) {
    World<S> world(settings<S>(0));
    const Box<S> box = {vec<S>(0.5, 0.25, 0.75)};
    const Child<S> part = {box.primitive(), {vec<S>(0.5, -0.25, 0.125), turn<S>({0, 0.6, 0.8}, 1.1)}};
    BodyDefinition<S> d = moving<S>(world.add_shape(std::span<const Child<S>>(&part, 1)), {-3, 2, 1}, {2, -1, 3});
    d.angular_velocity = vec<S>(-1, 2, 1.5);
    d.mass = num<S>(20);
    if (users) d.inertia = vec<S>(5, 7, 4);
    const BodyId body = world.create(d);
    const GridHull solid = grid_box(box).value();
    const Fracture f = fracture(solid, VoronoiCells{12, 0}, blow(solid, {0, 0, 0}, {0, 0, 0}), 4).value();
    const D3 about = real(world.center_of_mass(body));
    Total before, after;
    add_body(before, world, body, about);
    const std::vector<ShapeId> shapes = add_piece_shapes(world, f);
    const auto shards = shatter<S>(f, world.view(body), shapes);
    ASSERT_TRUE(shards.ok());
    for (const BodyDefinition<S>& shard : shards.value()) add_body(after, world, world.create(shard), about);
    EXPECT_LT(length(after.centre() - before.centre()), bound);
    EXPECT_LT(relative(after.momentum, before.momentum), bound);
    EXPECT_LT(relative(after.angular, before.angular), bound);
  }
}

TYPED_TEST(Shatter, pieces_are_where_the_body_was_and_move_as_its_points_did) {
  using S = TypeParam;
  Scene<S> scene(Solid::rock);
  const Fracture f = scene.broken(VoronoiCells{20, 128});
  const Pose<S> pose = scene.world.pose(scene.body);
  const D3 centre = real(scene.world.center_of_mass(scene.body)), v = real(scene.world.velocity(scene.body));
  const D3 w = real(scene.world.angular_velocity(scene.body));
  const std::vector<BodyId> bodies = scene.shatter_body(f);
  const double step = std::ldexp(1, -f.exponent);
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    const GridPoint o = f.pieces[i].origin;
    const D3 local = D3{double(o.x), double(o.y), double(o.z)} * (step / 2);
    const D3 expected = real(pose.position) + rotated<S>(pose.orientation, local);
    expect_near(real(scene.world.pose(bodies[i]).position), expected, 2 * step + 4 * grain<S>(8));
    const D3 arm = real(scene.world.center_of_mass(bodies[i])) - centre;
    expect_near(real(scene.world.velocity(bodies[i])), v + cross(w, arm), 5e-4);
    EXPECT_EQ(scene.world.user_data(bodies[i]), 42u);
  }
}

/// Momentum of a broken box in the air, while its pieces push each other: nothing but gravity changes it.
TYPED_TEST(Shatter, a_box_broken_in_the_air_falls_on_as_one) {
  using S = TypeParam;
  for (const NamedPattern& p : patterns()) {
    Scene<S> scene(Solid::box, -10);
    run(scene.world, 10);
    Total before;
    add_body(before, scene.world, scene.body, {0, 0, 0});
    const std::vector<BodyId> bodies = scene.shatter_body(scene.broken(p.pattern));
    run(scene.world, 30);
    Total after;
    for (const BodyId b : bodies) add_body(after, scene.world, b, {0, 0, 0});
    const D3 expected = before.momentum + D3{0, -10 * 0.5 * before.mass, 0};
    EXPECT_LT(relative(after.momentum, expected), pick<S>(1e-5, 1e-12, 1e-3, 1e-8)) << p.name;
  }
}

TYPED_TEST(Shatter, a_world_that_breaks_a_body_restores_and_replays) {
  using S = TypeParam;
  Scene<S> scene(Solid::rock, -10);
  add_ground(scene.world);
  const Fracture f = scene.broken(RadialCracks{6, 1});
  typename World<S>::Snapshot saved;
  run(scene.world, 5);
  scene.world.save(saved);
  World<S> other(settings<S>(-10));
  std::vector<std::uint8_t> portable = bytes_of(scene.world);
  Reader reader(portable);
  ASSERT_TRUE(other.read_portable(reader).ok());
  std::vector<std::uint8_t> log;
  std::vector<std::vector<std::uint8_t>> frames;
  std::vector<std::uint64_t> hashes;
  for (int round = 0; round < 2; ++round) {
    ASSERT_TRUE(round == 0 || scene.world.load(saved));
    scene.world.record_to(round == 0 ? &log : nullptr);
    scene.shatter_body(f);
    for (int i = 0; i < 90; ++i) {
      scene.world.step();
      if (round == 0) {
        hashes.push_back(scene.world.hash());
        frames.push_back(log);
        log.clear();
      }
      ASSERT_EQ(scene.world.hash(), hashes[static_cast<std::size_t>(i)]) << "frame " << i;
    }
  }
  // By the commands alone, which carry the blobs.
  for (std::size_t i = 0; i < frames.size(); ++i) {
    const Result<void> stepped = other.step_recorded(frames[i]);
    ASSERT_TRUE(stepped.ok()) << stepped.error().message.view();
    ASSERT_EQ(other.hash(), hashes[i]) << "frame " << i;
  }
}

TYPED_TEST(Shatter, what_cannot_be_broken_is_refused_by_name) {
  using S = TypeParam;
  Scene<S> scene(Solid::box);
  const Fracture f = scene.broken(EightBoxes{});
  std::vector<ShapeId> shapes = add_piece_shapes(scene.world, f);
  const auto place = [&](const Fracture& pieces, BodyId body) {
    const auto result = shatter<S>(pieces, scene.world.view(body), shapes);
    return result.ok() ? "" : std::string(result.error().place.view());
  };
  EXPECT_EQ(place(f, scene.body), "");
  EXPECT_EQ(place(f, BodyId{}), "body");
  EXPECT_EQ(place(f, scene.world.create(still<S>(add_box(scene.world, 1, 1, 1)))), "body");
  EXPECT_EQ(place(f, scene.world.create(moving<S>(add_ball(scene.world, 1), {9, 9, 9}))), "body");
  EXPECT_EQ(place(Fracture{}, scene.body), "pieces");
  shapes.pop_back();
  EXPECT_EQ(place(f, scene.body), "shapes");
}

TEST(ShatterOfQ16, masses_and_sizes_below_the_scalar_are_refused) {
  Scene<Q16_16> scene(Solid::box);
  BodyDefinition<Q16_16> light = moving<Q16_16>(add_box(scene.world, 0.5, 0.5, 0.5), {9, 9, 9});
  light.mass = resolution<Q16_16>();
  const Fracture f = scene.broken(EightBoxes{});
  const std::vector<ShapeId> shapes = add_piece_shapes(scene.world, f);
  const auto dust = shatter<Q16_16>(f, scene.world.view(scene.world.create(light)), shapes);
  ASSERT_FALSE(dust.ok());
  EXPECT_EQ(dust.error().place.view(), "mass");
  const Result<Fracture> fine = fracture(scene.solid, EightBoxes{}, blow(scene.solid, {0.49, 0, 0}, {0, 0, 0}), 1,
                                         {.most_pieces = 8, .least_width = 64});
  const auto small = shatter<Q16_16>(fine.value(), scene.world.view(scene.body), shapes);
  ASSERT_FALSE(small.ok());
  EXPECT_EQ(small.error().place.view(), "pieces");
}

}  // namespace shatter_test
}  // namespace isostep::test
