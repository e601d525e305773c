// Swept cores against surfaces: the least fraction of the triangles that the sweep's box meets and that may be reached.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/collision/continuous/core_way.hpp"
#include "isostep/collision/continuous/time_of_impact.hpp"
#include "isostep/geometry/baked/unit_of_steps.hpp"
#include "isostep/geometry/surfaces.hpp"

namespace isostep::detail {

template <class S> ISO_INLINE MeshBox steps_of(const Aabb<S>& box, int exponent) {
  MeshBox steps;
  for (int axis = 0; axis < 3; ++axis) {
    steps.low[axis] = floor_scaled(box.low[axis], exponent);
    steps.high[axis] = floor_scaled(box.high[axis], exponent) + 1;
  }
  return steps;
}
template <class S> Vec3<S> middle_of(const ConvexCore<S>& core) {
  const Unit<S> share = divide_to<Unit<S>>(S(1), S(static_cast<std::int32_t>(core.vertices.size())));
  Vec3<S> middle = Vec3<S>::zero();
  for (const Vec3<S>& v : core.vertices) middle += v * share;
  return middle;
}

/// Sweeps a core against a surface at rest.
/// Method:  time_of_impact() is asked about few triangles only. Not about those whose plane the core stays above, nor
///          about those that lie below the plane of such a one, as beyond a ridge.
template <class S, class G> class SurfaceSweep {
 public:
  ISO_INLINE SurfaceSweep(const G& surface, const Transform<S>& t, const ConvexCore<S>& core,
                          const CoreMotion<S>& motion, S target)
      : surface_(surface), t_(t), core_(core), motion_(motion), target_(target), way_(t, core, motion) {}

  TimeOfImpact<S> first() {
    const Vec3<S> start = to_local(t_, to_world(Transform<S>::of(motion_.start), middle_of(core_)));
    surface_.query(steps_of(way_.box(target_), surface_.exponent()), [&](std::uint32_t id) {
      const BakedTriangle baked = surface_.triangle(id);
      const SolidPlane<S> plane = {unit_of_steps<Unit<S>>(baked.normal()), place_of(baked.points[0])};
      if (dot(plane.normal, start - plane.point) < S(0)) return true;
      if (way_.stays_above(plane, target_)) {
        if (planes_ < kMostPlanes) plane_[planes_++] = plane;
        return true;
      }
      const Triangle triangle = {{plane.point, place_of(baked.points[1]), place_of(baked.points[2])}};
      if (left_ == kMostLeft) meet(triangle);
      else triangle_[left_++] = triangle;
      return first_.impact != Impact::at_start;
    });
    for (std::uint32_t i = 0; i < left_ && first_.impact != Impact::at_start; ++i) {
      if (!is_below_planes(triangle_[i])) meet(triangle_[i]);
    }
    return first_;
  }

 private:
  struct Triangle {
    Vec3<S> points[3];  // [m]
  };
  static constexpr std::uint32_t kMostPlanes = 4, kMostLeft = 16;

  ISO_INLINE Vec3<S> place_of(const MeshPoint& p) const { return point_of_steps<S>(p, surface_.exponent()); }
  /// Returns true if all corners are below one plane that the core stays above. stays_above() allows for the rounding.
  ISO_INLINE bool is_below_planes(const Triangle& triangle) const {
    for (std::uint32_t i = 0; i < planes_; ++i) {
      const auto below = [&](Vec3<S> p) ISO_INLINE_LAMBDA {
        return dot(plane_[i].normal, p - plane_[i].point) <= gap_noise(S(0));
      };
      if (below(triangle.points[0]) && below(triangle.points[1]) && below(triangle.points[2])) return true;
    }
    return false;
  }
  void meet(const Triangle& triangle) {
    const Vec3<S> points[3] = {t_.rotation * triangle.points[0], t_.rotation * triangle.points[1],
                               t_.rotation * triangle.points[2]};
    const Pose<S> rest = {t_.position, Quat<Unit<S>>::identity()};
    const TimeOfImpact<S> found =
        time_of_impact(core_, motion_, {points, S(0)}, {rest, rest, Vec3<S>::zero()}, target_);
    const bool sooner = found.impact == Impact::at_start || found.fraction < first_.fraction;
    if (found.impact != Impact::none && sooner) first_ = found;
  }

  const G& surface_;
  const Transform<S>& t_;
  const ConvexCore<S>& core_;
  const CoreMotion<S>& motion_;
  S target_;  // [m]
  CoreWay<S> way_;
  TimeOfImpact<S> first_ = {Impact::none, Unit<S>(1), Vec3<Unit<S>>::zero(), Vec3<S>::zero(), Vec3<S>::zero(), S(0), 0};
  SolidPlane<S> plane_[kMostPlanes];  // that the core stays above
  Triangle triangle_[kMostLeft];      // not known to be out of reach
  std::uint32_t planes_ = 0, left_ = 0;
};

/// Finds the time of impact with those triangles of a surface at rest whose outward side the core's middle is on at the
/// start. A touch of one of them at the start counts as a touch of all.
template <class S, class G>
TimeOfImpact<S> surface_impact(const G& surface, const Transform<S>& t, const ConvexCore<S>& core,
                               const CoreMotion<S>& motion, S target) {
  return SurfaceSweep<S, G>(surface, t, core, motion, target).first();
}

}  // namespace isostep::detail
