// BodySpring: a spring or a bungee between points of two bodies, or of one and the world.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/core/id.hpp"
#include "isostep/math/vec3.hpp"

namespace isostep {

using BodySpringId = Id<struct BodySpringTag>;

/// Pulls its ends together by stiffness (length - rest_length) + damping d(length)/dt, or pushes them apart. One that
/// only pulls (the book's bungee) does nothing while it is slack. Evaluated in every sub-step: energies stay bounded
/// while the sub-step's rate is above half of sqrt(stiffness / reduced mass), and a record beyond that is refused.
/// Stiffer ones are joints with springs, which are solved.
template <class S> struct BodySpring {
  BodyId a = {};
  BodyId b = {};                          // null: the world
  Vec3<S> anchor_a = {S(0), S(0), S(0)};  // [m] body a's frame
  Vec3<S> anchor_b = {S(0), S(0), S(0)};  // [m] body b's frame, or the world's
  S rest_length = S(0);                   // [m]
  S stiffness = S(0);                     // [N/m]
  S damping = S(0);                       // [N s/m] along the spring
  bool only_pulls = false;

  template <class Visitor, class Self> static ISO_INLINE constexpr void fields(Visitor&& visit, Self&& self) {
    visit("a", self.a);
    visit("b", self.b);
    visit("anchor_a", self.anchor_a);
    visit("anchor_b", self.anchor_b);
    visit("rest_length", self.rest_length);
    visit("stiffness", self.stiffness);
    visit("damping", self.damping);
    visit("only_pulls", self.only_pulls);
  }
};

}  // namespace isostep
