// A relay between real processes: forwards UDP to a target and back, and does to each packet what a profile says.
// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>

#include "isostep/core/result.hpp"
#include "isostep/session/timeline/frame.hpp"
#include "transport/network_profile.hpp"

namespace isostep::transport {

struct RelaySettings {
  std::string listen_address = "127.0.0.1";  // "::" is every address of IPv6 and IPv4
  std::uint16_t listen_port = 0;             // 0: the system chooses
  std::string target_address = "127.0.0.1";
  std::uint16_t target_port = 0;
  NetworkProfile profile = {};  // up: from the clients to the target
  std::uint64_t seed = 1;
  std::size_t max_clients = 64;
  std::size_t max_queued = 8192;  // packets of all clients under way
};

/// The traffic of one direction; bytes are those of UDP's payload.
struct RelayTraffic {
  std::uint64_t received = 0, received_bytes = 0;
  std::uint64_t forwarded = 0, forwarded_bytes = 0;
  std::uint64_t lost = 0, doubled = 0;  // as the profile has it
  std::uint64_t overflowed = 0;         // the queue was full, or the packet larger than kLargestPacket
  std::uint64_t unsent = 0;             // refused by the socket, or their client has gone
};

struct RelayStatistics {
  RelayTraffic up, down;
  std::uint64_t clients = 0;      // that ever were
  std::uint64_t turned_away = 0;  // packets of clients for whom there was no room
};

/// Each client address has a socket of its own towards the target, so that the target sees as many peers, and a
/// schedule of its own: stream 2 n up and 2 n + 1 down for the n-th client. Packets leave up to 1 ms late, for poll()
/// waits in milliseconds. IPv4 and IPv6 on either side, so that ENet, which knows IPv4 alone, reaches IPv6 and is
/// reached from there. POSIX sockets.
class UdpRelay {
 public:
  static constexpr std::size_t kLargestPacket = 4096;  // [bytes]
  static constexpr Time kIdle = 60 * kSecond;          // after that a client makes room for a new one

  /// Names are looked up at once, which may block. The profile's time 0 is now.
  static Result<UdpRelay> open(const RelaySettings& settings);
  UdpRelay(UdpRelay&&) noexcept;
  UdpRelay& operator=(UdpRelay&&) noexcept;
  ~UdpRelay();

  std::uint16_t port() const;
  /// Takes what has come and sends what is due, after waiting at most this long for either.
  Result<void> turn(Time longest);
  /// Runs until `stop`, which is looked at every 50 ms.
  Result<void> run(const std::atomic<bool>& stop);

  const RelayStatistics& statistics() const;

 private:
  struct State;
  explicit UdpRelay(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

}  // namespace isostep::transport
