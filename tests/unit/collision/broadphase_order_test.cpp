// The tree of boxes when many come one by one, in the orders in which levels are made: what that costs.
// SPDX-License-Identifier: MIT
#include <bit>
#include <cmath>
#include <cstdlib>
#include <string>

#include "unit/collision/broadphase_model.hpp"

namespace isostep::test {
namespace broadphase_order_test {

template <class S> class BroadphaseOrder : public testing::Test {};
TYPED_TEST_SUITE(BroadphaseOrder, BroadphaseScalars);

enum class Order { rows, line, reverse, spiral, scattered, halving, one_place, both_ends, pyramid, walls, walk };
constexpr Order kOrders[] = {Order::rows,      Order::line,    Order::reverse,   Order::spiral,
                             Order::scattered, Order::halving, Order::one_place, Order::both_ends,
                             Order::pyramid,   Order::walls,   Order::walk};

/// [m] The place of the box of that number, in quarters.
struct Places {
  Order order;
  int count;
  Pcg32 random = Pcg32::seeded(5);
  int x = 0, y = 0, z = 0;

  template <class S> Vec3<S> at(int i) {
    const int side = static_cast<int>(std::sqrt(count)) + 1;
    switch (order) {
      case Order::rows: return quarter<S>(4 * (i % side), 0, 4 * (i / side));
      case Order::line: return quarter<S>(i, 0, 0);
      case Order::reverse: return quarter<S>(count - i, 0, 0);
      case Order::spiral: {
        const double turn = 0.1 * i, far = 4 * std::sqrt(i);
        return quarter<S>(static_cast<int>(far * isostep::cos(turn)), 0, static_cast<int>(far * isostep::sin(turn)));
      }
      case Order::scattered: return random_point<S>(random, 400);
      case Order::halving: return {S(64) * from_double<S>(std::ldexp(1.0, -(i % 12))), S(i / 12) * S(0.0625), S(0)};
      case Order::one_place: return quarter<S>(28, 28, 28);
      case Order::both_ends: return quarter<S>(i % 2 == 0 ? i : -i, 0, 0);
      case Order::pyramid: {
        const int row = static_cast<int>(std::sqrt(2.0 * i));
        return quarter<S>(4 * (i - row * (row + 1) / 2) - 2 * row, 4 * row, 0);
      }
      case Order::walls: return quarter<S>(i % 2 * 1000, i / 2, 0);
      case Order::walk:
        x += random_between(random, -1, 1);
        y += random_between(random, -1, 1);
        z += random_between(random, -1, 1);
        return quarter<S>(x, y, z);
    }
    return Vec3<S>::zero();
  }
  template <class S> static Vec3<S> quarter(int x, int y, int z) {
    return {S(x) * S(0.25), S(y) * S(0.25), S(z) * S(0.25)};
  }
};

/// An insertion visits the nodes above its leaf, so no more than the height; and no build takes the tree apart.
TYPED_TEST(BroadphaseOrder, no_order_makes_insertions_visit_more_than_a_few_times_the_least_height) {
  using S = TypeParam;
  const int count = 3000;
  for (const Order order : kOrders) {
    for (const bool ground : {false, true}) {  // below all of them
      Places places{order, count};
      AabbTree<S> tree;
      const S wide = S(400);
      if (ground) tree.insert(count, {{-wide, S(-2), -wide}, {wide, S(0), wide}});
      std::uint64_t visited = 0, least = 0;
      for (int i = 0; i < count; ++i) {
        const Vec3<S> at = places.at<S>(i);
        tree.insert(static_cast<std::uint32_t>(i), {at, at + Vec3<S>{S(1), S(1), S(1)}});
        visited += tree.height();
        least += static_cast<std::uint64_t>(std::bit_width(tree.size()));
      }
      const std::string what = "order " + std::to_string(static_cast<int>(order));
      EXPECT_LE(visited, 2 * least) << what;
      EXPECT_EQ(tree.built(), 0u) << what;
      ASSERT_TRUE(tree.validate()) << what;
      tree.optimise();
      ASSERT_TRUE(tree.validate()) << what;
    }
  }
}

/// A level that grows while the game runs: some boxes, a search, some boxes. What a search builds anew is what came.
TYPED_TEST(BroadphaseOrder, boxes_that_come_between_searches_cost_what_they_are) {
  using S = TypeParam;
  const int count = 3000;
  for (const Order order : kOrders) {
    Places places{order, count};
    AabbTree<S> tree;
    std::uint64_t above = 0;
    for (int i = 0; i < count; ++i) {
      const Vec3<S> at = places.at<S>(i);
      tree.insert(static_cast<std::uint32_t>(i), {at, at + Vec3<S>{S(1), S(1), S(1)}});
      if (i % 10 != 9) continue;
      tree.optimise();
      above += 10 * tree.height();
    }
    ASSERT_TRUE(tree.validate());
    EXPECT_LE(tree.built(), 2 * above + count) << "order " << static_cast<int>(order);
  }
}

}  // namespace broadphase_order_test
}  // namespace isostep::test
