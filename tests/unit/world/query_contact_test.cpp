// Casts that begin in touch or inside, and rays and casts along the edges of meshes and height fields.
// SPDX-License-Identifier: MIT
#include <optional>

#include "isostep/geometry/baked/surface_blob.hpp"
#include "random/dice.hpp"
#include "random/hull.hpp"

namespace isostep::test {
namespace query_contact_test {

enum class Ground { half_space, box, mesh, height_field };
constexpr Ground kGrounds[] = {Ground::half_space, Ground::box, Ground::mesh, Ground::height_field};
constexpr int kCells = 8;  // of a metre; the surfaces are centred on the origin

template <class S> class QueryContact : public ::testing::Test {
 public:
  using Height = double (*)(int i, int k);
  static double plain(int, int) { return 0; }

  static BodyId add(World<S>& w, Ground ground, Height height = plain) {
    if (ground == Ground::half_space) return add_ground(w);
    if (ground == Ground::box) return w.create(still<S>(add_box(w, 6, 1, 6), {0, -1, 0}));
    std::vector<double> heights;
    std::vector<D3> points;
    std::vector<MeshTriangle> triangles;
    for (int k = 0; k <= kCells; ++k) {
      for (int i = 0; i <= kCells; ++i) {
        heights.push_back(height(i, k));
        points.push_back({i - kCells / 2.0, height(i, k), k - kCells / 2.0});
        if (i == kCells || k == kCells) continue;
        const auto at = static_cast<std::uint32_t>(k * (kCells + 1) + i), below = at + kCells + 1;
        triangles.push_back({{at, below, at + 1}});
        triangles.push_back({{below + 1, at + 1, below}});
      }
    }
    std::vector<BlobRef> blobs;
    Child<S> child = part_at(primitive_of(Mesh<S>{1}), {0, 0, 0});
    if (ground == Ground::mesh) {
      blobs.push_back(mesh_blob(points, triangles).value());
    } else {
      blobs.push_back(height_field_blob({kCells + 1, kCells + 1, 1}, heights).value());
      child = part_at(primitive_of(HeightField<S>{1}), {-kCells / 2.0, 0, -kCells / 2.0});
    }
    return w.create(still<S>(w.add_shape(std::span<const Child<S>>(&child, 1), blobs)));
  }

  /// Solids that stand on the ground when their middle is `height` [m] above it.
  struct Standing {
    ShapeId shape;
    double height;
  };
  static std::vector<Standing> solids(World<S>& w) {
    std::vector<D3> prism;
    for (int i = 0; i < 6; ++i) {
      const double x = 0.5 * std::cos(i * kPi / 3), z = 0.5 * std::sin(i * kPi / 3);
      prism.push_back({x, 0.25, z});
      prism.push_back({x, -0.25, z});
    }
    return {{add_ball(w, 0.375), 0.375},
            {w.add_shape(Capsule<S>{num<S>(0.5), num<S>(0.25)}), 0.75},
            {add_box(w, 0.25, 0.5, 0.375), 0.5},
            {w.add_shape(hull_blob(std::span<const D3>(prism)).value()), 0.25}};
  }
};
TYPED_TEST_SUITE(QueryContact, AllScalars);

TYPED_TEST(QueryContact, what_rests_moves_away_and_along_freely_and_not_into_the_ground) {
  using S = TypeParam;
  for (const Ground ground : kGrounds) {
    World<S> w(settings<S>(0));
    const BodyId floor = this->add(w, ground);
    Dice dice(11);
    for (const auto& solid : this->solids(w)) {
      for (int i = 0; i < 60; ++i) {
        const double sunk = i % 3 == 0 ? 0 : dice.in(0, 0.008), angle = dice.in(0, 2 * kPi);
        const double z = dice.in(-1, 1), x = dice.in(-1, 1);
        const Pose<S> pose = {vec<S>(x, solid.height - sunk, z), turn<S>({0, 1, 0}, dice.in(0, 6))};
        const D3 along = {2.5 * std::cos(angle), 0, 2.5 * std::sin(angle)};
        const std::string where = std::to_string(static_cast<int>(ground)) + ", " + std::to_string(i);
        EXPECT_FALSE(w.cast_shape(solid.shape, pose, vec<S>(along))) << where << " along";
        EXPECT_FALSE(w.cast_shape(solid.shape, pose, vec<S>(along + D3{0, dice.in(0, 1), 0}))) << where << " away";
        EXPECT_FALSE(w.cast_shape(solid.shape, pose, vec<S>(0, 2, 0))) << where << " up";
        EXPECT_FALSE(w.cast_shape(solid.shape, pose, vec<S>(0, 0, 0))) << where << " nowhere";
        const auto hit = w.cast_shape(solid.shape, pose, vec<S>(along + D3{0, -dice.in(0.5, 2), 0}));
        ASSERT_TRUE(hit.has_value()) << where;
        EXPECT_EQ(hit->body, floor);
        EXPECT_FALSE(hit->inside) << where;
        EXPECT_LT(to_double(hit->fraction), 1e-4) << where;
        EXPECT_GT(to_double(hit->normal.y), 0.999) << where;
      }
    }
  }
}

TYPED_TEST(QueryContact, what_begins_inside_hits_at_nothing_or_passes_as_it_is_told) {
  using S = TypeParam;
  for (const Ground ground : kGrounds) {
    World<S> w(settings<S>(0));
    const BodyId floor = this->add(w, ground);
    for (const auto& solid : this->solids(w)) {
      const Pose<S> pose = {vec<S>(0.3, solid.height - 0.125, 0.2), Quat<Unit<S>>::identity()};
      QueryFilter filter;
      const auto hit = w.cast_shape(solid.shape, pose, vec<S>(0, -3, 0.5), filter);
      ASSERT_TRUE(hit.has_value());
      EXPECT_EQ(hit->body, floor);
      EXPECT_TRUE(hit->inside);
      EXPECT_EQ(hit->fraction, Unit<S>(0));
      EXPECT_GT(to_double(hit->normal.y), 0.99) << static_cast<int>(ground);
      filter.start_inside = StartInside::ignore;
      // A surface has no inside: what moves aside, or grows wider downwards, comes to triangles beside those.
      const bool is_surface = ground == Ground::mesh || ground == Ground::height_field, is_round = solid.height != 0.5;
      if (is_surface && is_round) continue;
      const double aside = is_surface ? 0 : 0.5;
      EXPECT_FALSE(w.cast_shape(solid.shape, pose, vec<S>(0, -3, aside), filter)) << static_cast<int>(ground);
    }
  }
}

TYPED_TEST(QueryContact, what_falls_on_flat_ground_is_told_its_normal_wherever_it_lands) {
  using S = TypeParam;
  for (const Ground ground : kGrounds) {
    World<S> w(settings<S>(0));
    this->add(w, ground);
    Dice dice(12);
    for (const auto& solid : this->solids(w)) {
      for (int i = 0; i < 80; ++i) {
        const bool on_edge = i % 2 == 0;
        const D3 land = on_edge ? D3{dice.below(5) - 2.0, solid.height, dice.in(-2, 2)}
                                : D3{dice.in(-2, 2), solid.height, dice.in(-2, 2)};
        const D3 back = {dice.in(-2, 2), dice.in(0.2, 3), dice.in(-2, 2)};
        const Pose<S> pose = {vec<S>(land + back), turn<S>({0, 1, 0}, dice.in(0, 6))};
        const auto hit = w.cast_shape(solid.shape, pose, vec<S>(back * -2.0));
        ASSERT_TRUE(hit.has_value()) << i;
        const double long_way = 2 * length(back);
        EXPECT_NEAR(to_double(hit->fraction), 0.5, 1e-3 / long_way) << static_cast<int>(ground) << " " << i;
        EXPECT_GT(to_double(hit->normal.y), 0.999) << static_cast<int>(ground) << " " << i;
        EXPECT_NEAR(to_double(hit->point.y), 0, 2e-3);
      }
    }
  }
}

TYPED_TEST(QueryContact, a_surface_is_met_from_its_outward_side_or_from_both) {
  using S = TypeParam;
  for (const Ground ground : {Ground::mesh, Ground::height_field}) {
    World<S> w(settings<S>(0));
    this->add(w, ground);
    const ShapeId ball = add_ball(w, 0.25);
    const Pose<S> below = {vec<S>(0.3, -2, 0.4), Quat<Unit<S>>::identity()};
    QueryFilter filter;
    EXPECT_FALSE(w.cast_ray(below.position, vec<S>(0, 4, 0), filter));
    EXPECT_FALSE(w.cast_shape(ball, below, vec<S>(0, 4, 0), filter));
    filter.back_faces = true;
    const auto ray = w.cast_ray(below.position, vec<S>(0, 4, 0), filter);
    ASSERT_TRUE(ray.has_value());
    EXPECT_NEAR(to_double(ray->fraction), 0.5, 1e-4);
    EXPECT_EQ(ray->normal, vec<Unit<S>>(0, -1, 0));
    const auto cast = w.cast_shape(ball, below, vec<S>(0, 4, 0), filter);
    ASSERT_TRUE(cast.has_value());
    EXPECT_NEAR(to_double(cast->fraction), 1.75 / 4, 1e-4);
    EXPECT_LT(to_double(cast->normal.y), -0.999);
    EXPECT_TRUE(w.cast_ray(vec<S>(0.3, 2, 0.4), vec<S>(0, -4, 0), filter));
  }
}

/// Up one side of a ridge and down the other, within the rounding of a fraction.
TYPED_TEST(QueryContact, of_sides_that_a_ray_meets_at_one_fraction_the_first_is_the_first_of_all) {
  using S = TypeParam;
  World<S> w(settings<S>(0));
  const std::vector<D3> points = {{-4, -32, 4}, {4, -32, 4}, {4, 0, 0}, {-4, 0, 0}, {4, -32, -4}, {-4, -32, -4}};
  const std::vector<MeshTriangle> triangles = {{{0, 1, 2}}, {{0, 2, 3}}, {{3, 2, 4}}, {{3, 4, 5}}};
  w.create(still<S>(w.add_shape(mesh_blob(points, triangles).value())));
  QueryFilter filter, each;
  filter.back_faces = each.back_faces = true;
  each.per = HitPer::triangle;
  int at_once = 0;
  for (int i = 1; i <= 64; ++i) {
    for (const double way : {-1.0, 1.0}) {
      const double depth = std::ldexp(i, -14 - i % 12);
      const Vec3<S> origin = vec<S>(i / 32.0, -depth, -3 * way), translation = vec<S>(0, 0, 8 * way);
      std::vector<RayCastHit<S>> all;
      w.cast_ray_all(origin, translation, all, each);
      const auto first = w.cast_ray(origin, translation, filter);
      ASSERT_EQ(first.has_value(), !all.empty()) << i;
      if (all.empty()) continue;
      at_once += all.size() > 1 && all[0].fraction == all[1].fraction;
      EXPECT_EQ(first->triangle, all[0].triangle) << i;
      EXPECT_EQ(first->fraction, all[0].fraction) << i;
      EXPECT_EQ(first->normal, all[0].normal) << i;
    }
  }
  EXPECT_TRUE(at_once > 0 || !(to_double(resolution<S>()) > 0x1p-30));
}

/// Hills on a grid that every scalar holds: what aims at a point of it meets that point exactly.
double hills(int i, int k) { return ((i * 7 + k * 5) % 8 - (i * k) % 4) / 8.0; }

TYPED_TEST(QueryContact, no_ray_falls_through_an_edge_or_a_corner) {
  using S = TypeParam;
  for (const Ground ground : {Ground::mesh, Ground::height_field}) {
    World<S> w(settings<S>(0));
    const BodyId floor = this->add(w, ground, hills);
    Dice dice(13);
    int twice = 0;
    for (int n = 0; n < 3000; ++n) {
      const int i = 1 + static_cast<int>(dice.below(kCells - 2)), k = 2 + static_cast<int>(dice.below(kCells - 3));
      const int share = static_cast<int>(dice.below(5)), way = static_cast<int>(dice.below(3));
      const int to_i = way == 1 ? i : i + 1, to_k = way == 0 ? k : way == 1 ? k + 1 : k - 1;  // an edge of the grid
      const double t = share / 4.0, s = 1 - t;
      const D3 on = {s * i + t * to_i - kCells / 2.0, s * hills(i, k) + t * hills(to_i, to_k),
                     s * k + t * to_k - kCells / 2.0};
      // Down, steep enough to come from the outward side of all triangles that meet there.
      const double tilt = n % 4 == 0 ? 0 : 0.25;
      const D3 from = {dice.in(-tilt, tilt), dice.in(2, 4), dice.in(-tilt, tilt)};
      const Vec3<S> origin = vec<S>(on + from), translation = vec<S>(from * -2.0);
      const auto hit = w.cast_ray(origin, translation);
      ASSERT_TRUE(hit.has_value()) << n;
      EXPECT_EQ(hit->body, floor);
      EXPECT_NEAR(to_double(hit->fraction), 0.5, 1e-3) << n;
      QueryFilter each;
      each.per = HitPer::triangle;
      std::vector<RayCastHit<S>> all;
      w.cast_ray_all(origin, translation, all, each);
      ASSERT_FALSE(all.empty());
      EXPECT_EQ(all[0].triangle, hit->triangle);
      twice += all.size() > 1;
      // A small ball along the same line does not fall through either.
      const auto ball =
          w.cast_shape(primitive_of(Sphere<S>{num<S>(0.03125)}), {origin, Quat<Unit<S>>::identity()}, translation);
      ASSERT_TRUE(ball.has_value()) << n;
      EXPECT_LE(to_double(ball->fraction), 0.5 + 1e-3) << n;
      EXPECT_GT(to_double(ball->fraction), 0.4) << n;
    }
    EXPECT_GT(twice, 20);
  }
}

TYPED_TEST(QueryContact, a_ball_meets_hills_where_the_nearest_triangle_says) {
  using S = TypeParam;
  for (const Ground ground : {Ground::mesh, Ground::height_field}) {
    World<S> w(settings<S>(0));
    this->add(w, ground, hills);
    World<double> oracle(settings<double>(0));
    QueryContact<double>::add(oracle, ground, hills);
    Dice dice(14);
    int hits = 0;
    for (int n = 0; n < 600; ++n) {
      const double radius = dice.in(0.1, 0.8);
      const double z = dice.in(-3, 3), y = dice.in(2, 3), x = dice.in(-3, 3);
      const double along_z = dice.in(-3, 3), down = dice.in(0, 3), along_x = dice.in(-3, 3);
      const Vec3<S> at = vec<S>(x, y, z), way = vec<S>(along_x, -down, along_z);
      const Sphere<S> ball = {num<S>(radius)};
      const auto hit = w.cast_shape(primitive_of(ball), {at, Quat<Unit<S>>::identity()}, way);
      const double r = to_double(ball.radius);
      // The distance of the ball's middle to the nearest triangle is its radius where it hits.
      if (hit) {
        ++hits;
        const D3 middle = real(at) + real(way) * to_double(hit->fraction);
        const auto nearest = oracle.closest_point(middle, 2);
        ASSERT_TRUE(nearest.has_value()) << n;
        EXPECT_NEAR(nearest->distance, r, 2e-3) << n;
        expect_near(nearest->normal, real(hit->normal), 0.05, std::to_string(n).c_str());
        expect_near(nearest->point, real(hit->point), 0.02);
      }
      // Before, it is further away.
      for (int step = 0; step < 20; ++step) {
        const double t = (hit ? to_double(hit->fraction) : 1) * step / 20;
        const auto nearest = oracle.closest_point(real(at) + real(way) * t, 2);
        const D3 normal = nearest ? nearest->normal : D3{0, 1, 0};
        if (!nearest || normal.y <= 0) continue;  // below it, or beyond its border
        ASSERT_GT(nearest->distance, r - 2e-3) << n << " " << step;
      }
    }
    EXPECT_GT(hits, 150);
  }
}

}  // namespace query_contact_test
}  // namespace isostep::test
