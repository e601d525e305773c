// The worlds that the tool verifies and compares, and for each what names the differences of two states.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/world/world_kinds.hpp"
#include "particle_diff.hpp"
#include "state_diff.hpp"
