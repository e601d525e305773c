// CommandExecutor alone: commands change the state and its caches, or leave a fault.
// SPDX-License-Identifier: MIT

#include "isostep/world/command_executor.hpp"

#include "unit/world/rooms.hpp"

namespace isostep::test {
namespace {

template <class S> class Executors : public ::testing::Test {
 protected:
  Executors() : rooms(world) {
    const Child<S> ball = {primitive_of(Sphere<S>{num<S>(0.5)}), Pose<S>::identity()};
    shape = executor.execute(AddShape<S>{{ball}});
  }

  World<S> world{settings<S>()};
  Rooms<S> rooms;
  CommandJournal journal;
  RenderPoses<S> render_poses{rooms.state};
  Destruction<S> destruction{rooms.state, rooms.map, rooms.proxies, rooms.wake};
  AssetSource assets;
  CommandExecutor<S> executor{rooms.state, rooms.map,    rooms.proxies, rooms.wake,
                              destruction, render_poses, assets,        journal};
  ShapeId shape;
};
TYPED_TEST_SUITE(Executors, RoomScalars);

TYPED_TEST(Executors, a_body_that_is_created_is_in_the_state_the_map_and_the_broad_phase) {
  using S = TypeParam;
  const BodyId body = this->executor.execute(CreateBody<S>{moving<S>(this->shape, {1, 2, 3})});
  ASSERT_TRUE(body);
  EXPECT_EQ(this->rooms.state.awake.states.size(), 1u);
  EXPECT_EQ(this->rooms.map.location(body.slot).set, Location::kAwake);
  EXPECT_TRUE(this->rooms.proxies.present(body.slot));
  EXPECT_TRUE(this->executor.execute(DestroyBody{body}));
  EXPECT_TRUE(this->rooms.state.awake.states.empty());
  EXPECT_FALSE(this->rooms.proxies.present(body.slot));
}

TYPED_TEST(Executors, what_is_refused_names_its_field_and_changes_nothing) {
  using S = TypeParam;
  BodyDefinition<S> d = moving<S>(this->shape, {0, 0, 0});
  d.mass = S(-1);
  EXPECT_FALSE(this->executor.execute(CreateBody<S>{d}));
  EXPECT_EQ(this->journal.fault().fault, Fault::bad_mass);
  EXPECT_STREQ(this->journal.fault().field, "mass");
  EXPECT_TRUE(this->rooms.state.body_slots.entries().empty());
  EXPECT_FALSE(this->executor.execute(RemoveShape{ShapeId{}}));
  EXPECT_EQ(this->journal.fault().fault, Fault::null_id);
}

TYPED_TEST(Executors, forces_add_up_until_the_step) {
  using S = TypeParam;
  BodyDefinition<S> d = moving<S>(this->shape, {0, 0, 0});
  d.mass = S(2);
  const BodyId body = this->executor.execute(CreateBody<S>{d});
  for (int i = 0; i < 2; ++i)
    EXPECT_TRUE(this->executor.execute(ApplyForce<S>{body, vec<S>(3, 0, 0), vec<S>(0, 0, 0)}));
  ASSERT_EQ(this->rooms.state.forces.size(), 1u);
  EXPECT_EQ(to_double(this->rooms.state.forces[0].linear.x), 3) << "6 N on 2 kg";
}

TYPED_TEST(Executors, of_many_to_destroy_a_stale_id_is_a_fault_and_the_others_go) {
  using S = TypeParam;
  const BodyId a = this->executor.execute(CreateBody<S>{moving<S>(this->shape, {0, 0, 0})});
  const BodyId b = this->executor.execute(CreateBody<S>{moving<S>(this->shape, {4, 0, 0})});
  const BodyId list[] = {a, a, b};
  EXPECT_EQ(this->executor.destroy_all(list), 2u);
  EXPECT_EQ(this->journal.first_fault().fault, Fault::stale_id);
  EXPECT_TRUE(this->rooms.state.awake.states.empty());
}

}  // namespace
}  // namespace isostep::test
