// The native half of native_match_test.mjs: the C++ game, a host's session and the simulated network, for a client that
// lives in another process. In virtual time, so that a match is one and the same however slow the machines are.
// SPDX-License-Identifier: MIT
//
// usage: native_host PROFILE FRAMES. First a line: the input's schema. Then by turns, all little-endian, from stdin:
// now u64, messages u32, of each: channel u8, size u32, bytes; and to stdout: state u8 (0: goes on, 1: all frames are
// final), arrivals u32, of each: kind u8, channel u8, size u32, bytes; then final frames u32, of each: frame u32, hash
// u64. Ends with its input.
#include <cstdio>
#include <cstdlib>
#include <utility>
#include <vector>

#include "pucks.hpp"
#include "transport/pump.hpp"
#include "transport/simulated_network.hpp"

using iso::transport::SimulatedNetwork;

namespace {

template <class T> bool take(T& value) { return std::fread(&value, sizeof value, 1, stdin) == 1; }
template <class T> void put(T value) { std::fwrite(&value, sizeof value, 1, stdout); }

struct Confirmations {
  std::vector<std::pair<std::uint32_t, std::uint64_t>> frames;
  void confirmed(iso::Frame frame, std::uint64_t hash) { frames.emplace_back(static_cast<std::uint32_t>(frame), hash); }
};

bool take_messages(SimulatedNetwork::Port& client) {
  std::uint32_t count = 0;
  if (!take(count)) return false;
  std::vector<std::uint8_t> bytes;
  for (; count > 0; --count) {
    std::uint8_t channel = 0;
    std::uint32_t size = 0;
    if (!take(channel) || !take(size)) return false;
    bytes.resize(size);
    if (size > 0 && std::fread(bytes.data(), 1, size, stdin) != size) return false;
    static_cast<void>(client.send(0, static_cast<iso::Channel>(channel), bytes).ok());
  }
  return true;
}
void put_arrivals(SimulatedNetwork::Port& client) {
  std::vector<std::uint8_t> all;
  std::uint32_t count = 0;
  while (const auto arrival = client.receive()) {
    const auto size = static_cast<std::uint32_t>(arrival->bytes.size());
    all.push_back(static_cast<std::uint8_t>(arrival->kind));
    all.push_back(static_cast<std::uint8_t>(arrival->channel));
    for (int shift = 0; shift < 32; shift += 8) all.push_back(static_cast<std::uint8_t>(size >> shift));
    all.insert(all.end(), arrival->bytes.begin(), arrival->bytes.end());
    ++count;
  }
  put(count);
  std::fwrite(all.data(), 1, all.size(), stdout);
}

}  // namespace

int main(int count, char** words) {
  if (count != 3) return 64;
  const iso::Frame frames = std::atoi(words[2]);
  Game game;
  iso::Session<Game> session(config_of(game));
  SimulatedNetwork network({.seed = 11});
  const auto line = network.add_client(iso::transport::parse_profile(words[1]).value());
  SimulatedNetwork::Port host = network.port(SimulatedNetwork::kHost), client = network.port(line);
  network.connect(line);
  std::printf("%llu\n", static_cast<unsigned long long>(iso::InputCodec<Push>::schema()));

  for (iso::Time now = 0; take(now);) {
    network.advance_to(now);
    if (!take_messages(client)) return 1;
    iso::transport::deliver(host, session, now);
    session.add_local_input(0, {static_cast<std::int8_t>((session.current() / 11) % 3 - 1)});
    Confirmations told;
    iso::drive(session, game, now, told);
    iso::transport::dispatch(host, session, now);
    put(static_cast<std::uint8_t>(session.confirmed() >= frames ? 1 : 0));
    put_arrivals(client);
    put(static_cast<std::uint32_t>(told.frames.size()));
    for (const auto& [frame, hash] : told.frames) {
      put(frame);
      put(hash);
    }
    std::fflush(stdout);
  }
  const auto again = static_cast<unsigned long long>(session.stats().steps) -
                     static_cast<unsigned long long>(session.current());
  std::fprintf(stderr, "%u touches, %llu frames stepped again\n", game.user.touches, again);
  return game.user.touches > 1 ? 0 : 1;
}
