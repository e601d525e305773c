// A source that includes the tool.
// SPDX-License-Identifier: MIT
#include "tool/run/high.hpp"
