// A header that includes what is above it.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/world/high.hpp"
