// A program of the tests: the probe shape as the engine's own files treat it, in a copy that has it in its list.
// SPDX-License-Identifier: MIT
#include <cstdio>

#include "isostep/collision/narrowphase/collide.inl"
#include "isostep/collision/query/closest_point.inl"
#include "isostep/collision/query/ray_cast.inl"
#include "isostep/geometry/mass_properties.inl"
#include "isostep/geometry/validate.inl"
#include "scenes/shape_keys.hpp"

using namespace isostep;

int main() {
  const Primitive<float> cube = primitive_of(Probe<float>{0.5f}), box = primitive_of(Box<float>{{0.5f, 0.5f, 0.5f}});
  const Child<float> child = {cube, Pose<float>::identity()};
  const Transform<float> here = Transform<float>::of(Pose<float>::identity());
  Transform<float> above = here;
  above.position = {0, 0.96875f, 0};
  Manifold<float> touch;
  collide(cube, above, box, here, 0.0f, touch);
  RayHit<float> hit = {};
  const bool met = ray_cast(cube, here, {0, 4, 0}, {0, -4, 0}, 1.0f, hit);
  int keys = 0;
  scenes::ScenePart part;
  part.type = ShapeType::probe;
  scenes::visit_sizes(part, [&](const char*, auto&, scenes::SizeRule) { ++keys; });
  std::printf("%s mass %g fault %d touch %u %g ray %d %g top %g keys %d\n", kShapeNames[kShapeTypes - 1],
              double{mass_properties(std::span<const Child<float>>(&child, 1), 2.0f).mass},
              static_cast<int>(validate(cube)), touch.count, double{touch.points[0].separation}, met,
              double{hit.fraction}, double{closest_point(cube, here, Vec3<float>{0, 4, 0}).point.y}, keys);
}
