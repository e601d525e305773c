// The simulated network in C.
// SPDX-License-Identifier: MIT
#include <memory>
#include <new>

#include "isostep.h"
#include "session_handle.hpp"
#include "transport/pump.hpp"
#include "transport/simulated_network.hpp"

using isostep::transport::Arrival;
using isostep::transport::EndpointId;
using isostep::transport::NetworkProfile;
using isostep::transport::SimulatedNetwork;

struct iso_network {
  SimulatedNetwork network;
  std::uint32_t endpoints = 1;  // the host is there from the beginning
  char problem[192] = "";

  explicit iso_network(std::uint64_t seed) : network({.seed = seed}) {}
};

namespace isostep::c {
namespace {

using Networks = LiveHandles<iso_network>;

/// An endpoint whose addresses are numbers of endpoints. Models Connector.
struct Line {
  iso_network& owner;
  EndpointId id;
  SimulatedNetwork::Port port;

  Line(iso_network& network, EndpointId endpoint)
      : owner(network), id(endpoint), port(network.network.port(endpoint)) {}
  Result<void> send(PeerId peer, Channel channel, Bytes bytes) { return port.send(peer, channel, bytes); }
  std::optional<Arrival> receive() { return port.receive(); }
  void disconnect(PeerId peer) { port.disconnect(peer); }
  Result<void> connect_to(std::string_view address) {
    std::uint32_t to = 0;
    bool is_number = !address.empty() && address.size() < 7;
    for (const char c : address) {
      is_number = is_number && c >= '0' && c <= '9';
      to = 10 * to + static_cast<std::uint32_t>(c - '0');
    }
    if (is_number && to < owner.endpoints && owner.network.connect(id, to)) return {};
    return Error{ErrorCode::invalid, "no other endpoint, or connected already", "address"};
  }
};

template <class F> iso_status with(iso_network* network, F&& function) {
  if (network == nullptr) return ISO_NULL;
  if (!Networks::has(network)) return ISO_NOT_ALIVE;
  network->problem[0] = 0;
  return guarded([&] { return function(*network); });
}

iso_status refuse(iso_network& network, std::string_view text) {
  network.problem[text.copy(network.problem, sizeof network.problem - 1)] = 0;
  return ISO_REFUSED;
}
iso_status refuse_endpoint(iso_network& network) { return refuse(network, "endpoint: there is none of this number"); }

template <class F> iso_status with_profile(iso_network& network, const char* text, F&& function) {
  const Result<NetworkProfile> profile = transport::parse_profile(text);
  if (profile) return function(profile.value());
  const Error& error = profile.error();
  return refuse(network, ShortText<192>(error.place.view()).append(": ").append(error.message.view()).view());
}

/// `function(line, session)`, where both are there.
template <class F> iso_status meet(iso_network* network, std::uint32_t endpoint, iso_session* session, F&& function) {
  return with(network, [&](iso_network& one) -> iso_status {
    if (endpoint >= one.endpoints) return refuse_endpoint(one);
    return call(session, [&](iso_session& other) {
      Line line(one, endpoint);
      function(line, other.session);
      return ISO_OK;
    });
  });
}

}  // namespace
}  // namespace isostep::c

using namespace isostep::c;

extern "C" {

iso_status iso_network_create(uint64_t seed, iso_network** out) {
  if (out == nullptr) return ISO_NULL;
  *out = nullptr;
  return guarded([&] {
    auto network = std::make_unique<iso_network>(seed);
    Networks::add(network.get());
    *out = network.release();
    return ISO_OK;
  });
}

iso_status iso_network_destroy(iso_network* network) {
  if (network == nullptr) return ISO_OK;
  if (!Networks::has(network)) return ISO_NOT_ALIVE;
  Networks::remove(network);
  delete network;
  return ISO_OK;
}

const char* iso_network_problem(const iso_network* network) {
  return network != nullptr && Networks::has(network) ? network->problem : "";
}

iso_status iso_network_add_client(iso_network* network, const char* profile, uint32_t* endpoint) {
  if (profile == nullptr || endpoint == nullptr) return ISO_NULL;
  return with(network, [&](iso_network& one) {
    return with_profile(one, profile, [&](const NetworkProfile& line) {
      *endpoint = one.network.add_client(line);
      ++one.endpoints;
      return ISO_OK;
    });
  });
}

iso_status iso_network_set_profile(iso_network* network, uint32_t client, const char* profile) {
  if (profile == nullptr) return ISO_NULL;
  return with(network, [&](iso_network& one) -> iso_status {
    if (client == 0 || client >= one.endpoints) return refuse_endpoint(one);
    return with_profile(one, profile, [&](const NetworkProfile& line) {
      one.network.set_profile(client, line);
      return ISO_OK;
    });
  });
}

iso_status iso_network_connect(iso_network* network, uint32_t from, uint32_t to) {
  return with(network, [&](iso_network& one) -> iso_status {
    if (from >= one.endpoints || to >= one.endpoints) return refuse_endpoint(one);
    if (one.network.connect(from, to)) return ISO_OK;
    return refuse(one, "connection: the last one is not over, or no place is free");
  });
}

iso_status iso_network_cut(iso_network* network, uint32_t client) {
  return with(network, [&](iso_network& one) -> iso_status {
    if (client == 0 || client >= one.endpoints) return refuse_endpoint(one);
    one.network.cut(client);
    return ISO_OK;
  });
}

iso_status iso_network_set_silent(iso_network* network, uint32_t endpoint, uint8_t silent) {
  if (silent > 1) return ISO_BAD_ENUM;
  return with(network, [&](iso_network& one) -> iso_status {
    if (endpoint >= one.endpoints) return refuse_endpoint(one);
    one.network.set_silent(endpoint, silent != 0);
    return ISO_OK;
  });
}

iso_status iso_network_set_side(iso_network* network, uint32_t endpoint, int32_t side) {
  return with(network, [&](iso_network& one) -> iso_status {
    if (endpoint >= one.endpoints) return refuse_endpoint(one);
    one.network.set_side(endpoint, side);
    return ISO_OK;
  });
}

iso_status iso_network_advance_to(iso_network* network, uint64_t now) {
  return with(network, [&](iso_network& one) -> iso_status {
    if (now < one.network.now()) return refuse(one, "now: before that of an earlier call");
    one.network.advance_to(now);
    return ISO_OK;
  });
}

iso_status iso_network_deliver(iso_network* network, uint32_t endpoint, iso_session* session, uint64_t now) {
  return meet(network, endpoint, session, [&](Line& line, auto& one) { isostep::transport::deliver(line, one, now); });
}

iso_status iso_network_dispatch(iso_network* network, uint32_t endpoint, iso_session* session, uint64_t now) {
  return meet(network, endpoint, session, [&](Line& line, auto& one) { isostep::transport::dispatch(line, one, now); });
}
}
