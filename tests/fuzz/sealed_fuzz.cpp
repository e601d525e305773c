// libFuzzer target: the input is what a stranger or a listener on the line says to sealed endpoints, and when.
// SPDX-License-Identifier: MIT
//
// clang++ -std=c++20 -O1 -g -fsanitize=fuzzer,address,undefined -Dalways_inline= -Iscalar/include
//         -Iinclude -Isrc tests/fuzz/sealed_fuzz.cpp src/sealed/*.cpp
//         src/transport/{simulated_network,impaired_direction,network_profile}.cpp build/release/libisostep.a
//         scalar/src/*.cpp -lsodium -o sealed_fuzz

#include <vector>

#include "sealed/sealed_transport.hpp"
#include "transport/simulated_network.hpp"

namespace {

using namespace isostep;
using sealed::SealedLink;
using transport::Arrival;
using transport::ArrivalKind;
using transport::EndpointId;
using transport::SimulatedNetwork;
using Sealed = sealed::SealedTransport<SimulatedNetwork::Port>;

void require(bool condition) {
  if (!condition) __builtin_trap();
}

sealed::SealSettings settings() {
  sealed::SealSettings settings{.keys = {{.id = 1, .secret = {}}}, .own_key = 1};
  settings.keys[0].secret.fill(3);
  return settings;
}

/// Hears connections and messages of honest ends alone: those hold 0x77.
struct End {
  End(SimulatedNetwork& network, EndpointId id) : port(network.port(id)), line(port, settings()) {}
  void turn(Time now) {
    line.tend(now);
    while (const std::optional<Arrival> arrival = line.receive()) {
      if (arrival->kind == ArrivalKind::connected) ++connections;
      if (arrival->kind == ArrivalKind::disconnected) ++ends;
      for (const std::uint8_t byte : arrival->bytes) require(byte == 0x77);
      heard += arrival->kind == ArrivalKind::message ? 1 : 0;
    }
  }
  SimulatedNetwork::Port port;
  Sealed line;
  int connections = 0, ends = 0, heard = 0;
};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  Bytes script(data, size);
  const auto byte = [&]() -> std::uint8_t {
    if (script.empty()) return 0;
    const std::uint8_t first = script[0];
    script = script.subspan(1);
    return first;
  };
  SimulatedNetwork network;
  const EndpointId honest = network.add_client({}), stranger = network.add_client({});
  End host(network, SimulatedNetwork::kHost), client(network, honest);
  SimulatedNetwork::Port port = network.port(stranger);
  network.connect(honest);
  for (int i = 0; i < 3; ++i) {
    host.turn(1);
    client.turn(1);
  }
  require(host.connections == 1 && client.connections == 1);
  network.connect(stranger);

  Time now = 1;
  std::vector<std::uint8_t> old;  // what the stranger has been told, to say it again changed
  int said = 0;
  while (!script.empty()) {
    const std::uint8_t op = byte();
    std::vector<std::uint8_t> bytes(old);
    bytes.resize(op % 2 == 0 ? bytes.size() : byte());
    for (int changes = byte() % 8; changes > 0 && !bytes.empty(); --changes) bytes[byte() % bytes.size()] ^= byte();
    const Channel channel = op % 4 < 2 ? Channel::datagram : Channel::reliable;
    switch (op >> 4 & 3) {
      case 0: network.inject(SimulatedNetwork::kHost, byte() % 3, channel, bytes); break;
      case 1: network.inject(honest, 0, channel, bytes); break;
      case 2:
        static_cast<void>(port.send(0, channel, bytes).ok());
        if (op >= 0x80) {  // its own hello is a real one
          SealedLink link;
          std::uint8_t hello[SealedLink::kHello];
          if (link.begin(settings().keys[0], hello)) static_cast<void>(port.send(0, Channel::reliable, hello).ok());
        }
        break;
      default:
        const std::uint8_t word[3] = {0x77, 0x77, 0x77};
        require(client.line.send(0, channel, word).ok() && host.line.send(0, channel, word).ok());
        ++said;
    }
    now += byte() * 1000;
    host.turn(now);
    client.turn(now);
    while (const std::optional<Arrival> arrival = port.receive()) {
      if (arrival->kind == ArrivalKind::message) old.assign(arrival->bytes.begin(), arrival->bytes.end());
      if (arrival->kind == ArrivalKind::disconnected) network.connect(stranger);
    }
  }
  require(host.connections == 1 && client.connections == 1);
  require(host.ends == 0 && client.ends == 0);
  require(host.heard == said && client.heard == said);
  return 0;
}
