// Time of impact: how far two convex cores that move and turn get before they touch.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "isostep/collision/continuous/core_motion.hpp"
#include "isostep/collision/narrowphase/convex_core.hpp"
#include "isostep/core/instantiate.hpp"

namespace isostep {

enum class Impact : std::uint8_t {
  none,      // they stay apart to the end
  touch,     // at `fraction` they are apart by the target or less
  at_start,  // they are apart by half the target or less, or overlap, at the start; nothing is said of what follows
  stays,     // as touch, but at once, and they were that near from the start on: where an earlier motion was stopped
  cut_off,   // as touch, but the rounds ended while they were further apart: early, never late
};

template <class S> struct TimeOfImpact {
  Impact impact;
  Unit<S> fraction;      // [1] of both motions, up to which they are proved to be apart; 1 for none
  Vec3<Unit<S>> normal;  // [1] from a to b, at `fraction`; zero for none, and where cores overlap from the start
  Vec3<S> on_a, on_b;    // [m] nearest points of their surfaces; as normal
  S separation;          // [m] proved by the plane across the normal; at_start: negative, or 0 for overlapping cores
  std::int32_t rounds;
};

/// Finds how far two cores move while at least half of `target` [m] apart, all the way. The target is at least 8
/// gap_noise() of their size and distance and 4 resolutions of S: a smaller one counts as that.
/// Source:  Conservative advancement, Mirtich 1996, Impulse-based Dynamic Simulation of Rigid Body Systems, sec. 2.3.2.
/// Differs: Along a plane's normal n that GJK found at t, the separation after d more is not less than
///            L(d) = (v_b - v_a).n d + min over b's vertices of r.(n + d n x w) - max over a's - B d^2 / 2,
///          with w the angular velocities at t, r from the centres of turning, and B what the vertices' accelerations
///          along n can be at most. L is concave: that L(d) is positive proves all that is before d, and so does a
///          chord between a positive and a negative value; Newton's method from the right finds its root. Bounds by
///          speeds alone, |v.n| + |w| |r|, are those of an L with a chord from 0 and advance less.
///          32 rounds; formats of 32 bits are searched in Q32.32.
/// Error:   poses of `fraction` in S, pose_at(), are off those of the proof by at most 2 resolutions of S and that of
///          Unit<S> times the cores' reach: cores there are never nearer than target / 2 less that.
/// Limits:  turns below half a turn, positions within Limits<S>::position(), at most 128 vertices.
template <class S>
TimeOfImpact<S> time_of_impact(const ConvexCore<S>& a, const CoreMotion<S>& of_a, const ConvexCore<S>& b,
                               const CoreMotion<S>& of_b, S target);

#define ISO_TIME_OF_IMPACT_OF(extern, S)                                                                              \
  extern template TimeOfImpact<S> time_of_impact<S>(const ConvexCore<S>&, const CoreMotion<S>&, const ConvexCore<S>&, \
                                                    const CoreMotion<S>&, S);
ISO_EXTERN_FOR_EACH_SCALAR(ISO_TIME_OF_IMPACT_OF)

}  // namespace isostep
