// Address: where the transports of others reach a machine, as text that a session only passes on.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>

#include "isostep/core/short_text.hpp"

namespace isostep {

/// [characters] of printable ASCII. The longest IPv6 address with a port has 53.
inline constexpr std::size_t kAddressCap = 64;
using Address = ShortText<kAddressCap>;

class Reader;
/// Reads an address. Fails if it is not printable ASCII, because it is shown to people.
Address read_address(Reader& reader);

}  // namespace isostep
