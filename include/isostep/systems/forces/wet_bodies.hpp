// WetBodies<S>: what bodies displace of waters, and what of them is under water.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "isostep/core/instantiate.hpp"
#include "isostep/store/body_map.hpp"
#include "isostep/systems/forces/substep_bodies.hpp"
#include "isostep/systems/forces/zones.hpp"

namespace isostep {

/// The water that a body displaces.
template <class S> struct Wet {
  S mass;       // [kg] of water
  Vec3<S> arm;  // [m] its middle from the body's centre of mass
  std::uint32_t row;
  const Water<S>* water;
  Vec3<S> flow;  // [m/s] of the water there
};

/// Input:   the Water records, the shapes and poses of bodies as a sub-step finds them.
/// Output:  the water that a body displaces below a surface; whether a point is under water.
/// Keeps:   what bodies displace of each water, as it found when it pushed them, until the sub-step ends.
template <class S> class WetBodies {
 public:
  ISO_INLINE WetBodies(const WorldState<S>& state, const BodyMap<S>& map, const Zones<S>& zones,
                       const SubstepBodies<S>& bodies)
      : state_(state), map_(map), zones_(zones), bodies_(bodies) {}

  void begin_substep();
  /// Returns what all parts of a body displace together, at the sub-step's pose. Overlaps count twice, as in its mass.
  Wet<S> displaced(std::uint32_t row, S density, const detail::WaterSurface<S>& surface) const;
  ISO_INLINE void keep(const Wet<S>& wet) { wet_.push_back(wet); }
  /// Calls visit(wet) for each body that displaces that water.
  template <class Visit> void for_each_of(const Water<S>& water, const Visit& visit) const {
    for (const Wet<S>& wet : wet_) {
      if (wet.water == &water) visit(wet);
    }
  }
  /// Returns true if a point of a body is under water. Sets `velocity` [m/s] to the flow of the water there.
  bool is_under_water(std::uint32_t row, Vec3<S> point, Vec3<S>& velocity) const;

 private:
  const WorldState<S>& state_;
  const BodyMap<S>& map_;
  const Zones<S>& zones_;
  const SubstepBodies<S>& bodies_;
  std::vector<Wet<S>> wet_;
};

#define ISO_WET_BODIES_OF(extern, S) extern template class WetBodies<S>;
ISO_EXTERN_FOR_EACH_SCALAR(ISO_WET_BODIES_OF)

}  // namespace isostep
