// The recordings that the library's self-check replays: which they are, and how they are made.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace isostep::tool {

/// Records each in every scalar of this build: put("medley.float.replay", bytes). The bytes are the same wherever they
/// are made: compiler and architecture are left out of the header. Throws ToolError 70 for one that one lane
/// does not verify.
void record_selfcheck(const std::function<void(const std::string& name, const std::vector<std::uint8_t>& bytes)>& put);

}  // namespace isostep::tool
