// Random pairs of primitives against independent answers in double, and the laws that every manifold keeps.
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "isostep/collision/narrowphase/box_tolerance.hpp"
#include "narrowphase/cases.hpp"

namespace isostep::test {
namespace narrowphase_laws_test {

constexpr double kMargin = 0.02;
constexpr int kPairs = 20000;

template <class S> class NarrowPhaseLaws : public testing::Test {};
using Scalars = testing::Types<float, double, Q16_16, Q32_32>;
TYPED_TEST_SUITE(NarrowPhaseLaws, Scalars);

template <class S> struct Pair {
  Primitive<S> a, b;
  Transform<S> ta, tb;
};
template <class S> Primitive<S> random_primitive(Random& random, int type) {
  if (type == 0) return sphere_of<S>(random.in(0.1, 1));
  if (type == 1) {
    const double x = random.in(0.1, 1), y = random.in(0.1, 1);
    return box_of<S>(x, y, random.in(0.1, 1));
  }
  if (type == 2) {
    const double radius = random.in(0.1, 0.5);
    return capsule_of<S>(radius, random.in(0.1, 1));
  }
  const Point normal = random.direction();
  return half_space_of<S>(normal, random.in(-0.3, 0.3));
}
/// Two shapes of about a metre, in contact more often than not.
template <class S> Pair<S> random_pair(Random& random) {
  const int type_a = random.below(4), type_b = type_a == 3 ? random.below(3) : random.below(4);
  Pair<S> pair;
  pair.a = random_primitive<S>(random, type_a);
  pair.b = random_primitive<S>(random, type_b);
  pair.ta = random_pose<S>(random, 0.1);
  pair.tb = random_pose<S>(random, 1);
  return pair;
}
bool is(const Solid& a, const Solid& b, ShapeType x, ShapeType y) {
  return (a.type == x && b.type == y) || (a.type == y && b.type == x);
}
/// [m] The depth that the preference of faces over edges, and of face normals over a capsule's, may cost; see
/// axis_tolerance (1/128 of the smallest half extent, once for b's faces and once for edges) and collide_box_capsule
/// (1/512 of the radii).
double preference(const Solid& a, const Solid& b) {
  const auto smallest = [](const Solid& s) { return std::min({s.half[0], s.half[1], s.half[2]}); };
  const double small = std::min(smallest(a), smallest(b));
  if (is(a, b, ShapeType::box, ShapeType::box)) return small / 64 + detail::edge_slack(small);
  if (is(a, b, ShapeType::box, ShapeType::capsule))
    return std::max(smallest(a), smallest(b)) / 128 + (a.radius + b.radius) / 512;
  if (is(a, b, ShapeType::capsule, ShapeType::capsule)) return (a.radius + b.radius) / 512;
  return 0;
}

TYPED_TEST(NarrowPhaseLaws, DeepestSeparationIsTheIndependentOne) {
  using S = TypeParam;
  Random random(1);
  int touching = 0, apart = 0;
  for (int n = 0; n < kPairs; ++n) {
    const Pair<S> p = random_pair<S>(random);
    const Solid a = solid(p.a, p.ta), b = solid(p.b, p.tb);
    const double truth = true_separation(a, b), slack = preference(a, b) + 8 * rounding<S>(2);
    const auto m = touch(p.a, p.ta, p.b, p.tb, kMargin);
    if (m.count == 0) {
      ++apart;
      // Separated boxes whose corners miss each other's faces may lie closer than the margin without a point.
      EXPECT_GT(truth, (is(a, b, ShapeType::box, ShapeType::box) ? 0 : kMargin) - slack) << "pair " << n;
      continue;
    }
    ++touching;
    // Apart, the separating axes of boxes bound the distance from below only.
    if (is(a, b, ShapeType::box, ShapeType::box) && truth > 0 && deepest(m) > truth) continue;
    EXPECT_NEAR(deepest(m), truth, slack)
        << "pair " << n << " types " << int(a.type) << int(b.type) << " count " << m.count;
    EXPECT_LE(deepest(m), to_double(from_double<S>(kMargin)));
  }
  EXPECT_GT(touching, kPairs / 4);
  EXPECT_GT(apart, kPairs / 20);
}

TYPED_TEST(NarrowPhaseLaws, PointsLieWithinHalfTheirSeparationOfBothShapes) {
  using S = TypeParam;
  Random random(2);
  for (int n = 0; n < kPairs; ++n) {
    const Pair<S> p = random_pair<S>(random);
    const Solid a = solid(p.a, p.ta), b = solid(p.b, p.tb);
    const auto m = touch(p.a, p.ta, p.b, p.tb, kMargin);
    for (int i = 0; i < m.count; ++i) {
      const Point q = point_of(m.points[i].position);
      // Capsules may diverge sideways by a sixteenth of the radii where they count as lying along something.
      const bool lines = a.type == ShapeType::capsule || b.type == ShapeType::capsule;
      const double aside = lines ? (a.radius + b.radius) / 32 : 0;
      const double allowed =
          std::abs(to_double(m.points[i].separation)) / 2 + aside + preference(a, b) + 8 * rounding<S>(2);
      EXPECT_LE(a.outside(q), allowed) << "pair " << n << " types " << int(a.type) << int(b.type) << " count "
                                       << m.count;
      EXPECT_LE(b.outside(q), allowed) << "pair " << n << " types " << int(a.type) << int(b.type) << " count "
                                       << m.count;
    }
  }
}

/// Moving b by its depth along the normal parts the shapes: the normal and the separation belong together.
TYPED_TEST(NarrowPhaseLaws, MovingBAlongTheNormalByTheDepthPartsTheShapes) {
  using S = TypeParam;
  Random random(4);
  for (int n = 0; n < kPairs; ++n) {
    Pair<S> p = random_pair<S>(random);
    const auto m = touch(p.a, p.ta, p.b, p.tb, kMargin);
    if (m.count == 0) continue;
    Solid a = solid(p.a, p.ta), b = solid(p.b, p.tb);
    const Point move = point_of(m.normal) * -deepest(m);
    b.centre = b.centre + move;
    b.offset += dot3(b.normal, move);
    EXPECT_NEAR(true_separation(a, b), 0, 2 * preference(a, b) + 16 * rounding<S>(2))
        << "pair " << n << " types " << int(a.type) << int(b.type) << " count " << m.count;
  }
}

TYPED_TEST(NarrowPhaseLaws, SwappingTheShapesMirrorsTheManifold) {
  using S = TypeParam;
  Random random(5);
  int boxes = 0, same_reference = 0;
  for (int n = 0; n < kPairs; ++n) {
    const Pair<S> p = random_pair<S>(random);
    const auto m = touch(p.a, p.ta, p.b, p.tb, kMargin);
    const auto w = touch(p.b, p.tb, p.a, p.ta, kMargin);
    const Solid a = solid(p.a, p.ta), b = solid(p.b, p.tb);
    if (is(a, b, ShapeType::box, ShapeType::box)) {
      // Where both boxes offer a face as good, each order takes its own first: then the depths agree to the preference.
      ++boxes;
      if (length3(point_of(m.normal) + point_of(w.normal)) > 64 * rounding<S>(1)) {
        if (m.count > 0 && w.count > 0) {
          EXPECT_NEAR(deepest(m), deepest(w), 2 * preference(a, b) + 8 * rounding<S>(2));
        }
        continue;
      }
      ++same_reference;
    }
    ASSERT_EQ(m.count, w.count) << "pair " << n << " types " << int(a.type) << int(b.type);
    for (int i = 0; i < m.count; ++i) {
      double nearest = 1e300;
      for (int j = 0; j < w.count; ++j) {
        const double d = length3(point_of(m.points[i].position) - point_of(w.points[j].position));
        nearest = std::min(nearest, d + std::abs(to_double(m.points[i].separation - w.points[j].separation)));
      }
      EXPECT_LE(nearest, 256 * rounding<S>(2)) << "pair " << n << " types " << int(a.type) << int(b.type);
    }
    EXPECT_LE(length3(point_of(m.normal) + point_of(w.normal)), 1024 * rounding<S>(1)) << "pair " << n;
  }
  EXPECT_GT(same_reference, boxes * 9 / 10);
}

TYPED_TEST(NarrowPhaseLaws, TinyMotionKeepsTheFeatures) {
  using S = TypeParam;
  Random random(6);
  int kept = 0, total = 0;
  for (int n = 0; n < kPairs; ++n) {
    Pair<S> p = random_pair<S>(random);
    const auto m = touch(p.a, p.ta, p.b, p.tb, kMargin);
    p.tb.position += vec_of<S>(random.point(1e-4));
    const auto w = touch(p.a, p.ta, p.b, p.tb, kMargin);
    for (int i = 0; i < m.count; ++i) {
      ++total;
      for (int j = 0; j < w.count; ++j) kept += m.points[i].feature == w.points[j].feature ? 1 : 0;
    }
  }
  EXPECT_GT(kept, total * 0.995);  // the rest crosses from one feature to the next
}

}  // namespace narrowphase_laws_test
}  // namespace isostep::test
