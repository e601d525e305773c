// Addresses as they are read from messages.
// SPDX-License-Identifier: MIT
#include "isostep/session/protocol/address.hpp"

#include "isostep/state/archive.hpp"

namespace isostep {

Address read_address(Reader& reader) {
  const std::string_view text = reader.read_text(kAddressCap);
  for (const char c : text) {
    if (c < ' ' || c > '~') reader.fail(ErrorCode::invalid, "an address that is not printable ASCII");
  }
  return Address(text);
}

}  // namespace isostep
