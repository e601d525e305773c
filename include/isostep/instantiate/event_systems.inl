// The systems that tell what happened in a step. Compiled apart from the step that calls them.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/systems/events/break_events.inl"
#include "isostep/systems/events/contact_events.inl"
#include "isostep/systems/events/contact_points.inl"
#include "isostep/systems/events/hit_events.inl"
#include "isostep/systems/events/joint_loads.inl"
#include "isostep/systems/events/sensor_overlaps.inl"

#define ISO_INSTANTIATE_EVENT_SYSTEMS(S) \
  ISO_SENSOR_OVERLAPS_OF(, S)            \
  ISO_CONTACT_EVENTS_OF(, S)             \
  ISO_BREAK_EVENTS_OF(, S)               \
  ISO_JOINT_LOADS_OF(, S)                \
  ISO_CONTACT_POINTS_OF(, S)             \
  ISO_HIT_EVENTS_OF(, S)
