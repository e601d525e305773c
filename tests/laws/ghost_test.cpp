// Laws of Ghost: two bodies pass each other until they are apart, and not for longer.
// SPDX-License-Identifier: MIT

#include "unit/world/worlds.hpp"

namespace isostep::test {
namespace ghost_test {

template <class S> class Ghosts : public ::testing::Test {
 protected:
  BodyId platform(D3 at, D3 half = {4, 0.125, 4}) { return w.create(still<S>(add_box(w, half.x, half.y, half.z), at)); }
  BodyId ball(D3 at, D3 velocity = {0, 0, 0}) { return w.create(moving<S>(add_ball(w, 0.25), at, velocity)); }
  std::size_t ghosts() const { return w.state().records->ghosts.slot_map().template ids<GhostId>().size(); }
  D3 at(BodyId body) const { return real(w.center_of_mass(body)); }

  World<S> w{settings<S>()};
};
TYPED_TEST_SUITE(Ghosts, AllScalars);

TYPED_TEST(Ghosts, a_ghost_falls_as_if_it_were_alone_and_ends_once_it_is_apart) {
  using S = TypeParam;
  World<S> alone(settings<S>());
  const BodyDefinition<S> d = moving<S>(add_box(alone, 0.25, 0.25, 0.25), {0, 0.25, 0}, {0.5, 0, 0});
  const BodyId twin = alone.create(d);
  const BodyId body = this->w.create(moving<S>(add_box(this->w, 0.25, 0.25, 0.25), {0, 0.25, 0}, {0.5, 0, 0}));
  const BodyId floor = this->platform({0, 0, 0}, {4, 0.125, 4});  // they overlap from the start
  const GhostId id = this->w.add(Ghost<S>{floor, body});
  ASSERT_TRUE(id) << describe(this->w.fault());
  double at_end = 0;
  for (int i = 0; i < 60; ++i) {
    if (this->w.find(id) != nullptr) at_end = this->at(body).y;
    this->w.step();
    alone.step();
    ASSERT_EQ(this->w.pose(body).position, alone.pose(twin).position) << i;
  }
  EXPECT_EQ(this->w.find(id), nullptr);
  EXPECT_LT(at_end, -0.125 - 0.25) << "not before they are apart";
  EXPECT_GT(at_end, -0.125 - 0.25 - 0.02 - 0.15) << "nor long after";
  const BodyId next = this->ball({1, 1, 0});
  run(this->w, 60);
  EXPECT_GT(this->at(next).y, 0.3);
}

TYPED_TEST(Ghosts, a_ghost_wakes_its_bodies_and_ends_their_contact) {
  using S = TypeParam;
  const BodyId floor = this->platform({0, 0, 0});
  const BodyId box = this->w.create(moving<S>(add_box(this->w, 0.25, 0.25, 0.25), {0, 0.375, 0}));
  ASSERT_TRUE(settle(this->w));
  ASSERT_TRUE(this->w.add(Ghost<S>{box, floor}));
  EXPECT_EQ(this->w.counts().awake, 1u);
  this->w.step();
  EXPECT_EQ(this->w.events().contact_end.size(), 1u);
  run(this->w, 30);
  EXPECT_LT(this->at(box).y, -0.5);
  EXPECT_EQ(this->ghosts(), 0u);
}

TYPED_TEST(Ghosts, a_ghost_ends_with_its_body_and_where_bodies_are_put_apart) {
  using S = TypeParam;
  const BodyId floor = this->platform({0, 0, 0}), other = this->platform({0, 0.125, 0});
  const GhostId of_statics = this->w.add(Ghost<S>{floor, other});
  const BodyId inside = this->ball({0, 0, 0});
  const GhostId id = this->w.add(Ghost<S>{floor, inside}), second = this->w.add(Ghost<S>{inside, other});
  this->w.step();
  EXPECT_NE(this->w.find(id), nullptr);
  EXPECT_NE(this->w.find(second), nullptr);
  EXPECT_NE(this->w.find(of_statics), nullptr);
  ASSERT_TRUE(this->w.set_pose(other, {vec<S>(0, 5, 0), Quat<Unit<S>>::identity()}));
  this->w.step();
  EXPECT_EQ(this->w.find(of_statics), nullptr);
  EXPECT_EQ(this->w.find(second), nullptr);
  EXPECT_NE(this->w.find(id), nullptr);
  ASSERT_TRUE(this->w.destroy(inside));
  EXPECT_EQ(this->w.find(id), nullptr);
  EXPECT_EQ(this->ghosts(), 0u);
}

TYPED_TEST(Ghosts, a_ghost_is_no_obstacle_to_a_bullet) {
  using S = TypeParam;
  const double fast = pick<S>(100, 100, 50, 100);
  this->w.set_gravity(Vec3<S>::zero());
  const BodyId plate = this->platform({0, 0, 0}, {4, 0.03125, 4});
  // Its box, a tenth of a metre wider than itself, meets the plate's, and so do their contacts' 2 cm.
  const BodyId ghost = this->ball({0, 0.29, 0}, {0, -fast, 0}), solid = this->ball({2, 0.29, 0}, {0, -fast, 0});
  ASSERT_TRUE(this->w.add(Ghost<S>{ghost, plate}));
  run(this->w, 5);
  EXPECT_NEAR(this->at(ghost).y, 0.29 - fast * 5 / 60, 0.01);
  EXPECT_GT(this->at(solid).y, 0);
}

TYPED_TEST(Ghosts, ghosts_are_refused_of_one_body_of_none_and_twice) {
  using S = TypeParam;
  const BodyId a = this->platform({0, 0, 0}), b = this->ball({0, 0, 0}), c = this->ball({0.25, 0, 0});
  ASSERT_TRUE(this->w.add(Ghost<S>{a, b}));
  const std::uint64_t before = this->w.hash();
  const auto refused = [&](Ghost<S> ghost, Fault fault, const char* field) {
    EXPECT_FALSE(this->w.add(ghost));
    EXPECT_EQ(this->w.fault(), fault) << field;
    EXPECT_STREQ(this->w.fault().field, field);
    EXPECT_EQ(this->w.hash(), before) << field;
  };
  refused({a, a}, Fault::bad_argument, "b");
  refused({a, b}, Fault::bad_argument, "b");
  refused({b, a}, Fault::bad_argument, "b");
  refused({a, {}}, Fault::null_id, "b");
  refused({{}, a}, Fault::null_id, "a");
  EXPECT_TRUE(this->w.add(Ghost<S>{b, c}));
  World<S> read;
  std::vector<std::uint8_t> bytes = bytes_of(this->w);
  Reader reader(bytes);
  EXPECT_TRUE(read.read_portable(reader).ok());
  EXPECT_EQ(read.hash(), this->w.hash());
}

}  // namespace ghost_test
}  // namespace isostep::test
