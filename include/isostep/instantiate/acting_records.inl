// The systems that records drive: forces, wheels, couplings, characters. Compiled apart from the step that calls them.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/systems/character/characters.inl"
#include "isostep/systems/forces/body_forces.inl"
#include "isostep/systems/forces/coupling_forces.inl"
#include "isostep/systems/forces/explosion_forces.inl"
#include "isostep/systems/forces/resisting_forces.inl"
#include "isostep/systems/forces/water_forces.inl"
#include "isostep/systems/forces/zone_forces.inl"
#include "isostep/systems/vehicle/wheel_forces.inl"

#define ISO_INSTANTIATE_ACTING_RECORDS(S) \
  template class WheelForces<S>;          \
  template class CouplingForces<S>;       \
  template class BodyForces<S>;           \
  template class Surroundings<S>;         \
  template class Characters<S>;
