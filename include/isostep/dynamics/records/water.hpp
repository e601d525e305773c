// Water: a body of water, in which everything floats, sinks and is slowed by what of it is wet.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/core/fields.hpp"
#include "isostep/core/id.hpp"
#include "isostep/dynamics/records/record_rules.hpp"
#include "isostep/math/aabb.hpp"

namespace isostep {

using WaterId = Id<struct WaterTag>;

/// Dynamic bodies that are awake, of a category of the mask, whose boxes touch the region, are borne by the weight of
/// the water in place of them: of each part of their shapes the exact volume below the surface, at its centre. What
/// drag says is of the wet part alone: it slows its centre, and the body's turning, to those of the water.
/// The surface is level, up is against the world's gravity; without gravity there is no surface and no force. A wave
/// travels over it, height wave_height sin(2 pi (x / wave_length - t / wave_period)) with x along wave_direction, and
/// carries the water round in circles (Airy's of deep water). A body meets it as the plane that touches it above or
/// below the body's centre of mass, along whose normal it is borne: what is longer than a third of a wave has waves of
/// its own to be built of several bodies.
/// Waters add up. One that replaces stands in place of those of lower priority, as a lock or a tank in the sea, with a
/// level, a density and a current of its own: a body whose centre of mass is in its region has this water and none of
/// those, below the surface and above it. It acts on no body whose centre is outside, so that of two such regions side
/// by side a body has one at a time. A ForceZone that replaces water hides that of lower priority.
/// Source:  Archimedes; geometry/submersion.hpp. Millington 2007, pp. 222-225, has BuoyancyPoint.
template <class S> struct Water {
  S surface_height = S(0);               // [m] along up, of the water at rest
  S density = S(1000);                   // [kg/m^3]
  Vec3<S> middle = {S(0), S(0), S(0)};   // [m] of the region: a box along the world's axes
  Vec3<S> half = {S(0), S(0), S(0)};     // [m] all 0: everywhere
  Vec3<S> current = {S(0), S(0), S(0)};  // [m/s]
  S linear_drag = S(0.5);                // [1/s] each of a kg of water displaced
  S quadratic_drag = S(0);               // [1/m] the same, times speed
  S angular_drag = S(0.5);               // [1/s] of the body's turning, each of its kg displaced
  S wave_height = S(0);                  // [m] above the water at rest; 0: no wave
  S wave_length = S(10);                 // [m]
  S wave_period = S(3);                  // [s]
  Vec3<Unit<S>> wave_direction = {Unit<S>(1), Unit<S>(0), Unit<S>(0)};  // [1] unit length; along the surface
  std::uint32_t mask = 0xffffffffu;                                     // categories: Filter
  std::int32_t priority = 0;
  bool replaces = false;  // hides water of lower priority from what it acts on

  ISO_FIELDS(surface_height, density, middle, half, current, linear_drag, quadratic_drag, angular_drag, wave_height,
             wave_length, wave_period, wave_direction, mask, priority, replaces)
};

template <class S> ISO_INLINE bool in_region(const Water<S>& water, const Aabb<S>& box) {
  const Vec3<S> h = water.half;
  return h == Vec3<S>::zero() || overlap(Aabb<S>::around(water.middle, h), box);
}

}  // namespace isostep

namespace isostep::detail {

inline constexpr int kMostWavePeriod = 1024;  // [s] its part in a sub-step still has digits

template <class S> struct RecordRules<Water<S>> : RecordDefaults<S> {
  static constexpr Wakes kWakes = Wakes::all;
  static constexpr bool kBears = true;
  static FaultReport fault(const Water<S>& w) {
    constexpr const char* kPlace = "a size up to Limits::position()";
    const S position = Limits<S>::position(), rate = S(kMaxRate);
    const Vec3<Unit<S>>& way = w.wave_direction;
    return Checklist()
        .finite(w.surface_height, "surface_height")
        .finite(w.density, "density")
        .also(fault_of_place(w.middle, "middle"))
        .finite(w.half, "half")
        .finite(w.current, "current")
        .finite(w.linear_drag, "linear_drag")
        .finite(w.quadratic_drag, "quadratic_drag")
        .finite(w.angular_drag, "angular_drag")
        .finite(w.wave_height, "wave_height")
        .finite(w.wave_length, "wave_length")
        .finite(w.wave_period, "wave_period")
        .in_range(within(w.surface_height, position), "surface_height", kPlace)
        .in_range(w.density <= Limits<S>::mass(), "density", "0 to Limits::mass()")
        .in_range(within(w.half, position), "half", "0 to Limits::position()")
        .in_range(no_longer(w.current, Limits<S>::speed()), "current", kWithinSpeed)
        .in_range(w.linear_drag <= rate, "linear_drag", "0 to 16384")
        .in_range(w.quadratic_drag <= rate, "quadratic_drag", "0 to 16384")
        .in_range(w.angular_drag <= rate, "angular_drag", "0 to 16384")
        .in_range(w.wave_length <= position, "wave_length", "16 Limits::minimum_size() to Limits::position()")
        .in_range(w.wave_period <= S(kMostWavePeriod), "wave_period", "1/64 to 1024")
        .proper(S(0) <= w.density, "density", "0 to Limits::mass()")
        .proper(S(0) <= w.half.x && S(0) <= w.half.y && S(0) <= w.half.z, "half", "0 to Limits::position()")
        .proper(S(0) <= w.linear_drag, "linear_drag", "0 to 16384")
        .proper(S(0) <= w.quadratic_drag, "quadratic_drag", "0 to 16384")
        .proper(S(0) <= w.angular_drag, "angular_drag", "0 to 16384")
        .proper(S(16) * Limits<S>::minimum_size() <= w.wave_length, "wave_length",
                "16 Limits::minimum_size() to Limits::position()")
        .proper(S(1.0 / 64) <= w.wave_period, "wave_period", "1/64 to 1024")
        // A steeper wave breaks (Stokes: a seventh of its length from trough to crest).
        .proper(S(0) <= w.wave_height && w.wave_height * S(14) <= w.wave_length, "wave_height", "0 to wave_length / 14")
        .proper(is_direction<S>(way), "wave_direction", "a vector of length 1")
        .report();
  }
};

}  // namespace isostep::detail
