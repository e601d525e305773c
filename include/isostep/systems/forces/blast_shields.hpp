// BlastShields<S>: which point of a body a blast meets, and whether something static keeps it off.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "isostep/core/instantiate.hpp"
#include "isostep/store/body_map.hpp"
#include "isostep/store/proxies.hpp"
#include "isostep/systems/forces/substep_bodies.hpp"

namespace isostep {

/// Input:   the shapes and poses of bodies as a sub-step finds them; the broad phase for static bodies.
/// Output:  the points of bodies that blasts hit, and whether a static body shields them.
/// Keeps:   nothing.
template <class S> class BlastShields {
 public:
  ISO_INLINE BlastShields(const BodyMap<S>& map, const Proxies<S>& proxies, const SubstepBodies<S>& bodies)
      : map_(map), proxies_(proxies), bodies_(bodies) {}

  /// [m] The vector from a body's centre of mass to its surface point nearest to `from`. Zero if `from` is inside.
  Vec3<S> exposed_point(std::uint32_t row, Vec3<S> from) const;
  /// Returns true if a static body stands between these points.
  bool is_shielded(Vec3<S> from, Vec3<S> to) const;

 private:
  const BodyMap<S>& map_;
  const Proxies<S>& proxies_;
  const SubstepBodies<S>& bodies_;
};

#define ISO_BLAST_SHIELDS_OF(extern, S) extern template class BlastShields<S>;
ISO_EXTERN_FOR_EACH_SCALAR(ISO_BLAST_SHIELDS_OF)

}  // namespace isostep
