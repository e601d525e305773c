// Body of plane_impact.hpp.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/collision/continuous/plane_impact.hpp"
#include "isostep/collision/continuous/time_of_impact.inl"

namespace isostep {
namespace detail {

template <class S> class PlaneAdvance {
  using F = Finer<S>;
  using U = Unit<F>;
  static constexpr std::int32_t kMostRounds = 32;

 public:
  ISO_INLINE PlaneAdvance(const SweptCore<S>& core, Vec3<U> normal, Vec3<F> point, F target)
      : core_(core),
        normal_(normal),
        up_{convert<F>(normal.x), convert<F>(normal.y), convert<F>(normal.z)},
        point_(point),
        target_(target) {}

  ISO_INLINE TimeOfImpact<S> run() const {
    TimeOfImpact<S> result = {Impact::none, Unit<S>(0), coarser_of<Unit<S>>(-normal_), Vec3<S>::zero(), Vec3<S>::zero(),
                              S(0),         0};
    U t = U(0);
    bool stays = false;  // nearer than the target in every round so far
    for (result.rounds = 1; result.rounds <= kMostRounds; ++result.rounds) {
      const GapBound<F> bound = bound_at(t);
      const F noise = gap_noise(core_.core.extent + max_abs(core_.from + core_.way * t - point_)) +
                      core_.reach * resolution<F>() * F(4);
      const F target = max(target_, noise * F(8)), keep = target * F(0.5);
      const F separation = bound.at(U(0)).height - noise;
      const bool nearby = separation <= target, begins = result.rounds == 1;
      stays = nearby && (begins || stays);
      result.impact = begins ? Impact::at_start : stays && t < kAtOnce<U> ? Impact::stays : Impact::touch;
      result.separation = coarser_down<S>(separation);
      if (separation <= (begins ? keep : target)) return result;
      result.impact = nearby ? Impact::touch : Impact::cut_off;
      const U rest = U(1) - t;
      GapBound<F> above = bound;
      above.gap = bound.gap - (keep + noise);
      const U step = above.proved(separation - keep, rest);
      if (!(step < rest)) {
        result.impact = Impact::none;
        result.fraction = Unit<S>(1);
        return result;
      }
      if (!(step > U(0))) return result;
      t = t + step;
      result.fraction = coarser_down<Unit<S>>(t);
    }
    return result;
  }

 private:
  /// Returns the bound of the core's surface above the plane. The plane is one vertex that does not move.
  ISO_INLINE GapBound<F> bound_at(U t) const {
    static constexpr Vec3<F> kNothing[1] = {{F(0), F(0), F(0)}};
    const Vec3<F> zero = kNothing[0];
    return {turning_of(core_, core_.at(t).rotation, up_, t),
            {kNothing, zero, zero, zero},
            dot(normal_, core_.from + core_.way * t - point_) - core_.core.radius,
            dot(normal_, core_.way),
            core_.bend};
  }

  const SweptCore<S>& core_;
  Vec3<U> normal_;
  Vec3<F> up_, point_;
  F target_;
};

/// Returns the point of the core's surface that is furthest against the normal.
template <class S> Vec3<S> lowest_point(const ConvexCore<S>& core, const Pose<S>& at, Vec3<Unit<S>> normal) {
  const Mat3<Unit<S>> rotation = to_matrix(at.orientation);
  Vec3<S> lowest = rotation * core.vertices[0];
  for (std::uint32_t i = 1; i < core.vertices.size(); ++i) {
    const Vec3<S> p = rotation * core.vertices[i];
    if (dot(normal, p) < dot(normal, lowest)) lowest = p;
  }
  return at.position + lowest - normal * core.radius;
}

}  // namespace detail

template <class S>
TimeOfImpact<S> plane_impact(const ConvexCore<S>& core, const CoreMotion<S>& motion, const SolidPlane<S>& plane,
                             S target) {
  using namespace detail;
  using F = Finer<S>;
  const Vec3<S> origin = motion.start.position;
  const SweptCore<S> sweep(core, motion, origin);
  TimeOfImpact<S> found = PlaneAdvance<S>(sweep, finer_of<Unit<F>>(plane.normal), finer_of<F>(plane.point - origin),
                                          finer<F>(max(target, resolution<S>() * S(4))))
                              .run();
  if (found.impact == Impact::at_start) found.on_a = lowest_point(core, motion.start, plane.normal);
  return found;
}

}  // namespace isostep
