// OverlapQueries<S>: what lies at a place: near a point, in a shape, in a box.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "isostep/core/fault_log.hpp"
#include "isostep/core/instantiate.hpp"
#include "isostep/query/asked_shape.hpp"
#include "isostep/query/query_sight.hpp"
#include "isostep/store/body_map.hpp"
#include "isostep/store/proxies.hpp"
#include "isostep/store/query_types.hpp"

namespace isostep {

/// Input:   the state, the body map and the broad phase, as the last step or command left them.
/// Output:  what World's calls of the same names return; the log holds the fault of a question that is refused.
/// Keeps:   nothing: any number of threads may ask at once, as long as no question is refused.
template <class S> class OverlapQueries {
 public:
  ISO_INLINE OverlapQueries(const WorldState<S>& state, const BodyMap<S>& map, const Proxies<S>& proxies,
                            FaultLog& faults)
      : state_(state), map_(map), proxies_(proxies), sight_(state, map), faults_(faults) {}

  std::optional<ClosestBody<S>> closest_point(Vec3<S> point, S max_distance, const QueryFilter& filter) const;
  void overlap_shape(const QueryShape<S>& shape, const Pose<S>& pose, std::vector<BodyId>& out,
                     const QueryFilter& filter) const;
  void overlap_shape(const QueryShape<S>& shape, const Pose<S>& pose, std::vector<OverlapHit>& out,
                     const QueryFilter& filter) const;
  std::optional<OverlapHit> overlap_first(const QueryShape<S>& shape, const Pose<S>& pose,
                                          const QueryFilter& filter) const;
  void overlap_aabb(const Aabb<S>& box, std::vector<BodyId>& out, const QueryFilter& filter) const;

 private:
  template <class Visit>
  void visit_parts_near(const detail::AskedShape<S>& asked, std::uint32_t slot, Visit&& visit) const;
  template <class Visit>
  void visit_overlaps(const detail::AskedShape<S>& asked, const QueryFilter& filter, std::uint32_t slot,
                      const Visit& visit) const;
  bool accept_box(const Aabb<S>& box) const;

  const WorldState<S>& state_;
  const BodyMap<S>& map_;
  const Proxies<S>& proxies_;
  QuerySight<S> sight_;
  FaultLog& faults_;
};

#define ISO_OVERLAP_QUERIES_OF(extern, S) extern template class OverlapQueries<S>;
ISO_EXTERN_FOR_EACH_SCALAR(ISO_OVERLAP_QUERIES_OF)

}  // namespace isostep
