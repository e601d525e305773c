// Bodies of queries.hpp.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/collision/narrowphase/collide.hpp"
#include "isostep/collision/query/closest_point.hpp"
#include "isostep/collision/query/ray_cast.hpp"
#include "isostep/core/stable_sort.hpp"
#include "isostep/dynamics/joints/joint_kinds.hpp"
#include "isostep/geometry/bounds.hpp"
#include "isostep/world/checks.hpp"
#include "isostep/world/queries.hpp"

namespace isostep {

template <class S> BodyId Queries<S>::id_of(std::uint32_t slot) const {
  return state_.body_slots.template id_of<BodyId>(slot);
}
/// Of the body's origin.
template <class S> Pose<S> Queries<S>::pose_of(std::uint32_t slot) const {
  const Location at = map_.location(slot);
  return BodyMap<S>::origin_pose(map_.state_at(at), map_.properties_at(at));
}

template <class S> bool Queries<S>::sees(const QueryFilter& filter, std::uint32_t slot) const {
  const BodyProperties<S>& body = map_.properties_at(map_.location(slot));
  const bool ignored = filter.ignore && id_of(slot) == filter.ignore;
  return (body.filter.category & filter.mask) != 0 && !ignored &&
         (filter.sensors || (body.flags & body_flag::kSensor) == 0);
}

// ---- rays

template <class S> bool Queries<S>::accept_ray(const char* name, Vec3<S> origin, Vec3<S> translation) const {
  return journal_.accept_call(name, detail::Checklist()
                                        .also(detail::fault_of_place(origin, "origin"))
                                        .also(detail::fault_of_place(translation, "translation"))
                                        .report());
}

/// The first hit of a body's parts, no further than `most` of the translation.
template <class S>
std::optional<RayCastHit<S>> Queries<S>::hit_of(std::uint32_t slot, Vec3<S> origin, Vec3<S> translation, S most) const {
  const BodyProperties<S>& body = map_.properties_at(map_.location(slot));
  const Transform<S> placed = Transform<S>::of(pose_of(slot));
  std::optional<RayCastHit<S>> first;
  for (const Child<S>& child : map_.children_of(body.shape)) {
    RayHit<S> hit;
    const Transform<S> at = compose(placed, Transform<S>::of(child.pose));
    const S reach = first ? first->fraction : most;
    if (!ray_cast(map_.contents().view(child.primitive), at, origin, translation, reach, hit)) continue;
    if (first && !(hit.fraction < first->fraction)) continue;
    first = RayCastHit<S>{id_of(slot), origin + translation * hit.fraction, hit.normal, hit.fraction};
  }
  return first;
}

template <class S>
std::optional<RayCastHit<S>> Queries<S>::cast_ray(Vec3<S> origin, Vec3<S> translation, QueryFilter filter) const {
  if (!accept_ray("cast_ray", origin, translation)) return {};
  std::optional<RayCastHit<S>> best;
  const Sweep<S> sweep = {origin, translation, Vec3<S>::zero(), Unit<S>(1)};
  proxies_.tree().sweep(sweep, [&](std::uint32_t slot, Unit<S> max_fraction) {
    if (!sees(filter, slot)) return max_fraction;
    const std::optional<RayCastHit<S>> hit = hit_of(slot, origin, translation, best ? best->fraction : S(1));
    if (hit &&
        (!best || hit->fraction < best->fraction || (hit->fraction == best->fraction && slot < best->body.slot))) {
      best = hit;
    }
    return best ? min(max_fraction, convert<Unit<S>>(best->fraction)) : max_fraction;
  });
  return best;
}

namespace detail {
struct BySlot {
  ISO_INLINE std::uint64_t operator()(BodyId body) const { return body.slot; }
};
struct BySlotOfHit {
  template <class S> ISO_INLINE std::uint64_t operator()(const RayCastHit<S>& hit) const { return hit.body.slot; }
};
/// Fractions are not negative, so their bits ascend as they do; but for a zero that has a sign.
struct ByFraction {
  template <class S> ISO_INLINE std::uint64_t operator()(const RayCastHit<S>& hit) const {
    return hit.fraction == S(0) ? 0 : static_cast<std::uint64_t>(field_bits(hit.fraction));
  }
};
}  // namespace detail

template <class S>
void Queries<S>::cast_ray_all(Vec3<S> origin, Vec3<S> translation, std::vector<RayCastHit<S>>& out,
                              QueryFilter filter) const {
  if (!accept_ray("cast_ray_all", origin, translation)) return;
  const std::size_t first = out.size();
  const Sweep<S> sweep = {origin, translation, Vec3<S>::zero(), Unit<S>(1)};
  proxies_.tree().sweep(sweep, [&](std::uint32_t slot, Unit<S> max_fraction) {
    if (!sees(filter, slot)) return max_fraction;
    if (const std::optional<RayCastHit<S>> hit = hit_of(slot, origin, translation, S(1))) out.push_back(*hit);
    return max_fraction;
  });
  const auto count = static_cast<std::uint32_t>(out.size() - first);
  std::vector<RayCastHit<S>> scratch(count);
  stable_sort(out.data() + first, scratch.data(), count, detail::BySlotOfHit{});
  stable_sort(out.data() + first, scratch.data(), count, detail::ByFraction{});
}

// ---- distances and overlaps

template <class S>
std::optional<ClosestBody<S>> Queries<S>::closest_point(Vec3<S> point, S max_distance, QueryFilter filter) const {
  const S edge = Limits<S>::position();
  if (!journal_.accept_call("closest_point", detail::Checklist()
                                                 .also(detail::fault_of_place(point, "point"))
                                                 .finite(max_distance, "max_distance")
                                                 .proper(S(0) <= max_distance, "max_distance", "0 or more")
                                                 .report()))
    return {};
  std::optional<ClosestBody<S>> best;
  const S reach = min(max_distance, edge);
  proxies_.tree().query(Aabb<S>::around(point, {reach, reach, reach}), [&](std::uint32_t slot) {
    if (!sees(filter, slot)) return true;
    const Transform<S> placed = Transform<S>::of(pose_of(slot));
    for (const Child<S>& child : map_.children_of(map_.properties_at(map_.location(slot)).shape)) {
      const ClosestPoint<S> found = isostep::closest_point(map_.contents().view(child.primitive),
                                                           compose(placed, Transform<S>::of(child.pose)), point);
      if (max_distance < found.distance) continue;
      const bool nearer =
          !best || found.distance < best->distance || (found.distance == best->distance && slot < best->body.slot);
      if (nearer) best = ClosestBody<S>{id_of(slot), found.point, found.normal, found.distance};
    }
    return true;
  });
  return best;
}

template <class S> bool Queries<S>::accept_shape(const Primitive<S>& shape, const Pose<S>& pose) const {
  const Child<S> part = {shape, Pose<S>::identity()};
  const ShapeFault of_shape = validate(std::span<const Child<S>>(&part, 1)), of_pose = validate(pose);
  const auto kind = [](ShapeFault f) { return f == ShapeFault::not_finite ? Fault::not_finite : Fault::bad_shape; };
  return journal_.accept_call("overlap_shape",
                              detail::Checklist()
                                  .ask(of_shape == ShapeFault::none, kind(of_shape), describe(of_shape), "")
                                  .ask(of_pose == ShapeFault::none, kind(of_pose), describe(of_pose), "")
                                  .report());
}

template <class S>
void Queries<S>::overlap_shape(const Primitive<S>& shape, const Pose<S>& pose, std::vector<BodyId>& out,
                               QueryFilter filter) const {
  if (!accept_shape(shape, pose)) return;
  std::vector<std::uint64_t> found;
  proxies_.tree().query(bounds(shape, Transform<S>::of(pose)), [&](std::uint32_t slot) {
    if (!sees(filter, slot)) return true;
    Pose<S> placed = pose_of(slot);
    placed.position -= pose.position;  // relative, as the narrow phase wants it
    const Transform<S> here = Transform<S>::of({Vec3<S>::zero(), pose.orientation}), there = Transform<S>::of(placed);
    for (const Child<S>& child : map_.children_of(map_.properties_at(map_.location(slot)).shape)) {
      Manifold<S> manifold;
      collide(shape, here, map_.contents().view(child.primitive), compose(there, Transform<S>::of(child.pose)), S(0),
              manifold);
      if (manifold.count == 0) continue;
      found.push_back(slot);
      break;
    }
    return true;
  });
  std::vector<std::uint64_t> scratch(found.size());
  stable_sort(found.data(), scratch.data(), static_cast<std::uint32_t>(found.size()), OwnKey{});
  for (const std::uint64_t slot : found) out.push_back(id_of(static_cast<std::uint32_t>(slot)));
}

template <class S> bool Queries<S>::accept_box(const Aabb<S>& box) const {
  const S edge = Limits<S>::position() + Limits<S>::position();
  return journal_.accept_call(
      "overlap_aabb",
      detail::Checklist()
          .finite(box.low, "box.low")
          .finite(box.high, "box.high")
          .in_range(detail::within(box.low, edge), "box.low", "coordinates up to 2 Limits::position()")
          .in_range(detail::within(box.high, edge), "box.high", "coordinates up to 2 Limits::position()")
          .report());
}

template <class S>
void Queries<S>::overlap_aabb(const Aabb<S>& box, std::vector<BodyId>& out, QueryFilter filter) const {
  if (!accept_box(box)) return;
  const std::size_t first = out.size();
  proxies_.tree().query(box, [&](std::uint32_t slot) {
    if (sees(filter, slot)) out.push_back(id_of(slot));
    return true;
  });
  const auto count = static_cast<std::uint32_t>(out.size() - first);
  if (count <= kInsertionSortLimit) return insertion_sort(out.data() + first, count, detail::BySlot{});
  std::vector<BodyId> scratch(count);
  stable_sort(out.data() + first, scratch.data(), count, detail::BySlot{});
}

// ---- joints

template <class S> S Queries<S>::joint_error(JointId joint) const {
  const JointProperties<S>* properties = map_.properties_of(joint);
  if (properties == nullptr) return S(0);
  const Pose<S> a = compose(map_.centre_pose_at(properties->body_a), properties->frame_a);
  const Pose<S> b = compose(map_.centre_pose_at(properties->body_b), properties->frame_b);
  return visit_joint_type(properties->type, [&](auto kind) ISO_INLINE_LAMBDA {
    return decltype(kind)::template Of<S>::error(*properties, a, b);
  });
}

}  // namespace isostep
