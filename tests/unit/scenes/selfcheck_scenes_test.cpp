// The scenes of the self-check are small, and nothing of the engines is missing from them.
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "isostep/store/state.hpp"
#include "scenes/build.hpp"
#include "scenes/named.hpp"
#include "scenes/particles/particle_game.hpp"
#include "scenes/particles/words.hpp"
#include "scenes/script.hpp"

namespace isostep::scenes {
namespace selfcheck_scenes_test {

template <class S> class SelfcheckScenes : public ::testing::Test {};
using Scalars = ::testing::Types<float, double, Q16_16, Q32_32>;
TYPED_TEST_SUITE(SelfcheckScenes, Scalars);

constexpr int kFrames = 180;

/// The things that a run of the medley met.
template <class S> struct Sights {
  std::set<JointType> joints;
  std::set<ShapeType> shapes;               // of bodies in contact
  std::set<BodyType> types;                 // likewise
  bool compound = false, conveyed = false;  // touched
  bool motor = false, spring = false;       // gave impulses
  bool lower = false, upper = false, swing = false;
  std::size_t contact_begin = 0, contact_end = 0, sensor_begin = 0, sensor_end = 0, fell_asleep = 0, woke = 0;

  void see(const World<S>& world) {
    const WorldState<S>& state = world.state();
    for (const JointProperties<S>& joint : state.joints.properties) joints.insert(joint.type);
    for (const JointState<S>& joint : state.joints.states) {
      for (std::uint32_t row = 0; row < kJointRows; ++row) {
        if (!joint.has_drive(row)) continue;
        lower = lower || joint.piece(row) == DrivePiece::lower;
        upper = upper || joint.piece(row) == DrivePiece::upper;
        motor = motor || joint.piece(row) >= DrivePiece::driven;
        swing = swing || (row == 3 && joint.angular.x != Velocity<S>(0));
      }
    }
    for (std::size_t i = 0; i < state.joints.states.size(); ++i) {
      const bool sprung = (state.joints.properties[i].flags & joint_flag::kSpring) != 0;
      const JointState<S>& joint = state.joints.states[i];
      for (std::uint32_t row = 0; row < kJointRows; ++row)
        spring = spring || (sprung && joint.has_drive(row) &&
                            (row < 3 ? joint.point : joint.angular)[static_cast<int>(row % 3)] != Velocity<S>(0));
    }
    for (const Contact<S>& contact : state.contacts) {
      touch(world.view(state.body_slots.template id_of<BodyId>(contact.key.body_a)));
      touch(world.view(state.body_slots.template id_of<BodyId>(contact.key.body_b)));
    }
    const Events<S>& events = world.events();
    contact_begin += events.contact_begin.size();
    contact_end += events.contact_end.size();
    sensor_begin += events.sensor_begin.size();
    sensor_end += events.sensor_end.size();
    fell_asleep += events.fell_asleep.size();
    woke += events.woke.size();
  }
  void touch(const BodyView<S>& body) {
    for (const Child<S>& child : body.children) shapes.insert(child.primitive.type);
    types.insert(body.properties->type);
    compound = compound || body.children.size() > 1;
    conveyed = conveyed || body.properties->material.surface_velocity.x != S(0);
  }
};

TYPED_TEST(SelfcheckScenes, MedleyAsksForEveryPartOfTheRigidEngine) {
  using S = TypeParam;
  const Scene scene = *find_scene("medley");
  World<S> world(settings_of<S>(scene));
  build(scene, world);
  EXPECT_LE(world.counts().bodies, 24u);
  Sights<S> sights;
  for (int i = 0; i < kFrames; ++i) {
    before_step(scene.script, world);
    ASSERT_EQ(world.fault(), Fault::none) << i << ": " << describe(world.fault());
    ASSERT_TRUE(world.step().clean()) << i;
    sights.see(world);
  }
  EXPECT_EQ(sights.joints.size(), 4u);
  EXPECT_EQ(sights.shapes.size(), 4u);
  EXPECT_EQ(sights.types.size(), 3u);
  EXPECT_TRUE(sights.compound && sights.conveyed);
  EXPECT_TRUE(sights.motor && sights.spring);
  EXPECT_TRUE(sights.lower);
  EXPECT_TRUE(sights.upper);
  EXPECT_TRUE(sights.swing);
  EXPECT_GT(sights.contact_begin, 10u);
  EXPECT_GT(sights.contact_end, 0u);
  EXPECT_GT(sights.sensor_begin, 0u);
  EXPECT_GT(sights.sensor_end, 0u);
  EXPECT_GE(sights.fell_asleep, 3u);
  EXPECT_GE(sights.woke, 3u);
}

/// The set's rigid recordings by other solvers are the first 30 frames: contacts and joints are at work by then.
TYPED_TEST(SelfcheckScenes, MedleyByEverySolverHasContactsAndPulledJointsWithinThirtyFrames) {
  using S = TypeParam;
  for (std::uint32_t solver = 0; solver < kSolvers; ++solver) {
    if (left_out(SolverName{solver}) != nullptr) continue;
    Scene scene = *find_scene("medley");
    scene.solver = static_cast<SolverName>(solver);
    World<S> world(settings_of<S>(scene));
    build(scene, world);
    for (int i = 0; i < 30; ++i) {
      before_step(scene.script, world);
      ASSERT_TRUE(world.step().clean()) << kSolverNames[solver] << ' ' << i;
    }
    EXPECT_GE(world.state().contacts.size(), 6u) << kSolverNames[solver];
    const auto& joints = world.state().joints.states;
    EXPECT_TRUE(std::any_of(joints.begin(), joints.end(), [](const JointState<S>& joint) {
      return joint.point.y != Velocity<S>(0);
    })) << kSolverNames[solver];
  }
}

template <class S> std::set<std::string> kinds_of(const World<S>& world) {
  std::set<std::string> kinds;
  RecordStore<S>::members(
      [&](const char* kind, const auto& registry) {
        if (!registry.slot_map().template ids<BodyId>().empty()) kinds.insert(kind);
      },
      *world.state().records);
  return kinds;
}

TYPED_TEST(SelfcheckScenes, ElementsHasEveryRecordAndEachActs) {
  using S = TypeParam;
  const Scene scene = *find_scene("elements");
  World<S> world(settings_of<S>(scene));
  const std::vector<BodyId> bodies = build(scene, world).bodies;
  std::size_t every = 0;
  RecordStore<S>::members([&](const char*, const auto&) { ++every; }, *world.state().records);
  EXPECT_EQ(kinds_of(world).size(), every);
  EXPECT_LE(world.counts().bodies, 18u);
  std::size_t broke = 0, joints_broken = 0, most = 0, ghosts = 0, hits = 0, felt = 0;
  double slowest = 0;  // [m/s] of the crate along z
  for (int i = 0; i < scene.frames; ++i) {
    before_step(scene.script, world);
    ASSERT_EQ(world.fault(), Fault::none) << i << ": " << describe(world.fault());
    ASSERT_TRUE(world.step().clean()) << i;
    broke += world.events().broke.size();
    joints_broken += world.events().joint_broke.size();
    hits += world.events().hits.size();
    felt += world.events().sensor_begin.size();
    ghosts = std::max(ghosts, world.state().records->ghosts.slot_map().template ids<GhostId>().size());
    slowest = std::min(slowest, to_double(world.velocity(bodies[8]).z));
    most = std::max<std::size_t>(most, world.counts().bodies);
  }
  const auto height = [&](int body) { return to_double(world.center_of_mass(bodies[body]).y); };
  EXPECT_EQ(broke, 1u);
  EXPECT_EQ(joints_broken, 1u);
  EXPECT_NEAR(to_double(world.angular_velocity(bodies[13]).z), -3, 0.1);  // geared to a motor
  EXPECT_GE(most, 19u);                                                   // the cube's pieces came
  // A servo turns the arm as far as its limit lets it.
  const JointId shoulder = world.state().joint_slots.template id_of<JointId>(3);
  EXPECT_NEAR(to_double(world.joint_position(shoulder, JointAxis::twist)), 0.25, 0.01);
  EXPECT_GE(hits, 1u);                                            // told by the hammer
  EXPECT_GE(felt, 1u);                                            // by what goes before the walker
  EXPECT_EQ(ghosts, 2u);                                          // swing and kite in the shelf
  EXPECT_LT(slowest, -0.5);                                       // the crate drives on its belt
  EXPECT_FALSE(world.contains(bodies[6]));                        // in its place
  EXPECT_LT(world.counts().bodies, most);                         // and went
  EXPECT_EQ(kinds_of(world).count("explosions"), 0u);             // ended
  EXPECT_GT(to_double(world.center_of_mass(bodies[8]).x), 15.0);  // blown away
  EXPECT_NEAR(height(1), 0.9, 0.3);                               // the raft floats
  EXPECT_GT(height(2), -0.25);                                    // so does the buoy
  EXPECT_GT(height(4), 2.0);                                      // hangs on its spring
  EXPECT_GT(to_double(world.center_of_mass(bodies[5]).z), 2.0);   // flown away
  EXPECT_GT(to_double(world.center_of_mass(bodies[10]).x), 1.5);  // walked
}

TYPED_TEST(SelfcheckScenes, PatchworkPullsEveryLinkAndTouchesEverything) {
  using S = TypeParam;
  ParticleGame<S> game(*find_particle_scene("patchwork"));
  const std::size_t links = game.world.counts().links;
  std::set<std::size_t> pulled;
  bool plane = false, line = false, pair = false;
  for (int i = 0; i < 120; ++i) {
    game.advance();
    ASSERT_EQ(game.world.fault(), Fault::none) << i;
    const ParticleState<S>& state = game.world.state();
    for (std::size_t slot = 0; slot < state.link_impulses.size(); ++slot) {
      if (state.link_impulses[slot] != Velocity<S>(0)) pulled.insert(slot);
    }
    for (const auto& begin : game.world.events().contact_begin) {
      pair = pair || bool(begin.b);
      const Collider<S>* const collider = game.world.find(begin.collider);
      plane = plane || (collider != nullptr && collider->type == ColliderType::plane);
      line = line || (collider != nullptr && collider->type == ColliderType::line);
    }
  }
  EXPECT_EQ(links, 5u);
  EXPECT_EQ(pulled.size(), links);
  EXPECT_TRUE(pair && plane && line);
  EXPECT_GT(game.world.counts().springs, 20u);
}

}  // namespace selfcheck_scenes_test
}  // namespace isostep::scenes
