// The closed list of records that are registered with a world and are no forces.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/dynamics/breakable.hpp"
#include "isostep/dynamics/character.hpp"
#include "isostep/dynamics/contact_report.hpp"
#include "isostep/dynamics/coupling.hpp"
#include "isostep/dynamics/damping_zone.hpp"
#include "isostep/dynamics/ghost.hpp"
#include "isostep/dynamics/hit_report.hpp"
#include "isostep/dynamics/joint_load.hpp"
#include "isostep/dynamics/joints/axis_drive.hpp"
#include "isostep/dynamics/kind_ghost.hpp"
#include "isostep/dynamics/kind_response.hpp"
#include "isostep/dynamics/material_pair.hpp"
#include "isostep/dynamics/move_target.hpp"
#include "isostep/dynamics/one_way.hpp"
#include "isostep/dynamics/ranked_water.hpp"
#include "isostep/dynamics/ranked_zone.hpp"
#include "isostep/dynamics/sensor_mount.hpp"
#include "isostep/dynamics/surface_velocity.hpp"
#include "isostep/dynamics/vehicle.hpp"

/// As ISO_FOR_EACH_FORCE in forces/force_list.hpp, of what does not act by `act` in a sub-step.
#define ISO_FOR_EACH_OTHER_RECORD(R, S)                \
  R(material_pair, MaterialPair<S>, MaterialPairId, S) \
  R(breakable, Breakable<S>, BreakableId, S)           \
  R(character, Character<S>, CharacterId, S)           \
  R(vehicle, Vehicle<S>, VehicleId, S)                 \
  R(wheel, Wheel<S>, WheelId, S)

/// The same, of newer kinds: how bodies touch, what joints bear, where kinematic bodies and sensors are to be, which
/// zones and waters hide others, what slows. The position is the kind's number in hashes and portable forms: append,
/// never reorder. A world to which none of a kind was ever added has the hash and form of one that does not know it.
#define ISO_FOR_EACH_NEWER_RECORD(R, S)                         \
  R(surface_velocity, SurfaceVelocity<S>, SurfaceVelocityId, S) \
  R(ghost, Ghost<S>, GhostId, S)                                \
  R(one_way, OneWay<S>, OneWayId, S)                            \
  R(hit_report, HitReport<S>, HitReportId, S)                   \
  R(joint_load, JointLoad<S>, JointLoadId, S)                   \
  R(coupling, Coupling<S>, CouplingId, S)                       \
  R(axis_drive, AxisDrive<S>, AxisDriveId, S)                   \
  R(move_target, MoveTarget<S>, MoveTargetId, S)                \
  R(kind_ghost, KindGhost<S>, KindGhostId, S)                   \
  R(ranked_zone, RankedZone<S>, RankedZoneId, S)                \
  R(contact_report, ContactReport<S>, ContactReportId, S)       \
  R(kind_response, KindResponse<S>, KindResponseId, S)          \
  R(damping_zone, DampingZone<S>, DampingZoneId, S)             \
  R(ranked_water, RankedWater<S>, RankedWaterId, S)             \
  R(sensor_mount, SensorMount<S>, SensorMountId, S)
