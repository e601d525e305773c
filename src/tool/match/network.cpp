// Addresses, profiles and ports.
// SPDX-License-Identifier: MIT
#include "network.hpp"

#include <chrono>

#include "tool/common/files.hpp"

namespace isostep::tool {

Time steady_now() {
  const auto since = std::chrono::steady_clock::now().time_since_epoch();
  return static_cast<Time>(std::chrono::duration_cast<std::chrono::microseconds>(since).count());
}

UdpAddress parse_address(const std::string& text) {
  const std::size_t colon = text.rfind(':');
  const std::string port = colon == std::string::npos ? "" : text.substr(colon + 1);
  const bool digits = !port.empty() && port.size() <= 5 && port.find_first_not_of("0123456789") == std::string::npos;
  const int number = digits ? std::stoi(port) : 0;
  if (colon == 0 || number < 1 || number > 65535) {
    throw ToolError(exit_status::kUsage, "\"" + text + "\" is no HOST:PORT");
  }
  std::string host = text.substr(0, colon);
  if (host.size() > 2 && host.front() == '[' && host.back() == ']') host = host.substr(1, host.size() - 2);
  return {host, static_cast<std::uint16_t>(number)};
}

transport::NetworkProfile profile_of(const std::string& text) {
  const Result<transport::NetworkProfile> profile = transport::parse_profile(text);
  if (!profile) throw ToolError(exit_status::kUsage, "--profile: " + std::string(profile.error().message.view()));
  return profile.value();
}

void write_port(const std::string& path, std::uint16_t port) {
  if (!path.empty()) write_file(path, std::to_string(port) + "\n");
}

}  // namespace isostep::tool
