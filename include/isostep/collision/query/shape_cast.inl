// Body of shape_cast.hpp.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/collision/narrowphase/epa.inl"
#include "isostep/collision/query/shape_cast.hpp"

namespace isostep {
namespace detail {

/// As CastHit, in a's frame at the start; the normal points from a to b.
template <class F> struct CoreHit {
  bool hit, inside;
  Unit<F> fraction;
  Vec3<Unit<F>> normal;
  Vec3<F> on_b;  // [m] of its core
};

/// A cast in a's frame, in which b moves the other way.
template <class F> class CoreCast {
  using U = Unit<F>;
  static constexpr int kMostRounds = 32;
  static constexpr F kEnough = F(0.5);  // of a distance: a plane that far away is worth a step before the best is found

 public:
  ArrayView<Vec3<F>> a, b;  // [m] vertices, each core's in its own frame
  F radii;                        // [m] of both together
  F extent;                       // [m] of both together
  Transform<F> b_in_a;            // at the start
  Vec3<F> way;                    // [m] of b, for a fraction of 1
  U end, latest;                  // [1] see CastMotion; latest by no less
  F touch, resolution;            // [m]

  ISO_INLINE CoreHit<F> run() const {
    U t = U(0);
    CoreHit<F> last = {};
    Simplex<F> simplex = {};
    for (int round = 0; round < kMostRounds; ++round) {
      const Transform<F> now = {b_in_a.position + way * t, b_in_a.rotation};
      const Gjk<F> search(a, b, now);
      simplex = round == 0 ? search.begin() : search.begin(simplex);
      const F noise = gap_noise(extent + max_abs(now.position)), near = noise * F(2) + resolution;
      const F far = radii + near * F(16);
      const GjkDistance<F> found = search.run(simplex, [=, this](F separation, F distance) ISO_INLINE_LAMBDA {
        return separation > far && separation - radii >= (distance - radii) * kEnough;
      });
      const F gap = found.separation - radii - noise;
      if (round == 0 && (found.distance == F(0) || gap <= near)) return from_touch(search, simplex, found, near);
      const F closing = -dot(way, found.normal);
      if (found.distance != F(0)) {
        if (!(closing > F(0)) || gap >= closing * (end - t)) return {};
        // Within `near` they touch, at t: how far the plane would let them go on is not asked.
        const bool ends_later = gap > near && gap > closing * (latest - t) + isostep::resolution<F>() * F(4);
        if (latest < end && ends_later) return {};
        last.hit = true;
        if (round == 0 || is_clear(found, noise)) last.normal = found.normal, last.on_b = found.on_b - way * t;
      }
      if (gap <= near) return last;
      const U step = divide_to<U>(gap, closing) - isostep::resolution<U>();
      if (!(step > U(0))) return last;
      t = last.fraction = t + step;
    }
    return last;
  }

 private:
  /// Whether the gap has a direction. Else that of the step before is right: its plane has just been reached.
  static ISO_INLINE bool is_clear(const GjkDistance<F>& found, F noise) { return found.distance > noise * F(256); }

  /// What a plane that they do not sink through decides for the whole way, as both are convex.
  ISO_INLINE CoreHit<F> from_touch(const Gjk<F>& search, const Simplex<F>& simplex, const GjkDistance<F>& found,
                                   F near) const {
    CoreHit<F> start = {true, false, U(0), found.normal, found.on_b};
    F depth = radii - found.separation;
    if (!is_clear(found, gap_noise(extent + max_abs(b_in_a.position)))) {
      const typename Epa<F>::Axis axis = Epa<F>(search, extent + max_abs(b_in_a.position)).run(simplex);
      depth = axis.depth + radii;
      start.normal = axis.normal;
      start.on_b = search.witnesses(axis.face, axis.rounds).on_b;
    }
    const F sinks = -dot(way, start.normal) * end;
    start.inside = depth > max(touch, near);
    start.hit = start.inside || sinks > max(min(touch, length(way) * end * F(0.00390625)), near);
    return start;
  }
};

}  // namespace detail

template <class S>
bool cast_convex(const ConvexCore<S>& a, const Transform<S>& ta, const ConvexCore<S>& b, const Transform<S>& tb,
                 const CastMotion<S>& motion, CastHit<S>& hit) {
  using namespace detail;
  using F = Finer<S>;
  const FineCore<S> fine_a(a), fine_b(b);
  const Mat3<Unit<F>> turn = finer_of(ta).rotation;
  CoreCast<F> cast = {};
  cast.a = fine_a.vertices;
  cast.b = fine_b.vertices;
  cast.radii = fine_a.radius + fine_b.radius;
  cast.extent = fine_a.extent + fine_b.extent;
  cast.b_in_a = fine_relative(ta, tb);
  cast.way = -transposed_times(turn, finer_of<F>(motion.translation));
  cast.end = finer<Unit<F>>(motion.max_fraction);
  // A fraction is rounded down to a step of S: what gives the latest one is found whatever the rounding.
  cast.latest = min(finer<Unit<F>>(motion.latest), Unit<F>(1)) + finer<Unit<F>>(resolution<Unit<S>>()) +
                Unit<F>(0x1p-20);
  cast.touch = finer<F>(motion.touch);
  cast.resolution = finer<F>(resolution<S>());
  const CoreHit<F> found = cast.run();
  if (!found.hit) return false;
  hit.fraction = coarser_down<Unit<S>>(found.fraction);
  const Vec3<Unit<F>> normal = turn * -found.normal;
  const Vec3<F> on_b = turn * found.on_b + normal * fine_b.radius;
  hit.normal = coarser_of<Unit<S>>(normal);
  hit.point = ta.position + coarser_of<S>(on_b);
  hit.inside = found.inside;
  return true;
}

}  // namespace isostep
