// The commands about shapes: what an accepted one does, and that a refused one names its fault and changes nothing.
// SPDX-License-Identifier: MIT
#include "unit/world/commanded_world.hpp"

namespace isostep::test {
namespace shape_commands_test {

template <class S> class ShapeCommands : public CommandedWorld<S> {};
TYPED_TEST_SUITE(ShapeCommands, AllScalars);

TYPED_TEST(ShapeCommands, adding_a_shape_counts_one_more_and_removing_it_one_less) {
  using S = TypeParam;
  World<S>& w = this->world;
  const std::uint32_t before = w.counts().shapes;
  const ShapeId id = w.add_shape(Capsule<S>{num<S>(0.25), num<S>(0.5)});
  ASSERT_TRUE(id);
  EXPECT_TRUE(w.contains(id));
  EXPECT_EQ(w.counts().shapes, before + 1);
  EXPECT_TRUE(w.remove_shape(id));
  EXPECT_FALSE(w.contains(id));
  EXPECT_EQ(w.counts().shapes, before);
}

TYPED_TEST(ShapeCommands, bad_shapes_are_refused) {
  using S = TypeParam;
  World<S>& w = this->world;
  this->expect_refused(Fault::bad_shape, [&] { return w.add_shape(Sphere<S>{S(0)}); });
  this->expect_refused(Fault::bad_shape, [&] { return w.add_shape(Sphere<S>{S(-1)}); });
  this->expect_refused(Fault::bad_shape, [&] { return w.add_shape(Box<S>{vec<S>(1, 0, 1)}); });
  this->expect_refused(Fault::bad_shape, [&] { return w.add_shape(Box<S>{{S(1), S(1), Limits<S>::extent() + S(1)}}); });
  this->expect_refused(Fault::bad_shape, [&] { return w.add_shape(Capsule<S>{S(1), S(0)}); });
  this->expect_refused(Fault::bad_shape, [&] {
    return w.add_shape(HalfSpace<S>{{Unit<S>(0.5), Unit<S>(0.5), Unit<S>(0)}, S(0)});
  });
  this->expect_refused(Fault::bad_shape, [&] { return w.add_shape(std::span<const Child<S>>{}); });
  Child<S> far_off = {primitive_of(Sphere<S>{S(1)}), Pose<S>::identity()};
  far_off.pose.position.x = Limits<S>::extent();
  this->expect_refused(Fault::bad_shape, [&] { return w.add_shape(std::span<const Child<S>>(&far_off, 1)); });
  if constexpr (!kIsFixed<S>) {
    this->expect_refused(Fault::not_finite, [&] { return w.add_shape(Sphere<S>{not_a_number<S>()}); });
    this->expect_refused(Fault::not_finite, [&] { return w.add_shape(Box<S>{{S(1), endless<S>(), S(1)}}); });
    EXPECT_EQ(describe(w.fault()),
              "add_shape: child 0: primitive.half: a number is not finite; expected a finite number");
  }
}

TYPED_TEST(ShapeCommands, a_shape_that_a_body_names_stays_whether_the_body_moves_sleeps_or_stands) {
  World<TypeParam>& w = this->world;
  this->expect_refused(Fault::shape_in_use, [&] { return w.remove_shape(this->ball); });
  this->expect_refused(Fault::shape_in_use, [&] { return w.remove_shape(this->box); });
  EXPECT_TRUE(w.destroy(this->kinematic));
  EXPECT_TRUE(w.destroy(this->watcher));
  this->expect_refused(Fault::shape_in_use, [&] { return w.remove_shape(this->box); });
  EXPECT_TRUE(w.destroy(this->sleeper));
  EXPECT_TRUE(w.remove_shape(this->box));
  this->expect_refused(Fault::stale_id, [&] { return w.remove_shape(this->box); });
}

TYPED_TEST(ShapeCommands, removing_a_shape_leaves_the_others_their_parts) {
  using S = TypeParam;
  World<S> w(settings<S>(0));
  const ShapeId first = add_ball(w, 0.5), second = add_box(w, 0.25, 0.5, 1), third = add_ball(w, 2);
  EXPECT_TRUE(w.remove_shape(first));
  const ShapeId fourth = w.add_shape(Capsule<S>{S(1), S(2)});
  EXPECT_EQ(fourth.slot, first.slot);
  EXPECT_NE(fourth.generation, first.generation);
  EXPECT_TRUE(w.create(still<S>(second, {0, 0, 0})));
  EXPECT_TRUE(w.create(still<S>(third, {10, 0, 0})));
  EXPECT_TRUE(w.create(still<S>(fourth, {20, 0, 0})));
  const auto height = [&](double x) { return to_double(w.cast_ray(vec<S>(x, 8, 0), vec<S>(0, -16, 0))->point.y); };
  const double slack = 64 * grain<S>(16);
  EXPECT_NEAR(height(0), 0.5, slack);
  EXPECT_NEAR(height(10), 2, slack);
  EXPECT_NEAR(height(20), 3, slack);
}

}  // namespace shape_commands_test
}  // namespace isostep::test
