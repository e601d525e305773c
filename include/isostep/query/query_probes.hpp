// Rays and casts as queries of a world put them to one part of a body.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/collision/broadphase/tree.hpp"
#include "isostep/collision/query/ray_cast.hpp"
#include "isostep/collision/query/solid_cast.hpp"
#include "isostep/store/query_types.hpp"

namespace isostep::detail {

/// A part as hits name it, and the list for its hits. Takers of hits are given a pointer to it.
template <class Probe, class List> struct PartSink {
  const Probe& probe;
  List& list;
  BodyId body;
  std::uint32_t child;

  static ISO_INLINE void take(void* user, const typename Probe::PartHit& hit) {
    const PartSink& self = *static_cast<const PartSink*>(user);
    self.list.add(self.probe.hit_of(self.body, self.child, hit));
  }
};

template <class S> class RayProbe {
 public:
  using Scalar = S;
  using Fraction = S;
  using Hit = RayCastHit<S>;
  using PartHit = RayHit<S>;

  ISO_INLINE RayProbe(Vec3<S> origin, Vec3<S> translation, const QueryFilter& filter)
      : origin_(origin),
        translation_(translation),
        back_faces_(filter.back_faces),
        skip_inside_(filter.start_inside == StartInside::ignore) {}

  ISO_INLINE Sweep<S> sweep() const { return {origin_, translation_, Vec3<S>::zero(), Unit<S>(1)}; }
  /// Returns the fraction after which no hit at `fraction` or before can begin, since fractions are rounded.
  ISO_INLINE Unit<S> beyond(S fraction) const { return convert<Unit<S>>(min(fraction + resolution<S>(), S(1))); }
  ISO_INLINE bool first(const ShapeView<S>& part, const Transform<S>& at, S latest, PartHit& hit) const {
    return ray_cast(part, at, origin_, translation_, latest, hit, back_faces_) && !(hit.inside && skip_inside_);
  }
  template <class List>
  ISO_INLINE void all(const ShapeView<S>& part, const Transform<S>& at, S latest,
                      PartSink<RayProbe, List>& sink) const {
    PartHit hit;
    if (is_surface(part.primitive.type)) {
      ray_cast_all(part, at, origin_, translation_, RayReach<S>{latest, back_faces_},
                   RayHitTaker<S>{&sink, &PartSink<RayProbe, List>::take});
    } else if (first(part, at, latest, hit)) {
      sink.take(&sink, hit);
    }
  }
  ISO_INLINE Hit hit_of(BodyId body, std::uint32_t child, const PartHit& hit) const {
    return {body,       child,        hit.triangle, origin_ + translation_ * hit.fraction,
            hit.normal, hit.fraction, hit.material, hit.inside};
  }

 private:
  Vec3<S> origin_, translation_;  // [m]
  bool back_faces_, skip_inside_;
};

template <class S> class CastProbe {
 public:
  using Scalar = S;
  using Fraction = Unit<S>;
  using Hit = ShapeCastHit<S>;
  using PartHit = SolidHit<S>;

  /// `box`: around the solid at the start, in the world's frame.
  ISO_INLINE CastProbe(const SolidCast<S>& cast, const Aabb<S>& box) : cast_(cast), box_(box) {}

  /// Returns the sweep of the solid's box. It is wider than the error by which a cast may hit beside a shape, which is
  /// `gap_noise` for cores.
  ISO_INLINE Sweep<S> sweep() const {
    const Vec3<S> half = (box_.high - box_.low) * S(0.5), centre = box_.low + half;
    const S margin = cast_margin(max_abs(half) + length(cast_.motion.translation)) + S(0.015625);
    return {centre, cast_.motion.translation, half + Vec3<S>{margin, margin, margin}, Unit<S>(1)};
  }
  ISO_INLINE Unit<S> beyond(Unit<S> fraction) const { return min(fraction + Unit<S>(0x1p-16), Unit<S>(1)); }
  ISO_INLINE bool first(const ShapeView<S>& part, const Transform<S>& at, Unit<S> latest, PartHit& hit) const {
    return cast_solid(until(latest), part, at, hit);
  }
  template <class List>
  ISO_INLINE void all(const ShapeView<S>& part, const Transform<S>& at, Unit<S> latest,
                      PartSink<CastProbe, List>& sink) const {
    cast_solid_all(until(latest), part, at, SolidHitTaker<S>{&sink, &PartSink<CastProbe, List>::take});
  }
  ISO_INLINE Hit hit_of(BodyId body, std::uint32_t child, const PartHit& hit) const {
    return {body, child, hit.triangle, hit.point, hit.normal, hit.fraction, hit.material, hit.inside};
  }

 private:
  ISO_INLINE SolidCast<S> until(Unit<S> latest) const {
    SolidCast<S> cast = cast_;
    cast.motion.latest = latest;
    return cast;
  }

  SolidCast<S> cast_;
  Aabb<S> box_;
};

}  // namespace isostep::detail
