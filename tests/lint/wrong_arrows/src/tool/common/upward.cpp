// A source of what commands share that includes one of them.
// SPDX-License-Identifier: MIT
#include "tool/run/high.hpp"
