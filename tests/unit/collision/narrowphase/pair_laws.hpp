// The laws that every manifold keeps, what is known to break them, and the count of what does.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/geometry/shape_type.hpp"
#include "sample.hpp"

namespace isostep::test {

inline constexpr int kPairs = 10000;  // of every two shapes

enum Law {
  none_apart,             // beyond the margin: 2 margins of solids that only axes tell apart
  some_in_touch,          // spheres and capsules within the margin; others where they overlap by more than a preference
  as_deep_as_its_normal,  // the deepest point is as deep as the shapes overlap along the normal
  no_axis_is_better,      // than the normal, by more than a preference
  points_between,         // each point's two ends are on the shapes they belong to
  well_formed,            // numbers finite, normals unit, points within the margin, names unique
  mirrored,               // the other order gives the same, turned round
  the_same_far_off,       // and so does a place far from the origin
  kLaws
};
inline constexpr const char* kLawNames[] = {"none_apart",        "some_in_touch",   "as_deep_as_its_normal",
                                            "no_axis_is_better", "points_between",  "well_formed",
                                            "mirrored",          "the_same_far_off"};

constexpr unsigned bit(ShapeType type) { return 1u << static_cast<unsigned>(type); }
inline constexpr unsigned kPolyhedra = bit(ShapeType::box) | bit(ShapeType::hull), kCapsule = bit(ShapeType::capsule),
                          kSurfaces = bit(ShapeType::mesh) | bit(ShapeType::height_field),
                          kRevolved = bit(ShapeType::cylinder) | bit(ShapeType::cone);

/// The pairs that are known to break a law: how many of kPairs, in the worst scalar. Every other number is 0.
struct Known {
  unsigned a, b;  // of the types
  Law law;
  int most;
};
inline constexpr Known kKnown[] = {
    // The direction of a gap of few digits, to an edge beside the centre: along it, a triangle's far end is nearer.
    {bit(ShapeType::sphere), kSurfaces, as_deep_as_its_normal, 12},
    {bit(ShapeType::sphere), kSurfaces, no_axis_is_better, 8},
    {kCapsule, bit(ShapeType::hull), as_deep_as_its_normal, 8},
    {kCapsule, bit(ShapeType::hull), no_axis_is_better, 8},
    // A core that is through a surface, or under it around its border.
    {kCapsule, kSurfaces, none_apart, 4},
    {kCapsule, kSurfaces, some_in_touch, 25},
    {kCapsule, kSurfaces, as_deep_as_its_normal, 140},
    {kCapsule, kSurfaces, no_axis_is_better, 200},
    {kCapsule, kSurfaces, points_between, 2},
    // A triangle whose best axis is across an inner edge takes the best of its own, which may be much deeper.
    {kPolyhedra, bit(ShapeType::height_field), as_deep_as_its_normal, 100},
    {kPolyhedra, bit(ShapeType::height_field), no_axis_is_better, 320},
    {kPolyhedra, bit(ShapeType::height_field), some_in_touch, 2},
    // A search from a triangle's plane that finds no way from there.
    {kRevolved, kSurfaces, none_apart, 2},
    {kRevolved, kSurfaces, some_in_touch, 90},
    {kRevolved, kSurfaces, as_deep_as_its_normal, 150},
    {kRevolved, kSurfaces, no_axis_is_better, 280},
    {kRevolved, kSurfaces, points_between, 40},
    {kRevolved, kSurfaces, the_same_far_off, 25},
    // A core inside the solid leaves from its deepest point, see collide_capsule_revolved.
    {kCapsule, kRevolved, as_deep_as_its_normal, 90},
    {kCapsule, kRevolved, no_axis_is_better, 85},
    // Deep overlaps, whose best axis is across a line beyond the solid's own axis; and a preferred face or disc over
    // which there is only what is less deep.
    {kPolyhedra, kRevolved, none_apart, 2},
    {kPolyhedra, kRevolved, as_deep_as_its_normal, 160},
    {kPolyhedra, kRevolved, no_axis_is_better, 140},
    {kPolyhedra, kRevolved, points_between, 140},
    {kRevolved, kRevolved, as_deep_as_its_normal, 60},
    {kRevolved, kRevolved, no_axis_is_better, 30},
    {kRevolved, kRevolved, points_between, 50},
    // reduce_to_four() keeps corners that are as deep as the deepest but for depth_tie().
    {bit(ShapeType::box), bit(ShapeType::mesh), as_deep_as_its_normal, 1},
    {bit(ShapeType::box), bit(ShapeType::hull), as_deep_as_its_normal, 1},
    // Faces within 3.6 degrees of each other, see kNearFace: a's tells what lies over it.
    {bit(ShapeType::hull), bit(ShapeType::hull), points_between, 4},
};
inline int known(Law law, ShapeType a, ShapeType b) {
  for (const Known& k : kKnown) {
    const bool here = ((k.a & bit(a)) != 0 && (k.b & bit(b)) != 0) || ((k.a & bit(b)) != 0 && (k.b & bit(a)) != 0);
    if (k.law == law && here) return known_in_quarter(k.most);
  }
  return 0;
}

struct Tally {
  struct Broken {
    int times = 0, first = -1;
    double worst = 0;  // [m]
  };
  Broken laws[kLaws];
  int touching = 0, apart = 0;

  void hold(Law law, double excess, int n) {
    if (excess <= 0) return;
    Broken& broken = laws[law];
    if (++broken.times == 1) broken.first = n;
    if (!(excess <= broken.worst)) broken.worst = excess, broken.first = n;
  }
};

}  // namespace isostep::test
