// The systems that tell what happened in a step. Compiled apart from the step that calls them.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/world/break_events.inl"
#include "isostep/world/contact_events.inl"
#include "isostep/world/contact_points.inl"
#include "isostep/world/hit_events.inl"
#include "isostep/world/joint_loads.inl"
#include "isostep/world/sensor_overlaps.inl"

#define ISO_INSTANTIATE_EVENT_SYSTEMS(S) \
  template class SensorOverlaps<S>;      \
  template class ContactEvents<S>;       \
  template class BreakEvents<S>;         \
  template class JointLoads<S>;          \
  template class ContactPoints<S>;       \
  template class HitEvents<S>;
