// Laws of rest: what lies flat falls asleep, however thin it is, whatever it lies on; what tips or is held by nothing
// does not.
// SPDX-License-Identifier: MIT

#include <string>
#include <vector>

#include "isostep/geometry/baked/hull_blob.hpp"
#include "isostep/geometry/baked/surface_blob.hpp"
#include "random/dice.hpp"
#include "unit/world/worlds.hpp"

namespace isostep::test {
namespace thin_rest_test {

enum class Ground { half_space, box, mesh, field };
constexpr Ground kGrounds[] = {Ground::half_space, Ground::box, Ground::mesh, Ground::field};
enum class Solid { box_plate, box_stick, plate, stick, wedge, disc };
constexpr Solid kSolids[] = {Solid::box_plate, Solid::box_stick, Solid::plate, Solid::stick, Solid::wedge, Solid::disc};

template <class S> class ThinRest : public ::testing::Test {
 protected:
  static constexpr int kCells = 8;  // of 1 m

  static BlobRef mesh() {
    std::vector<D3> points;
    std::vector<MeshTriangle> triangles;
    for (int z = 0; z <= kCells; ++z) {
      for (int x = 0; x <= kCells; ++x) {
        points.push_back({x - kCells / 2.0, 0, z - kCells / 2.0});
        if (x == kCells || z == kCells) continue;
        const auto at = static_cast<std::uint32_t>(z * (kCells + 1) + x), next = at + kCells + 1;
        triangles.push_back({{at, next, at + 1}});
        triangles.push_back({{at + 1, next, next + 1}});
      }
    }
    return mesh_blob(points, triangles).value();
  }
  static void add_ground(World<S>& w, Ground kind) {
    const double middle = -kCells / 2.0;
    BodyDefinition<S> d = still<S>(ShapeId{});
    switch (kind) {
      case Ground::half_space: d.shape = w.add_shape(HalfSpace<S>{{Unit<S>(0), Unit<S>(1), Unit<S>(0)}, S(0)}); break;
      case Ground::box: d = still<S>(add_box(w, kCells, 1, kCells), {0, -1, 0}); break;
      case Ground::mesh: d.shape = w.add_shape(mesh()); break;
      case Ground::field: {
        const std::vector<double> heights((kCells + 1) * (kCells + 1), 0.0);
        d = still<S>(w.add_shape(height_field_blob({kCells + 1, kCells + 1, 1.0}, heights).value()),
                     {middle, 0, middle});
        break;
      }
    }
    ASSERT_TRUE(w.create(d));
  }
  /// Flat solids of a thickness and some 60 cm across; sticks are as thick as that both ways. Null: too small for S.
  static ShapeId add_solid(World<S>& w, Solid kind, double half, Dice& dice) {
    const double a = dice.in(0.2, 0.5), b = dice.in(0.2, 0.5);
    std::vector<D3> points;
    const auto corners = [&](double x, double y, double z, double least) {
      for (int i = 0; i < 8; ++i) {
        points.push_back({((i & 1) != 0 ? x : -x) * dice.in(least, 1), ((i & 2) != 0 ? y : -y) * dice.in(least, 1),
                          ((i & 4) != 0 ? z : -z) * dice.in(least, 1)});
      }
    };
    switch (kind) {
      case Solid::box_plate: return add_box(w, a, half, b);
      case Solid::box_stick: return add_box(w, half, a, half);
      case Solid::disc: return w.add_shape(Cylinder<S>{num<S>(a), num<S>(half)});
      case Solid::stick: corners(half, a, half * 0.8, 1); break;
      case Solid::wedge: corners(a, half, b, 0.7); break;
      case Solid::plate: {
        const int n = 3 + static_cast<int>(dice.below(7));
        for (int k = 0; k < n; ++k) {
          const double turn = 2 * kPi * (k + dice.in(-0.3, 0.3)) / n;
          for (const double side : {-1, 1}) points.push_back({a * std::cos(turn), side * half, a * std::sin(turn)});
        }
      }
    }
    const auto blob = hull_blob<double>(points);
    return blob ? w.add_shape(blob.value()) : ShapeId{};
  }
  static int awake_after_five_seconds(Ground ground, Solid kind, double half, std::uint64_t seed) {
    World<S> w(settings<S>());
    add_ground(w, ground);
    Dice dice(seed);
    const ShapeId shape = add_solid(w, kind, half, dice);
    if (!shape) return 0;
    BodyDefinition<S> d = moving<S>(shape, {dice.in(-1, 1), half + 0.15, dice.in(-1, 1)});
    d.mass = S(1);
    d.orientation = turn<S>({1, 0, 0}, dice.in(-0.5, 0.5)) * turn<S>({0, 1, 0}, dice.in(-3, 3));
    const BodyId id = w.create(d);
    EXPECT_TRUE(id);
    for (int frame = 0; frame < 300 && w.is_awake(id); ++frame) w.step();
    return w.is_awake(id) ? 1 : 0;
  }
};
TYPED_TEST_SUITE(ThinRest, AllScalars);

TYPED_TEST(ThinRest, of_flat_solids_of_2_to_24_mm_on_every_ground_comes_within_five_seconds) {
  const double least = to_double(Limits<TypeParam>::minimum_size());
  for (const Ground ground : kGrounds) {
    for (const Solid kind : kSolids) {
      int awake = 0;
      for (const double half : {0.001, 0.004, 0.012}) {
        if (half < least) continue;
        awake += this->awake_after_five_seconds(ground, kind, half, 1);
      }
      EXPECT_EQ(awake, 0) << "ground " << static_cast<int>(ground) << ", solid " << static_cast<int>(kind);
    }
  }
}

}  // namespace thin_rest_test
}  // namespace isostep::test
