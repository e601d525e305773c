// The systems that records drive: forces, wheels, couplings, characters. Compiled apart from the step that calls them.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/world/body_forces.inl"
#include "isostep/world/characters.inl"
#include "isostep/world/coupling_forces.inl"
#include "isostep/world/explosion_forces.inl"
#include "isostep/world/resisting_forces.inl"
#include "isostep/world/water_forces.inl"
#include "isostep/world/wheel_forces.inl"
#include "isostep/world/zone_forces.inl"

#define ISO_INSTANTIATE_ACTING_RECORDS(S) \
  template class WheelForces<S>;          \
  template class CouplingForces<S>;       \
  template class BodyForces<S>;           \
  template class Surroundings<S>;         \
  template class Characters<S>;
