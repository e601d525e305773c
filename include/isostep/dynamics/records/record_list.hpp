// The closed list of records: what is registered with a world beside bodies, shapes and joints.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/dynamics/records/aero_surface.hpp"
#include "isostep/dynamics/records/attractor.hpp"
#include "isostep/dynamics/records/axis_drive.hpp"
#include "isostep/dynamics/records/body_spring.hpp"
#include "isostep/dynamics/records/breakable.hpp"
#include "isostep/dynamics/records/buoyancy_point.hpp"
#include "isostep/dynamics/records/character.hpp"
#include "isostep/dynamics/records/contact_report.hpp"
#include "isostep/dynamics/records/coupling.hpp"
#include "isostep/dynamics/records/damping_zone.hpp"
#include "isostep/dynamics/records/drag.hpp"
#include "isostep/dynamics/records/explosion.hpp"
#include "isostep/dynamics/records/force_zone.hpp"
#include "isostep/dynamics/records/ghost.hpp"
#include "isostep/dynamics/records/hit_report.hpp"
#include "isostep/dynamics/records/joint_load.hpp"
#include "isostep/dynamics/records/kind_ghost.hpp"
#include "isostep/dynamics/records/kind_response.hpp"
#include "isostep/dynamics/records/material_pair.hpp"
#include "isostep/dynamics/records/one_way.hpp"
#include "isostep/dynamics/records/sensor_mount.hpp"
#include "isostep/dynamics/records/surface_velocity.hpp"
#include "isostep/dynamics/records/thruster.hpp"
#include "isostep/dynamics/records/vehicle.hpp"
#include "isostep/dynamics/records/water.hpp"

/// Expands ISO_FOR_EACH_RECORD_WITH(R, X, S) to R(X, name, Record, Id, S) for each kind, at most 31 of them. Kinds that
/// act in a sub-step (Acts) act in this order. Resisting kinds - drag, surfaces, the drag of water - act after all
/// others, since they need the effect of those. Every kind has three commands, add_name, set_name and remove_name, and
/// a registry in RecordStore, whose name is the same with an s. The order is that of hashes, portable forms and
/// commands. To add one: README.md.
#define ISO_FOR_EACH_RECORD_WITH(R, X, S)                          \
  R(X, force_zone, ForceZone<S>, ForceZoneId, S)                   \
  R(X, attractor, Attractor<S>, AttractorId, S)                    \
  R(X, body_spring, BodySpring<S>, BodySpringId, S)                \
  R(X, thruster, Thruster<S>, ThrusterId, S)                       \
  R(X, buoyancy, BuoyancyPoint<S>, BuoyancyId, S)                  \
  R(X, explosion, Explosion<S>, ExplosionId, S)                    \
  R(X, water, Water<S>, WaterId, S)                                \
  R(X, drag, BodyDrag<S>, DragId, S)                               \
  R(X, aero_surface, AeroSurface<S>, AeroSurfaceId, S)             \
  R(X, damping_zone, DampingZone<S>, DampingZoneId, S)             \
  R(X, material_pair, MaterialPair<S>, MaterialPairId, S)          \
  R(X, breakable, Breakable<S>, BreakableId, S)                    \
  R(X, character, CharacterSettings<S>, CharacterId, S)            \
  R(X, vehicle, VehicleSettings<S>, VehicleId, S)                  \
  R(X, wheel, WheelSettings<S>, WheelId, S)                        \
  R(X, surface_velocity, SurfaceVelocity<S>, SurfaceVelocityId, S) \
  R(X, ghost, Ghost<S>, GhostId, S)                                \
  R(X, one_way, OneWay<S>, OneWayId, S)                            \
  R(X, hit_report, HitReport<S>, HitReportId, S)                   \
  R(X, contact_report, ContactReport<S>, ContactReportId, S)       \
  R(X, joint_load, JointLoad<S>, JointLoadId, S)                   \
  R(X, coupling, Coupling<S>, CouplingId, S)                       \
  R(X, axis_drive, AxisDrive<S>, AxisDriveId, S)                   \
  R(X, kind_ghost, KindGhost<S>, KindGhostId, S)                   \
  R(X, kind_response, KindResponse<S>, KindResponseId, S)          \
  R(X, sensor_mount, SensorMount<S>, SensorMountId, S)

/// Expands R(name, Record, Id, S) for each kind.
#define ISO_FOR_EACH_RECORD(R, S) ISO_FOR_EACH_RECORD_WITH(ISO_RECORD_ALONE, R, S)
#define ISO_RECORD_ALONE(R, name, Record, Id, S) R(name, Record, Id, S)

/// The kinds with an input, which a game sets frame by frame: R(X, name, Input, Id, S). Such a kind has one more
/// command, set_name_input.
#define ISO_FOR_EACH_INPUT_WITH(R, X, S)             \
  R(X, breakable, Blow<S>, BreakableId, S)           \
  R(X, character, CharacterInput<S>, CharacterId, S) \
  R(X, vehicle, VehicleInput<S>, VehicleId, S)
#define ISO_FOR_EACH_INPUT(R, S) ISO_FOR_EACH_INPUT_WITH(ISO_RECORD_ALONE, R, S)

/// The kinds with a state, which the step writes: R(X, name, State, Id, S).
#define ISO_FOR_EACH_RECORD_STATE_WITH(R, X, S)       \
  R(X, character, CharacterState<S>, CharacterId, S)  \
  R(X, vehicle, VehicleState<S>, VehicleId, S)        \
  R(X, wheel, WheelState<S>, WheelId, S)              \
  R(X, joint_load, JointLoadState<S>, JointLoadId, S) \
  R(X, coupling, CouplingState<S>, CouplingId, S)
#define ISO_FOR_EACH_RECORD_STATE(R, S) ISO_FOR_EACH_RECORD_STATE_WITH(ISO_RECORD_ALONE, R, S)
