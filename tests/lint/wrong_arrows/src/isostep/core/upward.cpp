// A source of the library that does.
// SPDX-License-Identifier: MIT
#include "isostep/world/high.hpp"
