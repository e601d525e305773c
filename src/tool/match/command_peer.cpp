// isostep peer: one machine of a match over UDP, played by a bot.
// SPDX-License-Identifier: MIT
#include <atomic>
#include <cstdio>
#include <sstream>
#include <thread>

#include "match_peer.inl"
#include "network.hpp"
#include "transport/udp_relay.hpp"

namespace isostep::tool {
namespace {

constexpr Time kGoodbye = 3 * kSecond;  // [us] a leaving client's last word may be lost, and is repeated
constexpr Time kLongestSleep = 10000;   // [us]

/// One line a frame: push_x push_z buttons aim. After the last line nothing is pressed.
std::vector<scenes::MatchInput> read_inputs(const std::string& path) {
  const std::vector<std::uint8_t> bytes = read_file(path);
  std::istringstream lines(std::string(bytes.begin(), bytes.end()));
  std::vector<scenes::MatchInput> inputs;
  for (std::string line; std::getline(lines, line);) {
    std::istringstream words(line);
    int x = 0, z = 0, buttons = 0, aim = 0;
    const bool whole = static_cast<bool>(words >> x >> z >> buttons >> aim) && (words >> std::ws).eof();
    scenes::MatchInput input;
    input.push_x = static_cast<std::int8_t>(x);
    input.push_z = static_cast<std::int8_t>(z);
    input.buttons = static_cast<std::uint8_t>(buttons);
    input.aim = static_cast<std::uint8_t>(aim);
    const bool in_range = x >= -128 && x < 128 && z >= -128 && z < 128 && buttons >= 0 && buttons < 256 && aim >= 0 &&
                          aim < 256 && input.valid();
    if (!whole || !in_range) {
      throw ToolError(exit_status::kUsage, path + ":" + std::to_string(inputs.size() + 1) +
                                               ": expected push_x push_z (-128..127) buttons (0..127) aim (0..255)");
    }
    inputs.push_back(input);
  }
  return inputs;
}

/// The profile of one peer's own line, between it and the address it believes to speak to.
class OwnRelay {
 public:
  OwnRelay(const UdpAddress& target, const std::string& profile, std::uint64_t seed)
      : relay_(expect(transport::UdpRelay::open({.target_address = target.host,
                                                 .target_port = target.port,
                                                 .profile = profile_of(profile),
                                                 .seed = seed}),
                      "relay")),
        thread_([this] { static_cast<void>(relay_.run(stop_).ok()); }) {}
  ~OwnRelay() {
    stop_ = true;
    thread_.join();
  }
  UdpAddress address() const { return {"127.0.0.1", relay_.port()}; }

 private:
  std::atomic<bool> stop_ = false;
  transport::UdpRelay relay_;
  std::thread thread_;
};

/// Ends all connections: a peer that hears nothing would wait for its timeout.
void say_goodbye(transport::EnetTransport& transport) {
  for (PeerId peer = 0; peer < transport::EnetSettings{}.max_peers; ++peer) transport.disconnect(peer);
  for (const Time end = steady_now() + kGoodbye; steady_now() < end;) {
    transport.poll();
    transport.wait(kLongestSleep);
  }
}

template <class S>
int play(const PeerOptions& options, const Address& own_address, transport::EnetTransport& transport) {
  MatchPeer<S> peer(options, own_address,
                    options.inputs.empty() ? std::vector<scenes::MatchInput>{} : read_inputs(options.inputs),
                    transport);
  const Time start = steady_now();
  for (Time now = start;; now = steady_now()) {
    if (interrupted()) break;
    peer.turn(now);
    if (peer.is_over(now)) break;
    const Time wait = peer.wait(steady_now());
    transport.wait(wait < kLongestSleep ? wait : kLongestSleep);
  }
  const Time end = steady_now();
  if (!peer.is_host()) say_goodbye(transport);
  return peer.finish(end - start);
}

/// The line to the host: its own address, or that of a relay in front of it, which is also the way to IPv6.
UdpAddress open_line(const PeerOptions& options, std::optional<OwnRelay>& relay) {
  const UdpAddress address = parse_address(options.connect);
  if (options.profile.empty() && !address.is_ipv6()) return address;
  relay.emplace(address, options.profile.empty() ? "loopback" : options.profile, options.bot);
  return relay->address();
}

transport::EnetTransport open_transport(const PeerOptions& options, std::optional<OwnRelay>& relay) {
  transport::EnetSettings patient;
  if (options.patience != 0) patient.timeout = patience_of(options);
  std::optional<UdpAddress> host;
  if (!options.connect.empty()) host = open_line(options, relay);
  if (host && options.migration == 0) {
    return expect(transport::EnetTransport::connect(host->host, host->port, patient), options.connect);
  }
  const auto port = static_cast<std::uint16_t>(options.listen < 0 ? 0 : options.listen);
  transport::EnetTransport transport =
      expect(transport::EnetTransport::listen(port, patient), "port " + std::to_string(port));
  write_port(options.port_file, transport.port());
  std::fprintf(stderr, "isostep peer: listening on port %u\n", static_cast<unsigned>(transport.port()));
  if (host) expect(transport.connect_to(host->host, host->port), options.connect);
  return transport;
}

void check(const PeerOptions& options) {
  if (options.listen < 0 && options.connect.empty()) {
    throw ToolError(exit_status::kUsage, "a peer either listens or connects: --listen PORT or --connect HOST:PORT");
  }
  if (options.listen >= 0 && !options.connect.empty() && options.migration == 0) {
    throw ToolError(exit_status::kUsage, "a peer either listens or connects; with --migration it may do both");
  }
  if (options.connect.empty() && !options.profile.empty()) {
    throw ToolError(exit_status::kUsage, "--profile belongs to the peers that connect");
  }
  for (const std::string& path : {options.hashes, options.bundle, options.port_file}) expect_writable(path);
}

}  // namespace

int command_peer(const PeerOptions& options) {
  check(options);
  std::optional<OwnRelay> relay;
  transport::EnetTransport transport = open_transport(options, relay);
  Address own_address;
  if (options.migration != 0) own_address = Address(options.address + ":" + std::to_string(transport.port()));
  int status = exit_status::kUsage;
  const bool found = with_scalar(
      options.scalar, [&](auto tag) { status = play<typename decltype(tag)::Type>(options, own_address, transport); });
  if (!found) throw ToolError(exit_status::kUsage, "this build lacks the scalar " + options.scalar);
  return status;
}

}  // namespace isostep::tool
