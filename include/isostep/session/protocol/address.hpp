// Address: where the transports of others reach a machine, as text that a session only passes on.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>

#include "isostep/core/short_text.hpp"

namespace isostep {

/// [characters] printable ASCII; the longest of IPv6 with a port has 53.
inline constexpr std::size_t kAddressCap = 64;
using Address = ShortText<kAddressCap>;

class Reader;
/// Fails where it is not printable ASCII: it is shown to people.
Address read_address(Reader& reader);

}  // namespace isostep
