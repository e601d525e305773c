// Bodies of cast_queries.hpp: rays, and shapes that are cast.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/collision/narrowphase/shape_core.hpp"
#include "isostep/dynamics/checks.hpp"
#include "isostep/dynamics/solvers/schedule.hpp"
#include "isostep/geometry/bounds.hpp"
#include "isostep/query/asked_shape.hpp"
#include "isostep/query/cast_queries.hpp"
#include "isostep/query/hit_list.hpp"
#include "isostep/query/query_probes.hpp"

namespace isostep {

/// Gathers all that a probe meets, body by body, those in its way first.
template <class S>
template <class Probe, class List>
void CastQueries<S>::gather(const Probe& probe, const QueryFilter& filter, List& list) const {
  proxies_.boxes().sweep(probe.sweep(), [&](std::uint32_t slot, Unit<S> most) {
    if (!sight_.sees(filter, slot)) return most;
    meet(probe, filter, slot, list);
    return min(most, probe.beyond(list.latest()));
  });
}

/// Gathers the hits of a body: of each triangle, of each child, or the first of all. If `own` is not null, only parts
/// that collide with it count.
template <class S>
template <class Probe, class List>
void CastQueries<S>::meet(const Probe& probe, const QueryFilter& filter, std::uint32_t slot, List& list,
                          const Filter* own) const {
  const Transform<S> placed = Transform<S>::of(map_.origin_pose_at(slot));
  const BodyProperties<S>& properties = map_.properties_at(map_.location(slot));
  const std::uint32_t shape = properties.shape;
  const bool traits = map_.shapes.traits_of(shape).flags != 0;
  const std::span<const Child<S>> children = map_.shapes.children_of(shape);
  const BodyId body = sight_.id_of(slot);
  typename Probe::Hit first = {};
  const auto latest = [&] { return first.body ? min(first.fraction, list.latest()) : list.latest(); };
  const auto passes = [&](const PartTraits<S>& part) {
    return !sight_.sees_part(filter, properties, part) ||
           (own != nullptr && !should_collide(*own, part.filter_or(properties.filter)));
  };
  const auto meet_child = [&](std::uint32_t i) {
    if (traits && passes(children[i].traits)) return;
    const ShapeView<S> part = map_.shapes.contents().view(children[i].primitive);
    const bool is_placed = children[i].pose.is_identity();
    const Transform<S> at = is_placed ? placed : compose(placed, Transform<S>::of(children[i].pose));
    if (filter.per == HitPer::triangle) {
      detail::PartSink<Probe, List> sink = {probe, list, body, i};
      return probe.all(part, at, list.latest(), sink);
    }
    typename Probe::PartHit found;
    if (!probe.first(part, at, latest(), found)) return;
    const typename Probe::Hit hit = probe.hit_of(body, i, found);
    if (filter.per == HitPer::child) list.add(hit);
    else if (!first.body || detail::comes_before(hit, first)) first = hit;
  };
  if (const ChildTree<S>* const tree = map_.shapes.tree_of(shape)) {
    tree->sweep(placed, probe.sweep(), [&](std::uint32_t i, Unit<S> most) {
      meet_child(i);
      return min(most, probe.beyond(latest()));
    });
  } else {
    for (std::uint32_t i = 0; i < children.size(); ++i) meet_child(i);
  }
  if (first.body) list.add(first);
}

// ---- rays

template <class S> FaultReport CastQueries<S>::fault_of_ray(Vec3<S> origin, Vec3<S> translation) {
  return detail::Checklist()
      .also(detail::fault_of_place(origin, "origin"))
      .also(detail::fault_of_place(translation, "translation"))
      .proper(!(translation == Vec3<S>::zero()), "translation", "a length above 0")
      .report();
}
template <class S>
std::optional<RayCastHit<S>> CastQueries<S>::cast_ray(Vec3<S> origin, Vec3<S> translation,
                                                      const QueryFilter& filter) const {
  RayCastHit<S> hit;
  if (!faults_.accept_call("cast_ray", fault_of_ray(origin, translation))) return {};
  detail::NearestHits<S, S> list({&hit, 1});
  gather(detail::RayProbe<S>(origin, translation, filter), filter, list);
  return list.count() == 0 ? std::optional<RayCastHit<S>>{} : hit;
}
template <class S>
void CastQueries<S>::cast_ray_all(Vec3<S> origin, Vec3<S> translation, std::vector<RayCastHit<S>>& out,
                                  const QueryFilter& filter) const {
  if (!faults_.accept_call("cast_ray_all", fault_of_ray(origin, translation))) return;
  detail::EveryHit<S, S> list(out);
  gather(detail::RayProbe<S>(origin, translation, filter), filter, list);
  list.sort();
}
template <class S>
std::size_t CastQueries<S>::cast_ray_all(Vec3<S> origin, Vec3<S> translation, std::span<RayCastHit<S>> out,
                                         const QueryFilter& filter) const {
  if (!faults_.accept_call("cast_ray_all", fault_of_ray(origin, translation))) return 0;
  detail::NearestHits<S, S> list(out);
  gather(detail::RayProbe<S>(origin, translation, filter), filter, list);
  return list.count();
}

// ---- casts

template <class S> FaultReport CastQueries<S>::fault_of_cast(const ShapeCast<S>& cast) const {
  const FaultReport of_shape = detail::fault_of_shape(state_, cast.shape, cast.pose);
  if (of_shape != Fault::none) return of_shape;
  return detail::Checklist()
      .ask(is_bounded(detail::asked_of(map_, cast.shape, cast.pose).primitive.type), Fault::bad_shape, "shape",
           "one with an end")
      .also(detail::fault_of_place(cast.pose.position, "pose.position"))
      .also(detail::fault_of_place(cast.translation, "translation"))
      .report();
}
/// Calls visit(probe) for an accepted cast. Bodies at rest overlap by up to kDeepOverlap: that counts as touching.
template <class S>
template <class Visit>
void CastQueries<S>::visit_cast(const ShapeCast<S>& cast, const Visit& visit) const {
  const detail::AskedShape<S> asked = detail::asked_of(map_, cast.shape, cast.pose);
  const Transform<S> start = Transform<S>::of(asked.pose);
  const QueryFilter& filter = cast.filter;
  visit_shape(asked.view(), [&](const auto& shape) ISO_INLINE_LAMBDA {
    if constexpr (kIsSolid<std::remove_cvref_t<decltype(shape)>>) {
      const ShapeCore<S> core(shape, S(0));
      const S touch = min(detail::kDeepOverlap<S>, shape.inner_radius() * S(0.25));
      const SolidCast<S> solid = {core.core(),
                                  start,
                                  {cast.translation, Unit<S>(1), touch},
                                  filter.back_faces,
                                  filter.start_inside == StartInside::ignore};
      visit(detail::CastProbe<S>(solid, shape.bounds(start)));
    }
  });
}
template <class S> template <class List> void CastQueries<S>::gather_cast(const ShapeCast<S>& cast, List& list) const {
  visit_cast(cast, [&](const auto& probe) { gather(probe, cast.filter, list); });
}
template <class S> std::optional<ShapeCastHit<S>> CastQueries<S>::cast_shape(const ShapeCast<S>& cast) const {
  ShapeCastHit<S> hit;
  if (!faults_.accept_call("cast_shape", fault_of_cast(cast))) return {};
  detail::NearestHits<S, Unit<S>> list({&hit, 1});
  gather_cast(cast, list);
  return list.count() == 0 ? std::optional<ShapeCastHit<S>>{} : hit;
}
template <class S>
void CastQueries<S>::cast_shape_all(const ShapeCast<S>& cast, std::vector<ShapeCastHit<S>>& out) const {
  if (!faults_.accept_call("cast_shape_all", fault_of_cast(cast))) return;
  detail::EveryHit<S, Unit<S>> list(out);
  gather_cast(cast, list);
  list.sort();
}
template <class S>
std::size_t CastQueries<S>::cast_shape_all(const ShapeCast<S>& cast, std::span<ShapeCastHit<S>> out) const {
  if (!faults_.accept_call("cast_shape_all", fault_of_cast(cast))) return 0;
  detail::NearestHits<S, Unit<S>> list(out);
  gather_cast(cast, list);
  return list.count();
}

// ---- among what is known to be near

template <class S>
void CastQueries<S>::find_near(const Aabb<S>& box, const QueryFilter& filter, std::vector<std::uint32_t>& out) const {
  proxies_.boxes().query(box, [&](std::uint32_t slot) {
    if (sight_.sees(filter, slot)) out.push_back(slot);
    return true;
  });
}
template <class S>
template <class Probe, class List>
void CastQueries<S>::meet_among(const Probe& probe, const QueryFilter& filter, std::span<const std::uint32_t> slot_list,
                                const Aabb<S>& box, const Filter& own, List& list) const {
  for (const std::uint32_t slot : slot_list) {
    if (overlap(map_.state_at(map_.location(slot)).fat, box)) meet(probe, filter, slot, list, &own);
  }
}
template <class S>
std::size_t CastQueries<S>::cast_among(std::span<const std::uint32_t> slot_list, const Aabb<S>& box, const Filter& own,
                                       const ShapeCast<S>& cast, std::span<ShapeCastHit<S>> out) const {
  detail::NearestHits<S, Unit<S>> list(out);
  visit_cast(cast, [&](const auto& probe) { meet_among(probe, cast.filter, slot_list, box, own, list); });
  return list.count();
}
template <class S>
std::size_t CastQueries<S>::ray_among(std::span<const std::uint32_t> slot_list, const Aabb<S>& box, const Filter& own,
                                      const RayCast<S>& ray, std::span<RayCastHit<S>> out) const {
  detail::NearestHits<S, S> list(out);
  meet_among(detail::RayProbe<S>(ray.origin, ray.translation, ray.filter), ray.filter, slot_list, box, own, list);
  return list.count();
}

}  // namespace isostep
