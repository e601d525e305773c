// Bodies of shape_impact.hpp.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/collision/continuous/plane_impact.hpp"
#include "isostep/collision/continuous/shape_impact.hpp"
#include "isostep/collision/continuous/surface_impact.hpp"
#include "isostep/collision/continuous/time_of_impact.hpp"
#include "isostep/collision/narrowphase/shape_core.hpp"

namespace isostep {
namespace detail {

// What is at rest: a solid, or one of the shapes that only bodies at rest have, each with two functions of its own. A
// surface of triangles joins here: the least fraction of those that the swept solid's box meets.

template <class S, class Shape> ISO_INLINE S thickness_of(const Shape& shape) {
  static_assert(kIsSolid<Shape>, "a shape without an end needs thickness_of and impact_with here");
  return min(shape.inner_radius(), kThick<S>);
}
template <class S, class Shape>
TimeOfImpact<S> impact_with(const Shape& shape, const Transform<S>& at, const Pose<S>& pose, const ConvexCore<S>& core,
                            const CoreMotion<S>& motion, S target) {
  const ShapeCore<S> other(shape, at, S(0));
  return time_of_impact(core, motion, other.core(), {pose, pose, Vec3<S>::zero()}, target);
}

template <class S> ISO_INLINE S thickness_of(const HalfSpace<S>&) { return kThick<S>; }
template <class S>
TimeOfImpact<S> impact_with(const HalfSpace<S>& space, const Transform<S>& at, const Pose<S>& pose,
                            const ConvexCore<S>& core, const CoreMotion<S>& motion, S target) {
  const Transform<S> t = compose(Transform<S>::of(pose), at);
  const Vec3<Unit<S>> normal = t.rotation * space.normal;
  const S height = dot(normal, motion.start.position - t.position) - space.offset;
  return plane_impact(core, motion, {normal, motion.start.position - normal * height}, target);
}

// A surface has no thickness: what its centre is behind of has passed it.
template <class S, ShapeType Type, class G> ISO_INLINE S thickness_of(const SurfaceShape<S, Type, G>&) { return S(0); }
template <class S, ShapeType Type, class G>
TimeOfImpact<S> impact_with(const SurfaceShape<S, Type, G>& shape, const Transform<S>& at, const Pose<S>& pose,
                            const ConvexCore<S>& core, const CoreMotion<S>& motion, S target) {
  return surface_impact(shape.surface(), compose(Transform<S>::of(pose), at), core, motion, target);
}

template <class S> class Passage {
 public:
  ISO_INLINE Passage(const PlacedShape<S>& a, const CoreMotion<S>& motion, const PlacedShape<S>& b, const Pose<S>& pose)
      : a_(a), motion_(motion), b_(b), pose_(pose) {}

  ISO_INLINE Unit<S> free_fraction() const {
    return visit_shape(a_.shape, [&](const auto& solid) ISO_INLINE_LAMBDA { return of_solid(solid); });
  }

 private:
  /// What is swept instead of the whole solid.
  struct Smaller {
    S inset;  // [m] so deep in it
    S ball;   // [m] not 0: the radius of a ball in its middle
  };

  template <class Shape> Unit<S> of_solid(const Shape& solid) const {
    if constexpr (kIsSolid<Shape>) {
      const S inner = solid.inner_radius(), graze = min(inner * S(0.25), kGraze<S>), target = graze * S(0.5);
      const TimeOfImpact<S> grazing = impact(solid, {graze, S(0)}, target);
      if (grazing.impact == Impact::none) return Unit<S>(1);
      if (grazing.impact != Impact::at_start) {
        const TimeOfImpact<S> whole = impact(solid, {S(0), S(0)}, target);
        return whole.impact == Impact::at_start ? grazing.fraction : min(whole.fraction, grazing.fraction);
      }
      const Smaller smaller[] = {{inner * S(0.25), S(0)}, {S(0), inner * S(0.75)}};
      for (const Smaller& by : smaller) {
        const TimeOfImpact<S> found = impact(solid, by, target);
        if (found.impact != Impact::at_start) return found.fraction;
      }
      return of_middle(solid, inner * S(0.25), target);
    }
    return Unit<S>(1);
  }
  /// A ball that has come as near as it may goes nowhere but away.
  template <class Shape> Unit<S> of_middle(const Shape& solid, S ball, S target) const {
    const TimeOfImpact<S> found = impact(solid, {S(0), ball}, target);
    if (found.impact != Impact::at_start) return found.fraction;
    return impact(solid, {S(0), ball}, target * S(0.5)).impact == Impact::touch ? Unit<S>(0) : Unit<S>(1);
  }
  template <class Shape> TimeOfImpact<S> impact(const Shape& solid, Smaller by, S target) const {
    ShapeCore<S> core(solid, a_.at, by.inset);
    if (by.ball > S(0)) core.become_ball(by.ball);
    return visit_shape(b_.shape, [&](const auto& shape) ISO_INLINE_LAMBDA {
      return impact_with(shape, b_.at, pose_, core.core(), motion_, target);
    });
  }

  const PlacedShape<S>& a_;
  const CoreMotion<S>& motion_;
  const PlacedShape<S>& b_;
  const Pose<S>& pose_;
};

}  // namespace detail

template <class S> S thickness(const ShapeView<S>& shape) {
  return visit_shape(shape,
                     [](const auto& visited) ISO_INLINE_LAMBDA { return detail::thickness_of<S>(visited); });
}

template <class S>
Unit<S> free_fraction(const PlacedShape<S>& a, const CoreMotion<S>& motion, const PlacedShape<S>& b,
                      const Pose<S>& pose_of_b) {
  return detail::Passage<S>(a, motion, b, pose_of_b).free_fraction();
}

}  // namespace isostep
