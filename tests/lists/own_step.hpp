// The World<float> of own_world.hpp with all that a step needs.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/instantiate/acting_records.inl"
#include "isostep/instantiate/world_queries.inl"
#include "isostep/world/engine_fields.inl"
#include "own_world.hpp"
