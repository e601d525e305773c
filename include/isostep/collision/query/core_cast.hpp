// Conservative advancement of one convex core towards another, whatever finds where they are nearest.
// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "isostep/collision/narrowphase/gjk.hpp"
#include "isostep/collision/query/shape_cast.hpp"
#include "isostep/geometry/closest.hpp"

namespace isostep::detail {

/// The hit of a cast, as CastHit, in the frame of the cast. The normal points from a to b.
template <class F> struct CoreHit {
  bool hit, inside;
  Unit<F> fraction;
  Vec3<Unit<F>> normal;
  Vec3<F> on_b;          // [m] of its core at the start
  F gap = F(0);          // [m] of a miss: what is at least left at the start, along the normal
  bool is_open = false;  // the search does not tell: the cores are so near at the start that they may overlap
};
/// The shortest translation that parts two cores which overlap.
template <class F> struct CoreWayOut {
  F depth;               // [m] its length
  Vec3<Unit<F>> normal;  // [1] from a to b: b leaves along it
  Vec3<F> on_b;          // [m] the deepest point of b's core
};

/// The size of a core, which a cast needs beside its search.
template <class F> struct CoreSize {
  F radius, extent;  // [m] as FineCore has them
};

/// A cast of core a to core b. The origin of its frame is a's position at the start, with any rotation. In it a stands
/// still and b moves the other way.
template <class S> struct CoreCast {
  using F = Finer<S>;
  using U = Unit<F>;
  const Mat3<U>& turn;  // from there to the world
  Vec3<S> origin;       // [m] a's position, world
  F radii, radius_b;    // [m] of both together
  F extent;             // [m] of both together
  Vec3<F> from, way;    // [m] b's position at the start, and its way for a fraction of 1
  U end, latest;        // [1] see CastMotion; latest by no less
  F touch, resolution;  // [m]
  Parting<S>* parting;

  ISO_INLINE CoreCast(CoreSize<F> a, Vec3<S> at_a, CoreSize<F> b, Vec3<S> at_b, const Mat3<U>& frame,
                      const CastMotion<S>& motion)
      : turn(frame),
        origin(at_a),
        radii(a.radius + b.radius),
        radius_b(b.radius),
        extent(a.extent + b.extent),
        from(transposed_times(frame, finer_of<F>(at_b - at_a))),
        way(-transposed_times(frame, finer_of<F>(motion.translation))),
        end(finer<U>(motion.max_fraction)),
        // A fraction is rounded down to a step of S: the latest one is found whatever the rounding.
        latest(min(finer<U>(motion.latest), U(1)) + finer<U>(isostep::resolution<Unit<S>>()) + U(0x1p-20)),
        touch(finer<F>(motion.touch)),
        resolution(finer<F>(isostep::resolution<S>())),
        parting(motion.parting) {}

  /// Runs the cast. The search knows both cores:
  ///   nearest(at, enough)  with b at a position, as GjkDistance; it may end early if enough(separation, distance)
  ///   way_out(size)        the way out of the overlap that `nearest` saw last; `size` [m] bounds the cores; or none
  template <class Search> ISO_INLINE CoreHit<F> run(Search& search) const {
    constexpr int kMostRounds = 32;
    constexpr F kEnough = F(0.5);  // of a distance: a plane that far away is worth a step before the best is found
    U t = U(0);
    CoreHit<F> last = {};
    for (int round = 0; round < kMostRounds; ++round) {
      const Vec3<F> at = from + way * t;
      const F noise = gap_noise(extent + max_abs(at)), nearby = noise * F(2) + resolution;
      const F distant = radii + nearby * F(16);
      const GjkDistance<F> found = search.nearest(at, [=, this](F separation, F distance) ISO_INLINE_LAMBDA {
        return separation > distant && separation - radii >= (distance - radii) * kEnough;
      });
      const F gap = found.separation - radii - noise;
      if (round == 0 && (found.distance == F(0) || gap <= nearby)) return from_touch(search, found, nearby);
      const F closing = -dot(way, found.normal);
      if (found.distance != F(0)) {
        if (!(closing > F(0)) || gap >= closing * (end - t)) return missed(found.normal, gap + closing * t);
        // They touch at t within `nearby`: how far the plane would let them go on is not asked.
        const bool ends_later = gap > nearby && gap > closing * (latest - t) + isostep::resolution<F>() * F(4);
        if (latest < end && ends_later) return missed(found.normal, gap + closing * t);
        last.hit = true;
        if (round == 0 || is_clear(found, noise)) last.normal = found.normal;
      }
      last.on_b = found.on_b - way * t;
      if (gap <= nearby) return last;
      const U step = divide_to<U>(gap, closing) - isostep::resolution<U>();
      if (!(step > U(0))) return last;
      t = last.fraction = t + step;
    }
    return last;
  }
  ISO_INLINE bool tell(const CoreHit<F>& found, CastHit<S>& hit) const {
    if (!found.hit) {
      if (parting != nullptr) *parting = {coarser_of<Unit<S>>(turn * -found.normal), origin, coarser<S>(found.gap)};
      return false;
    }
    hit.fraction = coarser_down<Unit<S>>(found.fraction);
    const Vec3<U> normal = turn * -found.normal;
    const Vec3<F> on_b = turn * found.on_b + normal * radius_b;
    hit.normal = coarser_of<Unit<S>>(normal);
    hit.point = origin + coarser_of<S>(on_b);
    hit.inside = found.inside;
    return true;
  }

 private:
  static ISO_INLINE CoreHit<F> missed(Vec3<U> normal, F gap) {
    CoreHit<F> miss = {false, false, U(0), normal, Vec3<F>::zero()};
    miss.gap = gap;
    return miss;
  }
  /// Returns true if the gap has a direction. If not, that of the step before holds: its plane has just been reached.
  static ISO_INLINE bool is_clear(const GjkDistance<F>& found, F noise) { return found.distance > noise * F(256); }

  /// Decides the whole way by a plane through which they do not sink, since both are convex.
  template <class Search>
  ISO_INLINE CoreHit<F> from_touch(Search& search, const GjkDistance<F>& found, F nearby) const {
    CoreHit<F> start = {true, false, U(0), found.normal, found.on_b};
    F depth = radii - found.separation;
    if (!is_clear(found, gap_noise(extent + max_abs(from)))) {
      const std::optional<CoreWayOut<F>> out = search.way_out(extent + max_abs(from));
      start.is_open = !out;
      if (!out) return start;
      depth = out->depth + radii;
      start.normal = out->normal;
      start.on_b = out->on_b;
    }
    start.gap = -depth;
    const F sinks = -dot(way, start.normal) * end;
    start.inside = depth > max(touch, nearby);
    start.hit = start.inside || sinks > max(min(touch, length(way) * end * F(0.00390625)), nearby);
    return start;
  }
};

}  // namespace isostep::detail
