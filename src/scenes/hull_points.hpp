// The hulls of scenes: from the points that a file has to a blob, and from a blob to what judges measure.
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <memory>
#include <string>
#include <vector>

#include "isostep/geometry/blob.hpp"
#include "scene.hpp"

namespace isostep::scenes {

/// The hull of a part's points, or of its baked file. Throws SceneError.
BlobRef hull_of_part(const ScenePart& part, const std::string& place);

/// A hull in double, from its exact faces: judges do not ask the engine that they judge.
struct SolidHull {
  std::vector<Vec3<double>> vertices;                  // [m]
  std::vector<Vec3<double>> normals;                   // [1] outward, of each face
  std::vector<std::array<Vec3<double>, 2>> edges;      // [m] their ends
  std::vector<std::array<Vec3<double>, 3>> triangles;  // [m] of the faces
  double volume;                                       // [m^3]
  Vec3<double> centre;                                 // [m] of mass
  Mat3<double> moments;                                // [m^2] means of x x^T about the centre
  double inner_radius;                                 // [m] from the centre to the nearest face
};
/// The solid of a hull's blob.
std::shared_ptr<const SolidHull> solid_hull(const Blob& blob);

/// The volume and moments that the engine gives a hull with a radius [m]: stretched about its centre, along each axis
/// until its box has grown by the radius on both sides.
struct StretchedHull {
  double volume;         // [m^3]
  Mat3<double> moments;  // [m^2] as SolidHull has them
};
StretchedHull stretched(const SolidHull& hull, double radius);

}  // namespace isostep::scenes
