// Bits that nobody else can know, from the system.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>

namespace isostep::transport {

/// Draws secret words. Returns false where the system gives none.
bool draw_secret(std::span<std::uint64_t> words);

}  // namespace isostep::transport
