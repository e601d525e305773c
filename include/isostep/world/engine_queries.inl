// WorldEngine: questions about space, and poses for drawing.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/collision/narrowphase/collide.hpp"
#include "isostep/collision/query/closest_point.hpp"
#include "isostep/collision/query/ray_cast.hpp"
#include "isostep/core/stable_sort.hpp"
#include "isostep/geometry/bounds.hpp"
#include "isostep/world/engine.hpp"

namespace isostep {

template <class S> bool WorldEngine<S>::sees(const QueryFilter& filter, std::uint32_t slot) const {
  const BodyProperties<S>& body = properties_at(locations_[slot]);
  const bool ignored = filter.ignore && state_.body_slots.template id_of<BodyId>(slot) == filter.ignore;
  return (body.filter.category & filter.mask) != 0 && !ignored &&
         (filter.sensors || (body.flags & body_flag::kSensor) == 0);
}

/// The first hit of a body's parts, no further than `most` of the translation.
template <class S>
std::optional<RayCastHit<S>> WorldEngine<S>::hit_of(std::uint32_t slot, Vec3<S> origin, Vec3<S> translation,
                                                    S most) const {
  const BodyProperties<S>& body = properties_at(locations_[slot]);
  const Transform<S> placed = Transform<S>::of(origin_pose(state_at(locations_[slot]), body));
  std::optional<RayCastHit<S>> first;
  for (const Child<S>& child : children_of(body.shape)) {
    RayHit<S> hit;
    const Transform<S> at = compose(placed, Transform<S>::of(child.pose));
    if (!ray_cast(child.primitive, at, origin, translation, first ? first->fraction : most, hit)) continue;
    if (first && !(hit.fraction < first->fraction)) continue;
    first = RayCastHit<S>{state_.body_slots.template id_of<BodyId>(slot), origin + translation * hit.fraction,
                          hit.normal, hit.fraction};
  }
  return first;
}

template <class S>
std::optional<RayCastHit<S>> WorldEngine<S>::cast_ray(Vec3<S> origin, Vec3<S> translation, QueryFilter filter) const {
  if (!journal_.accept_call("cast_ray", detail::Checklist()
                                            .also(detail::fault_of_place(origin, "origin"))
                                            .also(detail::fault_of_place(translation, "translation"))
                                            .report()))
    return {};
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
struct BySlotOfHit {
  template <class S> ISO_INLINE std::uint64_t operator()(const RayCastHit<S>& hit) const { return hit.body.slot; }
};
/// Fractions are not negative, so their bits ascend as they do; but for a zero that has a sign.
struct ByFraction {
  template <class S> ISO_INLINE std::uint64_t operator()(const RayCastHit<S>& hit) const {
    return hit.fraction == S(0) ? 0 : static_cast<std::uint64_t>(leaf_bits(hit.fraction));
  }
};
}  // namespace detail

template <class S>
void WorldEngine<S>::cast_ray_all(Vec3<S> origin, Vec3<S> translation, std::vector<RayCastHit<S>>& out,
                                  QueryFilter filter) const {
  if (!journal_.accept_call("cast_ray_all", detail::Checklist()
                                                .also(detail::fault_of_place(origin, "origin"))
                                                .also(detail::fault_of_place(translation, "translation"))
                                                .report()))
    return;
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

template <class S>
std::optional<ClosestBody<S>> WorldEngine<S>::closest(Vec3<S> point, S max_distance, QueryFilter filter) const {
  const S edge = Limits<S>::position();
  if (!journal_.accept_call("closest", detail::Checklist()
                                           .also(detail::fault_of_place(point, "point"))
                                           .finite(max_distance, "max_distance")
                                           .proper(S(0) <= max_distance, "max_distance", "0 or more")
                                           .report()))
    return {};
  std::optional<ClosestBody<S>> best;
  const S reach = min(max_distance, edge);
  proxies_.tree().query(Aabb<S>::around(point, {reach, reach, reach}), [&](std::uint32_t slot) {
    const BodyProperties<S>& body = properties_at(locations_[slot]);
    if (!sees(filter, slot)) return true;
    const Transform<S> placed = Transform<S>::of(origin_pose(state_at(locations_[slot]), body));
    for (const Child<S>& child : children_of(body.shape)) {
      const ClosestPoint<S> found =
          closest_point(child.primitive, compose(placed, Transform<S>::of(child.pose)), point);
      if (max_distance < found.distance) continue;
      const bool nearer =
          !best || found.distance < best->distance || (found.distance == best->distance && slot < best->body.slot);
      if (nearer)
        best =
            ClosestBody<S>{state_.body_slots.template id_of<BodyId>(slot), found.point, found.normal, found.distance};
    }
    return true;
  });
  return best;
}

template <class S>
void WorldEngine<S>::overlapping(const Primitive<S>& shape, const Pose<S>& pose, std::vector<BodyId>& out,
                                 QueryFilter filter) const {
  const ShapeFault of_shape = validate(shape), of_pose = validate(pose);
  const auto kind = [](ShapeFault f) { return f == ShapeFault::not_finite ? Fault::not_finite : Fault::bad_shape; };
  if (!journal_.accept_call("overlapping",
                            detail::Checklist()
                                .ask(of_shape == ShapeFault::none, kind(of_shape), describe(of_shape), "")
                                .ask(of_pose == ShapeFault::none, kind(of_pose), describe(of_pose), "")
                                .report()))
    return;
  std::vector<std::uint64_t> found;
  proxies_.tree().query(bounds(shape, Transform<S>::of(pose)), [&](std::uint32_t slot) {
    const BodyProperties<S>& body = properties_at(locations_[slot]);
    if (!sees(filter, slot)) return true;
    Pose<S> placed = origin_pose(state_at(locations_[slot]), body);
    placed.position -= pose.position;  // relative, as the narrow phase wants it
    const Transform<S> here = Transform<S>::of({Vec3<S>::zero(), pose.orientation}), there = Transform<S>::of(placed);
    for (const Child<S>& child : children_of(body.shape)) {
      Manifold<S> manifold;
      collide(shape, here, child.primitive, compose(there, Transform<S>::of(child.pose)), S(0), manifold);
      if (manifold.count == 0) continue;
      found.push_back(slot);
      break;
    }
    return true;
  });
  std::vector<std::uint64_t> scratch(found.size());
  stable_sort(found.data(), scratch.data(), static_cast<std::uint32_t>(found.size()), OwnKey{});
  for (const std::uint64_t slot : found)
    out.push_back(state_.body_slots.template id_of<BodyId>(static_cast<std::uint32_t>(slot)));
}

namespace detail {
struct BySlot {
  ISO_INLINE std::uint64_t operator()(BodyId body) const { return body.slot; }
};
}  // namespace detail

template <class S>
void WorldEngine<S>::bodies_near(const Aabb<S>& box, std::vector<BodyId>& out, QueryFilter filter) const {
  const S edge = Limits<S>::position() + Limits<S>::position();
  if (!journal_.accept_call(
          "bodies_near",
          detail::Checklist()
              .finite(box.low, "box.low")
              .finite(box.high, "box.high")
              .in_range(detail::within(box.low, edge), "box.low", "coordinates up to 2 Limits::position()")
              .in_range(detail::within(box.high, edge), "box.high", "coordinates up to 2 Limits::position()")
              .report()))
    return;
  const std::size_t first = out.size();
  proxies_.tree().query(box, [&](std::uint32_t slot) {
    if (sees(filter, slot)) out.push_back(state_.body_slots.template id_of<BodyId>(slot));
    return true;
  });
  const auto count = static_cast<std::uint32_t>(out.size() - first);
  if (count <= kInsertionSortLimit) return insertion_sort(out.data() + first, count, detail::BySlot{});
  std::vector<BodyId> scratch(count);
  stable_sort(out.data() + first, scratch.data(), count, detail::BySlot{});
}

/// Positions by straight line, orientations by normalised straight line between the start and the end of the last step.
template <class S> void WorldEngine<S>::fill_render_poses(float alpha) {
  render_poses_.clear();
  const auto number = [](auto x) { return static_cast<float>(to_double(x)); };
  const auto add = [&](const BodyState<S>& state, const BodyProperties<S>& body, const Pose<S>* start) {
    const Pose<S> now = origin_pose(state, body);
    BodyState<S> then_state = state;
    if (start != nullptr) {
      then_state.centre = start->position;
      then_state.orientation = start->orientation;
    }
    const Pose<S> then = origin_pose(then_state, body);
    const auto blend = [&](auto from, auto to) { return number(from) + alpha * (number(to) - number(from)); };
    const Quat<Unit<S>> p = then.orientation, q = now.orientation;
    const float sign =
        number(p.x) * number(q.x) + number(p.y) * number(q.y) + number(p.z) * number(q.z) + number(p.w) * number(q.w) <
                0
            ? -1.0f
            : 1.0f;
    const auto turn = [&](auto from, auto to) {
      return sign * number(from) + alpha * (number(to) - sign * number(from));
    };
    RenderPose pose = {state_.body_slots.template id_of<BodyId>(state.slot),
                       {blend(then.position.x, now.position.x), blend(then.position.y, now.position.y),
                        blend(then.position.z, now.position.z)},
                       {turn(p.x, q.x), turn(p.y, q.y), turn(p.z, q.z), turn(p.w, q.w)}};
    float* o = pose.orientation;
    const float size = sqrt(o[0] * o[0] + o[1] * o[1] + o[2] * o[2] + o[3] * o[3]);
    for (int i = 0; i < 4; ++i) o[i] /= size;
    render_poses_.push_back(pose);
  };
  // A body created or woken since the last step has no earlier pose and is drawn where it is. Both lists ascend.
  std::size_t start = 0;
  for (std::size_t i = 0; i < state_.awake.states.size(); ++i) {
    const std::uint32_t slot = state_.awake.states[i].slot;
    while (start < start_slots_.size() && start_slots_[start] < slot) ++start;
    const bool known = start < start_slots_.size() && start_slots_[start] == slot;
    add(state_.awake.states[i], state_.awake.properties[i], known ? &start_poses_[start] : nullptr);
  }
  for (const std::shared_ptr<const FrozenIsland<S>>& island : state_.frozen) {
    for (std::size_t i = 0; i < island->bodies.states.size(); ++i)
      add(island->bodies.states[i], island->bodies.properties[i], nullptr);
  }
}

}  // namespace isostep
