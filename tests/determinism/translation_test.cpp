// Far from the origin fixed point loses nothing: a scene moved as a whole moves bit for bit the same.
// SPDX-License-Identifier: MIT

#include "determinism/mess.hpp"

namespace isostep::test {
namespace translation_test {

template <class S> class FarFromTheOrigin : public ::testing::Test {};
TYPED_TEST_SUITE(FarFromTheOrigin, FixedScalars);

TYPED_TEST(FarFromTheOrigin, a_scene_does_to_the_bit_what_it_does_at_the_origin) {
  using S = TypeParam;
  const D3 away = std::is_same_v<S, Q16_16> ? D3{100, -50, 75} : D3{10000, -5000, 7500};
  World<S> here(settings<S>(-10, 60, 4)), there(settings<S>(-10, 60, 4));
  build_mess(here);
  build_mess(there, away);
  const Vec3<S> offset = vec<S>(away);
  const std::vector<BodyId> bodies = here.bodies();
  ASSERT_EQ(bodies, there.bodies());
  Activity activity;
  for (int frame = 0; frame < 400; ++frame) {
    if (frame % 50 == 20) {
      for (std::size_t i = 3; i < bodies.size(); i += 5) {
        const Vec3<S> push = vec<S>(0.25, 1.5, -0.5);
        here.apply_impulse_at(bodies[i], push, here.center_of_mass(bodies[i]) + vec<S>(0.125, 0, 0.25));
        there.apply_impulse_at(bodies[i], push, there.center_of_mass(bodies[i]) + vec<S>(0.125, 0, 0.25));
      }
    }
    here.step();
    there.step();
    activity.watch(here);
    for (const BodyId id : bodies) {
      ASSERT_EQ(there.center_of_mass(id) - offset, here.center_of_mass(id)) << "body " << id.slot << " frame " << frame;
      ASSERT_EQ(there.pose(id).orientation, here.pose(id).orientation) << "body " << id.slot << " frame " << frame;
      ASSERT_EQ(there.velocity(id), here.velocity(id));
      ASSERT_EQ(there.is_awake(id), here.is_awake(id));
    }
    ASSERT_EQ(there.events().contact_begin.size(), here.events().contact_begin.size());
  }
  EXPECT_GT(activity.contacts, 30u);
  EXPECT_GT(activity.sleepers, 4u);
  EXPECT_GT(activity.begins, 40u);
}

}  // namespace translation_test
}  // namespace isostep::test
