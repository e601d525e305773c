// SurfaceVelocity: a body or a part of it whose surface runs: a conveyor belt, an escalator, a turntable, a treadmill.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "isostep/core/fields.hpp"
#include "isostep/core/id.hpp"
#include "isostep/dynamics/records/record_rules.hpp"
#include "isostep/math/vec3.hpp"

namespace isostep {

using SurfaceVelocityId = Id<struct SurfaceVelocityTag>;

/// The value of SurfaceVelocity::part in a record for the whole body.
inline constexpr std::uint32_t kEveryPart = 0xffffffffu;

/// Moves the surface of a body while the body stays: friction drags touching bodies towards the velocity that a rigid
/// body with these two would have at the contact, as far as friction and load allow. The body may be static,
/// kinematic or dynamic; a dynamic one is pushed back. It adds to Material::surface_velocity, which is the same in
/// world axes.
/// Parts: a record with a `part` is about that child of the body's shape alone, and replaces the body's record there,
/// even if it does not run. One record a body and one a part. A body with a record of a part gets no shape without
/// that part.
/// A turning surface turns bodies that lie on it and leads them round a circle: a sub-step aims at the end of the
/// arc, as on a kinematic body that turns (carrying.hpp). A character rides on it.
/// Sleep: a running surface keeps touching bodies awake, even one that a wall holds: the wall may go.
/// Limits: all that a body's surface adds at a point is held within Limits::speed(), axis by axis.
template <class S> struct SurfaceVelocity {
  BodyId body = {};
  Vec3<S> linear = {S(0), S(0), S(0)};   // [m/s] body frame
  Vec3<S> angular = {S(0), S(0), S(0)};  // [rad/s] body frame, about the body's origin, of a part's record too
  std::uint32_t part = kEveryPart;       // child of the body's shape

  ISO_INLINE bool runs() const { return !(linear == Vec3<S>::zero() && angular == Vec3<S>::zero()); }

  ISO_FIELDS(body, linear, angular, part)
};

}  // namespace isostep

namespace isostep::detail {

template <class S> struct RecordRules<SurfaceVelocity<S>> : RecordDefaults<S> {
  static constexpr Acts kActs = Acts::not_here;
  static constexpr Wakes kWakes = Wakes::touching;
  static FaultReport fault(const SurfaceVelocity<S>& v) {
    return Checklist()
        .finite(v.linear, "linear")
        .finite(v.angular, "angular")
        .in_range(no_longer(v.linear, Limits<S>::speed()), "linear", kWithinSpeed)
        .in_range(no_longer(v.angular, Limits<S>::angular_speed()), "angular", "a length up to Limits::angular_speed()")
        .report();
  }
  static constexpr NamedBodies<S> bodies(const SurfaceVelocity<S>& v) { return named_body<S>(v.body, MustBe::any); }
  static constexpr OnlyOne only_one(const SurfaceVelocity<S>& v) {
    return v.part == kEveryPart ? kOneABody : OnlyOne{"part", "a part that has no record yet"};
  }
  static RecordKey key(const SurfaceVelocity<S>& v) { return {v.body.slot, v.part}; }
  static FaultReport fault_at(const SurfaceVelocity<S>& v, const RecordPlace<S>& place) {
    return Checklist()
        .proper(v.part == kEveryPart || v.part < place.parts.size(), "part",
                "kEveryPart, or a child of the body's shape")
        .report();
  }
  template <class Random> static void draw(SurfaceVelocity<S>& v, Random& random) {
    v.body = random.any_body();
    v.linear = random.arrow(0, 2);
    if (random.moves(v.body)) v.angular = random.arrow(0, 0.5);  // the ground is wide
    if (random.one_in(2)) v.part = random.below(random.parts(v.body));
  }
};

}  // namespace isostep::detail
