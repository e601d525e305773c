// Bodies of shape_impact.hpp.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/collision/continuous/core_way.hpp"
#include "isostep/collision/continuous/plane_impact.hpp"
#include "isostep/collision/continuous/shape_impact.hpp"
#include "isostep/collision/continuous/surface_impact.hpp"
#include "isostep/collision/continuous/time_of_impact.hpp"
#include "isostep/collision/narrowphase/cropped_box.hpp"
#include "isostep/collision/narrowphase/shape_core.hpp"

namespace isostep {
namespace detail {

// thickness_of() and impact_with() treat `b`: a solid, or one of the shapes that only bodies at rest have, each with
// two functions of its own. A surface of triangles joins here: the least fraction of those that the swept solid's box
// meets.

template <class S, class Shape> ISO_INLINE S thickness_of(const Shape& shape) {
  static_assert(kIsSolid<Shape>, "a shape without an end needs thickness_of and impact_with here");
  return min(shape.inner_radius(), kThick<S>);
}
template <class S, class Shape>
TimeOfImpact<S> impact_with(const Shape& shape, const Transform<S>& at, const CoreMotion<S>& of_shape,
                            const ConvexCore<S>& core, const CoreMotion<S>& motion, S target) {
  const ShapeCore<S> other(shape, at, S(0));
  return time_of_impact(core, motion, other.core(), of_shape, target);
}
/// Crops a box that does not turn to what is near the core's way: the noise of a distance grows with the box.
template <class S>
TimeOfImpact<S> impact_with(const Box<S>& box, const Transform<S>& at, const CoreMotion<S>& of_box,
                            const ConvexCore<S>& core, const CoreMotion<S>& motion, S target) {
  if (of_box.start.orientation == of_box.end.orientation) {
    const Transform<S> t = compose(Transform<S>::of(of_box.start), at);
    const Vec3<S> way = of_box.end.position - of_box.start.position;
    const CoreMotion<S> seen = {motion.start, {motion.end.position - way, motion.end.orientation}, motion.centre};
    const CroppedBox<S> kept = cropped(box.half_extents, CoreWay<S>(t, core, seen).box(target));
    if (!(kept.half == box.half_extents)) {
      const Vec3<S> middle = to_world(t, kept.middle);
      const Quat<Unit<S>> turn = of_box.start.orientation;
      const CoreMotion<S> of_kept = {{middle, turn}, {middle + way, turn}, Vec3<S>::zero()};
      const Transform<S> turned = {Vec3<S>::zero(), at.rotation};
      return impact_with<S, Box<S>>({kept.half}, turned, of_kept, core, motion, target);
    }
  }
  return impact_with<S, Box<S>>(box, at, of_box, core, motion, target);
}

template <class S> ISO_INLINE S thickness_of(const HalfSpace<S>&) { return kThick<S>; }
template <class S>
TimeOfImpact<S> impact_with(const HalfSpace<S>& space, const Transform<S>& at, const CoreMotion<S>& of_space,
                            const ConvexCore<S>& core, const CoreMotion<S>& motion, S target) {
  const Transform<S> t = compose(Transform<S>::of(of_space.start), at);
  const Vec3<Unit<S>> normal = t.rotation * space.normal;
  const S height = dot(normal, motion.start.position - t.position) - space.offset;
  return plane_impact(core, motion, {normal, motion.start.position - normal * height}, target);
}

// A surface has no thickness: a solid whose centre is behind it has passed it.
template <class S, ShapeType Type, class G> ISO_INLINE S thickness_of(const SurfaceShape<S, Type, G>&) { return S(0); }
template <class S, ShapeType Type, class G>
TimeOfImpact<S> impact_with(const SurfaceShape<S, Type, G>& shape, const Transform<S>& at,
                            const CoreMotion<S>& of_surface, const ConvexCore<S>& core, const CoreMotion<S>& motion,
                            S target) {
  return surface_impact(shape.surface(), compose(Transform<S>::of(of_surface.start), at), core, motion, target);
}

template <class S> ISO_INLINE S graze_of(S inner) { return min(inner * S(0.25), kGraze<S>); }

/// [1] The fraction of a motion that counts as progress. A solid that is kGraze deeper before is fast, 7 m/s and more
/// at 60 Hz, and its first contact has to stop it.
template <class U> inline constexpr U kGettingOn = U(0.03125);
/// [m] Returns the way of a point of a solid from the start to the end of its motion.
template <class S> ISO_INLINE Vec3<S> way_of_point(const CoreMotion<S>& motion, Vec3<S> point) {
  return motion.end.position - motion.start.position + rotate(motion.end.orientation, point) -
         rotate(motion.start.orientation, point);
}

template <class S> class Passage {
 public:
  ISO_INLINE Passage(const PlacedShape<S>& a, const CoreMotion<S>& motion, const PlacedShape<S>& b,
                     const CoreMotion<S>& of_b)
      : a_(a), motion_(motion), b_(b), of_b_(of_b) {}

  ISO_INLINE FreeWay<S> free_way() const {
    return visit_shape(a_.shape, [&](const auto& solid) ISO_INLINE_LAMBDA { return of_solid(solid); });
  }
  ISO_INLINE bool touches_at_start(Vec3<S>& on_a) const {
    return visit_shape(a_.shape, [&](const auto& solid) ISO_INLINE_LAMBDA { return is_touched(solid, on_a); });
  }
  ISO_INLINE bool is_deep_at_start() const {
    return visit_shape(a_.shape, [&](const auto& solid) ISO_INLINE_LAMBDA { return is_deep(solid); });
  }

 private:
  /// The smaller solid that is swept in place of the whole.
  struct Smaller {
    S inset;  // [m] so deep in it
    S ball;   // [m] not 0: the radius of a ball in its middle
  };

  template <class Shape> FreeWay<S> of_solid(const Shape& solid) const {
    if constexpr (kIsSolid<Shape>) {
      const S inner = solid.inner_radius(), graze = graze_of(inner), target = graze * S(0.5);
      S inset = graze;
      TimeOfImpact<S> whole = impact(solid, {inset, S(0)}, target);
      while (whole.impact == Impact::at_start && inset < inner * S(0.5)) {
        inset = min(inset + inset, inner * S(0.5));
        whole = impact(solid, {inset, S(0)}, target);
      }
      if (whole.impact == Impact::at_start) return of_middle(solid, inner, target);
      if (whole.impact != Impact::stays) return up_to(whole.fraction);
      const TimeOfImpact<S> deeper = impact(solid, {inset + graze, S(0)}, target);
      const bool gets_on = deeper.impact != Impact::at_start && !(deeper.fraction < kGettingOn<Unit<S>>);
      return up_to(gets_on ? deeper.fraction : whole.fraction);
    }
    return up_to(Unit<S>(1));
  }
  template <class Shape> bool is_touched(const Shape& solid, Vec3<S>& on_a) const {
    if constexpr (kIsSolid<Shape>) {
      const S graze = graze_of<S>(solid.inner_radius());
      const TimeOfImpact<S> nearby = impact(solid, {graze, S(0)}, graze * S(3));
      on_a = nearby.on_a;
      return nearby.impact == Impact::at_start && !(nearby.normal == Vec3<Unit<S>>::zero());
    }
    return false;
  }
  template <class Shape> bool is_deep(const Shape& solid) const {
    if constexpr (kIsSolid<Shape>) {
      const S inset = min(solid.inner_radius() * S(0.5), kTooDeep<S>);
      return impact(solid, {inset, S(0)}, S(0)).impact == Impact::at_start;
    }
    return false;
  }
  ISO_INLINE FreeWay<S> up_to(Unit<S> fraction) const {
    return {fraction, false, Vec3<S>::zero(), Vec3<Unit<S>>::zero()};
  }
  /// Sweeps balls in the middle. A ball that has come as near as it may only moves away. The first triangle of a
  /// surface that it meets decides that for all of them, so smaller balls, which may come nearer, are tried before.
  template <class Shape> FreeWay<S> of_middle(const Shape& solid, S inner, S target) const {
    ShapeCore<S> core(solid, a_.at, S(0));
    core.become_ball(inner);
    const Vec3<S> middle = core.core().vertices[0];
    const struct {
      S radius, target;
    } balls[] = {{inner * S(0.75), target},
                 {inner * S(0.25), target},
                 {inner * S(0.25), target * S(0.5)},
                 {inner * S(0.0625), target * S(0.25)}};
    TimeOfImpact<S> ball = impact(solid, {S(0), balls[0].radius}, balls[0].target);
    for (int i = 1; i < 4 && ball.impact == Impact::at_start; ++i)
      ball = impact(solid, {S(0), balls[i].radius}, balls[i].target);
    if (ball.impact == Impact::at_start) {
      const Vec3<S> there = motion_.start.position + rotate(motion_.start.orientation, middle);
      const Vec3<S> on_b = transposed_times(to_matrix(of_b_.start.orientation), there - of_b_.start.position);
      const Vec3<S> way = way_of_point(motion_, middle) - way_of_point(of_b_, on_b);
      if (!(dot(ball.normal, way) > S(0))) return up_to(Unit<S>(1));
      ball.fraction = Unit<S>(0);
    }
    FreeWay<S> free = up_to(ball.fraction);
    free.is_held = ball.impact != Impact::none;
    free.middle = middle;
    free.normal = ball.normal;
    return free;
  }
  template <class Shape> TimeOfImpact<S> impact(const Shape& solid, Smaller by, S target) const {
    ShapeCore<S> core(solid, a_.at, by.inset);
    if (by.ball > S(0)) core.become_ball(by.ball);
    return visit_shape(b_.shape, [&](const auto& shape) ISO_INLINE_LAMBDA {
      return impact_with(shape, b_.at, of_b_, core.core(), motion_, target);
    });
  }

  const PlacedShape<S>& a_;
  const CoreMotion<S>& motion_;
  const PlacedShape<S>& b_;
  const CoreMotion<S>& of_b_;
};

}  // namespace detail

template <class S> S thickness(const ShapeView<S>& shape) {
  return visit_shape(shape, [](const auto& visited) ISO_INLINE_LAMBDA { return detail::thickness_of<S>(visited); });
}

template <class S>
FreeWay<S> free_way(const PlacedShape<S>& a, const CoreMotion<S>& motion, const PlacedShape<S>& b,
                    const CoreMotion<S>& of_b) {
  return detail::Passage<S>(a, motion, b, of_b).free_way();
}

template <class S>
bool is_deep(const PlacedShape<S>& a, const Pose<S>& pose_of_a, const PlacedShape<S>& b, const Pose<S>& pose_of_b) {
  const CoreMotion<S> of_a = {pose_of_a, pose_of_a, Vec3<S>::zero()}, of_b = {pose_of_b, pose_of_b, Vec3<S>::zero()};
  return detail::Passage<S>(a, of_a, b, of_b).is_deep_at_start();
}

template <class S>
bool touches_at_start(const PlacedShape<S>& a, const CoreMotion<S>& motion, const PlacedShape<S>& b,
                      const Pose<S>& pose_of_b, Vec3<S>& on_a) {
  const CoreMotion<S> of_b = {pose_of_b, pose_of_b, Vec3<S>::zero()};
  return detail::Passage<S>(a, motion, b, of_b).touches_at_start(on_a);
}

}  // namespace isostep
