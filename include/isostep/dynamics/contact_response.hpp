// A contact that solves for other masses than its bodies', or bears only so much: what KindResponse says of it.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>

#include "isostep/core/fields.hpp"
#include "isostep/core/lower_bound.hpp"
#include "isostep/dynamics/reduced_mass.hpp"
#include "isostep/dynamics/solver_body.hpp"

namespace isostep {

/// The response of one contact, with the sides of the contact.
template <class S> struct ContactResponse {
  std::uint32_t contact;   // of the step's
  S mass_a, mass_b;        // [1] scales of the inverse masses; one of them may be 0
  S inertia_a, inertia_b;  // [1] of the inverse inertias, times those
  S most_force;            // [N] 0: any

  ISO_FIELDS(contact, mass_a, mass_b, inertia_a, inertia_b, most_force)
  /// Returns mass_share() of masses over their scales. With u = m_b / (m_a + m_b) it is s_a u / (s_a u + s_b (1 - u)).
  /// No share is between 0 and 2^-8, so the sum is 2^-9 or more if neither is 0.
  ISO_INLINE MassShare<S> share(S of_a, S of_b) const {
    const MassShare<S> whole = mass_share(of_a, of_b);
    if (!(of_a > S(0)) || !(of_b > S(0)) || mass_a == mass_b) return whole;
    if (mass_a == S(0)) return {S(0), S(1)};
    if (mass_b == S(0)) return {S(1), S(0)};
    const S scaled_a = whole.a * mass_a, scaled_b = whole.b * mass_b;
    const S a = divide_to<S>(scaled_a, scaled_a + scaled_b);
    return {a, S(1) - a};
  }
  /// [kg] Returns the mass to which the contact's impulses refer, on the side with the larger scale: reduced_mass() of
  /// the masses over their scales, times that scale.
  ISO_INLINE S reduced(S of_a, S of_b) const {
    if (!(of_a > S(0)) || !(of_b > S(0)) || mass_a == mass_b) return reduced_mass(of_a, of_b);
    const MassShare<S> part = share(of_a, of_b);
    return mass_b < mass_a ? part.a * of_a : part.b * of_b;
  }
  /// Returns a body's mass with its inverse inertia scaled for the contact.
  ISO_INLINE SolverMass<S> seen_a(const SolverMass<S>& body) const {
    return {body.mass, scaled(body.kappa, inertia_a)};
  }
  ISO_INLINE SolverMass<S> seen_b(const SolverMass<S>& body) const {
    return {body.mass, scaled(body.kappa, inertia_b)};
  }
  ISO_INLINE bool is_limited() const { return S(0) < most_force; }
  /// [m/s] Returns the most that all points of the contact give in h seconds; the highest of the format without limit.
  ISO_INLINE Velocity<S> most_impulse(S of_a, S of_b, Step<S> h) const {
    if (!is_limited()) return highest<Velocity<S>>();
    const S mass = reduced(of_a, of_b);
    if (!(product(most_force, S(1)) < product(highest<S>(), mass))) return highest<Velocity<S>>();
    return saturate_to<Velocity<S>>(product(divide_to<S>(most_force, mass), h));
  }

 private:
  static ISO_INLINE Mat3<S> scaled(const Mat3<S>& m, S scale) {
    return {{m.rows[0] * scale, m.rows[1] * scale, m.rows[2] * scale}};
  }
};

/// Returns the response of a contact, or null for an ordinary one.
template <class S>
ISO_INLINE const ContactResponse<S>* response_of(std::span<const ContactResponse<S>> all, std::size_t contact) {
  const std::size_t at =
      lower_bound(all.size(), [&](std::size_t i) ISO_INLINE_LAMBDA { return all[i].contact < contact; });
  return at < all.size() && all[at].contact == contact ? &all[at] : nullptr;
}

}  // namespace isostep
