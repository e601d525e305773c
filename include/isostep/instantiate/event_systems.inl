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
  template class SensorOverlaps<S>;      \
  template class ContactEvents<S>;       \
  template class BreakEvents<S>;         \
  template class JointLoads<S>;          \
  template class ContactPoints<S>;       \
  template class HitEvents<S>;
