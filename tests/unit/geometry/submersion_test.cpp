// Parts of solids below a plane against integrals in double, for every scalar.
// SPDX-License-Identifier: MIT
#include "isostep/geometry/submersion.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <numbers>

#include "isostep/geometry/bounds.hpp"
#include "isostep/geometry/content.hpp"
#include "isostep/geometry/mass_properties.hpp"
#include "scenes/hull_points.hpp"
#include "unit/geometry/hull_recipes.hpp"
#include "unit/geometry/oracle.hpp"
#include "unit/world/worlds.hpp"

namespace isostep::test {
namespace submersion_test {

using oracle::D3;

struct Part {
  double volume = 0;
  D3 moment = {0, 0, 0};

  void add(double of, D3 at) {
    volume += of;
    moment += at * of;
  }
};

/// A shape with what its integrals need: the outline of what is round, the triangles of what is flat.
template <class S> struct Solid {
  Child<S> child;
  std::vector<BlobRef> blobs;
  std::vector<const void*> contents;
  std::shared_ptr<const scenes::SolidHull> flat;
  double size = 0;  // [m] no point is further from the frame's origin

  ShapeView<S> view() const { return Contents<S>{contents.data()}.view(child.primitive); }
};

/// The errors allowed of the share, of what slices measure and of the rest; of the centre times the share over the size
/// the same.
template <class S> struct Promise;
template <> struct Promise<float> { static constexpr double sliced = 2e-6, exact = 2e-6; };
template <> struct Promise<double> { static constexpr double sliced = 1e-7, exact = 1e-12; };
template <> struct Promise<Q16_16> { static constexpr double sliced = 4e-5, exact = 4e-5; };
template <> struct Promise<Q32_32> { static constexpr double sliced = 1e-7, exact = 1e-9; };
template <class S> double allowed(const Solid<S>& solid) {
  const ShapeType type = solid.child.primitive.type;
  const bool sliced = type == ShapeType::capsule || type == ShapeType::cylinder || type == ShapeType::cone;
  return sliced ? Promise<S>::sliced : Promise<S>::exact;
}

template <class S> Solid<S> drawn(oracle::Random& random, int kind) {
  Solid<S> solid;
  const double low = std::is_same_v<S, Q16_16> ? 0.25 : 0.05;
  if (kind < 5) {
    solid.child = {random.primitive<S>(kind, low, 4), Pose<S>::identity()};
  } else {
    scenes::Draws draws(static_cast<std::uint32_t>(kind));
    std::vector<D3> points;
    for (const scenes::Point& p : scenes::drawn_hull(kind, draws).points) points.push_back({p.x, p.y, p.z});
    solid.blobs = {hull_blob(std::span<const D3>(points)).value()};
    solid.flat = scenes::solid_hull(*solid.blobs[0]);
    solid.child = {Hull<S>{1, S(0)}.primitive(), Pose<S>::identity()};
    find_contents<S>(solid.blobs, solid.contents);
  }
  const Aabb<S> box = bounds(solid.view(), Transform<S>::of(Pose<S>::identity()));
  solid.size = 2 * std::max(to_double(max_abs(box.low)), to_double(max_abs(box.high)));
  return solid;
}

/// Adds the part below the plane of a triangle's tetrahedron with a point of the plane: of the corners below it in
/// turn.
void add_cut(Part& part, D3 a, D3 b, D3 c, D3 up, double level) {
  std::vector<D3> kept;
  const D3 corner[3] = {a, b, c};
  for (int i = 0; i < 3; ++i) {
    const D3 p = corner[i], q = corner[(i + 1) % 3];
    const double hp = dot(up, p) - level, hq = dot(up, q) - level;
    if (hp <= 0) kept.push_back(p);
    if ((hp <= 0) != (hq <= 0)) kept.push_back(p + (q - p) * (hp / (hp - hq)));
  }
  const D3 apex = up * level;
  for (std::size_t i = 2; i < kept.size(); ++i) {
    const D3 u = kept[0] - apex, v = kept[i - 1] - apex, w = kept[i] - apex;
    part.add(dot(u, cross(v, w)) / 6, apex + (u + v + w) * 0.25);
  }
}
Part box_below(D3 h, D3 up, double level) {
  Part part;
  for (int axis = 0; axis < 3; ++axis) {
    for (const double side : {-1.0, 1.0}) {
      const auto corner = [&](double s, double t) {
        D3 p = {0, 0, 0};
        p[axis] = side * h[axis];
        p[(axis + 1) % 3] = side * s * h[(axis + 1) % 3];
        p[(axis + 2) % 3] = t * h[(axis + 2) % 3];
        return p;
      };
      add_cut(part, corner(-1, -1), corner(1, -1), corner(1, 1), up, level);
      add_cut(part, corner(-1, -1), corner(1, 1), corner(-1, 1), up, level);
    }
  }
  return part;
}
/// Thin discs along y.
Part round_below(const Primitive<double>& p, D3 up, double level) {
  Part part;
  const bool capped = p.type == ShapeType::capsule || p.type == ShapeType::sphere;
  const double r = p.radius, h = p.half.y, top = capped ? h + r : h;
  const double sine = std::hypot(up.x, up.z);
  const D3 aside = sine > 0 ? D3{up.x / sine, 0, up.z / sine} : D3{1, 0, 0};
  constexpr int kDiscs = 100000;
  for (int i = 0; i < kDiscs; ++i) {
    const double y = top * (2 * (i + 0.5) / kDiscs - 1), past = std::fmax(std::fabs(y) - h, 0);
    const double radius = capped                      ? std::sqrt(std::fmax(r * r - past * past, 0))
                          : p.type == ShapeType::cone ? r * (h - y) / (2 * h)
                                                      : r;
    const double reach = sine * radius, d = level - up.y * y;
    if (d <= -reach) continue;
    const double u = d >= reach ? 1 : d / reach, v = std::sqrt(1 - u * u);
    const double area = radius * radius * (std::numbers::pi / 2 + std::asin(u) + u * v);
    const double width = 2 * top / kDiscs;
    part.volume += area * width;
    part.moment += D3{0, y * area * width, 0} - aside * (radius * radius * radius * v * v * v * 2 / 3 * width);
  }
  return part;
}
template <class S> Part part_below(const Solid<S>& solid, D3 up, double level) {
  const Primitive<double> p = oracle::real(solid.child.primitive);
  if (p.type == ShapeType::box) return box_below(p.half, up, level);
  if (!solid.flat) return round_below(p, up, level);
  Part part;
  for (const auto& t : solid.flat->triangles) add_cut(part, t[0], t[1], t[2], up, level);
  return part;
}

/// Discs of a round solid are so many that this is what they are off by.
template <class S> double round_reference(const Solid<S>& solid) {
  const ShapeType type = solid.child.primitive.type;
  return type == ShapeType::sphere ? 1e-9 : 0;
}

template <class S> class SubmersionTest : public ::testing::Test {};
TYPED_TEST_SUITE(SubmersionTest, AllScalars);

TYPED_TEST(SubmersionTest, shares_and_centres_are_those_of_integrals) {
  using S = TypeParam;
  oracle::Random random(5);
  int across = 0;
  double worst_share = 0, worst_moment = 0;
  for (int n = 0; n < 120; ++n) {
    const Solid<S> solid = drawn<S>(random, n % 10);
    const Vec3<Unit<S>> up = normalise(oracle::made<S>(random.direction() * 8));
    const S level = from_double<S>(random.in(-1, 1) * solid.size * 0.4);
    const Submersion<S> got = submersion<S>(solid.view(), up, level);
    const D3 way = oracle::real(up);
    const Part part = part_below(solid, way, to_double(level)), whole = part_below(solid, way, 2 * solid.size);
    const double share = part.volume / whole.volume;
    ASSERT_NEAR(to_double(got.share), share, allowed(solid) + round_reference(solid)) << "solid " << n;
    worst_share = std::fmax(worst_share, std::fabs(to_double(got.share) - share));
    if (share < 1e-3) continue;
    across += share < 0.999 ? 1 : 0;
    const D3 centre = part.moment * (1 / part.volume);
    const double off = oracle::length(oracle::real(got.centre) - centre) * share / solid.size;
    const double rounding = 2 * to_double(resolution<S>()) / solid.size;
    const double most = 2 * (allowed(solid) + round_reference(solid)) + (std::is_floating_point_v<S> ? 0 : rounding);
    ASSERT_LE(off, most) << "solid " << n;
    worst_moment = std::fmax(worst_moment, off);
  }
  EXPECT_GT(across, 60);
  this->RecordProperty("worst_share", std::to_string(worst_share * 1e9) + "e-9");
  this->RecordProperty("worst_moment", std::to_string(worst_moment * 1e9) + "e-9");
}

TYPED_TEST(SubmersionTest, what_is_below_and_what_is_above_are_the_whole) {
  using S = TypeParam;
  oracle::Random random(9);
  for (int n = 0; n < 400; ++n) {
    const Solid<S> solid = drawn<S>(random, n % 10);
    const Vec3<Unit<S>> up = n < 40 ? Vec3<Unit<S>>{Unit<S>(0), Unit<S>(n % 2 == 0 ? 1 : -1), Unit<S>(0)}
                                    : normalise(oracle::made<S>(random.direction() * 8));
    const S level = from_double<S>(random.in(-1, 1) * solid.size * 0.5);
    const Submersion<S> below = submersion<S>(solid.view(), up, level);
    const Submersion<S> above = submersion<S>(solid.view(), -up, -level);
    EXPECT_NEAR(to_double(below.share) + to_double(above.share), 1, 2 * allowed(solid)) << "solid " << n;
    EXPECT_GE(below.share, Unit<S>(0));
    EXPECT_LE(below.share, Unit<S>(1));
  }
}

TYPED_TEST(SubmersionTest, a_plane_that_misses_leaves_all_or_nothing) {
  using S = TypeParam;
  oracle::Random random(3);
  for (int kind = 0; kind < 10; ++kind) {
    const Solid<S> solid = drawn<S>(random, kind);
    const Vec3<Unit<S>> up = normalise(oracle::made<S>(random.direction() * 8));
    const S far = from_double<S>(solid.size * 2 + 1);
    EXPECT_EQ(submersion<S>(solid.view(), up, far).share, Unit<S>(1)) << kind;
    EXPECT_EQ(submersion<S>(solid.view(), up, -far).share, Unit<S>(0)) << kind;
    EXPECT_EQ(submersion<S>(solid.view(), up, Limits<S>::position()).share, Unit<S>(1)) << kind;
  }
  const Primitive<S> floor = primitive_of(HalfSpace<S>::of(HalfSpace<>{{0, 1, 0}, 0}));
  EXPECT_EQ(submersion<S>(floor, {Unit<S>(0), Unit<S>(1), Unit<S>(0)}, S(1)).share, Unit<S>(0));
}

}  // namespace submersion_test
}  // namespace isostep::test
