// ContinuousCollision alone, as a rule on a state whose poses the test moves: who is put back, and where to.
// SPDX-License-Identifier: MIT

#include "isostep/systems/continuous/continuous_collision.hpp"

#include "isostep/collision/broadphase/pairs.hpp"
#include "isostep/store/fat_box.hpp"
#include "random/dice.hpp"
#include "random/hull.hpp"
#include "unit/world/systems.hpp"

namespace isostep::test {
namespace continuous_collision_test {

template <class S> class ContinuousCollisions : public ::testing::Test {
 protected:
  static constexpr double kNear = 0.004;  // [m] what is put back is no further from what it hit

  BodyId add_wall(double half = 0.03125) { return world.create(still<S>(add_box(world, half, 2, 2))); }
  BodyId add_ball_at(D3 at) { return world.create(moving<S>(add_ball(world, 0.125), at)); }

  /// Moves as a step does: from where the body is in the world to `to`, and turned by `by`.
  void move(BodyId body, D3 to, const Quat<Unit<S>>& by = Quat<Unit<S>>::identity()) {
    begin();
    BodyState<S>& state = systems->awake(body);
    state.centre = vec<S>(to);
    state.orientation = normalise(by * state.orientation);
    state.angular_velocity = Vec3<Velocity<S>>{Velocity<S>(60), Velocity<S>(0), Velocity<S>(0)};
    detail::renew_fat_box(systems->map, state, systems->map.properties_at(systems->map.location(body.slot)), false);
    systems->proxies.place(state, systems->map.properties_at(systems->map.location(body.slot)), true);
  }
  void begin() {
    if (systems) return;
    systems.emplace(world);
    for (const BodyState<S>& state : systems->state.awake.states) start.push_back({state.centre, state.orientation});
  }
  void update(std::span<const std::uint64_t> joined = {}) {
    ContinuousCollision<S> continuous(systems->state, systems->map, systems->proxies);
    continuous.update(start, joined);
  }
  D3 place(BodyId body) { return real(systems->awake(body).centre); }

  World<S> world{settings<S>(0)};
  std::optional<Systems<S>> systems;
  std::vector<Pose<S>> start;
};
TYPED_TEST_SUITE(ContinuousCollisions, SystemScalars);

TYPED_TEST(ContinuousCollisions, a_fast_ball_is_put_back_to_the_wall_that_it_passed) {
  const BodyId ball = (this->add_wall(), this->add_ball_at({-1, 0.5, 0.25}));
  this->move(ball, {3, 0.5, 0.25});
  this->update();
  const D3 at = this->place(ball);
  EXPECT_LT(at.x, -0.03125 - 0.125 + detail::kGraze<double>);  // it overlaps a little, and its contact finds it
  EXPECT_GT(at.x, -0.03125 - 0.125 - this->kNear);
  EXPECT_NEAR(at.y, 0.5, 1e-5);
  EXPECT_NEAR(at.z, 0.25, 1e-5);
  EXPECT_TRUE(this->systems->proxies.boxes().box(ball.slot) == this->systems->awake(ball).fat);
}

TYPED_TEST(ContinuousCollisions, of_two_walls_the_first_one_counts) {
  using S = TypeParam;
  BodyDefinition<S> d = still<S>(add_box(this->world, 0.03125, 2, 2), {1, 0, 0});
  this->world.create(d);
  this->add_wall();
  const BodyId ball = this->add_ball_at({3, 0, 0});
  this->move(ball, {-3, 0, 0});
  this->update();
  EXPECT_NEAR(this->place(ball).x, 1 + 0.03125 + 0.125, this->kNear);
}

TYPED_TEST(ContinuousCollisions, slow_bodies_are_left_alone) {
  const BodyId ball = (this->add_wall(), this->add_ball_at({-0.1875, 0, 0}));
  this->move(ball, {-0.1875 + 0.02, 0, 0});  // a contact would have seen it coming
  this->update();
  EXPECT_NEAR(this->place(ball).x, -0.1675, 1e-4);
}

TYPED_TEST(ContinuousCollisions, what_ends_deep_inside_of_something_thick_is_put_back_to_its_surface) {
  for (const double end : {-1.0625, -0.96875}) {
    const BodyId ball = (this->add_wall(1), this->add_ball_at({-1.25, 0, 0}));
    this->systems.reset();
    this->start.clear();
    this->move(ball, {end, 0, 0});
    this->update();
    EXPECT_NEAR(this->place(ball).x, -1.125, this->kNear);
  }
}

TYPED_TEST(ContinuousCollisions, what_touches_something_thick_is_left_to_contacts) {
  const BodyId ball = (this->add_wall(1), this->add_ball_at({-1.13, 0, 0}));
  this->move(ball, {-1.12, 0.0625, 0});
  this->update();
  EXPECT_NEAR(this->place(ball).x, -1.12, 1e-4);
  EXPECT_EQ(this->place(ball).y, 0.0625);
}

TYPED_TEST(ContinuousCollisions, half_spaces_are_not_passed) {
  using S = TypeParam;
  add_ground(this->world);
  const BodyId rod = this->world.create(moving<S>(add_box(this->world, 0.03125, 0.5, 0.03125), {0, 1, 0}));
  this->move(rod, {0, -3, 0}, turn<S>({0, 0, 1}, 1));
  this->update();
  EXPECT_GT(this->place(rod).y, 0.03);
  EXPECT_LT(this->place(rod).y, 0.5 + this->kNear);
}

TYPED_TEST(ContinuousCollisions, the_far_end_of_a_rod_that_touches_does_not_swing_through) {
  using S = TypeParam;
  this->add_wall();
  const BodyId rod =
      this->world.create(moving<S>(add_box(this->world, 0.03125, 0.5, 0.03125), {-0.03125 - 0.0625 - 0.3, 0, 0}));
  // One end touches, and the rod turns about it until it lies on the other side.
  BodyDefinition<S> d = moving<S>(add_box(this->world, 0.03125, 0.5, 0.03125), {-0.4, 0, 1});
  d.orientation = turn<S>({0, 0, 1}, 0.75);
  const BodyId tilted = this->world.create(d);
  this->move(tilted, {0.4, 0, 1}, turn<S>({0, 0, 1}, -1.5));
  this->update();
  EXPECT_LT(this->place(tilted).x, 0);
  (void)rod;
}

TYPED_TEST(ContinuousCollisions, a_rod_that_touches_from_the_start_is_still_stopped) {
  using S = TypeParam;
  this->add_wall();
  BodyDefinition<S> d = moving<S>(add_box(this->world, 0.03125, 0.5, 0.03125), {0, 0, 0});
  d.orientation = turn<S>({0, 0, 1}, 0.5);
  // The lower right edge is 1 mm inside of the wall.
  const double extent = 0.5 * std::sin(0.5) + 0.03125 * std::cos(0.5);
  d.position = vec<S>(-0.03125 - extent + 0.001, 0, 0);
  const BodyId rod = this->world.create(d);
  this->move(rod, {0.25, 0, 0}, turn<S>({0, 0, 1}, -1));
  this->update();
  EXPECT_LT(this->place(rod).x, -0.03);
}

TYPED_TEST(ContinuousCollisions, filters_sensors_and_joints_let_pass) {
  using S = TypeParam;
  for (int i = 0; i < 4; ++i) {
    BodyDefinition<S> d = still<S>(add_box(this->world, 0.03125, 0.5, 0.5), {0, 0, 4.0 * i});
    if (i == 0) d.filter.category = 2;
    if (i == 1) d.sensor = true;
    if (i == 2) d.collide = false;
    const BodyId wall = this->world.create(d);
    d = moving<S>(add_ball(this->world, 0.125), {-1, 0, 4.0 * i});
    d.filter.mask = 1;
    const BodyId ball = this->world.create(d);
    this->systems.reset();
    this->start.clear();
    this->move(ball, {1, 0, 4.0 * i});
    const std::uint64_t joined[] = {pair_key(wall.slot, ball.slot)};
    if (i == 3) this->update(joined);
    else this->update();
    EXPECT_EQ(this->place(ball).x, 1) << i;
  }
}

TYPED_TEST(ContinuousCollisions, a_kinematic_wall_takes_along_what_it_meets) {
  using S = TypeParam;
  BodyDefinition<S> d = still<S>(add_box(this->world, 0.03125, 2, 2), {0, 0, 0});
  d.type = BodyType::kinematic;
  const BodyId wall = this->world.create(d), ball = this->add_ball_at({-1, 0, 0});
  this->move(wall, {-0.5, 0, 0});
  this->move(ball, {1, 0, 0});
  this->update();
  EXPECT_NEAR(this->place(ball).x, -0.5 - 0.03125 - 0.125, this->kNear);
}

TYPED_TEST(ContinuousCollisions, a_fast_kinematic_wall_does_not_pass_what_rests) {
  using S = TypeParam;
  BodyDefinition<S> d = still<S>(add_box(this->world, 0.03125, 2, 2), {0, 0, 0});
  d.type = BodyType::kinematic;
  const BodyId wall = this->world.create(d), ball = this->add_ball_at({-1, 0, 0});
  this->move(wall, {-2, 0, 0});
  this->update();
  EXPECT_NEAR(this->place(ball).x, -2 - 0.03125 - 0.125, this->kNear);
}

TYPED_TEST(ContinuousCollisions, bullets_do_not_pass_what_moves_and_others_do) {
  using S = TypeParam;
  const BodyId plate = this->world.create(moving<S>(add_box(this->world, 0.03125, 2, 2), {0, 0, 0}));
  BodyDefinition<S> d = moving<S>(add_ball(this->world, 0.125), {-1, 0, 0});
  const BodyId ball = this->world.create(d);
  d.position = vec<S>(-1, 0, 1);
  d.bullet = true;
  const BodyId bullet = this->world.create(d);
  d = moving<S>(add_box(this->world, 0.03125, 2, 2), {0.5, 0, 0});
  d.bullet = true;
  this->world.create(d);
  this->move(plate, {0.0625, 0, 0});
  this->move(ball, {2, 0, 0});
  this->move(bullet, {2, 0, 1});
  this->update();
  EXPECT_EQ(this->place(ball).x, 2);
  EXPECT_NEAR(this->place(bullet).x, 0.0625 - 0.03125 - 0.125, this->kNear) << "the plate is where the step left it";
}

TYPED_TEST(ContinuousCollisions, a_bullet_that_rests_goes_along_with_what_would_pass_over_it) {
  using S = TypeParam;
  const BodyId plate = this->world.create(moving<S>(add_box(this->world, 0.03125, 2, 2), {1, 0, 0}));
  BodyDefinition<S> d = moving<S>(add_ball(this->world, 0.125), {0, 0, 0});
  d.bullet = true;
  const BodyId bullet = this->world.create(d);
  d.bullet = false;
  d.position = vec<S>(0, 0, 1);
  const BodyId ball = this->world.create(d);
  this->move(plate, {-1, 0, 0});
  this->update();
  EXPECT_NEAR(this->place(bullet).x, -1 - 0.03125 - 0.125, this->kNear);
  EXPECT_EQ(this->place(ball).x, 0);
}

TYPED_TEST(ContinuousCollisions, two_that_would_change_places_meet) {
  using S = TypeParam;
  const BodyId cube = this->world.create(moving<S>(add_box(this->world, 0.5, 0.5, 0.5), {1, 0, 0}));
  BodyDefinition<S> d = moving<S>(add_ball(this->world, 0.125), {-1, 0, 0});
  d.bullet = true;
  const BodyId bullet = this->world.create(d);
  this->move(cube, {-1.5, 0, 0});
  this->move(bullet, {1.5, 0, 0});
  this->update();
  EXPECT_NEAR(this->place(bullet).x, -1.5 - 0.5 - 0.125, this->kNear);
}

TYPED_TEST(ContinuousCollisions, every_pair_of_solids_stops) {
  using S = TypeParam;
  Dice dice(3);
  const auto shape = [&](int kind, double size) {
    switch (kind) {
      case 0: return add_ball(this->world, size);
      case 1: return add_box(this->world, size, 2 * size, size);
      case 2: return this->world.add_shape(Capsule<S>{num<S>(size), num<S>(size)});
      default: {
        const Child<S> part = {primitive_of(Hull<S>{1}), Pose<S>::identity()};
        const BlobRef blobs[] = {draw_hull(dice, {size, size, size})};
        return this->world.add_shape(std::span<const Child<S>>(&part, 1), blobs);
      }
    }
  };
  std::vector<BodyId> bodies;
  for (int i = 0; i < 16; ++i) {
    const double z = 8.0 * i;
    BodyDefinition<S> d = still<S>(shape(i % 4, 1), {0, 0, z});
    d.orientation = dice.template orientation<S>();
    this->world.create(d);
    d = moving<S>(shape(i / 4, 0.125), {-4, 0.0625, z});
    d.orientation = dice.template orientation<S>();
    bodies.push_back(this->world.create(d));
  }
  for (int i = 0; i < 16; ++i)
    this->move(bodies[static_cast<std::size_t>(i)], {4, 0.0625, 8.0 * i}, turn<S>({0, 1, 0}, 1));
  this->update();
  for (int i = 0; i < 16; ++i) EXPECT_LT(this->place(bodies[static_cast<std::size_t>(i)]).x, 0) << i;
}

TYPED_TEST(ContinuousCollisions, what_joints_tie_together_stops_together) {
  using S = TypeParam;
  this->add_wall();
  std::vector<BodyId> chain;
  for (int i = 0; i < 3; ++i) chain.push_back(this->add_ball_at({-1, 3.0 * i, 0}));
  const BodyId alone = this->add_ball_at({-1, 9, 0});
  for (int i = 0; i < 2; ++i) {
    const Pose<S> between = {vec<S>(-1, 3.0 * i + 1.5, 0), Quat<Unit<S>>::identity()};
    const auto next = static_cast<std::size_t>(i) + 1;
    this->world.create(this->world.joint_at(JointType::ball, chain[next - 1], chain[next], between));
  }
  for (int i = 0; i < 3; ++i) this->move(chain[static_cast<std::size_t>(i)], {3, 3.0 * i + (i == 2 ? 0.5 : 0.0), 0});
  this->move(alone, {3, 9, 0});
  this->update();
  const double stopped = this->place(chain[0]).x;
  EXPECT_NEAR(stopped, -0.03125 - 0.125, this->kNear);
  EXPECT_NEAR(this->place(chain[1]).x, stopped, 1e-3);
  EXPECT_NEAR(this->place(chain[2]).x, stopped, 1e-3);
  EXPECT_NEAR(this->place(chain[2]).y, 6, 1e-3);  // where its joint holds it, whatever the solver left
  EXPECT_EQ(this->place(alone).x, 3);
  for (const BodyId ball : chain)
    EXPECT_TRUE(this->systems->proxies.boxes().box(ball.slot) == this->systems->awake(ball).fat);
}

/// Were each to go a part of its own straight way, they would be 0.18 m apart: an arc of 1.5 m differs so much from a
/// chord.
TYPED_TEST(ContinuousCollisions, what_turns_about_a_joint_stops_with_it) {
  using S = TypeParam;
  constexpr double kArm = 1.5, kTurn = 1;  // [m], [rad]
  this->add_wall();
  const BodyId hub = this->add_ball_at({-1, 0, 0}), limb = this->add_ball_at({-1, kArm, 0});
  const Pose<S> pin = {vec<S>(-1, 0, 0), Quat<Unit<S>>::identity()};
  this->world.create(this->world.joint_at(JointType::hinge, hub, limb, pin));
  this->move(hub, {1, 0, 0});
  this->move(limb, {1 - kArm * isostep::sin(kTurn), kArm * isostep::cos(kTurn), 0}, turn<S>({0, 0, 1}, kTurn));
  this->update();
  const double fraction = (this->place(hub).x + 1) / 2;
  EXPECT_NEAR(this->place(hub).x, -0.03125 - 0.125, this->kNear);
  const BodyState<S>& state = this->systems->awake(limb);
  expect_near(this->place(limb) + rotated<S>(state.orientation, {0, -kArm, 0}), this->place(hub), 1e-5);
  const D3 up = rotated<S>(state.orientation, {0, 1, 0});
  EXPECT_NEAR(std::atan2(-up.x, up.y), fraction * kTurn, 0.01);
  EXPECT_NEAR(up.z, 0, 1e-6);
}

TYPED_TEST(ContinuousCollisions, what_hangs_on_the_world_stays_on_it) {
  using S = TypeParam;
  this->world.create(still<S>(add_box(this->world, 2, 0.03125, 2), {0, -1, 0}));
  const BodyId rod = this->add_ball_at({1.5, 0, 0});
  const Pose<S> pin = {vec<S>(0, 0, 0), Quat<Unit<S>>::identity()};
  this->world.create(this->world.joint_at(JointType::hinge, BodyId{}, rod, pin));
  this->move(rod, {0, -1.5, 0}, turn<S>({0, 0, 1}, -kPi / 2));
  this->update();
  EXPECT_NEAR(length(this->place(rod)), 1.5, 1e-5);
  EXPECT_GT(this->place(rod).y, -1 + 0.03125 + 0.125 - 3 * this->kNear);
  EXPECT_LT(this->place(rod).y, -0.5);
}

TYPED_TEST(ContinuousCollisions, the_order_of_bodies_in_the_tree_does_not_matter) {
  using S = TypeParam;
  Dice dice(5);
  std::vector<BodyId> balls;
  for (int i = 0; i < 40; ++i) {
    BodyDefinition<S> d = still<S>(add_box(this->world, 0.0625, 0.5, 0.5), dice.point(3));
    d.orientation = dice.template orientation<S>();
    this->world.create(d);
  }
  for (int i = 0; i < 20; ++i) balls.push_back(this->add_ball_at({-6, 0.3 * i - 3, 0}));
  std::vector<D3> found[2];
  for (int round = 0; round < 2; ++round) {
    this->systems.reset();
    this->start.clear();
    this->begin();
    if (round == 1) {  // another tree over the same state
      for (const std::uint32_t slot : {7u, 3u, 21u, 12u}) {
        const Location at = this->systems->map.location(slot);
        this->systems->proxies.remove(slot);
        this->systems->proxies.place(this->systems->map.state_at(at), this->systems->map.properties_at(at), false);
      }
    }
    for (int i = 0; i < 20; ++i) this->move(balls[static_cast<std::size_t>(i)], {6, 3 - 0.3 * i, 0});
    this->update();
    for (const BodyId ball : balls) found[round].push_back(this->place(ball));
  }
  int stopped = 0;
  for (std::size_t i = 0; i < 20; ++i) {
    EXPECT_TRUE(found[0][i] == found[1][i]) << i;
    stopped += found[0][i].x < 5.9 ? 1 : 0;
  }
  EXPECT_GT(stopped, 4);
}

}  // namespace continuous_collision_test
}  // namespace isostep::test
