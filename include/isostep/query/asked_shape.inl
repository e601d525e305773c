// Bodies of asked_shape.hpp.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/dynamics/checks.hpp"
#include "isostep/geometry/bounds.hpp"
#include "isostep/math/rotations.hpp"
#include "isostep/query/asked_shape.hpp"

namespace isostep::detail {

template <class S>
FaultReport fault_of_shape(const WorldState<S>& state, const QueryShape<S>& shape, const Pose<S>& pose) {
  const auto kind = [](ShapeFault f) { return f == ShapeFault::not_finite ? Fault::not_finite : Fault::bad_shape; };
  const ShapeFault of_pose = validate(pose);
  const bool turned = of_pose == ShapeFault::orientation_not_unit;
  const FaultReport bad_pose = {kind(of_pose), "", turned ? "pose.orientation" : "pose", expected_of(of_pose)};
  if (shape.of_world) {
    const FaultReport of_id = fault_of_id(state.shape_slots, shape.id, state.settings.id_space, "shape");
    if (of_id != Fault::none) return of_id;
    const std::span<const Child<S>> children = state.shapes[shape.id.slot]->children;
    if (children.size() != 1 || is_surface(children[0].primitive.type))
      return {Fault::bad_shape, "", "shape", "one convex part"};
  } else {
    const Child<S> part = {shape.primitive, Pose<S>::identity()};
    FaultReport of_shape = report_of(find_fault(std::span<const Child<S>>(&part, 1)));
    of_shape.child = FaultReport::kNoChild;  // it has one alone
    if (of_shape.fault != Fault::none) return of_shape;
  }
  return of_pose == ShapeFault::none ? FaultReport{} : bad_pose;
}

template <class S> AskedShape<S> asked_of(const BodyMap<S>& map, const QueryShape<S>& shape, const Pose<S>& pose) {
  if (!shape.of_world) return {shape.primitive, nullptr, pose};
  const Child<S>& part = map.shapes.children_of(shape.id.slot)[0];
  return {part.primitive, map.shapes.contents().view(part.primitive).content,
          part.pose.is_identity() ? pose : compose(pose, part.pose)};
}

/// Uses the box of the shape in a frame whose y is that direction.
template <class S>
S reach_of(const BodyMap<S>& map, ShapeId shape, const Quat<Unit<S>>& orientation, Vec3<Unit<S>> along) {
  const Vec3<Unit<S>> y = {Unit<S>(0), Unit<S>(1), Unit<S>(0)};
  const Quat<Unit<S>> turned = rotation_between(along, y) * orientation;
  return bounds(asked_of<S>(map, shape, {Vec3<S>::zero(), turned}).view(), Transform<S>::of({Vec3<S>::zero(), turned}))
      .high.y;
}

}  // namespace isostep::detail
