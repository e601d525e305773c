// A contact between two bodies' parts: what is remembered from step to step, and what one step knows of its geometry.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "isostep/collision/narrowphase/manifold.hpp"
#include "isostep/core/fields.hpp"
#include "isostep/dynamics/body.hpp"
#include "isostep/math/vec3.hpp"
#include "isostep/scalar/math.hpp"

namespace isostep {

/// The key that orders contacts: body slots first (a < b), then the parts of each. Parts are leaves, see
/// surface_pairs.hpp, or in bodies without surfaces the children of their shapes.
struct ContactKey {
  std::uint32_t body_a, body_b;
  std::uint32_t child_a, child_b;

  friend ISO_INLINE constexpr bool operator==(const ContactKey& x, const ContactKey& y) {
    return x.body_a == y.body_a && x.body_b == y.body_b && x.child_a == y.child_a && x.child_b == y.child_b;
  }
  friend ISO_INLINE constexpr bool operator<(const ContactKey& x, const ContactKey& y) {
    const std::uint64_t bodies_x = std::uint64_t{x.body_a} << 32 | x.body_b;
    const std::uint64_t bodies_y = std::uint64_t{y.body_a} << 32 | y.body_b;
    if (bodies_x != bodies_y) return bodies_x < bodies_y;
    return x.child_a != y.child_a ? x.child_a < y.child_a : x.child_b < y.child_b;
  }
  ISO_FIELDS(body_a, body_b, child_a, child_b)
};

/// Bits of Contact::flags.
namespace contact_flag {
inline constexpr std::uint32_t kTouching = 1u << 0;  // carried an impulse in the last step: what events speak of
inline constexpr std::uint32_t kReported = 1u << 1;  // of a body or part with kReportContacts: events tell of it
}  // namespace contact_flag

/// State: a contact with points. Impulses are velocity changes of the pair's reduced mass, m = ma mb / (ma + mb).
template <class S> struct Contact {
  ContactKey key;
  std::uint32_t count;  // points, 1..4
  std::uint32_t flags;  // contact_flag
  std::uint32_t features[kMaxContactPoints];
  Velocity<S> normal_impulse[kMaxContactPoints];  // [m/s]
  Vec3<Velocity<S>> friction_impulse;             // [m/s] world, on b
  Velocity<S> twist_impulse;                      // [m/s] on b about the normal, times AngularRow's radius

  ISO_FIELDS(key, count, flags, features, normal_impulse, friction_impulse, twist_impulse)
};
static_assert(kHasNoPadding<Contact<float>> && kHasNoPadding<Contact<double>>);

/// [m/s] Returns the sum of the normal impulses of a contact's points.
template <class S> ISO_INLINE Velocity<S> total_normal_impulse(const Contact<S>& contact) {
  Velocity<S> total = Velocity<S>(0);
  for (std::uint32_t p = 0; p < contact.count; ++p) total = saturating_add(total, contact.normal_impulse[p]);
  return total;
}

/// The mixture of two materials.
template <class S> struct MixedMaterial {
  S friction;                // [1]
  S restitution;             // [1]
  S rolling_resistance;      // [m]
  S spin_resistance;         // [m]
  Vec3<S> surface_velocity;  // [m/s] of b's surface against a's, world

  ISO_FIELDS(friction, restitution, rolling_resistance, spin_resistance, surface_velocity)
};

/// Returns the root of the product.
template <class S> ISO_INLINE S mixed_friction(S a, S b) { return a == b ? a : sqrt(a * b); }

/// Mixes two materials: sliding friction and spin resistance by the root of the product, the rest by the larger value.
template <class S> ISO_INLINE MixedMaterial<S> mix(const Material<S>& a, const Material<S>& b) {
  return {mixed_friction(a.friction, b.friction), max(a.restitution, b.restitution),
          max(a.rolling_resistance, b.rolling_resistance), mixed_friction(a.spin_resistance, b.spin_resistance),
          b.surface_velocity - a.surface_velocity};
}

/// Holds one step's geometry of a contact: its place, its mixed material, its rows of SolverBodies. Parallel to the
/// contacts.
template <class S> struct ContactGeometry {
  std::uint32_t row_a, row_b;
  Vec3<Unit<S>> normal;  // [1] from a to b, world
  Vec3<Unit<S>> axis;    // [1] along which a grain leaves most of the friction, in the plane of contact
  Unit<S> ratio;         // [1] what it leaves across, over that. 1: friction has no axis
  struct Point {
    Vec3<S> arm_a, arm_b;  // [m] from each centre of mass, world
    S separation;          // [m] negative: overlap

    ISO_FIELDS(arm_a, arm_b, separation)
  } points[kMaxContactPoints];
  MixedMaterial<S> material;
};

/// Returns the tangents along which a contact's friction has limits of its own, or any where it has no axis.
template <class S> ISO_INLINE Tangents<Unit<S>> friction_tangents(const ContactGeometry<S>& g) {
  if (g.ratio < Unit<S>(1)) return {g.axis, cross(g.normal, g.axis)};
  return tangents_of(g.normal);
}

namespace detail {
/// Holds the arms from both bodies to the middle of a contact's points, where its friction acts, or to the first point.
template <class S> struct ContactArms {
  Vec3<S> a, b;  // [m]

  static ISO_INLINE ContactArms middle_of(const ContactGeometry<S>& g, std::uint32_t count) {
    constexpr S kShares[kMaxContactPoints] = {S(1), S(0.5), S(1.0 / 3), S(0.25)};
    ContactArms sum = {g.points[0].arm_a, g.points[0].arm_b};
    for (std::uint32_t p = 1; p < count; ++p) sum = {sum.a + g.points[p].arm_a, sum.b + g.points[p].arm_b};
    return {sum.a * kShares[count - 1], sum.b * kShares[count - 1]};
  }
};
/// [m/s] Returns the velocity of a body at the end of an arm. Null: it does not move.
template <class S> ISO_INLINE Vec3<Velocity<S>> velocity_at(const BodyState<S>* body, Vec3<S> arm) {
  if (body == nullptr) return Vec3<Velocity<S>>::zero();
  const Vec3<Velocity<S>> w = body->angular_velocity;
  const auto part = [&](int i, int j) ISO_INLINE_LAMBDA {
    return round_to<Velocity<S>>(product(w[i], arm[j]) - product(w[j], arm[i]));
  };
  return body->velocity + Vec3<Velocity<S>>{part(1, 2), part(2, 0), part(0, 1)};
}
}  // namespace detail

}  // namespace isostep
