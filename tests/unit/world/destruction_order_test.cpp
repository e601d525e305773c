// Many bodies, joints and records that go at once: the world is the one that they leave one after the other.
// SPDX-License-Identifier: MIT
#include "isostep/core/random.hpp"
#include "isostep/world/joint_presets.hpp"
#include "unit/world/worlds.hpp"

namespace isostep::test {
namespace destruction_order_test {

/// Hubs with bodies around them on joints, which motors drive and loads measure; springs from body to body.
template <class S> class DestructionOrder : public ::testing::Test {
 protected:
  struct Made {
    World<S> w{settings<S>(0)};
    std::vector<BodyId> bodies, hubs;
    std::vector<JointId> joints;
  };
  static void build(Made& made, std::uint64_t seed) {
    Pcg32 random = Pcg32::seeded(seed);
    const ShapeId ball = add_ball(made.w, 0.25);
    for (int i = 0; i < 40; ++i) {
      BodyDefinition<S> d = moving<S>(ball, {1.0 * (i % 8), 1.0 * (i / 8), 0});
      if (i % 7 == 3) d.type = BodyType::static_;
      d.collide = false;
      made.bodies.push_back(made.w.create(d));
      if (i % 10 == 0) made.hubs.push_back(made.bodies.back());
    }
    const auto any = [&] { return made.bodies[static_cast<std::size_t>(random_between(random, 0, 39))]; };
    for (int i = 0; i < 90; ++i) {
      const BodyId a = made.hubs[static_cast<std::size_t>(random_between(random, 0, 3))], b = any();
      if (a == b) continue;
      const JointId joint = made.w.create(made.w.joint_at(JointType::ball, a, b, Pose<S>::identity()));
      made.joints.push_back(joint);
      JointLoad<S> load;
      load.joint = joint;
      if (i % 3 == 0) made.w.add(load);
      BodySpring<S> spring;
      spring.a = a;
      spring.b = any();
      spring.stiffness = S(1);
      if (i % 4 == 0 && spring.a != spring.b) made.w.add(spring);
    }
  }
  /// Destroys a body's joints and then the body, one after the other.
  static void destroy_by_hand(Made& made, BodyId body) {
    std::vector<JointId> own;
    for (const JointId joint : made.joints) {
      const JointProperties<S>* const p = made.w.joint(joint);
      if (p != nullptr && (p->body_a == body.slot || p->body_b == body.slot)) own.push_back(joint);
    }
    std::sort(own.begin(), own.end(), [](JointId a, JointId b) { return a.slot < b.slot; });
    for (const JointId joint : own) EXPECT_TRUE(made.w.destroy(joint));
    EXPECT_TRUE(made.w.destroy(body));
  }
  /// The next ids are the same too.
  static void expect_equal(Made& a, Made& b) {
    ASSERT_EQ(a.w.hash(), b.w.hash());
    for (Made* const made : {&a, &b}) {
      const BodyId first = made->w.create(moving<S>(add_ball(made->w, 0.5), {0, 9, 0}));
      const BodyId second = made->w.create(moving<S>(add_ball(made->w, 0.5), {2, 9, 0}));
      for (int i = 0; i < 5; ++i) made->w.create(made->w.joint_at(JointType::ball, first, second, Pose<S>::identity()));
      run(made->w, 3);
    }
    EXPECT_EQ(a.w.hash(), b.w.hash());
  }
};
TYPED_TEST_SUITE(DestructionOrder, AllScalars);

TYPED_TEST(DestructionOrder, a_body_goes_as_its_joints_by_slot_and_then_itself) {
  using S = TypeParam;
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    typename TestFixture::Made at_once, by_hand;
    this->build(at_once, seed);
    this->build(by_hand, seed);
    ASSERT_EQ(at_once.w.hash(), by_hand.w.hash());
    for (int h = 3; h >= 0; --h) {
      const BodyId hub = at_once.hubs[static_cast<std::size_t>(h)];
      EXPECT_TRUE(at_once.w.destroy(hub));
      this->destroy_by_hand(by_hand, hub);
      ASSERT_EQ(at_once.w.hash(), by_hand.w.hash()) << seed << ' ' << h;
      if (h == 2) run<S>(at_once.w, 2), run<S>(by_hand.w, 2);
    }
    this->expect_equal(at_once, by_hand);
  }
}

TYPED_TEST(DestructionOrder, many_bodies_go_as_one_after_the_other) {
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    typename TestFixture::Made together, alone;
    this->build(together, seed);
    this->build(alone, seed);
    const std::vector<BodyId> gone = {together.hubs[2], together.bodies[7],  together.hubs[0],   together.bodies[3],
                                      together.hubs[1], together.bodies[17], together.bodies[38]};
    EXPECT_EQ(together.w.destroy(gone), gone.size());
    for (const BodyId body : gone) EXPECT_TRUE(alone.w.destroy(body));
    this->expect_equal(together, alone);
  }
}

}  // namespace destruction_order_test
}  // namespace isostep::test
