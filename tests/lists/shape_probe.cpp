// A program of the tests: the probe shape as the engine's own files treat it, in a copy that has it in its list.
// SPDX-License-Identifier: MIT
#include <cmath>
#include <cstdio>

#include "isostep/collision/narrowphase/collide.inl"
#include "isostep/collision/query/closest_point.inl"
#include "isostep/collision/query/ray_cast.inl"
#include "isostep/geometry/baked/hull_blob.hpp"
#include "isostep/geometry/baked/surface_blob.hpp"
#include "isostep/geometry/mass_properties.inl"
#include "isostep/geometry/submersion.inl"
#include "isostep/geometry/validate.inl"
#include "scenes/shape_keys.hpp"

using namespace isostep;

namespace {

const Primitive<float> kProbe = primitive_of(Probe<float>{0.5f, 0.5f});
Transform<float> at(float y) {
  Transform<float> t = Transform<float>::of(Pose<float>::identity());
  t.position.y = y;
  return t;
}

/// The probe on what lies below it, 1/32 m deep; `top` [m] of that.
void stand_on(const ShapeView<float>& ground, float top, Transform<float> t = at(0)) {
  Manifold<float> touch;
  collide(kProbe, at(top + 0.46875f), ground, t, 0.0f, touch);
  float deepest = 0;
  for (int i = 0; i < touch.count; ++i) deepest = std::fmin(deepest, touch.points[i].separation);
  std::printf("%s %d %g\n", kShapeNames[static_cast<int>(ground.primitive.type)], touch.count, double{deepest});
}

void stand_on_all() {
  stand_on(primitive_of(Sphere<float>{0.5f}), 0.5f);
  stand_on(primitive_of(Box<float>{{0.5f, 0.5f, 0.5f}}), 0.5f);
  Transform<float> lying = at(0);
  lying.rotation = {{{0, -1, 0}, {1, 0, 0}, {0, 0, 1}}};
  stand_on(primitive_of(Capsule<float>{0.25f, 0.25f}), 0.25f, lying);
  stand_on(primitive_of(HalfSpace<float>{{0, 1, 0}, 0}), 0);
  std::vector<Vec3<double>> cube;
  for (int i = 0; i < 8; ++i) cube.push_back({(i & 1) - 0.5, (i >> 1 & 1) - 0.5, (i >> 2) - 0.5});
  const BlobRef hull = hull_blob(std::span<const Vec3<double>>(cube)).value();
  const auto of_hull = HullContent<float>::make(hull->bytes());
  const Primitive<float> as_hull = primitive_of(Hull<float>{1});
  stand_on({as_hull, of_hull.get()}, 0.5f);
  const std::vector<Vec3<double>> corners = {{-4, 0, -4}, {-4, 0, 8}, {8, 0, -4}};
  const std::vector<MeshTriangle> triangles = {{{0, 1, 2}}};
  const BlobRef mesh = mesh_blob(corners, triangles).value();
  const auto of_mesh = SurfaceContent<TriangleMesh>::make(mesh->bytes());
  const Primitive<float> as_mesh = primitive_of(Mesh<float>{1});
  stand_on({as_mesh, of_mesh.get()}, 0);
  const BlobRef field = height_field_blob({2, 2, 16}, std::vector<double>(4, 0.0)).value();
  const auto of_field = SurfaceContent<BakedHeightField>::make(field->bytes());
  const Primitive<float> as_field = primitive_of(HeightField<float>{1});
  Transform<float> aside = at(0);
  aside.position = {-4, 0, -4};
  stand_on({as_field, of_field.get()}, 0, aside);
  stand_on(primitive_of(Cylinder<float>{0.5f, 0.5f}), 0.5f);
  stand_on(primitive_of(Cone<float>{0.5f, 0.5f}), 0.5f);
  stand_on(kProbe, 0.5f);
}

}  // namespace

int main() {
  const Child<float> child = {kProbe, Pose<float>::identity()};
  RayHit<float> hit = {};
  const bool met = ray_cast(kProbe, at(0), {0, 4, 0}, {0, -4, 0}, 1.0f, hit);
  int keys = 0;
  scenes::ScenePart part;
  part.type = ShapeType::probe;
  scenes::visit_sizes(part, [&](const char*, auto&, scenes::SizeRule) { ++keys; });
  const float lying_half = submersion<float>(kProbe, {1, 0, 0}, 0).share;  // half of it is below its own axis
  std::printf("%s mass %g fault %d ray %d %g top %g below %g keys %d\n", kShapeNames[kShapeTypes - 1],
              double{mass_properties(std::span<const Child<float>>(&child, 1), 2.0f).mass},
              static_cast<int>(validate(kProbe)), met, double{hit.fraction},
              double{closest_point(kProbe, at(0), Vec3<float>{0, 4, 0}).point.y}, double{lying_half}, keys);
  stand_on_all();
}
