// The book's oracle O30, of collision: depths however they are found, and swapped shapes.
// SPDX-License-Identifier: MIT

#include <algorithm>

#include "isostep/collision/narrowphase/epa.hpp"
#include "laws/particle_laws.hpp"
#include "unit/collision/narrowphase/cases.hpp"

namespace isostep::test {
namespace book_collision_oracles_test {

template <class S> class BookCollisionOracles : public ::testing::Test {};
TYPED_TEST_SUITE(BookCollisionOracles, AllScalars);

/// The depth of two boxes along the best of the 15 axes, in double; negative where they are apart.
double depth_by_axes(Point half_a, const Transform<double>& a, Point half_b, const Transform<double>& b) {
  std::vector<D3> axes;
  for (int i = 0; i < 3; ++i) {
    axes.push_back(a.rotation.column(i)), axes.push_back(b.rotation.column(i));
    for (int j = 0; j < 3; ++j) {
      const D3 n = cross(a.rotation.column(i), b.rotation.column(j));
      if (length(n) > 1e-3) axes.push_back(n * (1 / length(n)));
    }
  }
  double least = 1e300;
  for (const D3 n : axes) {
    double depth = -std::fabs(dot(n, b.position - a.position));
    for (std::size_t k = 0; k < 3; ++k) {
      depth += half_a[k] * std::fabs(dot(n, a.rotation.column(static_cast<int>(k)))) +
               half_b[k] * std::fabs(dot(n, b.rotation.column(static_cast<int>(k))));
    }
    least = std::min(least, depth);
  }
  return least;
}
template <class S> Transform<double> in_double(const Transform<S>& t) {
  Transform<double> r;
  r.position = real(t.position);
  for (int i = 0; i < 3; ++i) r.rotation.rows[i] = real(t.rotation.rows[i]);
  return r;
}
template <class S> std::vector<Vec3<S>> corners_of(Point half) {
  std::vector<Vec3<S>> corners;
  for (int i = 0; i < 8; ++i)
    corners.push_back(vec<S>((i & 1) != 0 ? half[0] : -half[0], (i & 2) != 0 ? half[1] : -half[1],
                             (i & 4) != 0 ? half[2] : -half[2]));
  return corners;
}

// O30. EPA's depth of boxes is that of the separating axes. The manifold's is so in either order of the two, but for
// its preference of faces, without which stacks would tremble between two axes.
TYPED_TEST(BookCollisionOracles, depths_of_boxes_agree_however_they_are_found) {
  using S = TypeParam;
  Random random(30);
  int overlapping = 0;
  double worst = 0, preferred = 0;
  for (int n = 0; n < 4000; ++n) {
    Point half[2];
    for (Point& h : half)
      for (double& x : h) x = held<S>(random.in(0.1, 1));
    const Transform<S> a = random_pose<S>(random, 0.1), b = random_pose<S>(random, 1);
    const double depth = depth_by_axes(half[0], in_double(a), half[1], in_double(b));
    if (depth < 0.001) continue;
    ++overlapping;
    const std::vector<Vec3<S>> corners[2] = {corners_of<S>(half[0]), corners_of<S>(half[1])};
    const EpaPenetration<S> found =
        epa_penetration(ConvexCore<S>{corners[0], S(0)}, a, ConvexCore<S>{corners[1], S(0)}, b);
    ASSERT_EQ(found.status, EpaStatus::converged) << n;
    worst = std::max(worst, std::fabs(to_double(found.depth) - depth));
    const Primitive<S> boxes[2] = {box_of<S>(half[0][0], half[0][1], half[0][2]),
                                   box_of<S>(half[1][0], half[1][1], half[1][2])};
    const double ab = -deepest(touch(boxes[0], a, boxes[1], b)), ba = -deepest(touch(boxes[1], b, boxes[0], a));
    double smallest = 1;
    for (const Point& h : half)
      for (const double x : h) smallest = std::min(smallest, x);
    preferred = std::max({preferred, std::fabs(ab - depth) / smallest, std::fabs(ba - depth) / smallest});
  }
  EXPECT_GT(overlapping, 1000);
  EXPECT_LT(worst, pick<S>(1e-5, 1e-12, 5e-4, 1e-8));
  EXPECT_LT(preferred, 1.0 / 30) << "of the smallest half extent: axis_tolerance() and edge_slack()";
}

// O30. Two spheres, and a sphere and a box, in either order.
TYPED_TEST(BookCollisionOracles, swapped_shapes_have_mirrored_contacts) {
  using S = TypeParam;
  Random random(31);
  double worst = 0;
  int touching = 0;
  const auto drawn_box = [&] {
    const double z = random.in(0.1, 1), y = random.in(0.1, 1), x = random.in(0.1, 1);
    return box_of<S>(x, y, z);
  };
  for (int n = 0; n < 4000; ++n) {
    const Primitive<S> ball = sphere_of<S>(random.in(0.1, 1));
    const Primitive<S> other = n % 2 == 0 ? sphere_of<S>(random.in(0.1, 1)) : drawn_box();
    const Transform<S> a = random_pose<S>(random, 0.1), b = random_pose<S>(random, 1);
    const Manifold<S> m = touch(ball, a, other, b), w = touch(other, b, ball, a);
    ASSERT_EQ(m.count, w.count);
    if (m.count == 0) continue;
    ++touching;
    worst = std::max({worst, length3(point_of(m.normal) + point_of(w.normal)),
                      length3(point_of(m.points[0].position) - point_of(w.points[0].position)),
                      std::fabs(to_double(m.points[0].separation - w.points[0].separation))});
  }
  EXPECT_GT(touching, 1000);
  EXPECT_LT(worst, pick<S>(1e-5, 1e-12, 5e-4, 1e-8));
}

}  // namespace book_collision_oracles_test
}  // namespace isostep::test
