// Resistance<S>: what resists the motion of bodies, by backward Euler, stable whatever its coefficients.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "isostep/core/instantiate.hpp"
#include "isostep/systems/forces/force_sums.hpp"
#include "isostep/systems/forces/substep_bodies.hpp"

namespace isostep {

/// Each force resists the velocity that the steady forces lead to, with an equal part of the body's mass. So many
/// forces on one body are as stable as one (mass splitting: Tonge et al. 2012, SIGGRAPH), their order does not matter,
/// and mirrored scenes stay mirrored.
/// Input:   the number of forces that resist a body, and its rates of fading; then the sums of all pushing forces.
/// Output:  the velocities that those lead to, parts of masses, the settled value of a resisting force; in the sums,
///          the motion that fades.
/// Keeps:   nothing from sub-step to sub-step but memory.
/// Order:   count() and fade() of all resisting records, take_steady(), the forces, solve_fading().
template <class S> class Resistance {
 public:
  using U = Unit<S>;

  ISO_INLINE Resistance(const SubstepBodies<S>& bodies, ForceSums<S>& sums) : bodies_(bodies), sums_(sums) {}

  void begin_substep();
  /// Announces a force that resists the body of a row.
  void count(std::uint32_t row);
  /// Adds rates [1/s] at which a body's motion and rotation fade. They add up, and resist together as one force.
  void fade(std::uint32_t row, S linear, S angular);
  /// Takes the present sums as the steady forces.
  void take_steady();
  void solve_fading();

  /// [m/s], [rad/s] The velocity that the sub-step leads to with the steady forces, before contacts and joints.
  /// Resisting forces act on this one, so that they balance steady forces exactly.
  Vec3<S> next_velocity(std::uint32_t row) const;
  Vec3<S> next_angular_velocity(std::uint32_t row) const;
  /// [m/s] The velocity of a point after the sub-step.
  Vec3<S> next_velocity(const BodyEnd<S>& end) const;
  /// [kg] The part of a body's mass that each of its resisting forces gets.
  S mass_part(std::uint32_t row) const;
  /// Returns tensor v', where v' is what the force makes of `velocity` in the sub-step (both in the frame `axes`): v' =
  /// v + h K tensor v', with K the inverse mass at the point.
  Vec3<S> settled(const BodyEnd<S>& end, const Mat3<U>& axes, const Mat3<S>& tensor, Vec3<S> velocity) const;
  /// Slows a rotation [rad/s] that fades at a rate [1/s].
  void slow_turning(std::uint32_t row, Vec3<S> turning, S rate);

 private:
  static constexpr std::uint32_t kMostParts = 1024;  // of a body's mass
  /// Rates of fading [1/s].
  struct Rates {
    S linear, angular;
    ISO_INLINE bool any() const { return S(0) < linear || S(0) < angular; }
  };

  S slowed(std::uint32_t row, S rate) const;
  Mat3<S> give_of(const BodyEnd<S>& end, const Mat3<U>& axes) const;

  const SubstepBodies<S>& bodies_;
  ForceSums<S>& sums_;
  std::vector<Acceleration<S>> steady_;
  std::vector<std::uint32_t> parts_;  // by awake body: how many forces resist its motion
  std::vector<Rates> fading_;         // by awake body; empty where none fades
};

#define ISO_RESISTANCE_OF(extern, S) extern template class Resistance<S>;
ISO_EXTERN_FOR_EACH_SCALAR(ISO_RESISTANCE_OF)

}  // namespace isostep
