// Addresses, profiles, a clock, and files that tell a port: for the tool's networked commands.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <type_traits>

#include "isostep/core/result.hpp"
#include "isostep/session/timeline/frame.hpp"
#include "tool/common/tool.hpp"
#include "transport/network_profile.hpp"

namespace isostep::tool {

/// A clock that never runs backwards [us].
Time steady_now();

struct UdpAddress {
  std::string host;
  std::uint16_t port;
  bool is_ipv6() const { return host.find(':') != std::string::npos; }
};
/// The address of "HOST:PORT", of IPv6 "[ADDRESS]:PORT". Throws ToolError 64.
UdpAddress parse_address(const std::string& text);
/// A profile's name or items. Throws ToolError 64.
transport::NetworkProfile profile_of(const std::string& text);
/// Writes the port into the file, unless its name is empty: for scripts that let the system choose. Throws ToolError
/// 74.
void write_port(const std::string& path, std::uint16_t port);

/// The value, or a ToolError 66 that begins with `what`.
template <class T> T expect(Result<T> result, const std::string& what) {
  if (!result) throw ToolError(exit_status::kNoInput, what + ": " + std::string(result.error().message.view()));
  if constexpr (!std::is_void_v<T>) return std::move(result.value());
}

}  // namespace isostep::tool
