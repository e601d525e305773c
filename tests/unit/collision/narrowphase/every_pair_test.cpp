// The laws of manifolds, of every two shapes there are: random pairs, deep, touching and apart, tiny and large, near
// the origin and far from it, beside an oracle in double.
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "isostep/collision/narrowphase/box_tolerance.hpp"
#include "sample.hpp"
#include "unit/collision/narrowphase/pair_laws.hpp"
#include "unit/collision/narrowphase/support_oracle.hpp"

namespace isostep::test {
namespace every_pair_test {

constexpr double kMargin = 0.015625;  // [m]

/// Shapes that only static bodies have pass through each other.
bool is_ground(ShapeType type) {
  return type == ShapeType::half_space || type == ShapeType::mesh || type == ShapeType::height_field;
}
/// The distance of the shape is told exactly, not along axes alone.
bool is_round(const DrawnShape& shape) {
  return shape.type() == ShapeType::sphere || shape.type() == ShapeType::capsule || shape.is_rounded();
}
bool is_surface(ShapeType type) { return type == ShapeType::mesh || type == ShapeType::height_field; }

/// A hundred shapes of each type and size.
const DrawnShape& some_shape(Random& random, ShapeType type, int size) {
  static std::map<int, std::vector<DrawnShape>> drawn;
  std::vector<DrawnShape>& shapes = drawn[static_cast<int>(type) * kSizes + size];
  Random own(static_cast<std::uint64_t>(type) * kSizes + static_cast<std::uint64_t>(size) + 1);
  while (shapes.size() < 100) shapes.push_back(ShapeDrawer::draw(own, type, size));
  return shapes[static_cast<std::size_t>(random.below(100))];
}

struct Turn {
  Point axis;
  double angle;
};
/// Any way, or by quarter turns and a hair.
Turn some_turn(Random& random) {
  if (random.below(4) != 0) return {random.direction(), random.in(-3, 3)};
  const Point axes[3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  const double hair = random.below(2) == 0 ? 0 : random.power_of_ten(-7, -2);
  return {axes[random.below(3)], std::acos(0.0) * random.below(4) + hair};
}

/// Two shapes where every scalar has them, and what the oracle says.
struct Case {
  const DrawnShape *a, *b;
  Turn turn_a, turn_b;
  Point b_at;   // [m] from a's origin
  Point shift;  // [m] of both
  bool minute;  // smaller than Q16.16 takes
  PlacedShape in_a, in_b;
  SupportOracle::Best best;

  template <class S> Transform<S> at_a(Point from) const { return at<S>(from, turn_a.axis, turn_a.angle); }
  template <class S> Transform<S> at_b(Point from) const { return at<S>(from + b_at, turn_b.axis, turn_b.angle); }
  double reach() const {
    return a->reach + b->reach + length3(b_at) + std::abs(a->record.offset) + std::abs(b->record.offset);
  }
  double along(Point n) const { return SupportOracle(in_a, in_b).along(n); }
  /// [m] 0 where they overlap.
  double distance() const {
    return in_a.is_plane() || in_b.is_plane() ? best.separation : SupportOracle(in_a, in_b).distance();
  }
};

double depth_of_some(Random& random, double size) {
  switch (random.below(5)) {
    case 0: return random.in(-0.004, 0.004) * std::min(1.0, size);
    case 1: return -0.1 * size * random.in(0, 1);
    case 2: return -1.5 * size * random.in(0, 1);
    case 3: return random.in(0, kMargin);
    default: return kMargin + size * random.in(0, 1);
  }
}
double smallest(const DrawnShape& s) {
  const double round = s.radius > 0 ? s.radius : 1e9;
  return std::min(round, s.inner);
}

Case some_case(Random& random, ShapeType type_a, ShapeType type_b, int n) {
  constexpr int kOfPair[8][2] = {{0, 0}, {0, 0}, {0, 0}, {0, 0}, {1, 1}, {2, 2}, {kMinute, kMinute}, {0, 1}};
  const int kind = n % 8, other = random.below(2);
  const int size_a = kOfPair[kind][other], size_b = n % 32 == 15 ? 2 : kOfPair[kind][1 - other];
  const DrawnShape &a = some_shape(random, type_a, size_a), &b = some_shape(random, type_b, size_b);
  const Turn turn_a = some_turn(random), turn_b = some_turn(random);
  const Transform<double> ta = at<double>({0, 0, 0}, turn_a.axis, turn_a.angle);
  const Transform<double> tb = at<double>({0, 0, 0}, turn_b.axis, turn_b.angle);
  Case c = {&a, &b, turn_a, turn_b, {}, {}, size_a == kMinute || size_b == kMinute, {a, ta, {}}, {b, tb, {}}, {}};
  if (n % 4 == 3) c.shift = snap(random.point(40));
  const SupportOracle oracle(c.in_a, c.in_b);
  Point way = random.direction();
  if (b.is_surface() && dot3(way, c.in_b.faces[0]) > 0) way = way * -1;
  if (b.type() == ShapeType::half_space) way = c.in_b.plane_normal() * -1;
  c.in_b.move_to(way * -oracle.along(way));
  const SupportOracle::Best first = oracle.best();
  const double size = std::min({smallest(a), smallest(b), 16.0});
  c.b_at = snap(c.in_b.at() + first.normal * (depth_of_some(random, size) - first.separation));
  c.in_b.move_to(c.b_at);
  c.best = oracle.best();
  if (!c.in_a.is_plane() && !c.in_b.is_plane()) {
    const SupportOracle::Best again = oracle.climb({oracle.along(first.normal), first.normal});
    if (again.separation > c.best.separation) c.best = again;
  }
  return c;
}

/// [m] The depth that the choice among axes may cost: 1/128 of the smaller inner radius for faces before edges, and
/// again for a before b; 1/512 of radii; face_slack().
double preference(const Case& c) {
  const double inner = std::min(c.a->inner, c.b->inner);
  return (inner < 1e9 ? inner / 64 + std::min(inner / 4, 1.0 / 1024) : 0) + (c.a->radius + c.b->radius) / 512;
}

template <class S> class PairLaws {
 public:
  PairLaws(const Case& c, Tally& tally, int n)
      : c_(c), tally_(tally), n_(n), noise_(8 * rounding<S>(c.reach() + length3(c.shift)) + 1e-9) {}

  void check() {
    const Manifold<S> m = touch(c_.shift, false);
    ++(m.count > 0 ? tally_.touching : tally_.apart);
    check_one(m);
    const Manifold<S> w = touch(c_.shift, true);
    if (c_.a->type() == c_.b->type()) check_one(mirror(w));
    else check_same(mirror(w), m, 0, {0, 0, 0}, mirrored);
    if (c_.shift != Point{0, 0, 0})
      check_same(touch({0, 0, 0}, false), m, kIsFixed<S> ? 0 : 4 * noise_, c_.shift, the_same_far_off);
  }

 private:
  void hold(Law law, double excess) { tally_.hold(law, excess, n_); }
  Manifold<S> touch(Point from, bool swapped) const {
    const Primitive<S> a = c_.a->template primitive<S>(), b = c_.b->template primitive<S>();
    const ShapeView<S> view_a(a, c_.a->template content<S>()), view_b(b, c_.b->template content<S>());
    const Transform<S> ta = c_.template at_a<S>(from), tb = c_.template at_b<S>(from);
    Manifold<S> m;
    if (swapped) collide(view_b, tb, view_a, ta, from_double<S>(kMargin), m);
    else collide(view_a, ta, view_b, tb, from_double<S>(kMargin), m);
    return m;
  }
  static Manifold<S> mirror(Manifold<S> m) {
    m.normal = -m.normal;
    return m;
  }
  void check_one(const Manifold<S>& m) {
    const bool exact = is_round(*c_.a) || is_round(*c_.b);
    if (c_.b->is_surface() && !is_in_front()) return hold(none_apart, is_behind() ? m.count : 0);
    const double best = c_.best.separation;
    const bool reachable = !c_.b->is_surface() || dot3(c_.best.normal, c_.in_b.faces[0]) < -0.01;
    if (m.count == 0) {
      const double near = exact ? kMargin : -preference(c_);
      if (reachable && best < near - noise_)
        hold(some_in_touch, std::min(near - noise_ - best, std::max(near, 1e-9) - c_.distance()));
      return;
    }
    if (reachable) hold(none_apart, best - (exact ? 1 : 2) * kMargin - noise_);
    Point n = point_of(m.normal);
    hold(well_formed, std::abs(length3(n) - 1) - 64 * to_double(resolution<Unit<S>>()) - 1e-15);
    if (!(length3(n) > 0.5)) return;
    n = n * (1 / length3(n));
    const double along = c_.along(n), deep = deepest(m), cost = preference(c_);
    // Along the normal of a face that a capsule leans on, it reaches further beyond the face than over it.
    const double beyond = leans(*c_.a) + leans(*c_.b);
    hold(as_deep_as_its_normal, along - deep - noise_);
    if (!reachable) return;
    if (!stands_for_best(deep)) {
      if (exact || best < 0) hold(as_deep_as_its_normal, deep - along - beyond - cost - noise_);
      hold(no_axis_is_better, (exact ? best : std::min(best, 0.0)) - beyond - cost - noise_ - along);
    }
    if (exact || best < 0) check_points(m, n);
  }
  void check_points(const Manifold<S>& m, Point n) {
    const Point u = cross3(n, std::abs(n[0]) < 0.6 ? Point{1, 0, 0} : Point{0, 1, 0}), v = cross3(n, u);
    for (int i = 0; i < m.count; ++i) {
      const ManifoldPoint<S>& p = m.points[i];
      hold(well_formed, is_finite(p.position) && is_finite(p.separation) ? 0 : 1);
      hold(well_formed, p.separation <= from_double<S>(kMargin) + kPatchReach<S> ? 0 : 1);
      for (int j = 0; j < i; ++j) hold(well_formed, p.feature == m.points[j].feature ? 1 : 0);
      const Point half = n * (to_double(p.separation) / 2), at = point_of(p.position) - c_.shift;
      for (const Point way : {n, u, u * -1, v, v * -1}) {
        const double aside = preference(c_) + (c_.a->radius + c_.b->radius) / 16 + 2 * noise_;
        hold(points_between, outside(c_.in_a, at - half, way) - aside);
        hold(points_between, outside(c_.in_b, at + half, way * -1) - aside);
      }
    }
  }
  double outside(const PlacedShape& shape, Point p, Point way) const {
    if (shape.is_plane()) return dot3(shape.plane_normal(), p) - shape.reach(shape.plane_normal());
    return dot3(way, p) - shape.reach(way);
  }
  void check_same(const Manifold<S>& m, const Manifold<S>& w, double slack, Point shift, Law law) {
    if (m.count != w.count) return hold(law, slack == 0 ? 1 : std::abs(c_.best.separation) - kMargin - slack);
    for (int i = 0; i < m.count; ++i) {
      hold(law, std::abs(to_double(m.points[i].separation - w.points[i].separation)) - slack);
      hold(law, length3(point_of(m.points[i].position) + shift - point_of(w.points[i].position)) - slack);
      hold(law, m.points[i].feature == w.points[i].feature ? 0 : 1);
    }
    hold(law, length3(point_of(m.normal) - point_of(w.normal)) - slack);
  }
  /// Faces of boxes and hulls stand for edges that cross where they tell of the same depth, but for edge_slack(): what
  /// lies deeper along their normal lies beside them.
  bool stands_for_best(double deep) const {
    const auto is_polyhedron = [](const DrawnShape& s) {
      return s.type() == ShapeType::box || s.type() == ShapeType::hull;
    };
    const double slack = detail::edge_slack(std::min(c_.a->inner, c_.b->inner)) + preference(c_) + noise_;
    return is_polyhedron(*c_.a) && is_polyhedron(*c_.b) && std::fabs(deep - c_.best.separation) <= slack;
  }
  static double leans(const DrawnShape& s) { return s.type() == ShapeType::capsule ? 2 * s.record.half.y / 16 : 0; }
  double height() const {
    return dot3(c_.in_b.faces[0], c_.in_a.world(c_.a->middle) - c_.in_b.world(c_.b->sides[0][0]));
  }
  bool is_in_front() const { return height() > noise_; }
  bool is_behind() const { return height() < -noise_; }

  const Case& c_;
  Tally& tally_;
  const int n_;
  const double noise_;  // [m]
};

void report(const Tally& tally, ShapeType a, ShapeType b, const char* scalar) {
  for (int i = 0; i < kLaws; ++i) {
    const Tally::Broken& broken = tally.laws[i];
    EXPECT_LE(broken.times, known(static_cast<Law>(i), a, b))
        << kShapeNames[static_cast<int>(a)] << " " << kShapeNames[static_cast<int>(b)] << ", " << scalar << ", "
        << kLawNames[i] << ": worst in pair " << broken.first << " by " << broken.worst;
  }
}

class EveryPair : public testing::TestWithParam<int> {};

TEST_P(EveryPair, keeps_the_laws_of_manifolds_in_every_scalar) {
  const auto type_a = static_cast<ShapeType>(GetParam() / kShapeTypes);
  const auto type_b = static_cast<ShapeType>(GetParam() % kShapeTypes);
  if (type_b < type_a) return;
  if (is_ground(type_a) && is_ground(type_b)) return;
  const bool surface_first = is_surface(type_a);
  Tally tallies[4];
  Random random(static_cast<std::uint64_t>(GetParam()) + 100);
  const int pairs = sampled(kPairs, kPairs / 4);
  for (int n = 0; n < pairs; ++n) {
    const Case c = some_case(random, surface_first ? type_b : type_a, surface_first ? type_a : type_b, n);
    PairLaws<float>(c, tallies[0], n).check();
    PairLaws<double>(c, tallies[1], n).check();
    if (!c.minute) PairLaws<Q16_16>(c, tallies[2], n).check();
    PairLaws<Q32_32>(c, tallies[3], n).check();
  }
  report(tallies[0], type_a, type_b, "float");
  report(tallies[1], type_a, type_b, "double");
  report(tallies[2], type_a, type_b, "Q16.16");
  report(tallies[3], type_a, type_b, "Q32.32");
  EXPECT_GT(tallies[1].touching, pairs / 3);
  EXPECT_GT(tallies[1].apart, pairs / 10);
}
INSTANTIATE_TEST_SUITE_P(Shapes, EveryPair, testing::Range(0, kShapeTypes* kShapeTypes));

}  // namespace every_pair_test
}  // namespace isostep::test
