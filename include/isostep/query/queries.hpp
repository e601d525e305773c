// Queries<S>: questions about space.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "isostep/core/fault_log.hpp"
#include "isostep/core/instantiate.hpp"
#include "isostep/core/task_runner.hpp"
#include "isostep/store/body_map.hpp"
#include "isostep/store/proxies.hpp"
#include "isostep/store/query_types.hpp"
#include "isostep/store/views.hpp"

namespace isostep {

/// Input:   the state, the body map and the broad phase, as the last step or command left them.
/// Output:  what World's calls of the same names return; the log holds the fault of a question that is refused.
/// Keeps:   nothing: any number of threads may query at once, as long as no question is refused.
/// Files:   queries.inl, points and joints; query_casts.inl, rays and casts; query_overlaps.inl; query_batches.inl.
template <class S> class Queries {
 public:
  ISO_INLINE Queries(const WorldState<S>& state, const BodyMap<S>& map, const Proxies<S>& proxies, FaultLog& faults)
      : state_(state), map_(map), proxies_(proxies), faults_(faults) {}

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

  std::optional<ClosestBody<S>> closest_point(Vec3<S> point, S max_distance, const QueryFilter& filter) const;
  void overlap_shape(const QueryShape<S>& shape, const Pose<S>& pose, std::vector<BodyId>& out,
                     const QueryFilter& filter) const;
  void overlap_shape(const QueryShape<S>& shape, const Pose<S>& pose, std::vector<OverlapHit>& out,
                     const QueryFilter& filter) const;
  std::optional<OverlapHit> overlap_first(const QueryShape<S>& shape, const Pose<S>& pose,
                                          const QueryFilter& filter) const;
  bool sees(const QueryFilter& filter, std::uint32_t slot) const;  // whether the filter takes a part of that body
  bool sees_part(const QueryFilter& filter, const BodyProperties<S>& body, const PartTraits<S>& part) const;
  /// [m] how far a shape of the world reaches from its frame's origin along a direction.
  S reach_of(ShapeId shape, const Quat<Unit<S>>& orientation, Vec3<Unit<S>> along) const;
  void overlap_aabb(const Aabb<S>& box, std::vector<BodyId>& out, const QueryFilter& filter) const;
  S joint_error(JointId joint) const;
  S joint_position(JointId joint) const;
  S joint_position(JointId joint, JointAxis axis) const;

 private:
  /// A shape to ask with, in the world.
  struct Asked {
    Primitive<S> primitive;
    const void* content;  // of its blob
    Pose<S> pose;         // of the primitive's frame, world

    ISO_INLINE ShapeView<S> view() const { return {primitive, content}; }
  };
  template <class Work> struct Batch;

  // query_casts.inl
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
  // query_overlaps.inl
  FaultReport fault_of_shape(const QueryShape<S>& shape, const Pose<S>& pose) const;
  Asked asked_of(const QueryShape<S>& shape, const Pose<S>& pose) const;
  template <class Visit> void visit_parts_near(const Asked& asked, std::uint32_t slot, Visit&& visit) const;
  template <class Visit>
  void visit_overlaps(const Asked& asked, const QueryFilter& filter, std::uint32_t slot, const Visit& visit) const;
  // queries.inl
  static bool sees(const QueryFilter& filter, const Filter& of, std::uint32_t kind, bool senses);
  bool accept_box(const Aabb<S>& box) const;
  BodyId id_of(std::uint32_t slot) const;

  const WorldState<S>& state_;
  const BodyMap<S>& map_;
  const Proxies<S>& proxies_;
  FaultLog& faults_;
};

#define ISO_QUERIES_OF(extern, S) extern template class Queries<S>;
ISO_EXTERN_FOR_EACH_SCALAR(ISO_QUERIES_OF)

}  // namespace isostep
