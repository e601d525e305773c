// The sizes of each shape in a scene: their keys in files, and the engine's shape of them.
// SPDX-License-Identifier: MIT
#pragma once

#include "scene.hpp"

namespace isostep::scenes {

/// The rule of a scene file for a size. A thickness is left out where it is 0, and stands beside a baked file too.
enum class SizeRule { positive, required, optional, thickness };

// visit_sizes: visit(key, size, rule) for every size of a part of that type; `part` may be const.

template <class Part, class Visit> void visit_sizes(ShapeClass<Sphere>, Part& part, const Visit& visit) {
  visit("radius", part.radius, SizeRule::positive);
}
template <class Part, class Visit> void visit_sizes(ShapeClass<Box>, Part& part, const Visit& visit) {
  visit("half_extents", part.half_extents, SizeRule::required);
}
template <class Part, class Visit> void visit_sizes(ShapeClass<Capsule>, Part& part, const Visit& visit) {
  visit("radius", part.radius, SizeRule::positive);
  visit("half_height", part.half_height, SizeRule::positive);
}
template <class Part, class Visit> void visit_sizes(ShapeClass<HalfSpace>, Part& part, const Visit& visit) {
  visit("normal", part.normal, SizeRule::required);
  visit("offset", part.offset, SizeRule::optional);
}
template <class Part, class Visit> void visit_sizes(ShapeClass<Hull>, Part& part, const Visit& visit) {
  visit("points", part.points, SizeRule::required);
  visit("radius", part.radius, SizeRule::thickness);
}
template <class Part, class Visit> void visit_sizes(ShapeClass<Mesh>, Part& part, const Visit& visit) {
  visit("vertices", part.vertices, SizeRule::required);
  visit("triangles", part.triangles, SizeRule::required);
  visit("materials", part.materials, SizeRule::optional);
  visit("surfaces", part.surfaces, SizeRule::optional);
}
template <class Part, class Visit> void visit_sizes(ShapeClass<HeightField>, Part& part, const Visit& visit) {
  visit("columns", part.columns, SizeRule::positive);
  visit("rows", part.rows, SizeRule::positive);
  visit("pitch", part.pitch, SizeRule::positive);
  visit("heights", part.heights, SizeRule::required);
  visit("materials", part.materials, SizeRule::optional);
  visit("surfaces", part.surfaces, SizeRule::optional);
}
template <class Part, class Visit> void visit_sizes(ShapeClass<Cylinder>, Part& part, const Visit& visit) {
  visit("radius", part.radius, SizeRule::positive);
  visit("half_height", part.half_height, SizeRule::positive);
}
template <class Part, class Visit> void visit_sizes(ShapeClass<Cone>, Part& part, const Visit& visit) {
  visit("radius", part.radius, SizeRule::positive);
  visit("half_height", part.half_height, SizeRule::positive);
}
/// A part of a baked file has no sizes but its name, and a thickness.
template <class Part, class Visit> void visit_sizes(Part& part, const Visit& visit) {
  const bool baked = !part.file.empty();
  if (baked) visit("file", part.file, SizeRule::required);
  visit_shape_type(part.type, [&](auto tag) {
    visit_sizes(tag, part, [&](const char* key, auto& size, SizeRule rule) {
      if (!baked || rule == SizeRule::thickness) visit(key, size, rule);
    });
  });
}

// What a part has of its own: visit(key, number), of a friction or a filter's bits, and visit_part_flags(visit(key,
// flag)).

template <class Traits, class Visit> void visit_part_material(Traits& own, const Visit& visit) {
  visit("friction", own.friction);
  visit("static_friction", own.static_friction);
  visit("restitution", own.restitution);
  visit("rolling_resistance", own.rolling_resistance);
  visit("spin_resistance", own.spin_resistance);
  visit("kind", own.kind);
}
template <class Traits, class Visit> void visit_part_filter(Traits& own, const Visit& visit) {
  visit("category", own.filter.category);
  visit("mask", own.filter.mask);
  visit("group", own.filter.group);
}
template <class Visit> void visit_part_flags(const Visit& visit) {
  visit("sensor", part_flag::kSensor);
  visit("report_contacts", part_flag::kReportContacts);
}

// shape_of: read.size(key, number) is an S, read.sizes(key, vector) a Vec3<S>, read.direction a Vec3<Unit<S>>,
// read.hull(part) the number that a Primitive has of the blob of a hull, read.mesh(part) and read.height_field(part)
// those of the surfaces.

template <class S, class Read> Sphere<S> shape_of(ShapeClass<Sphere>, const ScenePart& part, const Read& read) {
  return {read.size("radius", part.radius)};
}
template <class S, class Read> Box<S> shape_of(ShapeClass<Box>, const ScenePart& part, const Read& read) {
  return {read.sizes("half_extents", part.half_extents)};
}
template <class S, class Read> Capsule<S> shape_of(ShapeClass<Capsule>, const ScenePart& part, const Read& read) {
  return {read.size("radius", part.radius), read.size("half_height", part.half_height)};
}
template <class S, class Read> HalfSpace<S> shape_of(ShapeClass<HalfSpace>, const ScenePart& part, const Read& read) {
  return {read.direction("normal", part.normal), read.size("offset", part.offset)};
}
template <class S, class Read> Hull<S> shape_of(ShapeClass<Hull>, const ScenePart& part, const Read& read) {
  const std::uint32_t blob = read.hull(part);
  return {blob, read.size("radius", part.radius)};
}
template <class S, class Read> Mesh<S> shape_of(ShapeClass<Mesh>, const ScenePart& part, const Read& read) {
  return {read.mesh(part)};
}
template <class S, class Read>
HeightField<S> shape_of(ShapeClass<HeightField>, const ScenePart& part, const Read& read) {
  return {read.height_field(part)};
}
template <class S, class Read> Cylinder<S> shape_of(ShapeClass<Cylinder>, const ScenePart& part, const Read& read) {
  return {read.size("radius", part.radius), read.size("half_height", part.half_height)};
}
template <class S, class Read> Cone<S> shape_of(ShapeClass<Cone>, const ScenePart& part, const Read& read) {
  return {read.size("radius", part.radius), read.size("half_height", part.half_height)};
}

}  // namespace isostep::scenes
