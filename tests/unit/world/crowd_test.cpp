// Crowds: bodies in one place, more pairs than the budget; what is kept, what is left out, what is said of it.
// SPDX-License-Identifier: MIT

#include <array>
#include <set>
#include <utility>

#include "unit/world/worlds.hpp"

namespace isostep::test {
namespace crowd_test {

template <class S> Settings<S> with_budget(std::int32_t most_pairs, double gravity = -10) {
  Settings<S> s = settings<S>(gravity, 60, 4);
  s.most_pairs = most_pairs;
  return s;
}
/// Adds so many balls of radius 0.25 with their centres in one place.
template <class S> std::vector<BodyId> add_crowd(World<S>& world, int count, BodyDefinition<S> ball) {
  ball.shape = add_ball(world, 0.25);
  std::vector<BodyId> crowd;
  for (int i = 0; i < count; ++i) crowd.push_back(world.create(ball));
  return crowd;
}
template <class S> std::set<std::pair<std::uint32_t, std::uint32_t>> pairs_in_contact(const World<S>& world) {
  std::set<std::pair<std::uint32_t, std::uint32_t>> pairs;
  for (const Contact<S>& contact : world.state().contacts) pairs.insert({contact.key.body_a, contact.key.body_b});
  return pairs;
}

template <class S> class Crowds : public ::testing::Test {};
TYPED_TEST_SUITE(Crowds, AllScalars);

TYPED_TEST(Crowds, of_as_many_pairs_as_the_budget_have_all_of_them_and_of_more_have_some) {
  using S = TypeParam;
  World<S> full(with_budget<S>(120)), over(with_budget<S>(119));
  for (World<S>* world : {&full, &over}) add_crowd(*world, 16, moving<S>({}, {0, 4, 0}));
  const StepReport report = full.step();
  EXPECT_TRUE(report.clean());
  EXPECT_EQ(pairs_in_contact(full).size(), 120u);
  const StepReport cut = over.step();
  EXPECT_FALSE(cut.clean());
  EXPECT_GT(cut.crowded, 0u);
  EXPECT_LE(pairs_in_contact(over).size(), 119u);
  EXPECT_GT(pairs_in_contact(over).size(), 60u);
}

TYPED_TEST(Crowds, cost_no_more_than_the_budget_however_many_there_are) {
  using S = TypeParam;
  World<S> world(with_budget<S>(2000));
  add_crowd(world, 1000, moving<S>({}, {0, 4, 0}));
  for (int i = 0; i < 3; ++i) {
    EXPECT_GT(world.step().crowded, 900u);
    EXPECT_LE(pairs_in_contact(world).size(), 2000u);
    EXPECT_GT(pairs_in_contact(world).size(), 900u);
  }
}

/// Nobody has all the budget: in the heap each has some neighbours to be pushed away from.
TYPED_TEST(Crowds, share_the_budget_evenly) {
  using S = TypeParam;
  World<S> world(with_budget<S>(1000));
  add_crowd(world, 100, moving<S>({}, {0, 4, 0}));
  world.step();
  std::array<int, 100> partners{};
  for (const auto& [a, b] : pairs_in_contact(world)) ++partners[a], ++partners[b];
  for (const int count : partners) EXPECT_TRUE(0 < count && count <= 60) << count;
}

TYPED_TEST(Crowds, fall_through_no_floor) {
  using S = TypeParam;
  World<S> world(with_budget<S>(300));
  add_ground(world);
  BodyDefinition<S> lift = moving<S>(add_box(world, 2, 0.5, 2), {10, 0, 0});
  lift.type = BodyType::kinematic;
  world.create(lift);
  const std::vector<BodyId> low = add_crowd(world, 100, moving<S>({}, {0, 0.3, 0}, {0, -4, 0}));
  const std::vector<BodyId> lifted = add_crowd(world, 100, moving<S>({}, {10, 0.8, 0}, {0, -4, 0}));
  std::uint32_t crowded = 0;
  for (int i = 0; i < 60; ++i) crowded += world.step().crowded;
  EXPECT_GT(crowded, 200u);
  for (const BodyId id : low) EXPECT_GT(to_double(world.pose(id).position.y), 0.15);
  for (const BodyId id : lifted) {
    const D3 at = real(world.pose(id).position);
    const bool on_lift = std::fabs(at.x - 10) < 1.7 && std::fabs(at.z) < 1.7;
    EXPECT_GT(at.y, on_lift ? 0.6 : 0.15);
  }
}

TYPED_TEST(Crowds, leave_contacts_elsewhere_as_they_are) {
  using S = TypeParam;
  World<S> world(with_budget<S>(400));
  add_ground(world);
  const ShapeId box = add_box(world, 0.5, 0.5, 0.5);
  std::vector<BodyId> stack;
  for (int i = 0; i < 5; ++i) stack.push_back(world.create(moving<S>(box, {20, 0.5 + i, 0})));
  run(world, 10);
  const auto before = pairs_in_contact(world);
  EXPECT_EQ(before.size(), 5u);
  const double top = to_double(world.pose(stack[4]).position.y);
  add_crowd(world, 200, moving<S>({}, {0, 3, 0}));
  for (int i = 0; i < 15; ++i) {
    EXPECT_GT(world.step().crowded, 0u);
    const auto now = pairs_in_contact(world);
    for (const auto& pair : before) EXPECT_EQ(now.count(pair), 1u);
  }
  EXPECT_NEAR(to_double(world.pose(stack[4]).position.y), top, 0.01);
}

TYPED_TEST(Crowds, that_cannot_collide_make_no_pairs) {
  using S = TypeParam;
  std::array<BodyDefinition<S>, 4> kinds;
  kinds.fill(moving<S>({}, {0, 4, 0}));
  kinds[0].collide = false;
  kinds[1].filter = {2, 1, 0};
  kinds[2].filter.group = 5;
  kinds[3].sensor = true;
  for (const BodyDefinition<S>& kind : kinds) {
    World<S> world(with_budget<S>(kLeastPairs));
    add_crowd(world, 500, kind);
    EXPECT_TRUE(world.step().clean());
    EXPECT_EQ(world.counts().contacts, 0u);
  }
}

TYPED_TEST(Crowds, of_fixed_bodies_make_no_pairs_with_one_another) {
  using S = TypeParam;
  World<S> world(with_budget<S>(kLeastPairs));
  const ShapeId ball = add_ball(world, 0.25);
  for (int i = 0; i < 500; ++i) world.create(still<S>(ball, {0, 4, 0}));
  EXPECT_TRUE(world.step().clean());
  world.create(moving<S>(ball, {0, 4, 0}));
  EXPECT_EQ(world.step().crowded, 1u);
  EXPECT_LE(pairs_in_contact(world).size(), static_cast<std::size_t>(kLeastPairs));
}

/// Compounds of eight balls in one place: 64 pairs of parts a pair.
TYPED_TEST(Crowds, of_compounds_collide_some_parts_of_every_pair) {
  using S = TypeParam;
  World<S> world(with_budget<S>(kLeastPairs));
  const Child<S> part = {primitive_of(Sphere<S>{num<S>(0.25)}), Pose<S>::identity()};
  const std::vector<Child<S>> parts(8, part);
  const ShapeId compound = world.add_shape(parts);
  for (int i = 0; i < 8; ++i) world.create(moving<S>(compound, {0, 4, 0}));
  const StepReport report = world.step();
  EXPECT_EQ(report.crowded, 0u);
  EXPECT_EQ(report.cut_compounds, 28u);
  EXPECT_FALSE(report.clean());
  EXPECT_EQ(pairs_in_contact(world).size(), 28u);
  EXPECT_LE(world.state().contacts.size(), 2u * static_cast<std::size_t>(kLeastPairs));
}

/// The direct solver's island of them all has a budget of its own; that is reported, and nothing was lost.
TYPED_TEST(Crowds, are_swept_by_the_direct_solver_which_says_so) {
  using S = TypeParam;
  Settings<S> s = with_budget<S>(10000);
  s.solver = SolverName::direct;
  World<S> world(s);
  BodyDefinition<S> alone = moving<S>(add_ball(world, 0.25), {9, 0.25, 0});
  add_ground(world);
  world.create(alone);
  StepReport report = world.step();
  EXPECT_EQ(report.unsolved, 0u);
  add_crowd(world, 40, moving<S>({}, {0, 4, 0}));
  report = world.step();
  EXPECT_EQ(report.unsolved, 1u);
  EXPECT_TRUE(report.clean());
}

TYPED_TEST(Crowds, come_apart_until_the_budget_is_enough) {
  using S = TypeParam;
  World<S> world(with_budget<S>(400, 0));
  add_crowd(world, 60, moving<S>({}, {0, 4, 0}));
  EXPECT_GT(world.step().crowded, 0u);
  bool clean = false;
  for (int i = 0; i < 240 && !clean; ++i) clean = world.step().clean();
  EXPECT_TRUE(clean);
}

TYPED_TEST(Crowds, are_reported_as_in_float) {
  using S = TypeParam;
  World<S> world(with_budget<S>(500));
  World<float> same(with_budget<float>(500));
  add_ground(world);
  add_ground(same);
  add_crowd(world, 90, moving<S>({}, {0, 0.25, 0}));
  add_crowd(same, 90, moving<float>({}, {0, 0.25, 0}));
  EXPECT_EQ(world.step().crowded, same.step().crowded);
  EXPECT_EQ(pairs_in_contact(world), pairs_in_contact(same));
}

TYPED_TEST(Crowds, have_budgets_within_limits) {
  using S = TypeParam;
  for (const std::int32_t budget : {kLeastPairs - 1, -1, kMostPairs + 1}) {
    World<S> world(with_budget<S>(budget));
    EXPECT_EQ(world.fault(), Fault::out_of_range);
    EXPECT_EQ(world.settings().most_pairs, budget < kLeastPairs ? kLeastPairs : kMostPairs);
  }
  World<S> world(with_budget<S>(kLeastPairs + 1)), other;
  EXPECT_EQ(world.fault(), Fault::none);
  std::vector<std::uint8_t> bytes = bytes_of(world);
  Reader good(bytes);
  ASSERT_TRUE(other.read_portable(good));
  EXPECT_EQ(other.settings().most_pairs, kLeastPairs + 1);
  // scalar, rates, gravity, allow_sleep, solver, id_space
  const std::size_t place = 4 + 8 + sizeof(Vec3<S>) + 1 + 4 + 4;
  ASSERT_EQ(load_le<std::uint32_t>(bytes.data() + place), static_cast<std::uint32_t>(kLeastPairs + 1));
  store_le(bytes.data() + place, static_cast<std::uint32_t>(kLeastPairs - 1));
  Reader bad(bytes);
  EXPECT_FALSE(other.read_portable(bad));
}

}  // namespace crowd_test
}  // namespace isostep::test
