// The systems that keep bodies where they belong: awake, asleep, and by their slots. Compiled apart from the step that
// calls them.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/store/body_map.inl"
#include "isostep/systems/sleep/island_sleep.inl"
#include "isostep/systems/sleep/island_wake.inl"

#define ISO_INSTANTIATE_ISLAND_SYSTEMS(S) \
  ISO_SHAPE_MAP_OF(, S)                   \
  ISO_JOINT_MAP_OF(, S)                   \
  ISO_BODY_MAP_OF(, S)                    \
  ISO_ISLAND_WAKE_OF(, S)                 \
  ISO_ISLAND_SLEEP_OF(, S)
