// CRC-32C (Castagnoli): finds damage to a chunk of a file; it proves nothing against intent.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "isostep/core/bytes.hpp"

namespace isostep {

/// Source: RFC 3720, appendix B.4: polynomial 0x1EDC6F41 reflected, all ones in and out.
/// To go on where an earlier piece ended, pass its result as `before`.
std::uint32_t crc32c(Bytes bytes, std::uint32_t before = 0);

}  // namespace isostep
