// The systems that records drive: forces, wheels, couplings, characters. Compiled apart from the step that calls them.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/systems/character/characters.inl"
#include "isostep/systems/forces/blast_shields.inl"
#include "isostep/systems/forces/body_forces.inl"
#include "isostep/systems/forces/force_sums.inl"
#include "isostep/systems/forces/resistance.inl"
#include "isostep/systems/forces/substep_bodies.inl"
#include "isostep/systems/forces/wet_bodies.inl"
#include "isostep/systems/forces/zones.inl"
#include "isostep/systems/mechanisms/coupling_rows.inl"
#include "isostep/systems/mechanisms/mechanisms.inl"
#include "isostep/systems/vehicle/vehicle_rows.inl"

#define ISO_INSTANTIATE_ACTING_RECORDS(S) \
  template class VehicleRows<S>;          \
  template class CouplingRows<S>;         \
  template class Mechanisms<S>;           \
  template class SubstepBodies<S>;        \
  template class ForceSums<S>;            \
  template class Zones<S>;                \
  template class Resistance<S>;           \
  template class WetBodies<S>;            \
  template class BlastShields<S>;         \
  template class BodyForces<S>;           \
  template class Surroundings<S>;         \
  template class Characters<S>;
