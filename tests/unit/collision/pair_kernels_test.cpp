// Pairs side by side: every lane of every instruction set has the bits that collide() gives the pair alone.
// SPDX-License-Identifier: MIT
#include "isostep/collision/narrowphase/pair_kernels.hpp"

#include <gtest/gtest.h>

#include <cstring>
#include <vector>

#include "narrowphase/cases.hpp"
#include "unit/collision/kernel_cases.hpp"

namespace isostep::test {
namespace pair_kernels_test {

template <class S> class PairKernelsTest : public testing::Test {};
using Scalars = testing::Types<float, double, Q16_16, Q32_32>;
TYPED_TEST_SUITE(PairKernelsTest, Scalars);

/// Bodies of one part each: 2 i and 2 i + 1 are a pair.
template <class S> struct Bodies {
  std::vector<Child<S>> children;
  std::vector<BodyFrame<S>> frames;
  std::vector<PartPair> pairs;
  std::vector<std::uint32_t> order;

  explicit Bodies(std::size_t count) {  // pairs point at children, so there is room for all of them
    children.reserve(2 * count);
  }
  void body(const Primitive<S>& part, Vec3<S> centre, const Transform<S>& origin) {
    children.push_back({part, Pose<S>::identity()});
    BodyFrame<S> frame = {};
    frame.centre = centre;
    frame.half = part.half;
    frame.radius = part.radius;
    frame.origin = origin;
    frame.children = &children.back();
    frame.child_count = 1;
    frame.plain = true;
    frames.push_back(frame);
  }
  void pair(const Primitive<S>& a, const Transform<S>& ta, const Primitive<S>& b, const Transform<S>& tb) {
    const auto first = static_cast<std::uint32_t>(frames.size());
    for (const auto& [part, t] : {std::pair{a, ta}, std::pair{b, tb}}) {
      body(part, t.position, {Vec3<S>::zero(), t.rotation});
    }
    order.push_back(static_cast<std::uint32_t>(pairs.size()));
    pairs.push_back({first, first + 1, 0, 0});
  }
  PairRun<S> run(std::uint32_t begin, std::uint32_t end, double margin, std::vector<std::uint8_t>& counts,
                 std::vector<Manifold<S>>& manifolds) const {
    return {frames.data(), pairs.data(),           order.data(),  begin,
            end,           from_double<S>(margin), counts.data(), manifolds.data()};
  }
};

struct Tally {
  int touching = 0, edges = 0, many = 0;
};
/// Runs every instruction set over [begin, end) and compares with collide() alone; what lies outside stays untouched.
template <class S> Tally expect_same(const Bodies<S>& bodies, bool spheres, std::uint32_t begin, std::uint32_t end) {
  constexpr double kMargin = 0.02;
  Tally tally;
  for (const Simd simd : kSets) {
    std::vector<Manifold<S>> manifolds(bodies.pairs.size());
    std::vector<std::uint8_t> counts(bodies.pairs.size(), 77);
    const PairKernels<S>& kernels = *pair_kernels<S>(simd);
    (spheres ? kernels.spheres : kernels.boxes)(bodies.run(begin, end, kMargin, counts, manifolds));
    for (std::uint32_t i = 0; i < bodies.order.size(); ++i) {
      const std::uint32_t at = bodies.order[i];
      if (i < begin || i >= end) {
        EXPECT_EQ(counts[at], 77) << "pair " << at;
        continue;
      }
      const BodyFrame<S>&a = bodies.frames[bodies.pairs[at].frame_a], &b = bodies.frames[bodies.pairs[at].frame_b];
      Manifold<S> alone;
      collide(a.children->primitive, a.origin, b.children->primitive, origin_beside(a, b), from_double<S>(kMargin),
              alone);
      EXPECT_EQ(counts[at], alone.count) << "set " << static_cast<int>(simd) << " pair " << at;
      EXPECT_TRUE(alone.count == 0 || same_bits(alone, manifolds[at]))
          << "set " << static_cast<int>(simd) << " pair " << at;
      if (simd != Simd::best) continue;
      tally.touching += alone.count > 0;
      tally.edges += alone.count == 1 && (alone.points[0].feature >> 31) == 0;
      tally.many += alone.count == 4;
    }
  }
  return tally;
}
template <class S> Tally expect_same(const Bodies<S>& bodies, bool spheres) {
  return expect_same(bodies, spheres, 0, static_cast<std::uint32_t>(bodies.order.size()));
}

TYPED_TEST(PairKernelsTest, boxes_anyhow) {
  using S = TypeParam;
  Random random(1);
  Bodies<S> bodies(4000);
  const auto size = [&] { return random.in(0.05, 1); };
  for (int i = 0; i < 4000; ++i) {
    const double x = size(), y = size(), z = size(), u = size(), v = size(), w = size();
    const Transform<S> ta = random_pose<S>(random, 0.8), tb = random_pose<S>(random, 0.8);
    bodies.pair(box_of<S>(x, y, z), ta, box_of<S>(u, v, w), tb);
  }
  const Tally tally = expect_same(bodies, false);
  EXPECT_GT(tally.touching, 1500);
  EXPECT_GT(tally.edges, 200);
  EXPECT_GT(tally.many, 300);
}

TYPED_TEST(PairKernelsTest, boxes_stacked_with_edges_parallel_or_nearly_so) {
  using S = TypeParam;
  Random random(2);
  Bodies<S> bodies(6000);
  for (int i = 0; i < 6000; ++i) {
    // On a grid of quarters: sides in one plane, corners on sides, faces that touch exactly.
    const double tilt = i % 3 == 0 ? 0 : random.power_of_ten(-8, -1);
    const auto grid = [&](int n) { return 0.25 * random.below(n); };
    const double x = 0.25 + grid(3), y = 0.25 + grid(3), z = 0.25 + grid(3);
    const Point axis = random.direction();
    const double quarter = random.below(2) == 0 ? 0 : 1.5707963267948966;
    const Point upright = {random.below(2) == 0 ? 1.0 : 0.0, 0, 1};
    const Transform<S> ta = at<S>({grid(5), grid(5), grid(5)}, axis, tilt);
    const Transform<S> tb = at<S>({grid(5), grid(5), grid(5)}, quarter == 0 ? axis : upright, tilt + quarter);
    const double w = 0.25 + grid(2), u = 0.25 + grid(3);
    bodies.pair(box_of<S>(x, y, z), ta, box_of<S>(u, 0.5, w), tb);
  }
  const Tally tally = expect_same(bodies, false);
  EXPECT_GT(tally.touching, 3000);
  EXPECT_GT(tally.many, 1000);
}

TYPED_TEST(PairKernelsTest, boxes_of_no_size_in_one_place_or_rounded) {
  using S = TypeParam;
  Random random(3);
  Bodies<S> bodies(3000);
  const auto size = [&] { return random.below(3) == 0 ? 0.0 : random.in(0, 1); };
  for (int i = 0; i < 3000; ++i) {
    const double z = size(), y = size(), x = size(), w = size(), v = size(), u = size();
    Primitive<S> a = box_of<S>(x, y, z), b = box_of<S>(u, v, w);
    a.radius = from_double<S>(0.125 * random.below(3));
    b.radius = from_double<S>(0.125 * random.below(3));
    const Transform<S> ta = random_pose<S>(random, 0.5);
    Transform<S> tb = i % 2 == 0 ? ta : random_pose<S>(random, 0.5);
    if (i % 4 == 0) tb.rotation = random_pose<S>(random, 0).rotation;
    bodies.pair(a, ta, b, tb);
  }
  EXPECT_GT(expect_same(bodies, false).touching, 1500);
}

TYPED_TEST(PairKernelsTest, boxes_far_from_the_origin_and_off_their_centre_of_mass) {
  using S = TypeParam;
  Random random(4);
  Bodies<S> bodies(1000);
  for (int i = 0; i < 1000; ++i) {
    const Point far = {300, -250, 400};
    for (int k = 0; k < 2; ++k) {
      const Transform<S> t = random_pose<S>(random, 0.6);
      bodies.body(box_of<S>(0.5, 0.25, 0.75), vec_of<S>(point_of(t.position) + far),
                  {vec_of<S>(random.point(0.3)), t.rotation});
    }
    bodies.order.push_back(static_cast<std::uint32_t>(i));
    bodies.pairs.push_back({2u * unsigned(i), 2u * unsigned(i) + 1, 0, 0});
  }
  EXPECT_GT(expect_same(bodies, false).touching, 300);
}

TYPED_TEST(PairKernelsTest, spheres_apart_touching_deep_and_with_coincident_centres) {
  using S = TypeParam;
  Random random(5);
  Bodies<S> bodies(4000);
  for (int i = 0; i < 4000; ++i) {
    const double r = random.in(0, 0.5), q = random.in(0, 0.5);
    const Transform<S> ta = random_pose<S>(random, 0.5);
    Transform<S> tb = random_pose<S>(random, 0.5);
    if (i % 5 == 0) tb.position = ta.position;
    if (i % 5 == 1) tb.position = ta.position + Vec3<S>{from_double<S>(r + q + 0.02), S(0), S(0)};  // at the margin
    if (i % 5 == 2) tb.position = ta.position + Vec3<S>{S(0), resolution<S>(), S(0)};
    bodies.pair(sphere_of<S>(r), ta, sphere_of<S>(q), tb);
  }
  EXPECT_GT(expect_same(bodies, true).touching, 2000);
}

TYPED_TEST(PairKernelsTest, runs_of_every_length_and_nothing_beyond_them) {
  using S = TypeParam;
  Random random(6);
  Bodies<S> boxes(40), spheres(40);
  for (int i = 0; i < 40; ++i) {
    const Transform<S> ta = random_pose<S>(random, 0.4), tb = random_pose<S>(random, 0.4);
    boxes.pair(box_of<S>(0.5, 0.5, 0.5), ta, box_of<S>(0.5, 0.5, 0.5), tb);
    spheres.pair(sphere_of<S>(0.5), ta, sphere_of<S>(0.5), tb);
  }
  for (std::uint32_t i = 0; i < 20; ++i) {  // any order
    std::swap(boxes.order[i], boxes.order[39 - 2 * i + i % 2]);
    std::swap(spheres.order[i], spheres.order[(7 * i) % 40]);
  }
  for (std::uint32_t length = 0; length <= 34; ++length) {
    for (const std::uint32_t begin : {0u, 3u}) {
      expect_same(boxes, false, begin, begin + length);
      expect_same(spheres, true, begin, begin + length);
    }
  }
}

}  // namespace pair_kernels_test
}  // namespace isostep::test
