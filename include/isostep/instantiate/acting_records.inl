// The systems that records drive: forces, wheels, couplings, characters. Compiled apart from the step that calls them.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/systems/character/characters.inl"
#include "isostep/systems/forces/blast_shields.inl"
#include "isostep/systems/forces/body_forces.inl"
#include "isostep/systems/forces/coupling_forces.inl"
#include "isostep/systems/forces/force_sums.inl"
#include "isostep/systems/forces/resistance.inl"
#include "isostep/systems/forces/substep_bodies.inl"
#include "isostep/systems/forces/wet_bodies.inl"
#include "isostep/systems/forces/zones.inl"
#include "isostep/systems/vehicle/wheel_forces.inl"

#define ISO_INSTANTIATE_ACTING_RECORDS(S) \
  ISO_WHEEL_FORCES_OF(, S)                \
  ISO_COUPLING_FORCES_OF(, S)             \
  ISO_SUBSTEP_BODIES_OF(, S)              \
  ISO_FORCE_SUMS_OF(, S)                  \
  ISO_ZONES_OF(, S)                       \
  ISO_RESISTANCE_OF(, S)                  \
  ISO_WET_BODIES_OF(, S)                  \
  ISO_BLAST_SHIELDS_OF(, S)               \
  ISO_BODY_FORCES_OF(, S)                 \
  ISO_SURROUNDINGS_OF(, S)                \
  ISO_CHARACTERS_OF(, S)
