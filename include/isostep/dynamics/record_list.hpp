// The closed list of records that are registered with a world and are no forces.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/dynamics/breakable.hpp"
#include "isostep/dynamics/character.hpp"
#include "isostep/dynamics/material_pair.hpp"
#include "isostep/dynamics/vehicle.hpp"

/// As ISO_FOR_EACH_FORCE in forces/force_list.hpp, of what does not act by `act` in a sub-step.
#define ISO_FOR_EACH_OTHER_RECORD(R, S)                \
  R(material_pair, MaterialPair<S>, MaterialPairId, S) \
  R(breakable, Breakable<S>, BreakableId, S)           \
  R(character, Character<S>, CharacterId, S)           \
  R(vehicle, Vehicle<S>, VehicleId, S)                 \
  R(wheel, Wheel<S>, WheelId, S)
