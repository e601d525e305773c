// Body of time_of_impact.hpp.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/collision/continuous/time_of_impact.hpp"
#include "isostep/collision/narrowphase/gjk.inl"

namespace isostep {
namespace detail {

/// A core and its motion, in world axes about an origin near it.
template <class S> class SweptCore {
  using F = Finer<S>;
  using U = Unit<F>;

 public:
  FineCore<S> core;
  Vec3<F> centre;     // [m] of turning, in the core's frame
  Vec3<F> from, way;  // [m] of it
  Quat<U> start, end;
  Vec3<F> sines;  // twice the sine of half the turn, along its axis
  F reach;        // [m] of the vertices from the centre
  F bend;         // [m] no vertex has a larger acceleration, in fractions of the motion

  ISO_INLINE SweptCore(const ConvexCore<S>& of, const CoreMotion<S>& motion, Vec3<S> origin)
      : core(of), centre(finer_of<F>(motion.centre)), start(fine(motion.start.orientation)) {
    end = on_near_side(start, fine(motion.end.orientation));
    const Vec3<F> arm = rotate(start, centre);
    from = finer_of<F>(motion.start.position - origin) + arm;
    way = finer_of<F>(motion.end.position - motion.start.position) + (rotate(end, centre) - arm);
    const Quat<U> turn = end * conjugate(start);
    const Vec3<F> sine = {convert<F>(turn.x), convert<F>(turn.y), convert<F>(turn.z)};
    sines = sine + sine;
    const Vec3<F> axis = transposed_times(to_matrix(start), sine);  // in the core's frame: its vertices turn about it
    const auto arm_of = [&](std::uint32_t i) ISO_INLINE_LAMBDA { return core.vertices[i] - centre; };
    reach = longest_of<F>(core.vertices.size(), arm_of);
    // [m] The largest distance of a vertex from the axis, times the sine.
    const F turned =
        longest_of<F>(core.vertices.size(), [&](std::uint32_t i) ISO_INLINE_LAMBDA { return cross(axis, arm_of(i)); });
    // c is the tangent of a quarter of the turn; the angular speed is 4 c and its change 16 c^3 at most.
    const F share = F(1) + convert<F>(turn.w), c = length(sine) / share;
    bend = c * (F(1) + c) * (turned / share) * F(16.25);
  }

  ISO_INLINE Transform<F> at(U t) const {
    const Mat3<U> rotation = to_matrix(normalise(between(start, end, t)));
    return {from + way * t - rotation * centre, rotation};
  }
  /// [1] Returns the angular velocity, in radians per motion.
  ISO_INLINE Vec3<F> spin(U t) const {
    const Quat<U> q = between(start, end, t);
    const U squared = round_to<U>(product(q.x, q.x) + product(q.y, q.y) + product(q.z, q.z) + product(q.w, q.w));
    return {divide_to<F>(sines.x, squared), divide_to<F>(sines.y, squared), divide_to<F>(sines.z, squared)};
  }

 private:
  static ISO_INLINE Quat<U> fine(Quat<Unit<S>> q) {
    return normalise(Quat<U>{finer<U>(q.x), finer<U>(q.y), finer<U>(q.z), finer<U>(q.w)});
  }
};

/// A lower bound of the height of one core's lowest vertex along a direction above its centre, and its slope.
template <class F> struct HeightBound {
  F height;  // [m]
  F slope;   // [m] for a fraction of 1
};
template <class F> struct Turning {
  ArrayView<Vec3<F>> vertices;  // [m]
  Vec3<F> centre;               // [m]
  Vec3<F> up, change;           // [1] the direction, in the core's frame, and how the core's turning changes it

  ISO_INLINE HeightBound<F> lowest(Unit<F> d) const {
    const Vec3<F> direction = up + change * d;
    std::uint32_t lowest = 0;
    F height = dot(direction, vertices[0]);
    for (std::uint32_t i = 1; i < vertices.size(); ++i) {
      const F other = dot(direction, vertices[i]);
      if (other < height) height = other, lowest = i;
    }
    return {height - dot(direction, centre), dot(change, vertices[lowest] - centre)};
  }
};

/// [1] The fraction of a motion that counts as progress.
template <class U> inline constexpr U kAtOnce = U(0.125);

/// L(d) of time_of_impact.hpp.
template <class F> struct GapBound {
  using U = Unit<F>;
  Turning<F> a, b;
  F gap;    // [m] of the centres along the normal, less what must remain
  F speed;  // [m] for a fraction of 1
  F bend;   // [m]

  ISO_INLINE HeightBound<F> at(U d) const {
    const HeightBound<F> of_a = a.lowest(d), of_b = b.lowest(d);
    const F bent = bend * d;
    return {gap + speed * d + of_a.height + of_b.height - bent * d * F(0.5), speed + of_a.slope + of_b.slope - bent};
  }
  /// Returns how far the bound is proved to stay above 0, up to `rest`. `now` is its value at 0.
  ISO_INLINE U proved(F now, U rest) const {
    U d = rest;
    for (int round = 0;; ++round) {
      const HeightBound<F> bound = at(d);
      if (bound.height >= F(0)) return d;
      const U back = bound.slope < F(0) ? divide_to<U>(bound.height, bound.slope) : d;
      if (round == 6 || !(back < d) || -bound.height < now * F(0.0625))
        return d * divide_to<U>(now, now - bound.height) - resolution<U>();
      d = d - back;
    }
  }
};

/// Returns the turning of a core's lower side along the normal n [1], in world axes, if `up` is n, or of its upper side
/// if `up` is -n.
template <class S, class F = Finer<S>>
ISO_INLINE Turning<F> turning_of(const SweptCore<S>& sweep, const Mat3<Unit<F>>& rotation, Vec3<F> up, Unit<F> t) {
  return {sweep.core.vertices, sweep.centre, transposed_times(rotation, up),
          transposed_times(rotation, cross(up, sweep.spin(t)))};
}

template <class S> class Advance {
  using F = Finer<S>;
  using U = Unit<F>;
  static constexpr std::int32_t kMostRounds = 32;
  static constexpr F kEnough = F(0.5);  // of a distance: a plane that far away is worth a step before the best is found

 public:
  struct Result {
    Impact impact;
    U fraction;
    Vec3<U> normal;      // [1] world axes
    Vec3<F> on_a, on_b;  // [m] of the cores, world axes
    F separation;        // [m]
    std::int32_t rounds;
  };

  ISO_INLINE Advance(const SweptCore<S>& a, const SweptCore<S>& b, F target)
      : a_(a), b_(b), target_(target), radii_(a.core.radius + b.core.radius) {}

  ISO_INLINE Result run() const {
    Result result = {Impact::none, U(0), Vec3<U>::zero(), Vec3<F>::zero(), Vec3<F>::zero(), F(0), 0};
    Simplex<F> simplex = {};
    bool stays = false;  // nearer than the target in every round so far
    for (result.rounds = 1; result.rounds <= kMostRounds; ++result.rounds) {
      const U t = result.fraction;
      const Transform<F> ta = a_.at(t), tb = b_.at(t), b_in_a = relative(ta, tb);
      const Gjk<F> search(a_.core.vertices, b_.core.vertices, b_in_a);
      simplex = result.rounds == 1 ? search.begin() : search.begin(simplex);
      const F noise = noise_at(max_abs(b_in_a.position)), target = max(target_, noise * F(8)), keep = target * F(0.5);
      const F distant = radii_ + target * F(2);
      const GjkDistance<F> found = search.run(simplex, [=, this](F separation, F distance) ISO_INLINE_LAMBDA {
        return separation > distant && separation - radii_ >= (distance - radii_) * kEnough;
      });
      result.separation = found.separation - radii_ - noise;
      result.normal = ta.rotation * found.normal;
      result.on_a = to_world(ta, found.on_a);
      result.on_b = to_world(ta, found.on_b);
      const bool nearby = result.separation <= target, begins = result.rounds == 1;
      stays = nearby && (begins || stays);
      result.impact = begins ? Impact::at_start : stays && t < kAtOnce<U> ? Impact::stays : Impact::touch;
      if (found.distance == F(0) || result.separation <= (begins ? keep : target)) return result;
      result.impact = nearby ? Impact::touch : Impact::cut_off;
      const U rest = U(1) - t;
      const U step = bound_at(t, ta, tb, result.normal, keep + noise).proved(result.separation - keep, rest);
      if (!(step < rest)) return {Impact::none, U(1), Vec3<U>::zero(), result.on_a, result.on_b, F(0), result.rounds};
      if (!(step > U(0))) return result;
      result.fraction = t + step;
    }
    return result;
  }

 private:
  /// [m] The rounding error of a separation: that of the vertices and of directions in F's digits.
  ISO_INLINE F noise_at(F apart) const {
    return gap_noise(a_.core.extent + b_.core.extent + apart) + (a_.reach + b_.reach) * resolution<F>() * F(4);
  }
  ISO_INLINE GapBound<F> bound_at(U t, const Transform<F>& ta, const Transform<F>& tb, Vec3<U> normal, F keep) const {
    const Vec3<F> n = {convert<F>(normal.x), convert<F>(normal.y), convert<F>(normal.z)};
    const Vec3<F> apart = b_.from + b_.way * t - (a_.from + a_.way * t);
    return {turning_of(a_, ta.rotation, -n, t), turning_of(b_, tb.rotation, n, t), dot(normal, apart) - radii_ - keep,
            dot(normal, b_.way - a_.way), a_.bend + b_.bend};
  }

  const SweptCore<S>&a_, &b_;
  F target_, radii_;  // [m]
};

}  // namespace detail

template <class S>
TimeOfImpact<S> time_of_impact(const ConvexCore<S>& a, const CoreMotion<S>& of_a, const ConvexCore<S>& b,
                               const CoreMotion<S>& of_b, S target) {
  using namespace detail;
  using F = Finer<S>;
  const Vec3<S> origin = of_a.start.position;
  const SweptCore<S> sweep_a(a, of_a, origin), sweep_b(b, of_b, origin);
  const F least = finer<F>(max(target, resolution<S>() * S(4)));
  const typename Advance<S>::Result found = Advance<S>(sweep_a, sweep_b, least).run();
  const auto placed = [&](Vec3<F> core, F radius)
                          ISO_INLINE_LAMBDA { return origin + coarser_of<S>(core + found.normal * radius); };
  return {found.impact,
          coarser_down<Unit<S>>(found.fraction),
          coarser_of<Unit<S>>(found.normal),
          placed(found.on_a, sweep_a.core.radius),
          placed(found.on_b, -sweep_b.core.radius),
          coarser_down<S>(found.separation),
          found.rounds};
}

}  // namespace isostep
