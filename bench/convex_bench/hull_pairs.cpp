// Pairs out of S10.
// SPDX-License-Identifier: MIT
#include "hull_pairs.hpp"

#include <algorithm>

#include "brute_force.hpp"
#include "isostep/collision/narrowphase/polyhedra.hpp"
#include "isostep/world/world.hpp"
#include "scenes/build.hpp"
#include "scenes/named.hpp"

namespace isostep::bench {
namespace {

constexpr double kNear = 0.1, kApart = 0.002, kSunk = 0.02;  // [m]

struct Lying {
  std::size_t hull;
  Pose<double> at;
  double radius;  // [m] about its frame's origin
};

BenchHull hull_of(const scenes::ScenePart& part) {
  const BlobRef blob = scenes::hull_of_part(part, "S10");
  Result<GridHull> grid = read_hull(blob->bytes());
  if (!grid.ok()) throw scenes::SceneError("S10", "a hull cannot be read");
  return {std::move(grid.value()), scenes::solid_hull(*blob)};
}

/// Those at rest; the pit is not asked about.
std::vector<Lying> lying_hulls(const scenes::Scene& scene, int frames, std::vector<BenchHull>& hulls) {
  World<double> world(scenes::settings_of<double>(scene));
  const scenes::Built<double> built = scenes::build(scene, world);
  for (int i = 0; i < frames; ++i) world.step();
  std::vector<Lying> lying;
  for (std::size_t i = 0; i < built.bodies.size(); ++i) {
    const scenes::ScenePart& part = scene.bodies[i].parts.front();
    if (part.type != ShapeType::hull) continue;
    hulls.push_back(hull_of(part));
    double radius = 0;
    for (const Vec3<double> v : hulls.back().solid->vertices) radius = std::max(radius, length(v));
    lying.push_back({hulls.size() - 1, world.pose(built.bodies[i]), radius});
  }
  return lying;
}

/// b goes into a along the normal between them.
BenchPair pushed(const BenchPair& pair, const std::vector<BenchHull>& hulls) {
  const HullSolid<double> a(hulls[pair.a].grid.hull, hulls[pair.a].grid.exponent);
  const HullSolid<double> b(hulls[pair.b].grid.hull, hulls[pair.b].grid.exponent);
  Manifold<double> manifold;
  manifold.clear();
  collide_polyhedra<double>(a.polyhedron(), Transform<double>::of(pair.at_a), b.polyhedron(),
                            Transform<double>::of(pair.at_b), 0.05, manifold);
  const double way = std::min(a.polyhedron().inner_radius, b.polyhedron().inner_radius) / 2;
  BenchPair deep = pair;
  deep.at_b.position -= manifold.normal * way;
  return deep;
}

/// Evenly through all of them.
void thin_out(std::vector<BenchPair>& pairs, std::size_t most) {
  if (pairs.size() <= most) return;
  std::vector<BenchPair> kept;
  for (std::size_t i = 0; i < most; ++i) kept.push_back(pairs[i * pairs.size() / most]);
  pairs = std::move(kept);
}

}  // namespace

PairSet pairs_of_pile(int frames, std::size_t most) {
  PairSet set;
  const std::vector<Lying> lying = lying_hulls(*scenes::find_scene("S10"), frames, set.hulls);
  auto& [near, touching, deep] = set.pairs;
  for (std::size_t i = 0; i < lying.size(); ++i) {
    for (std::size_t k = i + 1; k < lying.size(); ++k) {
      const Vec3<double> way = lying[k].at.position - lying[i].at.position;
      if (length(way) > lying[i].radius + lying[k].radius + kNear) continue;
      const BenchPair pair = {
          lying[i].hull, lying[k].hull, {way * -0.5, lying[i].at.orientation}, {way * 0.5, lying[k].at.orientation}};
      const Exact exact = brute_force(placed_hull(set.hulls[pair.a], Transform<double>::of(pair.at_a)),
                                      placed_hull(set.hulls[pair.b], Transform<double>::of(pair.at_b)));
      if (exact.gap > -kSunk && exact.gap < kApart) touching.push_back(pair);
      else if (exact.gap > 0 && exact.distance < kNear) near.push_back(pair);
    }
  }
  thin_out(near, most);
  thin_out(touching, most);
  for (const BenchPair& pair : touching) deep.push_back(pushed(pair, set.hulls));
  return set;
}

}  // namespace isostep::bench
