// The narrow phase far from comfort: aligned, touching, huge, tiny and degenerate shapes, with traps on overflow.
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "isostep/collision/narrowphase/box_tolerance.hpp"
#include "isostep/collision/narrowphase/polyhedra.inl"  // a default argument of collide
#include "unit/collision/narrowphase/hostile_shapes.hpp"
#include "unit/collision/narrowphase/trapping.hpp"

namespace isostep::test {
namespace narrowphase_fuzz_test {

constexpr int kPairs = 100000;

template <class S> class NarrowPhaseFuzz : public testing::Test {};
using Scalars = testing::Types<float, double, TrapQ16, TrapQ32>;
TYPED_TEST_SUITE(NarrowPhaseFuzz, Scalars);

template <class S> double documented_extent() {
  return std::is_same_v<S, TrapQ32> || std::is_same_v<S, double> ? 1000 : 100;
}

template <class S> struct Pair {
  Primitive<S> a, b;
  Transform<S> ta, tb;
};
template <class S> Primitive<S> any_primitive(Random& random, int type, double largest) {
  const double x = any_size(random, largest), y = any_size(random, largest), z = any_size(random, largest);
  if (type == 0) return sphere_of<S>(x);
  if (type == 1) return box_of<S>(x, y, z);
  if (type == 2) return capsule_of<S>(x, y);
  const Point normal = random.direction();
  return half_space_of<S>(normal, random.in(-largest, largest));
}
/// [m] The length that rounding is relative to.
double scale(const Solid& a, const Solid& b) {
  const double planes = (a.type == ShapeType::half_space ? std::abs(a.offset) : 0) +
                        (b.type == ShapeType::half_space ? std::abs(b.offset) : 0);
  return length3(a.half) + length3(b.half) + a.radius + b.radius + length3(b.centre - a.centre) + planes;
}
/// The reach of a shape along a direction from its centre.
double support(const Solid& s, Point n) {
  double reach = s.radius;
  for (std::size_t k = 0; k < 3; ++k) reach += s.half[k] * std::abs(dot3(s.axes[k], n));
  return reach;
}
/// The pair touches along one axis to within a centimetre, often exactly; or lies anywhere.
template <class S> Pair<S> any_pair(Random& random, double largest) {
  const int type_a = random.below(4), type_b = type_a == 3 ? random.below(3) : random.below(4);
  Pair<S> pair;
  pair.a = any_primitive<S>(random, type_a, largest);
  pair.b = any_primitive<S>(random, type_b, largest);
  pair.ta = any_pose<S>(random, {0, 0, 0});
  pair.tb = any_pose<S>(random, {0, 0, 0});
  const Solid a = solid(pair.a, pair.ta), b = solid(pair.b, pair.tb);
  const auto k = static_cast<std::size_t>(random.below(3));
  const Point n = random.below(4) == 0 ? random.direction() : a.axes[k] * (random.below(2) ? 1.0 : -1.0);
  const double gaps[4] = {0, random.in(-0.02, 0.02), 0.01, -random.power_of_ten(-5, 1)};
  Point p = n * (support(a, n) + support(b, n) + gaps[random.below(4)]);
  for (std::size_t j = 0; j < 3; ++j) {  // sideways, by up to what both reach
    const double reach = support(a, a.axes[j]) + support(b, a.axes[j]);
    if (random.below(3) != 0) p = p + (a.axes[j] - n * dot3(n, a.axes[j])) * random.in(-reach, reach);
  }
  for (double& c : p) c = std::clamp(c, -largest, largest);
  pair.tb.position = vec_of<S>(p);
  return pair;
}

TYPED_TEST(NarrowPhaseFuzz, AnyPairWithinTheDocumentedRangeGivesAFiniteManifoldWithoutATrap) {
  using S = TypeParam;
  Random random(20);
  int touching = 0;
  for (int n = 0; n < kPairs; ++n) {
    const Pair<S> p = any_pair<S>(random, documented_extent<S>());
    const auto m = touch(p.a, p.ta, p.b, p.tb, random.below(4) == 0 ? 0 : 0.02);
    ASSERT_GE(m.count, 0);
    ASSERT_LE(m.count, kMaxContactPoints);
    touching += m.count > 0 ? 1 : 0;
    if (m.count == 0) continue;
    ASSERT_NEAR(length3(point_of(m.normal)), 1, 1e-6) << "pair " << n;
    for (int i = 0; i < m.count; ++i) {
      ASSERT_TRUE(is_finite(m.points[i].position) && is_finite(m.points[i].separation)) << "pair " << n;
      for (int j = 0; j < i; ++j) ASSERT_NE(m.points[i].feature, m.points[j].feature) << "pair " << n;
    }
  }
  EXPECT_GT(touching, kPairs / 4);
}

/// The depth is the independent one up to: the preference of axes, rounding of the extents, and the angle below which
/// two edges count as parallel, over their length.
TYPED_TEST(NarrowPhaseFuzz, DepthIsTheIndependentOneForAlignedTouchingHugeAndTinyShapes) {
  using S = TypeParam;
  Random random(21);
  int compared = 0;
  for (int n = 0; n < kPairs; ++n) {
    const Pair<S> p = any_pair<S>(random, 50);
    const Solid a = solid(p.a, p.ta), b = solid(p.b, p.tb);
    const auto m = touch(p.a, p.ta, p.b, p.tb, 0.02);
    const double truth = true_separation(a, b);
    const double length = scale(a, b);
    const double parallel = std::sqrt(to_double(detail::near_parallel<S>()));
    const auto smallest = [](const Solid& s) { return std::min({s.half[0], s.half[1], s.half[2]}); };
    const bool boxes = a.type == ShapeType::box && b.type == ShapeType::box;
    const double small = boxes ? std::min(smallest(a), smallest(b)) : std::max(smallest(a), smallest(b));
    // 1e-7: what true_separation takes for touching cores. Of boxes faces may tell the depth of the best edges.
    const double face = boxes ? detail::edge_slack(small) : 0;
    const double slack =
        1e-7 + face + small / 64 + (a.radius + b.radius + 0.02) / 512 + 16 * rounding<S>(length) + parallel * length;
    if (m.count == 0) {
      EXPECT_GT(truth, (boxes ? 0 : 0.02) - slack) << "pair " << n << " types " << int(a.type) << int(b.type);
      continue;
    }
    ++compared;
    // Apart, separating axes bound the distance from below only.
    if (boxes && truth > 0 && deepest(m) > truth) continue;
    EXPECT_NEAR(deepest(m), truth, slack)
        << "pair " << n << " types " << int(a.type) << int(b.type) << " count " << m.count;
  }
  EXPECT_GT(compared, kPairs / 4);
}

TYPED_TEST(NarrowPhaseFuzz, PointsOfDegenerateShapesLieWithinReachOfBoth) {
  using S = TypeParam;
  Random random(22);
  for (int n = 0; n < kPairs; ++n) {
    const Pair<S> p = any_pair<S>(random, 50);
    const Solid a = solid(p.a, p.ta), b = solid(p.b, p.tb);
    const auto m = touch(p.a, p.ta, p.b, p.tb, 0.02);
    const double length = scale(a, b);
    for (int i = 0; i < m.count; ++i) {
      const Point q = point_of(m.points[i].position);
      const double parallel = std::sqrt(to_double(detail::near_parallel<S>()));
      const double allowed = 0.02 + std::abs(to_double(m.points[i].separation)) / 2 + (a.radius + b.radius) / 16 +
                             std::max(length3(a.half), length3(b.half)) / 64 + 32 * rounding<S>(length) +
                             parallel * length;
      EXPECT_LE(a.outside(q), allowed) << "pair " << n << " types " << int(a.type) << int(b.type);
      EXPECT_LE(b.outside(q), allowed) << "pair " << n << " types " << int(a.type) << int(b.type);
    }
  }
}

}  // namespace narrowphase_fuzz_test
}  // namespace isostep::test
