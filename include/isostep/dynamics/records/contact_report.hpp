// ContactReport: a body whose contacts every step tells of.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/core/id.hpp"
#include "isostep/scalar/platform.hpp"

namespace isostep {

using ContactReportId = Id<struct ContactReportTag>;

/// Events::contacts has every point of every contact of the body, step by step; World::contacts_of picks them. Changes
/// nothing that moves. One record a body.
template <class S> struct ContactReport {
  BodyId body = {};

  template <class Visitor, class Self> static ISO_INLINE constexpr void fields(Visitor&& visit, Self&& self) {
    visit("body", self.body);
  }
};

}  // namespace isostep
