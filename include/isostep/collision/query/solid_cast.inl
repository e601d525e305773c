// Bodies of solid_cast.hpp.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/collision/narrowphase/cropped_box.hpp"
#include "isostep/collision/narrowphase/shape_core.hpp"
#include "isostep/collision/query/ball_cast.hpp"
#include "isostep/collision/query/plane_cast.hpp"
#include "isostep/collision/query/round_cast.inl"
#include "isostep/collision/query/solid_cast.hpp"
#include "isostep/collision/query/surface_cast.hpp"

namespace isostep {
namespace detail {

template <class S> ISO_INLINE SolidHit<S> of_whole_shape(const CastHit<S>& hit) {
  return {hit.fraction, hit.normal, hit.point, hit.inside, 0, 0};
}

/// Crops a wide box, whose frame is `t`, to what is near the way of a cast.
template <class S> ISO_INLINE void crop_to_way(Box<S>& box, Transform<S>& t, const SolidCast<S>& cast) {
  const Aabb<S> start = box_of(cast.core, relative(t, cast.start));
  const Vec3<S> way = transposed_times(t.rotation, cast.motion.translation);
  crop_to(box.half_extents, t, {min(start.low, start.low + way), max(start.high, start.high + way)});
}
/// Casts against a box by nearest points in closed form. Undecided if there are none.
template <class S>
ISO_INLINE RoundCast cast_at_box(const SolidCast<S>& cast, const Box<S>& box, const Transform<S>& t, CastHit<S>& hit) {
  if (cast.core.vertices.size() > 2) return RoundCast::undecided;
  if (cast.core.vertices.size() == 1) {
    const FaceCast by_face = cast_ball(cast.core, cast.start, box.half_extents, t, cast.motion, hit);
    if (by_face != FaceCast::undecided) return by_face == FaceCast::hit ? RoundCast::hit : RoundCast::miss;
  }
  return cast_round(cast.core, cast.start, box.half_extents, t, cast.motion, hit);
}
/// Casts against any core by nearest points in closed form. Undecided if there are none.
template <class S>
ISO_INLINE RoundCast cast_at_core(const SolidCast<S>& cast, const ConvexCore<S>& core, const Transform<S>& t,
                                  CastHit<S>& hit) {
  if (cast.core.vertices.size() > 2 || core.vertices.size() > 2) return RoundCast::undecided;
  return cast_round(cast.core, cast.start, core, t, cast.motion, hit);
}

/// Casts against a shape that is not a surface: a solid, or a half-space.
template <class S>
bool cast_whole(const SolidCast<S>& cast, const ShapeView<S>& shape, const Transform<S>& t, CastHit<S>& hit) {
  return visit_shape(shape, [&](const auto& visited) ISO_INLINE_LAMBDA {
    using Shape = std::remove_cvref_t<decltype(visited)>;
    if constexpr (std::same_as<Shape, HalfSpace<S>>) {
      return cast_plane(cast.core, cast.start, visited.normal, visited.offset, t, cast.motion, hit);
    } else if constexpr (kIsSolid<Shape>) {
      RoundCast by_segments = RoundCast::undecided;
      Shape solid = visited;
      Transform<S> at = t;
      if constexpr (std::same_as<Shape, Box<S>>) {
        crop_to_way(solid, at, cast);
        by_segments = cast_at_box(cast, solid, at, hit);
        if (by_segments != RoundCast::undecided) return by_segments == RoundCast::hit;
      }
      const ShapeCore<S> other(solid, S(0));
      if constexpr (!std::same_as<Shape, Box<S>>) by_segments = cast_at_core(cast, other.core(), at, hit);
      if (by_segments != RoundCast::undecided) return by_segments == RoundCast::hit;
      return cast_convex(cast.core, cast.start, other.core(), at, cast.motion, hit);
    } else {
      return false;
    }
  });
}

}  // namespace detail

template <class S>
bool cast_solid(const SolidCast<S>& cast, ShapeView<S> shape, const Transform<S>& transform, SolidHit<S>& hit) {
  using namespace detail;
  if (!is_surface(shape.primitive.type)) {
    CastHit<S> found;
    if (!cast_whole(cast, shape, transform, found) || (found.inside && cast.skip_inside)) return false;
    hit = of_whole_shape(found);
    return hit.fraction <= cast.motion.latest;
  }
  bool any = false;
  visit_surface(shape, [&](const auto& surface) ISO_INLINE_LAMBDA {
    SurfaceCast<S, std::remove_cvref_t<decltype(surface)>>(cast, surface, transform)
        .run([&](const SolidHit<S>& found) ISO_INLINE_LAMBDA {
          const bool sooner = !any || found.fraction < hit.fraction ||
                              (found.fraction == hit.fraction && found.triangle < hit.triangle);
          if (sooner && found.fraction <= cast.motion.latest) hit = found, any = true;
          return any ? hit.fraction : cast.motion.latest;
        });
  });
  return any;
}

template <class S>
void cast_solid_all(const SolidCast<S>& cast, ShapeView<S> shape, const Transform<S>& transform,
                    const SolidHitTaker<S>& taker) {
  using namespace detail;
  if (!is_surface(shape.primitive.type)) {
    SolidHit<S> hit;
    if (cast_solid(cast, shape, transform, hit)) taker.take(taker.user, hit);
    return;
  }
  visit_surface(shape, [&](const auto& surface) ISO_INLINE_LAMBDA {
    SurfaceCast<S, std::remove_cvref_t<decltype(surface)>>(cast, surface, transform)
        .run([&](const SolidHit<S>& found) ISO_INLINE_LAMBDA {
          if (found.fraction <= cast.motion.latest) taker.take(taker.user, found);
          return cast.motion.latest;
        });
  });
}

}  // namespace isostep
