// The simulated network in C.
// SPDX-License-Identifier: MIT
#include <memory>

#include "session_handle.hpp"
#include "transport/pump.hpp"
#include "transport/simulated_network.hpp"

using isostep::transport::Arrival;
using isostep::transport::EndpointId;
using isostep::transport::NetworkProfile;
using isostep::transport::SimulatedNetwork;

namespace isostep::c {

struct NetworkObject {
  SimulatedNetwork network;
  std::uint32_t endpoints = 1;  // the host is there from the beginning

  explicit NetworkObject(std::uint64_t seed) : network({.seed = seed}) {}
};
template <> struct HandleOf<iso_network> {
  using Object = NetworkObject;
  static constexpr HandleKind kKind = HandleKind::network;
  static constexpr const char* kName = "network";
};

namespace {

/// An endpoint whose addresses are numbers of endpoints. Models Connector.
struct Line {
  NetworkObject& owner;
  EndpointId id;
  SimulatedNetwork::Port port;

  Line(NetworkObject& network, EndpointId endpoint)
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

/// Runs `work(NetworkObject&)`, which returns a status, where the network and the endpoints that it names are there.
template <class Work>
iso_status in_network(iso_network* handle, const char* call, std::initializer_list<std::uint32_t> endpoints,
                      const Work& work) {
  const Found<iso_network> found(handle, call);
  if (found.status != ISO_OK) return found.status;
  for (const std::uint32_t endpoint : endpoints) {
    if (endpoint >= found.object->endpoints) return refuse(ISO_REFUSED, call, "endpoint", "one that was added, or 0");
  }
  return guarded(call, [&] { return work(*found.object); });
}

iso_status refuse_host(const char* call) { return refuse(ISO_REFUSED, call, "client", "one that was added, not 0"); }

/// Runs `work(line, session)` where both are there.
template <class Work>
iso_status meet(iso_network* network, const char* call, std::uint32_t endpoint, iso_session* session,
                const Work& work) {
  return in_network(network, call, {endpoint}, [&](NetworkObject& one) {
    return in_session(session, call, [&](SessionObject& other) {
      Line line(one, endpoint);
      work(line, other.session);
      return ISO_OK;
    });
  });
}

}  // namespace
}  // namespace isostep::c

using namespace isostep::c;

extern "C" {

iso_status iso_network_create(uint64_t seed, iso_network** out) {
  ISO_C_REQUIRE(ISO_C_CALL, out);
  *out = nullptr;
  return guarded(ISO_C_CALL, [&] {
    auto network = std::make_unique<NetworkObject>(seed);
    *out = open_handle<iso_network>(network.get());
    network.release();
    return ISO_OK;
  });
}

iso_status iso_network_destroy(iso_network* network) { return destroy_handle(network, ISO_C_CALL); }

iso_status iso_network_add_client(iso_network* network, const char* profile, uint32_t* endpoint) {
  ISO_C_REQUIRE(ISO_C_CALL, profile);
  ISO_C_REQUIRE(ISO_C_CALL, endpoint);
  return in_network(network, ISO_C_CALL, {}, [&, call = ISO_C_CALL](NetworkObject& one) -> iso_status {
    const isostep::Result<NetworkProfile> line = isostep::transport::parse_profile(profile);
    if (!line) return refuse(ISO_REFUSED, call, line.error());
    *endpoint = one.network.add_client(line.value());
    ++one.endpoints;
    return ISO_OK;
  });
}

iso_status iso_network_set_profile(iso_network* network, uint32_t client, const char* profile) {
  ISO_C_REQUIRE(ISO_C_CALL, profile);
  if (client == 0) return refuse_host(ISO_C_CALL);
  return in_network(network, ISO_C_CALL, {client}, [&, call = ISO_C_CALL](NetworkObject& one) -> iso_status {
    const isostep::Result<NetworkProfile> line = isostep::transport::parse_profile(profile);
    if (!line) return refuse(ISO_REFUSED, call, line.error());
    one.network.set_profile(client, line.value());
    return ISO_OK;
  });
}

iso_status iso_network_connect(iso_network* network, uint32_t from, uint32_t to) {
  return in_network(network, ISO_C_CALL, {from, to}, [&, call = ISO_C_CALL](NetworkObject& one) -> iso_status {
    if (one.network.connect(from, to)) return ISO_OK;
    return refuse(ISO_REFUSED, call, "", "two endpoints whose last connection is over, and a free place");
  });
}

iso_status iso_network_cut(iso_network* network, uint32_t client) {
  if (client == 0) return refuse_host(ISO_C_CALL);
  return in_network(network, ISO_C_CALL, {client}, [&](NetworkObject& one) {
    one.network.cut(client);
    return ISO_OK;
  });
}

iso_status iso_network_set_silent(iso_network* network, uint32_t endpoint, uint8_t silent) {
  if (silent > 1) return refuse(ISO_BAD_ENUM, ISO_C_CALL, "silent");
  return in_network(network, ISO_C_CALL, {endpoint}, [&](NetworkObject& one) {
    one.network.set_silent(endpoint, silent != 0);
    return ISO_OK;
  });
}

iso_status iso_network_set_side(iso_network* network, uint32_t endpoint, int32_t side) {
  return in_network(network, ISO_C_CALL, {endpoint}, [&](NetworkObject& one) {
    one.network.set_side(endpoint, side);
    return ISO_OK;
  });
}

iso_status iso_network_advance_to(iso_network* network, uint64_t now) {
  return in_network(network, ISO_C_CALL, {}, [&, call = ISO_C_CALL](NetworkObject& one) -> iso_status {
    if (now < one.network.now()) return refuse(ISO_REFUSED, call, "now", "no time before that of an earlier call");
    one.network.advance_to(now);
    return ISO_OK;
  });
}

iso_status iso_network_deliver(iso_network* network, uint32_t endpoint, iso_session* session, uint64_t now) {
  return meet(network, ISO_C_CALL, endpoint, session,
              [&](Line& line, auto& one) { isostep::transport::deliver(line, one, now); });
}

iso_status iso_network_dispatch(iso_network* network, uint32_t endpoint, iso_session* session, uint64_t now) {
  return meet(network, ISO_C_CALL, endpoint, session,
              [&](Line& line, auto& one) { isostep::transport::dispatch(line, one, now); });
}
}
