// place_of: finds in a world the bodies and joints that a record names.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/dynamics/joints/joint_coordinate.hpp"
#include "isostep/dynamics/records/record_rules.hpp"

namespace isostep::detail {

template <class S> ISO_INLINE JointSeen<S> seen(const JointProperties<S>* joint) {
  if (joint == nullptr) return {};
  return {joint, has_coordinate(joint->type), measure_of(joint->type)};
}

/// Finds what a record names, by body(id) and joint(id), null for a null id, and children_of(shape's slot).
template <class S, class Record, class Body, class Joint, class Children>
ISO_INLINE RecordPlace<S> place_of(const Record& record, const Settings<S>& settings, const Body& body,
                                   const Joint& joint, const Children& children_of) {
  RecordPlace<S> place = {settings, {}, {}, {}};
  const NamedBodies<S> bodies = bodies_of(record);
  for (int i = 0; i < bodies.count; ++i) place.bodies[i] = body(bodies.all[i].body);
  if (place.bodies[0] != nullptr) place.parts = children_of(place.bodies[0]->shape);
  const NamedJoints joints = joints_of(record);
  for (int i = 0; i < joints.count; ++i) place.joints[i] = seen(joint(joints.all[i]));
  return place;
}

}  // namespace isostep::detail
