// Bodies of the solvers that a world is instantiated with.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/dynamics/solvers/sequential.inl"
#include "isostep/world/solvers.hpp"
