// Water: a body of water, in which everything floats, sinks and is slowed by what of it is wet.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/core/fields.hpp"
#include "isostep/core/id.hpp"
#include "isostep/dynamics/records/record_rules.hpp"
#include "isostep/math/aabb.hpp"
#include "isostep/math/mat3.hpp"

namespace isostep {

using WaterId = Id<struct WaterTag>;

/// Acts on awake dynamic bodies with a category of the mask whose boxes touch the region. They are borne by the weight
/// of the water that they displace: the exact volume of each part of their shapes below the surface, at its centre.
/// Drag acts on the wet part alone: it slows its centre, and the body's rotation, to those of the water.
/// The surface is level, up is against the world's gravity. Without gravity there is no surface and no force. A wave
/// travels over it, height wave_height sin(2 pi (x / wave_length - t / wave_period)) with x along wave_direction, and
/// carries the water round in circles (Airy's, of deep water). A body meets it as the plane that touches it above or
/// below the body's centre of mass, and is borne along the plane's normal. Build a body that is longer than a third of
/// a wave of several bodies.
/// Waters add up. One that replaces takes the place of those of lower priority, as a lock or a tank in the sea, with
/// its own level, density and current. A body with its centre of mass in its region has this water and none of those,
/// below the surface and above it; others are not affected, so that of two such regions side by side a body has one at
/// a time. A ForceZone that replaces water hides that of lower priority.
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

/// Returns true if the water hides waters of lower priority at a point, from bodies of that category.
template <class S> ISO_INLINE bool replaces(const Water<S>& water, std::uint32_t category, Vec3<S> point) {
  return water.replaces && (category & water.mask) != 0 && in_region<S>(water, {point, point});
}

inline constexpr double kTurn = 2 * kPi;  // [rad]

/// Returns the angle of a wave after so many sub-steps of h [s]. The error after an hour is that after a second: the
/// part of a turn in a sub-step is rounded once, to 2^-32 of a turn.
template <class S> S wave_angle(std::uint64_t substeps, Step<S> h, S period) {
  const auto part = static_cast<std::uint64_t>(nearest_scaled(divide_to<Unit<S>>(h, period), 32));
  return from_lattice<S>(static_cast<std::int64_t>(substeps * part & 0xffffffffu), 32) * S(kTurn);
}

/// The plane of a water above or below a point.
template <class S> struct WaterSurface {
  Vec3<Unit<S>> normal;
  S depth;           // [m] of the point below it, along the normal
  Vec3<S> velocity;  // [m/s] of the water there
};
/// `clock`: that of a sub-step.
template <class S, class Clock>
WaterSurface<S> surface_at(const Water<S>& water, Vec3<S> at, Vec3<S> gravity, const Clock& clock) {
  using U = Unit<S>;
  const Vec3<U> up = -heading_of(gravity).direction;
  const S depth = water.surface_height - dot(up, at);
  if (!(S(0) < water.wave_height)) return {up, depth, water.current};
  const Vec3<U> along = water.wave_direction - up * dot(up, water.wave_direction);
  const S number = S(kTurn) / water.wave_length, speed = S(kTurn) / water.wave_period;
  const S phase =
      saturate_to<S>(product(dot(along, at), number)) - wave_angle<S>(clock.count(), clock.h, water.wave_period);
  const SinCos<S> wave = sin_cos(phase);
  const S height = water.wave_height, slope = saturate_to<S>(product(height * number, wave.cos));
  const Vec3<U> normal = normalise(convert<S>(up) - along * slope);
  // Deep water goes in circles at its surface, forward on the crest.
  const Vec3<S> circling = along * (height * speed * wave.sin) - up * (height * speed * wave.cos);
  return {normal, (depth + height * wave.sin) * dot(normal, up), saturating_add(water.current, circling)};
}

template <class S> struct RecordRules<Water<S>> : RecordDefaults<S> {
  static constexpr Acts kActs = Acts::pushes_and_resists;
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
  template <class Random> static void draw(Water<S>& w, Random& random) {
    w.surface_height = random.in(-1, 2);
    w.density = random.in(0, 2, random.mass(random.body()));
    w.middle = random.point(2);
    if (random.one_in(2)) w.half = {random.in(1, 4), S(8), random.in(1, 4)};
    w.current = random.arrow(0, 2);
    w.linear_drag = random.in(0, 2);
    w.quadratic_drag = random.in(0, 1);
    w.angular_drag = random.in(0, 2);
    w.wave_length = random.in(4, 20);
    if (random.one_in(2)) w.wave_height = random.in(0, 0.25);
    w.wave_period = random.in(1, 4);
    w.wave_direction = random.direction();
    w.priority = random.rank();
    w.replaces = random.one_in(2);
  }
  template <class Forces> static void act(const Water<S>& w, Forces& forces) {
    const auto& bodies = forces.bodies;
    const Heading<S> down = heading_of(bodies.gravity());
    if (!(S(0) < down.length)) return;
    for (std::uint32_t row = 1; row < bodies.rows(); ++row) {
      if (!bodies.is_pushed(row, w.mask)) continue;
      const BodyState<S>& state = bodies.state(row);
      const Aabb<S> solid = bodies.solid_box(row);
      const Aabb<S> box = w.replaces ? Aabb<S>{state.centre, state.centre} : solid;
      if (!in_region(w, box) || forces.zones.is_dry(w.priority, bodies.category(row), state.centre)) continue;
      const WaterSurface<S> surface = surface_at(w, state.centre, bodies.gravity(), bodies.when());
      // The box is where the step began, with its margin: what of it is dry stays so for a sub-step's motion.
      const Vec3<S> reach = max(abs(solid.high - state.centre), abs(solid.low - state.centre));
      if (surface.depth <= -dot(abs(surface.normal), reach)) continue;
      auto wet = forces.wet.displaced(row, w.density, surface);
      if (!(S(0) < wet.mass)) continue;
      const S weight = saturate_to<S>(product(wet.mass, down.length));
      forces.sums.push(row, surface.normal * weight, wet.arm);
      wet.water = &w, wet.flow = surface.velocity;
      forces.wet.keep(wet);
      forces.resistance.count(row);
    }
  }
  /// Slows the wet part of each body, as act() found it.
  template <class Forces> static void resist(const Water<S>& w, Forces& forces) {
    forces.wet.for_each_of(w, [&](const auto& wet) { resist(w, wet, forces); });
  }

 private:
  template <class Wet, class Forces> static void resist(const Water<S>& w, const Wet& wet, Forces& forces) {
    const auto end = forces.bodies.end_of(wet.row, wet.arm);
    const S speed = length(end.velocity - wet.flow);
    const S rate = saturating_add(w.linear_drag, saturate_to<S>(product(w.quadratic_drag, speed)));
    if (S(0) < rate) {
      const S c = -saturate_to<S>(product(rate, wet.mass));
      const Vec3<S> next = forces.resistance.next_velocity(end) - wet.flow;
      const Mat3<S> tensor = Mat3<S>::diagonal({c, c, c});
      forces.sums.push(end, forces.resistance.settled(end, Mat3<Unit<S>>::identity(), tensor, next));
    }
    if (!(S(0) < w.angular_drag)) return;
    const S share = wet.mass / max(forces.bodies.mass(wet.row).mass, wet.mass);
    const Vec3<S> turning = forces.resistance.next_angular_velocity(wet.row);
    forces.resistance.slow_turning(wet.row, turning, w.angular_drag * share);
  }
};

}  // namespace isostep::detail
