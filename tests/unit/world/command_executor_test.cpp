// CommandExecutor alone: commands change the state and its caches, or leave a fault.
// SPDX-License-Identifier: MIT

#include "isostep/commands/command_executor.hpp"

#include "isostep/state/members.hpp"
#include "isostep/systems/sleep/island_sleep.hpp"
#include "unit/world/systems.hpp"

namespace isostep::test {
namespace command_executor_test {

template <class S> class Executors : public ::testing::Test {
 protected:
  Executors() : systems(world) {
    const Child<S> ball = {primitive_of(Sphere<S>{num<S>(0.5)}), Pose<S>::identity()};
    shape = executor.execute(AddShape<S>{{ball}});
  }
  std::uint64_t hash() const {
    detail::StateHasher hasher;
    WorldState<S>::members(hasher, systems.state);
    return hasher.value();
  }

  World<S> world{settings<S>()};
  Systems<S> systems;
  FaultLog faults;
  CommandJournal journal;
  RenderPoses<S> render_poses{systems.state};
  IslandSleep<S> sleep{systems.state, systems.map, systems.proxies};
  Destruction<S> destruction{systems.state, systems.map, systems.proxies, systems.wake};
  AssetSource assets;
  CommandExecutor<S> executor{systems.state, systems.map,  systems.proxies, systems.wake, sleep,
                              destruction,   render_poses, assets,          faults,       journal};
  ShapeId shape;
};
TYPED_TEST_SUITE(Executors, SystemScalars);

TYPED_TEST(Executors, a_body_that_is_created_is_in_the_state_the_map_and_the_broad_phase) {
  using S = TypeParam;
  const BodyId body = this->executor.execute(CreateBody<S>{moving<S>(this->shape, {1, 2, 3})});
  ASSERT_TRUE(body);
  EXPECT_EQ(this->systems.state.awake.states.size(), 1u);
  EXPECT_EQ(this->systems.map.location(body.slot).set, Location::kAwake);
  EXPECT_TRUE(this->systems.proxies.present(body.slot));
  EXPECT_TRUE(this->executor.execute(DestroyBody{body}));
  EXPECT_TRUE(this->systems.state.awake.states.empty());
  EXPECT_FALSE(this->systems.proxies.present(body.slot));
}

/// In a state where much could be changed: a body that sleeps on a joint to the world, one that is awake and pushed.
TYPED_TEST(Executors, what_is_refused_names_its_field_and_changes_nothing) {
  using S = TypeParam;
  const BodyId asleep = this->executor.execute(CreateBody<S>{moving<S>(this->shape, {0, 0, 0})});
  JointProperties<S> tie;
  tie.body_a = asleep.slot;
  tie.generation_a = asleep.generation;
  const JointId joint = this->executor.execute(CreateJoint<S>{tie});
  ASSERT_TRUE(joint);
  IslandSleep<S>& islands = this->sleep;
  std::vector<BodyId> fell_asleep;
  this->render_poses.keep_start();
  for (int i = 0; i < 30; ++i) islands.update(fell_asleep, this->render_poses.start());
  ASSERT_TRUE(this->systems.is_asleep(asleep));
  const BodyId awake = this->executor.execute(CreateBody<S>{moving<S>(this->shape, {0.75, 0, 0})});
  const BodyId gone = this->executor.execute(CreateBody<S>{moving<S>(this->shape, {8, 0, 0})});
  ASSERT_TRUE(this->executor.execute(DestroyBody{gone}));
  ASSERT_TRUE(this->executor.execute(ApplyForce<S>{awake, vec<S>(3, 0, 0), vec<S>(0, 0, 0)}));

  const auto expect_refused = [&](const auto& command, Fault fault, const char* field) {
    const std::uint64_t before = this->hash();
    this->faults.forget();
    EXPECT_FALSE(this->executor.execute(command));
    EXPECT_EQ(this->faults.last().fault, fault);
    EXPECT_STREQ(this->faults.last().field, field);
    EXPECT_EQ(this->hash(), before) << "a refused command changed something: " << field;
  };
  BodyDefinition<S> d = moving<S>(this->shape, {0, 0, 0});
  d.mass = S(-1);
  const Vec3<S> beyond = {Limits<S>::position() + S(1), S(0), S(0)}, fast = {Limits<S>::speed() + S(1), S(0), S(0)};
  const Vec3<S> none = vec<S>(0, 0, 0);
  Material<S> rough;
  rough.friction = S(-1);
  JointProperties<S> other = tie;
  other.type = JointType::distance;
  expect_refused(AddShape<S>{}, Fault::bad_shape, "children");
  expect_refused(CreateBody<S>{d}, Fault::bad_mass, "mass");
  expect_refused(RemoveShape{ShapeId{}}, Fault::null_id, "shape");
  expect_refused(RemoveShape{this->shape}, Fault::shape_in_use, "shape");
  expect_refused(DestroyBody{gone}, Fault::stale_id, "body");
  expect_refused(SetPose<S>{asleep, {beyond, Quat<Unit<S>>::identity()}}, Fault::out_of_range, "position");
  expect_refused(SetVelocity<S>{asleep, fast, none}, Fault::out_of_range, "linear");
  expect_refused(SetMaterial<S>{asleep, rough}, Fault::bad_argument, "material.friction");
  expect_refused(SetMotion<S>{asleep, S(1), S(-1), S(0), 0}, Fault::bad_argument, "linear_damping");
  expect_refused(SetFilter{gone, {}}, Fault::stale_id, "body");
  expect_refused(ApplyForce<S>{gone, none, none}, Fault::stale_id, "body");
  expect_refused(ApplyImpulse<S>{gone, none, none}, Fault::stale_id, "body");
  expect_refused(SetGravity<S>{fast}, Fault::out_of_range, "gravity");
  expect_refused(CreateJoint<S>{{}}, Fault::not_dynamic, "body_a, body_b");
  expect_refused(SetJoint<S>{joint, other}, Fault::bad_argument, "type");
  expect_refused(DestroyJoint{JointId{}}, Fault::null_id, "joint");
}

TYPED_TEST(Executors, forces_add_up_until_the_step) {
  using S = TypeParam;
  BodyDefinition<S> d = moving<S>(this->shape, {0, 0, 0});
  d.mass = S(2);
  const BodyId body = this->executor.execute(CreateBody<S>{d});
  for (int i = 0; i < 2; ++i)
    EXPECT_TRUE(this->executor.execute(ApplyForce<S>{body, vec<S>(3, 0, 0), vec<S>(0, 0, 0)}));
  ASSERT_EQ(this->systems.state.forces.size(), 1u);
  EXPECT_EQ(to_double(this->systems.state.forces[0].linear.x), 3) << "6 N on 2 kg";
}

TYPED_TEST(Executors, of_many_to_destroy_a_stale_id_is_a_fault_and_the_others_go) {
  using S = TypeParam;
  const BodyId a = this->executor.execute(CreateBody<S>{moving<S>(this->shape, {0, 0, 0})});
  const BodyId b = this->executor.execute(CreateBody<S>{moving<S>(this->shape, {4, 0, 0})});
  const BodyId list[] = {a, a, b};
  EXPECT_EQ(this->executor.destroy_all(list), 2u);
  EXPECT_EQ(this->faults.first().fault, Fault::stale_id);
  EXPECT_TRUE(this->systems.state.awake.states.empty());
}

}  // namespace command_executor_test
}  // namespace isostep::test
