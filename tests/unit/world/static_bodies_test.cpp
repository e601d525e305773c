// Static bodies and shapes in pages: what a command copies once a snapshot shares them, and that pages do not show.
// SPDX-License-Identifier: MIT
#include "isostep/core/random.hpp"
#include "unit/world/worlds.hpp"

namespace isostep::test {
namespace static_bodies_test {

template <class S> class StaticPages : public ::testing::Test {
 protected:
  /// `count` boxes in rows.
  void fill(int count) {
    box_ = add_box(world, 0.5, 0.5, 0.5);
    for (int i = 0; i < count; ++i) ids.push_back(world.create(still<S>(box_, {1.0 * (i % 20), 0, 1.0 * (i / 20)})));
    world.step();
  }
  static int pages_that_differ(const WorldState<S>& a, const WorldState<S>& b) {
    int differ = 0;
    for (std::size_t p = 0; p < std::max(a.static_bodies.pages(), b.static_bodies.pages()); ++p)
      differ += a.static_bodies.shares_page(p, b.static_bodies) ? 0 : 1;
    return differ;
  }
  static int pages_of_shapes_that_differ(const WorldState<S>& a, const WorldState<S>& b) {
    int differ = 0;
    for (std::size_t p = 0; p < std::max(a.shapes.pages(), b.shapes.pages()); ++p)
      differ += a.shapes.shares_page(p, b.shapes) ? 0 : 1;
    return differ;
  }

  World<S> world{settings<S>()};
  ShapeId box_ = {};
  std::vector<BodyId> ids;
};
TYPED_TEST_SUITE(StaticPages, AllScalars);

TYPED_TEST(StaticPages, a_body_that_comes_goes_or_is_put_elsewhere_copies_its_page_alone) {
  using S = TypeParam;
  this->fill(1000);
  World<S>& w = this->world;
  const auto copies = [&](const auto& change) {
    const WorldState<S> before = w.state();
    change();
    w.step();
    w.hash();
    return this->pages_that_differ(before, w.state());
  };
  EXPECT_EQ(copies([&] { w.create(still<S>(this->box_, {0, 0, -5})); }), 1);
  EXPECT_EQ(copies([&] { w.destroy(this->ids[5]); }), 1);
  EXPECT_EQ(copies([&] { w.create(still<S>(this->box_, {0, 0, -7})); }), 1);  // in the slot of the one that went
  EXPECT_EQ(copies([&] { w.set_pose(this->ids[500], {vec<S>(0, 3, 0), Quat<Unit<S>>::identity()}); }), 1);
  EXPECT_EQ(copies([&] { w.set_user_data(this->ids[700], 7); }), 1);
  EXPECT_EQ(copies([&] { w.create(moving<S>(this->box_, {0, 9, 0})); }), 0);
}

TYPED_TEST(StaticPages, a_shape_that_comes_or_goes_copies_its_page_alone) {
  using S = TypeParam;
  World<S>& w = this->world;
  std::vector<ShapeId> shapes;
  for (int i = 0; i < 1000; ++i) shapes.push_back(add_ball(w, 0.25 + 0.001 * i));
  for (const int i : {0, 400, 999}) {
    WorldState<S> before = w.state();
    ASSERT_TRUE(w.remove_shape(shapes[static_cast<std::size_t>(i)]));
    EXPECT_EQ(this->pages_of_shapes_that_differ(before, w.state()), 1);
    before = w.state();
    EXPECT_TRUE(add_ball(w, 0.5));
    EXPECT_EQ(this->pages_of_shapes_that_differ(before, w.state()), 1);
  }
}

TYPED_TEST(StaticPages, a_shape_goes_once_no_body_has_it_whatever_the_bodies_went_through) {
  using S = TypeParam;
  World<S>& w = this->world;
  const ShapeId ball = add_ball(w, 0.5), other = add_ball(w, 0.25);
  const auto in_use = [&](ShapeId shape) {
    const bool refused = !w.remove_shape(shape);
    return refused && w.fault() == Fault::shape_in_use;
  };
  const BodyId a = w.create(moving<S>(ball, {0, 0, 0})), b = w.create(still<S>(ball, {5, 0, 0}));
  typename World<S>::Snapshot both;
  w.save(both);
  EXPECT_TRUE(in_use(ball));
  ASSERT_TRUE(w.set_type(a, BodyType::static_));
  ASSERT_TRUE(w.set_enabled(b, false));
  w.destroy(a);
  EXPECT_TRUE(in_use(ball));
  w.destroy(b);
  typename World<S>::Snapshot none;
  w.save(none);
  EXPECT_TRUE(w.load(both));
  EXPECT_TRUE(in_use(ball));
  std::vector<std::uint8_t> bytes = bytes_of(w);
  EXPECT_TRUE(w.load(none));
  EXPECT_TRUE(w.remove_shape(ball));
  EXPECT_TRUE(w.remove_shape(other));
  Reader reader(bytes);
  ASSERT_TRUE(w.read_portable(reader).ok());
  EXPECT_TRUE(in_use(ball));
  EXPECT_EQ(w.destroy(std::vector<BodyId>{a, b}), 2u);
  EXPECT_TRUE(w.remove_shape(ball));
}

/// Bodies that come and go at random, beside a world that is read from the portable form of the first.
TYPED_TEST(StaticPages, a_world_that_is_read_or_loaded_has_the_hash_of_the_one_that_grew) {
  using S = TypeParam;
  this->fill(300);
  World<S>& w = this->world;
  Pcg32 random = Pcg32::seeded(3);
  World<S> loaded(settings<S>());
  typename World<S>::Snapshot snapshot;
  for (int round = 0; round < 20; ++round) {
    for (int i = 0; i < 15; ++i) {
      BodyId& body = this->ids[static_cast<std::size_t>(random_between(random, 0, 299))];
      if (w.contains(body)) {
        w.destroy(body);
      } else {
        const D3 at = {1.0 * random_between(random, 0, 20), 1.0 * round, -3};
        body = w.create(i % 5 == 0 ? moving<S>(this->box_, at) : still<S>(this->box_, at));
      }
    }
    w.step();
    const std::vector<std::uint8_t> bytes = bytes_of(w);
    World<S> read(settings<S>());
    Reader reader(bytes);
    ASSERT_TRUE(read.read_portable(reader).ok()) << round;
    ASSERT_EQ(read.hash(), w.hash()) << round;
    w.save(snapshot);
    ASSERT_TRUE(loaded.load(snapshot));
    loaded.step();
    read.step();
    ASSERT_EQ(loaded.hash(), read.hash()) << round;
  }
}

}  // namespace static_bodies_test
}  // namespace isostep::test
