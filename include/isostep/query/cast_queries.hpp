// CastQueries<S>: what rays and moving shapes meet.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "isostep/core/fault_log.hpp"
#include "isostep/core/instantiate.hpp"
#include "isostep/core/task_runner.hpp"
#include "isostep/query/query_sight.hpp"
#include "isostep/store/body_map.hpp"
#include "isostep/store/proxies.hpp"
#include "isostep/store/query_types.hpp"

namespace isostep {

/// Input:   the state, the body map and the broad phase, as the last step or command left them.
/// Output:  what World's calls of the same names return; the log holds the fault of a question that is refused.
/// Keeps:   nothing: any number of threads may ask at once, as long as no question is refused.
/// Files:   cast_queries.inl, single rays and casts; query_batches.inl, many at once.
template <class S> class CastQueries {
 public:
  ISO_INLINE CastQueries(const WorldState<S>& state, const BodyMap<S>& map, const Proxies<S>& proxies, FaultLog& faults)
      : state_(state), map_(map), proxies_(proxies), sight_(state, map), faults_(faults) {}

  std::optional<RayCastHit<S>> cast_ray(Vec3<S> origin, Vec3<S> translation, const QueryFilter& filter) const;
  void cast_ray_all(Vec3<S> origin, Vec3<S> translation, std::vector<RayCastHit<S>>& out,
                    const QueryFilter& filter) const;
  std::size_t cast_ray_all(Vec3<S> origin, Vec3<S> translation, std::span<RayCastHit<S>> out,
                           const QueryFilter& filter) const;
  std::optional<ShapeCastHit<S>> cast_shape(const ShapeCast<S>& cast) const;
  void cast_shape_all(const ShapeCast<S>& cast, std::vector<ShapeCastHit<S>>& out) const;
  std::size_t cast_shape_all(const ShapeCast<S>& cast, std::span<ShapeCastHit<S>> out) const;
  // For who asks often about one place, and asks nothing that is refused: appends the slots of all that the filter sees
  // whose fat box meets a box, in no order; what a cast or ray meets of those, where its way lies in `box`, by parts
  // that collide with `own`.
  void find_near(const Aabb<S>& box, const QueryFilter& filter, std::vector<std::uint32_t>& out) const;
  std::size_t cast_among(std::span<const std::uint32_t> slot_list, const Aabb<S>& box, const Filter& own,
                         const ShapeCast<S>& cast, std::span<ShapeCastHit<S>> out) const;
  std::size_t ray_among(std::span<const std::uint32_t> slot_list, const Aabb<S>& box, const Filter& own,
                        const RayCast<S>& ray, std::span<RayCastHit<S>> out) const;
  bool cast_rays(std::span<const RayCast<S>> rays, std::span<RayCastHit<S>> hits, const TaskRunner& runner) const;
  bool cast_shapes(std::span<const ShapeCast<S>> casts, std::span<ShapeCastHit<S>> hits,
                   const TaskRunner& runner) const;

 private:
  template <class Work> struct Batch;

  // cast_queries.inl
  static FaultReport fault_of_ray(Vec3<S> origin, Vec3<S> translation);
  FaultReport fault_of_cast(const ShapeCast<S>& cast) const;
  template <class Probe, class List> void gather(const Probe& probe, const QueryFilter& filter, List& list) const;
  template <class Probe, class List>
  void meet(const Probe& probe, const QueryFilter& filter, std::uint32_t slot, List& list,
            const Filter* own = nullptr) const;
  template <class Visit> void visit_cast(const ShapeCast<S>& cast, const Visit& visit) const;
  template <class List> void gather_cast(const ShapeCast<S>& cast, List& list) const;
  template <class Probe, class List>
  void meet_among(const Probe& probe, const QueryFilter& filter, std::span<const std::uint32_t> slot_list,
                  const Aabb<S>& box, const Filter& own, List& list) const;
  // query_batches.inl
  template <class Work> bool run_batch(const char* name, const Work& work, const TaskRunner& runner) const;

  const WorldState<S>& state_;
  const BodyMap<S>& map_;
  const Proxies<S>& proxies_;
  QuerySight<S> sight_;
  FaultLog& faults_;
};

#define ISO_CAST_QUERIES_OF(extern, S) extern template class CastQueries<S>;
ISO_EXTERN_FOR_EACH_SCALAR(ISO_CAST_QUERIES_OF)

}  // namespace isostep
