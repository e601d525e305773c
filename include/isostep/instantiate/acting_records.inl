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
  ISO_VEHICLE_ROWS_OF(, S)                \
  ISO_COUPLING_ROWS_OF(, S)               \
  ISO_MECHANISMS_OF(, S)                  \
  ISO_SUBSTEP_BODIES_OF(, S)              \
  ISO_FORCE_SUMS_OF(, S)                  \
  ISO_ZONES_OF(, S)                       \
  ISO_RESISTANCE_OF(, S)                  \
  ISO_WET_BODIES_OF(, S)                  \
  ISO_BLAST_SHIELDS_OF(, S)               \
  ISO_BODY_FORCES_OF(, S)                 \
  ISO_SURROUNDINGS_OF(, S)                \
  ISO_CHARACTERS_OF(, S)
