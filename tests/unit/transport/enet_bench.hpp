// EnetTransports on 127.0.0.1, driven in one thread by tests that wait for what they hear.
// SPDX-License-Identifier: MIT
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "transport/enet_transport.hpp"
#include "transport/udp_relay.hpp"
#include "unit/transport/udp.hpp"

namespace isostep::transport {

using Bytevec = std::vector<std::uint8_t>;
inline constexpr Time kMs = 1000;
inline constexpr Time kPatience = 600 * kSecond;  // [us] beyond any stall of a busy machine

struct Heard {
  ArrivalKind kind;
  PeerId peer;
  Channel channel;
  Bytevec bytes;
  bool incoming;
};

/// Polls endpoints and turns a relay, in one thread, and keeps what each endpoint heard.
struct Bench {
  std::vector<EnetTransport*> endpoints;
  UdpRelay* relay = nullptr;
  std::vector<std::vector<Heard>> heard = {};

  void turn() {
    heard.resize(endpoints.size());
    EXPECT_TRUE(relay == nullptr || relay->turn(0).ok());
    for (std::size_t i = 0; i < endpoints.size(); ++i) {
      if (endpoints[i] == nullptr) continue;
      endpoints[i]->poll();
      while (const std::optional<Arrival> arrival = endpoints[i]->receive()) {
        const Bytevec bytes(arrival->bytes.begin(), arrival->bytes.end());
        heard[i].push_back({arrival->kind, arrival->peer, arrival->channel, bytes, arrival->incoming});
      }
      endpoints[i]->flush();
    }
    if (endpoints[0] != nullptr) endpoints[0]->wait(1 * kMs);
  }
  bool turn_until(const std::function<bool()>& done) {
    for (const Deadline deadline; !deadline.over(); turn()) {
      if (done()) return true;
    }
    return false;
  }
  std::size_t count(std::size_t endpoint, ArrivalKind kind) const {
    if (endpoint >= heard.size()) return 0;
    return static_cast<std::size_t>(std::count_if(heard[endpoint].begin(), heard[endpoint].end(),
                                                  [&](const Heard& arrival) { return arrival.kind == kind; }));
  }
  bool turn_until_heard(std::size_t endpoint, ArrivalKind kind, std::size_t times = 1) {
    return turn_until([&] { return count(endpoint, kind) >= times; });
  }
};

inline EnetTransport must(Result<EnetTransport> result) {
  EXPECT_TRUE(result.ok()) << (result.ok() ? "" : std::string(result.error().message.view()));
  return std::move(result.value());
}
/// Tests that are about a timeout bring their own.
inline EnetTransport listen_here(EnetSettings settings = {.timeout = kPatience}) {
  settings.bind_address = "127.0.0.1";
  return must(EnetTransport::listen(0, settings));
}
inline EnetTransport connect_to(std::uint16_t port, const EnetSettings& settings = {.timeout = kPatience}) {
  return must(EnetTransport::connect("127.0.0.1", port, settings));
}

/// A host (0) and a client (1) that have met.
struct Pair {
  EnetTransport host, client;
  Bench bench;

  explicit Pair(const EnetSettings& host_settings = {.timeout = kPatience},
                const EnetSettings& client_settings = {.timeout = kPatience})
      : host(listen_here(host_settings)), client(connect_to(host.port(), client_settings)), bench{{&host, &client}} {
    EXPECT_TRUE(bench.turn_until_heard(1, ArrivalKind::connected));
    EXPECT_TRUE(bench.turn_until_heard(0, ArrivalKind::connected));
  }
};

}  // namespace isostep::transport
