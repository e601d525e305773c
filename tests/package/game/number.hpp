// The game's own number: 24 bits before the point, 40 after it.
// SPDX-License-Identifier: MIT
#pragma once

#include <isostep/scalar/fixed.hpp>

namespace game {
using Number = isostep::Fixed<std::int64_t, 40>;
}
