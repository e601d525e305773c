// isostep relay: a bad network between real processes.
// SPDX-License-Identifier: MIT
#include <cstdio>

#include "commands.hpp"
#include "network.hpp"
#include "transport/udp_relay.hpp"

namespace isostep::tool {

int command_relay(const RelayOptions& options) {
  const UdpAddress target = parse_address(options.target);
  transport::UdpRelay relay =
      expect(transport::UdpRelay::open({.listen_address = options.bind,
                                        .listen_port = static_cast<std::uint16_t>(options.listen),
                                        .target_address = target.host,
                                        .target_port = target.port,
                                        .profile = profile_of(options.profile),
                                        .seed = options.seed}),
             "relay");
  write_port(options.port_file, relay.port());
  std::fprintf(stderr, "isostep relay: %s, port %u, to %s, %s; Ctrl-C ends it\n", options.bind.c_str(),
               static_cast<unsigned>(relay.port()), options.target.c_str(), options.profile.c_str());
  while (!interrupted()) {
    if (const Result<void> turn = relay.turn(50000); !turn) {
      throw ToolError(exit_status::kSoftware, std::string(turn.error().message.view()));
    }
  }
  const transport::RelayStatistics& s = relay.statistics();
  std::printf("up: %llu packets, %llu lost, %llu doubled; down: %llu packets, %llu lost, %llu doubled\n",
              static_cast<unsigned long long>(s.up.received), static_cast<unsigned long long>(s.up.lost),
              static_cast<unsigned long long>(s.up.doubled), static_cast<unsigned long long>(s.down.received),
              static_cast<unsigned long long>(s.down.lost), static_cast<unsigned long long>(s.down.doubled));
  return exit_status::kOk;
}

}  // namespace isostep::tool
