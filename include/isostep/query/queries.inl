// Bodies of queries.hpp.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/collision/query/closest_point.hpp"
#include "isostep/core/stable_sort.hpp"
#include "isostep/dynamics/checks.hpp"
#include "isostep/dynamics/joints/joint_coordinate.hpp"
#include "isostep/query/queries.hpp"
#include "isostep/query/query_batches.inl"
#include "isostep/query/query_casts.inl"
#include "isostep/query/query_overlaps.inl"

namespace isostep {

template <class S> BodyId Queries<S>::id_of(std::uint32_t slot) const {
  return state_.body_slots.template id_of<BodyId>(slot);
}

template <class S> bool Queries<S>::sees(const QueryFilter& filter, std::uint32_t slot) const {
  const BodyProperties<S>& body = map_.properties_at(map_.location(slot));
  for (const BodyId unseen : filter.ignore_all) {
    if (unseen && id_of(slot) == unseen) return false;
  }
  if (filter.ignore && id_of(slot) == filter.ignore) return false;
  const bool senses = (body.flags & body_flag::kSensor) != 0;
  if (map_.shapes.traits_of(body.shape).flags == 0) return sees(filter, body.filter, body.material.kind, senses);
  for (const Child<S>& child : map_.shapes.children_of(body.shape)) {
    if (sees_part(filter, body, child.traits)) return true;
  }
  return false;
}
/// Of a body that is not ignored by its id.
template <class S>
bool Queries<S>::sees_part(const QueryFilter& filter, const BodyProperties<S>& body, const PartTraits<S>& part) const {
  return sees(filter, part.filter_or(body.filter), part.material_or(body.material).kind,
              (body.flags & body_flag::kSensor) != 0 || part.has(part_flag::kSensor));
}
template <class S> bool Queries<S>::sees(const QueryFilter& filter, const Filter& of, std::uint32_t kind, bool senses) {
  for (const std::uint32_t ignored : filter.ignore_kinds) {
    if (ignored == kind) return false;
  }
  const bool grouped = filter.group != 0 && filter.group == of.group;
  return (of.category & filter.mask) != 0 && !grouped && (filter.sensors || !senses);
}

template <class S>
std::optional<ClosestBody<S>> Queries<S>::closest_point(Vec3<S> point, S max_distance,
                                                        const QueryFilter& filter) const {
  const S edge = Limits<S>::position();
  if (!faults_.accept_call("closest_point", detail::Checklist()
                                                .also(detail::fault_of_place(point, "point"))
                                                .finite(max_distance, "max_distance")
                                                .proper(S(0) <= max_distance, "max_distance", "0 or more")
                                                .report()))
    return {};
  std::optional<ClosestBody<S>> best;
  const S reach = min(max_distance, edge);
  proxies_.boxes().query(Aabb<S>::around(point, {reach, reach, reach}), [&](std::uint32_t slot) {
    if (!sees(filter, slot)) return true;
    const Transform<S> placed = Transform<S>::of(map_.origin_pose_at(slot));
    const BodyProperties<S>& body = map_.properties_at(map_.location(slot));
    const std::span<const Child<S>> children = map_.shapes.children_of(body.shape);
    const bool traits = map_.shapes.traits_of(body.shape).flags != 0;
    for (std::uint32_t i = 0; i < children.size(); ++i) {
      const Child<S>& child = children[i];
      if (traits && !sees_part(filter, body, child.traits)) continue;
      const ClosestPoint<S> found = isostep::closest_point(map_.shapes.contents().view(child.primitive),
                                                           compose(placed, Transform<S>::of(child.pose)), point);
      if (max_distance < found.distance) continue;
      const bool nearer =
          !best || found.distance < best->distance || (found.distance == best->distance && slot < best->body.slot);
      if (nearer) best = ClosestBody<S>{id_of(slot), i, found.point, found.normal, found.distance};
    }
    return true;
  });
  return best;
}

template <class S> bool Queries<S>::accept_box(const Aabb<S>& box) const {
  const S edge = Limits<S>::position() + Limits<S>::position();
  return faults_.accept_call(
      "overlap_aabb",
      detail::Checklist()
          .finite(box.low, "box.low")
          .finite(box.high, "box.high")
          .in_range(detail::within(box.low, edge), "box.low", "coordinates up to 2 Limits::position()")
          .in_range(detail::within(box.high, edge), "box.high", "coordinates up to 2 Limits::position()")
          .proper(min(box.low, box.high) == box.low, "box.low", "no coordinate above one of box.high")
          .report());
}

template <class S>
void Queries<S>::overlap_aabb(const Aabb<S>& box, std::vector<BodyId>& out, const QueryFilter& filter) const {
  if (!accept_box(box)) return;
  const std::size_t first = out.size();
  proxies_.boxes().query(box, [&](std::uint32_t slot) {
    if (sees(filter, slot)) out.push_back(id_of(slot));
    return true;
  });
  const auto count = static_cast<std::uint32_t>(out.size() - first);
  if (count <= kInsertionSortLimit) return insertion_sort(out.data() + first, count, detail::BySlotOfId{});
  std::vector<BodyId> scratch(count);
  stable_sort(out.data() + first, scratch.data(), count, detail::BySlotOfId{});
}

// ---- joints

template <class S> S Queries<S>::joint_error(JointId joint) const {
  const JointProperties<S>* properties = map_.joints.properties_of(joint);
  if (properties == nullptr) return S(0);
  const Pose<S> a = compose(map_.centre_pose_at(properties->body_a), properties->frame_a);
  const Pose<S> b = compose(map_.centre_pose_at(properties->body_b), properties->frame_b);
  return visit_joint_type(properties->type, [&](auto kind) ISO_INLINE_LAMBDA {
    return decltype(kind)::template Of<S>::error(*properties, a, b);
  });
}

namespace detail {
/// As they lie now; arms are not looked for.
template <class S> ISO_INLINE JointFrames<S> frames_of(const BodyMap<S>& map, const JointProperties<S>& joint) {
  const Pose<S> a = compose(map.centre_pose_at(joint.body_a), joint.frame_a);
  const Pose<S> b = compose(map.centre_pose_at(joint.body_b), joint.frame_b);
  const Vec3<S> none = Vec3<S>::zero();
  return {none, none, b.position - a.position, a.orientation, b.orientation};
}
}  // namespace detail
template <class S> S Queries<S>::joint_position(JointId joint) const {
  const JointProperties<S>* properties = map_.joints.properties_of(joint);
  return properties == nullptr ? S(0) : detail::position_of(properties->type, detail::frames_of(map_, *properties));
}
template <class S> S Queries<S>::joint_position(JointId joint, JointAxis axis) const {
  const JointProperties<S>* properties = map_.joints.properties_of(joint);
  if (properties == nullptr || properties->type != JointType::six_axis) return S(0);
  const auto& drives = state_.records->axis_drives;
  const auto find = [&](JointAxis of) { return drives.find(detail::drive_on(*state_.records, joint, of)); };
  const bool swings = axis == JointAxis::swing_x || axis == JointAxis::swing_y;
  const int tilting =
      swings ? detail::tilting_swing(properties->flags, find(JointAxis::swing_x), find(JointAxis::swing_y)) : -1;
  return detail::position_of(axis, properties->flags, tilting, detail::frames_of(map_, *properties));
}

}  // namespace isostep

/// What games ask between steps.
#define ISO_INSTANTIATE_WORLD_QUERIES(S) ISO_QUERIES_OF(, S)
