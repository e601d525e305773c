// The pieces of a fracture: they add up, stay inside, keep apart, and are the same everywhere.
// SPDX-License-Identifier: MIT
#include "isostep/fracture/fracture.hpp"

#include <algorithm>
#include <string>

#include "unit/effects/fractured.hpp"

namespace isostep::test {
namespace fracture_test {

/// [steps] The shift of the corners from the exact ones, along a direction: sqrt(3) 5/8.
constexpr double kReach = 1.1;

Fracture broken(const GridHull& solid, const FracturePattern& pattern, std::uint64_t seed = 1,
                FractureLimits limits = {}) {
  const FractureImpact impact = blow(solid, {0.1, 0.2, -0.15}, {0.3, -1, 0.2});
  const Result<Fracture> result = fracture(solid, pattern, impact, seed, limits);
  EXPECT_TRUE(result.ok()) << (result.ok() ? "" : std::string(result.error().message.view()));
  return result.ok() ? result.value() : Fracture{};
}

/// [steps^2]
double area_of(const ConvexHull& hull, double scale) {
  double area = 0;
  for (std::size_t f = 0; f < hull.faces.size(); ++f) {
    const std::uint8_t first = hull.faces[f];
    const GridPoint a = hull.vertices[hull.half_edges[first].origin];
    std::uint8_t edge = hull.half_edges[first].next;
    for (std::uint8_t next = hull.half_edges[edge].next; next != first; next = hull.half_edges[next].next) {
      const GridVector n =
          cross(hull.vertices[hull.half_edges[edge].origin] - a, hull.vertices[hull.half_edges[next].origin] - a);
      area += 0.5 * length(D3{double(n.x), double(n.y), double(n.z)});
      edge = next;
    }
  }
  return area * scale * scale;
}

TEST(Fracture, eight_boxes_of_a_box_add_up_to_the_last_step) {
  const GridHull solid = cube();
  const Fracture f = broken(solid, EightBoxes{});
  ASSERT_EQ(f.pieces.size(), 8u);
  EXPECT_EQ(f.refused, 0u);
  EXPECT_EQ(f.volume6, f.solid_volume6);
  for (const FracturePiece& piece : f.pieces) {
    EXPECT_EQ(piece.blob, nullptr);
    const GridPoint h = piece.half_extents;
    EXPECT_EQ(piece.volume6, 6 * std::int64_t{h.x} * h.y * h.z);
  }
}

TEST(Fracture, a_blow_on_a_face_halves_the_box_along_itself) {
  const GridHull solid = cube();
  const Result<Fracture> f = fracture(solid, EightBoxes{}, blow(solid, {0.5, 0.125, 0}, {-1, 0, 0}), 1);
  ASSERT_EQ(f.value().pieces.size(), 8u);
  for (const FracturePiece& piece : f.value().pieces) EXPECT_EQ(piece.half_extents.x, 1 << 15);
}

TEST(Fracture, volumes_add_up_within_the_stated_bound) {
  for (const GridHull& solid : {cube(), rock()}) {
    for (const NamedPattern& p : patterns()) {
      for (std::uint64_t seed = 0; seed < 5; ++seed) {
        const Fracture f = broken(solid, p.pattern, seed);
        EXPECT_GT(f.pieces.size(), 4u) << p.name;
        double area = 0;
        std::int64_t sum = 0;
        for (const FracturePiece& piece : f.pieces) {
          area += area_of(hull_of(piece), piece.blob == nullptr ? 0.5 : 1);
          sum += piece.volume6;
        }
        EXPECT_EQ(sum, f.volume6);
        const double missing = std::fabs(double(f.volume6 - f.solid_volume6)) / 6;
        EXPECT_LT(missing, kReach * area) << p.name;
        // Hulls of rounded corners are a little too large: 0.12 steps times the area at most, where this was measured.
        EXPECT_LT(missing, 0.15 * area) << p.name;
      }
    }
  }
}

TEST(Fracture, no_piece_reaches_out_of_the_solid) {
  for (const GridHull& solid : {cube(), rock()}) {
    for (const NamedPattern& p : patterns()) {
      for (const FracturePiece& piece : broken(solid, p.pattern).pieces) {
        for (std::size_t f = 0; f < solid.hull.faces.size(); ++f) {
          const GridPoint at = solid.hull.vertices[solid.hull.half_edges[solid.hull.faces[f]].origin];
          for (const D3 corner : corners_of(piece)) {
            const D3 from = corner - D3{double(at.x), double(at.y), double(at.z)};
            EXPECT_LT(dot(unit_normal(solid.hull, f), from), kReach) << p.name;
          }
        }
      }
    }
  }
}

std::vector<D3> edges_of(const ConvexHull& hull) {
  std::vector<D3> edges;
  for (std::size_t e = 0; e < hull.half_edges.size(); e += 2) {
    const GridVector v = hull.vertices[hull.half_edges[e + 1].origin] - hull.vertices[hull.half_edges[e].origin];
    edges.push_back({double(v.x), double(v.y), double(v.z)});
  }
  return edges;
}
/// [steps] The least overlap along the axes of two convex solids; stops below `enough`.
double overlap(const FracturePiece& a, const FracturePiece& b, double enough) {
  const std::vector<D3> of_a = corners_of(a), of_b = corners_of(b);
  const ConvexHull hull_a = hull_of(a), hull_b = hull_of(b);
  double least = 1e9;
  const auto try_axis = [&](D3 axis) {
    double low_a = 1e9, high_a = -1e9, low_b = 1e9, high_b = -1e9;
    for (const D3 p : of_a) low_a = std::min(low_a, dot(axis, p)), high_a = std::max(high_a, dot(axis, p));
    for (const D3 p : of_b) low_b = std::min(low_b, dot(axis, p)), high_b = std::max(high_b, dot(axis, p));
    least = std::min(least, std::min(high_a - low_b, high_b - low_a));
  };
  for (std::size_t f = 0; f < hull_a.faces.size() && least > enough; ++f) try_axis(unit_normal(hull_a, f));
  for (std::size_t f = 0; f < hull_b.faces.size() && least > enough; ++f) try_axis(unit_normal(hull_b, f));
  for (const D3 e : edges_of(hull_a)) {
    for (const D3 g : edges_of(hull_b)) {
      const D3 axis = cross(e, g);
      if (least > enough && length(axis) > 1e-6 * length(e) * length(g)) try_axis(axis * (1 / length(axis)));
    }
  }
  return least;
}

TEST(Fracture, pieces_overlap_by_no_more_than_rounding) {
  for (const GridHull& solid : {cube(), rock()}) {
    for (const NamedPattern& p : patterns()) {
      const Fracture f = broken(solid, p.pattern);
      for (std::size_t i = 0; i < f.pieces.size(); ++i) {
        for (std::size_t j = 0; j < i; ++j)
          EXPECT_LT(overlap(f.pieces[i], f.pieces[j], 2 * kReach), 2 * kReach) << p.name << " " << i << " " << j;
      }
    }
  }
}

TEST(Fracture, equal_arguments_give_equal_bytes_and_seeds_differ) {
  for (const NamedPattern& p : patterns()) {
    const std::vector<std::uint8_t> once = bytes_of(broken(rock(), p.pattern, 7));
    EXPECT_EQ(once, bytes_of(broken(rock(), p.pattern, 7))) << p.name;
    const bool seeded = p.pattern.index() != 0;
    EXPECT_EQ(once != bytes_of(broken(rock(), p.pattern, 8)), seeded) << p.name;
  }
}

TEST(Fracture, pieces_are_the_golden_ones) {
  const std::uint64_t golden[] = {1181466882881612795u, 9569420900237928158u, 4269914072840468911u,
                                  9960330916906234632u};
  for (const NamedPattern& p : patterns()) {
    const std::vector<std::uint8_t> bytes = bytes_of(broken(rock(), p.pattern, 2026));
    EXPECT_EQ(hash_bytes(bytes.data(), bytes.size()), golden[p.pattern.index()]) << p.name;
  }
}

template <class S> class FractureOf : public ::testing::Test {};
TYPED_TEST_SUITE(FractureOf, AllScalars);

TYPED_TEST(FractureOf, every_scalar_gives_the_same_pieces) {
  using S = TypeParam;
  const GridHull solid = grid_box(Box<S>{vec<S>(0.5, 0.25, 1)}).value();
  const FractureImpact impact = grid_impact(solid, vec<S>(0.125, 0.25, 0.5), vec<S>(0, -1, 0.25)).value();
  const GridHull other = grid_box(Box<double>{{0.5, 0.25, 1}}).value();
  for (const NamedPattern& p : patterns()) {
    const Result<Fracture> f = fracture(solid, p.pattern, impact, 3);
    EXPECT_EQ(bytes_of(f.value()),
              bytes_of(fracture(other, p.pattern, blow(other, {0.125, 0.25, 0.5}, {0, -1, 0.25}), 3).value()));
  }
}

TYPED_TEST(FractureOf, sizes_and_impacts_off_the_grid_are_refused) {
  using S = TypeParam;
  const auto place = [](const auto& result) { return result.ok() ? "" : std::string(result.error().place.view()); };
  EXPECT_EQ(place(grid_box(Box<S>{vec<S>(0, 1, 1)})), "half_extents");
  EXPECT_EQ(place(grid_box(Box<S>{vec<S>(1, -1, 1)})), "half_extents");
  EXPECT_EQ(place(grid_impact(cube(), vec<S>(9, 0, 0), vec<S>(0, 1, 0))), "point");
  EXPECT_EQ(place(grid_impact(cube(), vec<S>(0, -9, 0), vec<S>(0, 1, 0))), "point");
  EXPECT_EQ(place(grid_impact(cube(), vec<S>(0, 1, 0), vec<S>(0, 0, 0))), "") << "no direction is one, too";
}

TEST(Fracture, thin_slabs_break_across_but_not_through) {
  const GridHull pane = grid_box(Box<double>{{0.5, 0.005, 0.75}}).value();
  for (const NamedPattern& p : patterns()) {
    const Result<Fracture> f = fracture(pane, p.pattern, blow(pane, {0.1, 0.005, 0.1}, {0, -1, 0}), 5);
    ASSERT_TRUE(f.ok()) << p.name;
    for (const FracturePiece& piece : f.value().pieces) EXPECT_GE(piece.half_extents.y, 2 * 328 * 7 / 8) << p.name;
  }
  const Result<Fracture> glass = fracture(pane, RadialCracks{9, 2}, blow(pane, {0.1, 0.005, 0.1}, {0, -1, 0}), 5);
  EXPECT_GT(glass.value().pieces.size(), 20u);
}

TEST(Fracture, impacts_outside_and_on_corners_leave_a_whole) {
  for (const GridHull& solid : {cube(), rock()}) {
    for (const D3 point : {D3{0.5, 0.5, 0.5}, D3{-0.5, 0.5, 0}, D3{3, 2, -1}, D3{7.9, -7.9, 7.9}}) {
      for (const NamedPattern& p : patterns()) {
        const Result<Fracture> f = fracture(solid, p.pattern, blow(solid, point, {1, 1, 0}), 5);
        ASSERT_TRUE(f.ok()) << p.name;
        ASSERT_GE(f.value().pieces.size(), 1u);
        EXPECT_NEAR(double(f.value().volume6), double(f.value().solid_volume6), 1e-4 * double(f.value().solid_volume6));
      }
    }
  }
  const GridHull solid = cube();
  const Result<Fracture> missed = fracture(solid, EightBoxes{}, blow(solid, {3, 3, 3}, {0, 0, 0}), 5);
  EXPECT_EQ(missed.value().pieces.size(), 1u);
  EXPECT_EQ(missed.value().volume6, missed.value().solid_volume6);
}

TEST(Fracture, what_is_too_small_is_not_cut_off) {
  const GridHull solid = cube();
  const Fracture boxes = fracture(solid, EightBoxes{}, blow(solid, {0.49, 0.1, 0.1}, {0, 0, 0}), 5).value();
  EXPECT_EQ(boxes.pieces.size(), 4u);
  EXPECT_EQ(boxes.refused, 1u);
  EXPECT_EQ(boxes.volume6, boxes.solid_volume6);
  const Fracture cells =
      fracture(solid, VoronoiCells{200, 256}, blow(solid, {0.5, 0.5, 0.5}, {0, 0, 0}), 5, {.most_pieces = 256}).value();
  EXPECT_GT(cells.refused, 0u);
  EXPECT_EQ(cells.pieces.size() + cells.refused, 200u);
  EXPECT_NEAR(double(cells.volume6), double(cells.solid_volume6), 1e-4 * double(cells.solid_volume6));
}

TEST(Fracture, one_cell_is_the_solid) {
  const Fracture f = broken(rock(), VoronoiCells{1, 0});
  ASSERT_EQ(f.pieces.size(), 1u);
  EXPECT_EQ(f.volume6, f.solid_volume6);
}

TEST(Fracture, bad_arguments_are_named) {
  const GridHull solid = cube();
  const FractureImpact impact = blow(solid, {0, 0, 0}, {0, 1, 0});
  const auto place = [&](const FracturePattern& pattern, FractureImpact at, FractureLimits limits = {}) {
    const Result<Fracture> f = fracture(solid, pattern, at, 1, limits);
    return f.ok() ? "" : std::string(f.error().place.view());
  };
  EXPECT_EQ(place(GrainPlanes{{0, 0, 0}}, impact), "pattern.grain");
  EXPECT_EQ(place(GrainPlanes{{1 << 19, 0, 0}}, impact), "pattern.grain");
  EXPECT_EQ(place(GrainPlanes{{1, 0, 0}, 65}, impact), "pattern.along");
  EXPECT_EQ(place(GrainPlanes{{1, 0, 0}, 1, 65}, impact), "pattern.across");
  EXPECT_EQ(place(RadialCracks{1, 0}, impact), "pattern.sectors");
  EXPECT_EQ(place(RadialCracks{8, 65}, impact), "pattern.rings");
  EXPECT_EQ(place(RadialCracks{}, blow(solid, {0, 0, 0}, {0, 0, 0})), "impact.direction");
  EXPECT_EQ(place(VoronoiCells{0, 0}, impact), "pattern.cells");
  EXPECT_EQ(place(VoronoiCells{257, 0}, impact), "pattern.cells");
  EXPECT_EQ(place(VoronoiCells{9, 257}, impact), "pattern.gathering");
  EXPECT_EQ(place(EightBoxes{}, {{1 << 19, 0, 0}, {0, 0, 0}}), "impact.point");
  EXPECT_EQ(place(EightBoxes{}, {{0, 0, 0}, {0, -(1 << 19), 0}}), "impact.direction");
  EXPECT_EQ(place(EightBoxes{}, impact, {.most_pieces = 0}), "limits.most_pieces");
  EXPECT_EQ(place(EightBoxes{}, impact, {.most_pieces = 8, .least_width = -1}), "limits.least_width");
  EXPECT_FALSE(fracture(GridHull{}, EightBoxes{}, impact, 1).ok());
  const Result<Fracture> many = fracture(solid, GrainPlanes{{0, 1, 0}, 12, 9}, impact, 1);
  ASSERT_FALSE(many.ok());
  EXPECT_EQ(many.error().code, ErrorCode::limit);
  EXPECT_EQ(many.error().message.view(), "the pattern may make 130 pieces; expected at most 64");
}

}  // namespace fracture_test
}  // namespace isostep::test
