// Explosion: a blast in three phases, with a clock of its own.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/core/fields.hpp"
#include "isostep/core/id.hpp"
#include "isostep/dynamics/records/record_rules.hpp"
#include "isostep/math/vec3.hpp"

namespace isostep {

using ExplosionId = Id<struct ExplosionTag>;

/// Pushes dynamic bodies with a category of the mask, each at its point nearest to the centre, on the line from the
/// centre through it, so that bodies spin. Bodies that contain the centre are pushed at their centre of mass.
/// With t [s] since it went off, d [m] of the point from the centre and T = implosion_duration:
///   implosion   t < T, implosion_least < d < implosion_most: implosion_force towards the centre
///   wave        t from T on, for wave_duration, in which it fades to nothing: with y = s (t - T) - d, s = wave_speed,
///               w = wave_width and k = wave_ramp, wave_force where -w < y < 0, rising to that from y = -w - k w on and
///               falling from it until y = k w; times 1 - u / s where the point flees at the speed u, at least 0. A
///               step gives exactly the impulse of what passes the point within it, however thin the wave
///   chimney     t from T on, for chimney_duration: in a cylinder about the centre, chimney_height up from it and of
///               radius chimney_radius, chimney_force (1 - r / chimney_radius) at r [m] from the axis
/// The world removes it after its end. While one exists nothing falls asleep. Without gravity there is no up, and no
/// chimney.
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
  /// [s] Returns how long it lasts, from when it goes off.
  ISO_INLINE S duration() const { return implosion_duration + max(wave_duration, chimney_duration); }
};

}  // namespace isostep

namespace isostep::detail {

inline constexpr int kMostBlastSeconds = 1024;  // [s] of each phase; the clock counts to 16384

/// [m] Integrates the wave's profile from its front, -w - k w, to y: it rises over k w, stays for w, falls over k w. A
/// force that passes at speed s gives force / s times the difference.
template <class S> S wave_passed(S y, S width, S ramp) {
  const S length = width * ramp;
  const auto half_square = [&](S part)
                               ISO_INLINE_LAMBDA { return S(0) < length ? S(0.5) * (part * (part / length)) : S(0); };
  if (y <= -width - length) return S(0);
  if (y < -width) return half_square(y + width + length);
  const S risen = S(0.5) * length;
  if (y < S(0)) return risen + y + width;
  if (y < length) return risen + width + risen - half_square(length - y);
  return risen + width + risen;
}
/// [s] Returns the time since an explosion's begin, for a sub-step. Below 0: it is still to come.
template <class S>
S seconds_since(std::uint64_t begin, std::uint64_t tick, std::int32_t hz, std::uint32_t substep, std::int32_t rate) {
  if (tick < begin) return S(-1);
  const std::uint64_t steps = tick - begin, whole = steps / static_cast<std::uint32_t>(hz);
  const auto rest = static_cast<std::int32_t>(steps % static_cast<std::uint32_t>(hz));
  const std::int32_t part = rest * (rate / hz) + static_cast<std::int32_t>(substep);
  constexpr std::uint64_t kMost = 16384;  // [s] more than any explosion lasts
  return S(static_cast<int>(min(whole, kMost))) + divide_to<S>(S(part), S(rate));
}
/// Returns true if an explosion is over at the start of that tick's step.
template <class S> bool has_ended(const Explosion<S>& e, std::uint64_t tick, std::int32_t hz) {
  return e.duration() <= seconds_since<S>(e.begin, tick, hz, 0, hz);
}

/// The point of a body that a blast hits.
template <class S> struct BlastTarget {
  S distance;      // [m] of the point from the centre
  S fleeing;       // [m/s] of the point, away from there
  S above, aside;  // [m] of the point over the centre, and from the chimney's axis
};
/// [N] Returns the outward force over a sub-step of h seconds that begins `t` after the blast.
template <class S> S blast(const Explosion<S>& e, S t, Step<S> h, const BlastTarget<S>& target) {
  const S distance = target.distance, above = target.above, aside = target.aside;
  SumOf<S, S> force = product(S(0), S(0));
  if (t < e.implosion_duration) {
    if (e.implosion_least < distance && distance < e.implosion_most) force = force - product(e.implosion_force, S(1));
    return saturate_to<S>(force);
  }
  const S since = t - e.implosion_duration;
  if (since < e.wave_duration) {
    const S before = e.wave_speed * since - distance, travelled = e.wave_speed * h;
    const S passed =
        wave_passed(before + travelled, e.wave_width, e.wave_ramp) - wave_passed(before, e.wave_width, e.wave_ramp);
    const S fade = S(1) - since / e.wave_duration;
    const S chase = max(S(0), S(1) - clamp(target.fleeing / e.wave_speed, S(-1), S(1)));
    force = force + product(e.wave_force, (passed / travelled) * (fade * chase));
  }
  if (since < e.chimney_duration && aside < e.chimney_radius && S(0) < above && above < e.chimney_height)
    force = force + product(e.chimney_force, S(1) - aside / e.chimney_radius);
  return saturate_to<S>(force);
}

template <class S> struct RecordRules<Explosion<S>> : RecordDefaults<S> {
  static constexpr bool kSeesOthers = true;
  static constexpr Acts kActs = Acts::pushes;
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
  template <class Random> static void draw(Explosion<S>& e, Random& random) {
    const double weight = 10 * random.mass(random.body());
    e.centre = random.point(2, 1);
    e.begin = random.tick() + random.below(20);
    e.implosion_force = random.in(0, 1, weight);
    e.implosion_most = random.in(0, 4);
    e.implosion_duration = random.in(0, 0.25);
    e.wave_force = random.in(0, 20, weight);
    e.wave_speed = random.in(4, 60);
    e.wave_width = random.in(0, 1);
    e.wave_ramp = random.in(0, 1);
    e.wave_duration = random.in(0, 1);
    e.chimney_force = random.in(0, 1, weight);
    e.chimney_duration = random.in(0, 0.5);
    e.is_shielded = random.one_in(2);
  }
  template <class Forces> static void act(const Explosion<S>& e, Forces& forces) {
    const auto& clock = forces.bodies.when();
    const S t = seconds_since<S>(e.begin, clock.tick, clock.hz, clock.substep, clock.rate);
    if (t < S(0) || e.duration() <= t) return;
    const Vec3<Unit<S>> up = -heading_of(forces.bodies.gravity()).direction;
    for (std::uint32_t row = 1; row < forces.bodies.rows(); ++row) {
      if (!forces.bodies.is_pushed(row, e.mask)) continue;
      const auto end = forces.bodies.end_of(row, forces.shields.exposed_point(row, e.centre));
      const Vec3<S> from_blast = end.at - e.centre;
      const Heading<S> way = heading_of(from_blast);
      if (!(S(0) < way.length)) continue;
      const S above = up == Vec3<Unit<S>>::zero() ? S(-1) : dot(up, from_blast);
      const S fleeing = dot(end.velocity, way.direction), aside = length(from_blast - up * above);
      const S force = blast<S>(e, t, clock.h, {way.length, fleeing, above, aside});
      if (force == S(0) || (e.is_shielded && forces.shields.is_shielded(e.centre, end.at))) continue;
      forces.sums.push(end, way.direction * force);
    }
  }
};

}  // namespace isostep::detail
