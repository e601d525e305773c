// Queries<S>: questions about space.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "isostep/core/instantiate.hpp"
#include "isostep/state/command_journal.hpp"
#include "isostep/world/body_map.hpp"
#include "isostep/world/proxies.hpp"
#include "isostep/world/world.hpp"

namespace isostep {

/// Input:   the state, the body map and the broad phase, as the last step or command left them.
/// Output:  what World's calls of the same names return; the journal holds the fault of a question that is refused.
/// Keeps:   nothing: any number of threads may query at once, as long as no question is refused.
template <class S> class Queries {
 public:
  ISO_INLINE Queries(const WorldState<S>& state, const BodyMap<S>& map, const Proxies<S>& proxies,
                     CommandJournal& journal)
      : state_(state), map_(map), proxies_(proxies), journal_(journal) {}

  std::optional<RayCastHit<S>> cast_ray(Vec3<S> origin, Vec3<S> translation, QueryFilter filter) const;
  void cast_ray_all(Vec3<S> origin, Vec3<S> translation, std::vector<RayCastHit<S>>& out, QueryFilter filter) const;
  std::optional<ClosestBody<S>> closest_point(Vec3<S> point, S max_distance, QueryFilter filter) const;
  void overlap_shape(const Primitive<S>& shape, const Pose<S>& pose, std::vector<BodyId>& out,
                     QueryFilter filter) const;
  void overlap_aabb(const Aabb<S>& box, std::vector<BodyId>& out, QueryFilter filter) const;
  S joint_error(JointId joint) const;

 private:
  bool accept_ray(const char* name, Vec3<S> origin, Vec3<S> translation) const;
  bool accept_shape(const Primitive<S>& shape, const Pose<S>& pose) const;
  bool accept_box(const Aabb<S>& box) const;
  bool sees(const QueryFilter& filter, std::uint32_t slot) const;
  std::optional<RayCastHit<S>> hit_of(std::uint32_t slot, Vec3<S> origin, Vec3<S> translation, S most) const;
  BodyId id_of(std::uint32_t slot) const;
  Pose<S> pose_of(std::uint32_t slot) const;

  const WorldState<S>& state_;
  const BodyMap<S>& map_;
  const Proxies<S>& proxies_;
  CommandJournal& journal_;
};

#define ISO_EXTERN(S) extern template class Queries<S>;
ISO_FOR_EACH_SCALAR(ISO_EXTERN)
#undef ISO_EXTERN

}  // namespace isostep
