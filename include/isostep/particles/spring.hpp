// Springs between two particles, or a particle and a fixed point: one record, three types.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "isostep/core/fields.hpp"
#include "isostep/particles/particle.hpp"

namespace isostep {

using SpringId = Id<struct SpringTag>;

/// spring  pulls and pushes
/// bungee  pulls only
/// stiff   is taken along its exact motion (a damped oscillator of rest length 0), meant to be the only force beside
///         gravity on its particles (Millington, ch. 6.3); where a constraint or another stiff spring holds one of them
///         too, or may within the step, by backward Euler, which damps. Stable at any stiffness.
enum class SpringType : std::uint32_t { spring, bungee, stiff };

/// f = -(stiffness (|d| - rest_length) + damping d|d|/dt) d/|d| on a, the opposite on b, where d goes from b to a. Ends
/// that meet push nowhere.
template <class S> struct Spring {
  SpringType type = SpringType::spring;
  ParticleId a = {}, b = {};            // b null: the anchor
  Vec3<S> anchor = {S(0), S(0), S(0)};  // [m] world; used where b is null
  S stiffness = S(0);                   // [N/m]
  S damping = S(0);                     // [N s/m]
  S rest_length = S(0);                 // [m]
  S elastic_limit = S(0);               // [m] extension beyond which it stays deformed; 0: none

  ISO_FIELDS(type, a, b, anchor, stiffness, damping, rest_length, elastic_limit)
};

}  // namespace isostep
