// The closed list of records that are registered with a world and are no forces.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/dynamics/records/axis_drive.hpp"
#include "isostep/dynamics/records/breakable.hpp"
#include "isostep/dynamics/records/character.hpp"
#include "isostep/dynamics/records/contact_report.hpp"
#include "isostep/dynamics/records/coupling.hpp"
#include "isostep/dynamics/records/damping_zone.hpp"
#include "isostep/dynamics/records/ghost.hpp"
#include "isostep/dynamics/records/hit_report.hpp"
#include "isostep/dynamics/records/joint_load.hpp"
#include "isostep/dynamics/records/kind_ghost.hpp"
#include "isostep/dynamics/records/kind_response.hpp"
#include "isostep/dynamics/records/material_pair.hpp"
#include "isostep/dynamics/records/move_target.hpp"
#include "isostep/dynamics/records/one_way.hpp"
#include "isostep/dynamics/records/ranked_water.hpp"
#include "isostep/dynamics/records/ranked_zone.hpp"
#include "isostep/dynamics/records/sensor_mount.hpp"
#include "isostep/dynamics/records/surface_velocity.hpp"
#include "isostep/dynamics/records/vehicle.hpp"

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
