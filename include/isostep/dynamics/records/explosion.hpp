// Explosion: a blast in three phases, with a clock of its own.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/core/fields.hpp"
#include "isostep/core/id.hpp"
#include "isostep/dynamics/records/record_rules.hpp"
#include "isostep/math/vec3.hpp"

namespace isostep {

using ExplosionId = Id<struct ExplosionTag>;

/// Acts on dynamic bodies of a category of the mask, at the point of each that is nearest to the centre, along the line
/// from the centre through it: so bodies spin. Bodies that hold the centre are pushed at their centre of mass.
/// With t [s] since it went off, d [m] of the point from the centre and T = implosion_duration:
///   implosion   t < T, implosion_least < d < implosion_most: implosion_force towards the centre
///   wave        t from T on, for wave_duration, in which it fades to nothing: with y = s (t - T) - d, s = wave_speed,
///               w = wave_width and k = wave_ramp, wave_force where -w < y < 0, rising to that from y = -w - k w on and
///               falling from it until y = k w; times 1 - u / s where the point flees at the speed u, at least 0. A
///               step gives exactly the impulse of what passes the point within it, however thin the wave
///   chimney     t from T on, for chimney_duration: in a cylinder about the centre, chimney_height up from it and of
///               radius chimney_radius, chimney_force (1 - r / chimney_radius) at r [m] from the axis
/// The world removes it once it has ended. While there is one nothing falls asleep. Without gravity there is no up, and
/// no chimney.
/// Source:  Millington 2007, pp. 412-418. Differs: the wave's outer ramp falls outwards, and the chimney's force
///          outwards from its axis, as the text has it and the formulas have not.
template <class S> struct Explosion {
  Vec3<S> centre = {S(0), S(0), S(0)};  // [m]
  std::uint64_t begin = 0;              // [steps] World::tick() at which it goes off; add() makes now of what is past
  S implosion_force = S(0);             // [N]
  S implosion_least = S(0);             // [m]
  S implosion_most = S(0);              // [m]
  S implosion_duration = S(0);          // [s]
  S wave_force = S(0);                  // [N]
  S wave_speed = S(50);                 // [m/s]
  S wave_width = S(1);                  // [m]
  S wave_ramp = S(0.5);                 // [1] of the width
  S wave_duration = S(0);               // [s]
  S chimney_force = S(0);               // [N]
  S chimney_radius = S(1);              // [m]
  S chimney_height = S(1);              // [m]
  S chimney_duration = S(0);            // [s]
  bool is_shielded = false;             // static bodies between the centre and the point keep it off
  std::uint32_t mask = 0xffffffffu;     // categories: Filter

  ISO_FIELDS(centre, begin, implosion_force, implosion_least, implosion_most, implosion_duration, wave_force,
             wave_speed, wave_width, wave_ramp, wave_duration, chimney_force, chimney_radius, chimney_height,
             chimney_duration, is_shielded, mask)
  /// [s] from when it goes off.
  ISO_INLINE S duration() const { return implosion_duration + max(wave_duration, chimney_duration); }
};

}  // namespace isostep

namespace isostep::detail {

inline constexpr int kMostBlastSeconds = 1024;  // [s] of each phase; the clock counts to 16384

template <class S> struct RecordRules<Explosion<S>> : RecordDefaults<S> {
  static constexpr Wakes kWakes = Wakes::all;
  static FaultReport fault(const Explosion<S>& e) {
    constexpr const char *kSeconds = "0 to 1024", *kLength = "0 to Limits::position()";
    Checklist list;
    list.also(fault_of_place(e.centre, "centre"));
    const auto length = [&](S x, const char* field) {
      list.finite(x, field).in_range(x <= Limits<S>::position(), field, kLength).proper(S(0) <= x, field, kLength);
    };
    const auto seconds = [&](S x, const char* field) {
      list.finite(x, field).in_range(x <= S(kMostBlastSeconds), field, kSeconds).proper(S(0) <= x, field, kSeconds);
    };
    list.finite(e.implosion_force, "implosion_force");
    length(e.implosion_least, "implosion_least");
    length(e.implosion_most, "implosion_most");
    seconds(e.implosion_duration, "implosion_duration");
    list.finite(e.wave_force, "wave_force");
    length(e.wave_speed, "wave_speed");
    length(e.wave_width, "wave_width");
    list.finite(e.wave_ramp, "wave_ramp").proper(S(0) <= e.wave_ramp && e.wave_ramp <= S(1), "wave_ramp", "0 to 1");
    seconds(e.wave_duration, "wave_duration");
    list.finite(e.chimney_force, "chimney_force");
    length(e.chimney_radius, "chimney_radius");
    length(e.chimney_height, "chimney_height");
    seconds(e.chimney_duration, "chimney_duration");
    // Beyond that the wave has nothing to meet, and its place would leave the format.
    list.in_range(product(e.wave_speed, e.wave_duration) <= product(Limits<S>::position(), S(1)), "wave_duration",
                  "wave_speed wave_duration up to Limits::position()");
    return list.proper(Limits<S>::minimum_size() <= e.wave_speed, "wave_speed", "Limits::minimum_size() or more")
        .proper(Limits<S>::minimum_size() <= e.chimney_radius, "chimney_radius", "Limits::minimum_size() or more")
        .report();
  }
};

}  // namespace isostep::detail
