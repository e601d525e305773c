// Every two shapes of the list, and compounds of them, far from comfort: what comes out is a manifold, in four scalars
// of which fixed ones trap on overflow. The laws of ordinary pairs are in narrowphase/every_pair_test.cpp.
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "isostep/collision/narrowphase/box_tolerance.hpp"
#include "isostep/collision/narrowphase/polyhedra.inl"  // a default argument of collide
#include "isostep/geometry/surfaces.hpp"
#include "sample.hpp"
#include "unit/collision/narrowphase/hostile_shapes.hpp"
#include "unit/collision/narrowphase/support_oracle.hpp"
#include "unit/collision/narrowphase/trapping.hpp"
#include "unit/geometry/oracle.hpp"

namespace isostep::test {
namespace hostile_pairs_test {

using Scalars = testing::Types<float, double, TrapQ16, TrapQ32>;

/// [m] The limit that collide() states for extents and distances.
template <class S> constexpr double documented_extent() {
  return std::is_same_v<S, TrapQ32> || std::is_same_v<S, double> ? 1000 : 100;
}
bool is_ground(ShapeType type) { return type == ShapeType::half_space || is_surface(type); }

template <class S> struct Part {
  DrawnShape shape;
  Transform<S> at;

  PlacedShape placed() const { return {shape, oracle::real(at), {0, 0, 0}}; }
};

enum Flaw { not_a_manifold, beyond_margin, out_of_reach, not_as_deep, not_mirrored, kFlaws };
constexpr const char* kFlawNames[] = {"not a manifold", "beyond the margin", "points out of reach",
                                      "not as deep as its normal", "not mirrored"};

constexpr int kPairs = 1000;  // of every two types

/// A flaw that is known: how many of kPairs break, in the worst scalar. Every other number is 0.
struct KnownFlaw {
  unsigned a, b;  // of the types
  Flaw flaw;
  int most;
};
constexpr unsigned bit(int type) { return 1u << type; }
constexpr unsigned bit(ShapeType type) { return bit(static_cast<int>(type)); }
constexpr unsigned kPolyhedra = bit(ShapeType::box) | bit(ShapeType::hull),
                   kRevolved = bit(ShapeType::cylinder) | bit(ShapeType::cone),
                   kSurfaces = bit(ShapeType::mesh) | bit(ShapeType::height_field), kCompound = bit(kShapeTypes),
                   kAny = (bit(kShapeTypes) << 1) - 1;
constexpr KnownFlaw kKnownFlaws[] = {
    // The direction of a gap of few digits, along a huge capsule.
    {bit(ShapeType::sphere), bit(ShapeType::capsule), not_as_deep, 2},
    // Deep overlaps of what is huge or thin with cylinders and cones: the axis is across a line beyond the solid's own,
    // and the point where the lines cross. See pair_laws.hpp, which has the rates of ordinary sizes.
    {kPolyhedra, kRevolved, out_of_reach, 25},
    {kPolyhedra, kRevolved, not_as_deep, 5},
    {kRevolved, kRevolved, out_of_reach, 9},
    {kRevolved, kRevolved, not_as_deep, 3},
    {kSurfaces, kRevolved, out_of_reach, 12},
    // A core inside the solid leaves from its deepest point.
    {bit(ShapeType::capsule), kRevolved, not_as_deep, 16},
    // Faces of needles and slabs.
    {bit(ShapeType::hull), kPolyhedra, out_of_reach, 3},
    // reduce_to_four() keeps corners that are as deep as the deepest but for depth_tie().
    {bit(ShapeType::hull), bit(ShapeType::half_space), not_as_deep, 2},
    // All of these, of their parts.
    {kCompound, kAny, out_of_reach, 12},
    {kCompound, kAny, not_as_deep, 18},
};
int known(Flaw flaw, int a, int b) {
  for (const KnownFlaw& k : kKnownFlaws) {
    const bool here = ((k.a & bit(a)) != 0 && (k.b & bit(b)) != 0) || ((k.a & bit(b)) != 0 && (k.b & bit(a)) != 0);
    if (k.flaw == flaw && here) return known_in_quarter(k.most);
  }
  return 0;
}

template <class S> class HostilePairs : public testing::Test {
 protected:
  /// One that the scalar takes: hulls may be too thin for it.
  static DrawnShape draw_shape(Random& random, ShapeType type, double largest) {
    for (;;) {
      const DrawnShape shape = HostileDrawer::draw(random, type, largest);
      if (type != ShapeType::hull) return shape;
      if (static_cast<const HullContent<S>*>(shape.content<S>())->fault == ShapeFault::none) return shape;
    }
  }
  /// One shape, or of a compound two or three at hostile places of its own.
  static std::vector<Part<S>> draw(Random& random, int type, double largest) {
    std::vector<Part<S>> parts;
    if (type < kShapeTypes) {
      parts.push_back({draw_shape(random, static_cast<ShapeType>(type), largest), {}});
      parts[0].at = any_pose<S>(random, {0, 0, 0});
      return parts;
    }
    const Transform<S> body = any_pose<S>(random, {0, 0, 0});
    for (int count = 2 + random.below(2); count > 0; --count) {
      const auto of = static_cast<ShapeType>(random.below(kShapeTypes));
      if (is_ground(of)) continue;
      const DrawnShape shape = draw_shape(random, of, largest / 2);
      const Point from = random.point(any_size(random, largest / 4));
      parts.push_back({shape, compose(body, any_pose<S>(random, from))});
    }
    return parts;
  }
  /// Moves b to where its first part touches a's to within a centimetre, often exactly, or is deep in it.
  static void bring(Random& random, const std::vector<Part<S>>& a, std::vector<Part<S>>& b, double largest) {
    if (a.empty() || b.empty()) return;
    const PlacedShape in_a = a[0].placed(), in_b = b[0].placed();
    const bool swaps = is_ground(a[0].shape.type());  // grounds lie below what comes
    const Part<S>& ground = swaps ? a[0] : b[0];
    Point n = random.below(4) == 0 ? random.direction() : axis_of(random, a[0].at);
    if (ground.shape.type() == ShapeType::half_space) n = (swaps ? in_a : in_b).plane_normal() * (swaps ? 1.0 : -1.0);
    Point p = {0, 0, 0};
    const double gaps[4] = {0, random.in(-0.02, 0.02), 0.01, -random.power_of_ten(-5, 1)};
    const double gap = gaps[random.below(4)];
    if (is_surface(ground.shape.type())) {
      const PlacedShape& below = swaps ? in_a : in_b;
      const auto& side =
          ground.shape.sides[static_cast<std::size_t>(random.below(static_cast<int>(ground.shape.sides.size())))];
      const double u = random.in(0, 1), v = random.in(0, 1 - u);
      const Point on = below.world(side[0] * (1 - u - v) + side[1] * u + side[2] * v);
      Point up = below.turned(cross3(side[1] - side[0], side[2] - side[0]));
      up = up * (1 / length3(up));
      const PlacedShape& above = swaps ? in_b : in_a;
      const Point lowest = above.support(up * -1);
      p = on + up * gap - lowest;
      if (!swaps) p = p * -1;
    } else {
      p = n * (in_a.reach(n) + in_b.reach(n * -1) + gap);
      for (int j = 0; j < 2; ++j) {  // sideways, by up to what both reach
        Point u = cross3(n, random.direction());
        const double most = a[0].shape.reach + b[0].shape.reach;
        if (random.below(3) == 0) p = p + u * random.in(-most, most);
      }
    }
    for (double& c : p) c = std::clamp(c, -largest, largest);
    for (Part<S>& part : b) part.at.position += vec_of<S>(p);
  }
  static Point axis_of(Random& random, const Transform<S>& t) {
    const double way = random.below(2) ? 1 : -1;
    return point_of(t.rotation.column(random.below(3))) * way;
  }

  struct Tally {
    int times[kFlaws] = {}, first[kFlaws] = {}, pairs = 0, touching = 0;
    double worst[kFlaws] = {};
    void hold(Flaw flaw, double excess, int n) {
      if (excess <= 0) return;
      if (times[flaw]++ == 0) first[flaw] = n;
      if (!(excess <= worst[flaw])) worst[flaw] = excess, first[flaw] = n;
    }
  };
  static Manifold<S> collided(const Part<S>& a, const Part<S>& b, S margin) {
    Manifold<S> m;
    const Primitive<S> pa = a.shape.template primitive<S>(), pb = b.shape.template primitive<S>();
    const ShapeView<S> view_a(pa, a.shape.template content<S>()), view_b(pb, b.shape.template content<S>());
    collide(view_a, a.at, view_b, b.at, margin, m);
    return m;
  }
  static void check(const Part<S>& a, const Part<S>& b, S margin, Tally& tally, int n) {
    if (is_ground(a.shape.type()) && is_ground(b.shape.type())) return;
    const Manifold<S> m = collided(a, b, margin);
    ++tally.pairs;
    tally.touching += m.count > 0;
    if (m.count < 0 || m.count > kMaxContactPoints) return tally.hold(not_a_manifold, 1e9, n);
    if (a.shape.type() != b.shape.type()) check_mirrored(m, collided(b, a, margin), tally, n);
    if (m.count == 0) return;
    const Point normal = point_of(m.normal);
    tally.hold(not_a_manifold, std::abs(length3(normal) - 1) - 64 * to_double(resolution<Unit<S>>()) - 1e-6, n);
    for (int i = 0; i < m.count; ++i) {
      const bool finite = is_finite(m.points[i].position) && is_finite(m.points[i].separation);
      tally.hold(not_a_manifold, finite ? 0 : 1e9, n);
      tally.hold(beyond_margin, to_double(m.points[i].separation - (margin + kPatchReach<S>)), n);
      for (int j = 0; j < i; ++j) tally.hold(not_a_manifold, m.points[i].feature == m.points[j].feature ? 1 : 0, n);
    }
    check_places(a, b, m, normal, to_double(margin), tally, n);
  }
  static void check_mirrored(const Manifold<S>& m, const Manifold<S>& w, Tally& tally, int n) {
    bool same = m.count == w.count && m.normal == -w.normal;
    for (int i = 0; same && i < m.count; ++i) {
      same = m.points[i].position == w.points[i].position && m.points[i].separation == w.points[i].separation &&
             m.points[i].feature == w.points[i].feature;
    }
    tally.hold(not_mirrored, same ? 0 : 1, n);
  }
  /// Checks where points are, and of convex shapes how deep.
  static void check_places(const Part<S>& a, const Part<S>& b, const Manifold<S>& m, Point normal, double margin,
                           Tally& tally, int n) {
    const PlacedShape in_a = a.placed(), in_b = b.placed();
    const double size = a.shape.reach + b.shape.reach + length3(in_b.at() - in_a.at()) +
                        std::abs(a.shape.record.offset) + std::abs(b.shape.record.offset);
    const double noise = 32 * rounding<S>(size) + 1e-9;
    const double inner = std::min(a.shape.inner, b.shape.inner);
    const double cost = (inner < 1e9 ? inner / 64 : 0) + (a.shape.radius + b.shape.radius) / 16 +
                        std::sqrt(to_double(detail::near_parallel<S>())) * size;
    const Point u = cross3(normal, std::abs(normal[0]) < 0.6 ? Point{1, 0, 0} : Point{0, 1, 0}), v = cross3(normal, u);
    for (int i = 0; i < m.count; ++i) {
      const Point p = point_of(m.points[i].position);
      const double depth = std::abs(to_double(m.points[i].separation));
      for (const Point way : {normal, normal * -1, u, u * -1, v, v * -1}) {
        const double allowed = depth / 2 + margin + cost + noise;
        if (!in_a.is_plane()) tally.hold(out_of_reach, dot3(p, way) - in_a.reach(way) - allowed, n);
        if (!in_b.is_plane()) tally.hold(out_of_reach, dot3(p, way) - in_b.reach(way) - allowed, n);
      }
    }
    if (is_surface(a.shape.type()) || is_surface(b.shape.type())) return;
    const double along = in_a.is_plane()   ? plane_gap(in_a, in_b)
                         : in_b.is_plane() ? plane_gap(in_b, in_a)
                                           : -in_a.reach(normal) - in_b.reach(normal * -1);
    double deep = 1e300;
    for (int i = 0; i < m.count; ++i) deep = std::min(deep, to_double(m.points[i].separation));
    tally.hold(not_as_deep, along - deep - cost - noise, n);
    // A capsule leans on a face that it reaches beyond.
    const auto leans = [](const DrawnShape& s) { return s.type() == ShapeType::capsule ? s.record.half.y / 8 : 0; };
    // Faces of polyhedra tell of what lies over them: what lies deeper along their normal lies beside them.
    const auto is_polyhedron = [](const DrawnShape& s) { return (kPolyhedra & bit(s.type())) != 0; };
    if (is_polyhedron(a.shape) && is_polyhedron(b.shape)) return;
    if (along < 0) tally.hold(not_as_deep, deep - along - cost - noise - leans(a.shape) - leans(b.shape), n);
  }
  static double plane_gap(const PlacedShape& plane, const PlacedShape& solid) {
    const Point n = plane.plane_normal();
    return -solid.reach(n * -1) - plane.reach(n);
  }
};
TYPED_TEST_SUITE(HostilePairs, Scalars);

TYPED_TEST(HostilePairs, give_manifolds_without_a_trap) {
  using S = TypeParam;
  constexpr double kLargest = documented_extent<S>();
  const auto name = [](int type) { return type < kShapeTypes ? kShapeNames[type] : "compound"; };
  for (int type_a = 0; type_a <= kShapeTypes; ++type_a) {
    for (int type_b = type_a; type_b <= kShapeTypes; ++type_b) {
      typename TestFixture::Tally tally;
      Random random(static_cast<std::uint64_t>(type_a * 100 + type_b) + 1000);
      for (int n = 0, pairs = sampled(kPairs, kPairs / 4); n < pairs; ++n) {
        const auto a = this->draw(random, type_a, kLargest / 2);
        auto b = this->draw(random, type_b, kLargest / 2);
        const S margin = from_double<S>(random.below(4) == 0 ? 0 : 0.02);
        this->bring(random, a, b, kLargest / 2);
        for (const auto& part_a : a) {
          for (const auto& part_b : b) this->check(part_a, part_b, margin, tally, n);
        }
      }
      for (int i = 0; i < kFlaws; ++i) {
        EXPECT_LE(tally.times[i], known(static_cast<Flaw>(i), type_a, type_b))
            << name(type_a) << " " << name(type_b) << " of " << tally.pairs << ", " << kFlawNames[i] << ": worst "
            << tally.first[i] << " by " << tally.worst[i];
      }
      EXPECT_GE(tally.touching, tally.pairs / 8) << name(type_a) << " " << name(type_b);
    }
  }
}

}  // namespace hostile_pairs_test
}  // namespace isostep::test
