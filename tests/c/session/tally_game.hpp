// A game without a world: sixteen bytes that inputs change, as a block or by callbacks, and with faults to be found.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <cstring>
#include <vector>

#include "isostep.h"

namespace isostep::test {

struct Tally {
  static constexpr std::size_t kSize = 16;
  std::uint8_t state[kSize] = {};
  std::uint8_t saved[128][kSize] = {};
  std::size_t blind = kSize;  // the byte that the hash of the callbacks does not see; kSize: sees all
  bool forgets = false;       // `steps` shapes the future, and is no state
  std::uint32_t steps = 0;
  std::vector<std::uint64_t> hashes;  // of confirmed frames
  int rollbacks = 0, guesses = 0, largest_slot = -1;
  void (*in_step)(Tally&) = nullptr;  // what a game might call from there
  iso_session* session = nullptr;

  void step(const iso_input* inputs, std::uint32_t players) {
    for (std::uint32_t p = 0; p < players; ++p) {
      const std::uint8_t what = inputs[p].status == ISO_DISCONNECTED ? 0xaa : inputs[p].bytes[0];
      state[what % kSize] = static_cast<std::uint8_t>(5 * state[what % kSize] + what + p + 1);
    }
    ++steps;
    if (forgets) state[0] = static_cast<std::uint8_t>(state[0] + steps);
  }
  static Tally& of(void* user) { return *static_cast<Tally*>(user); }

  iso_game describe(bool by_callbacks) {
    iso_game game;
    iso_game_init(&game);
    game.user = this;
    game.step = [](void* user, std::int32_t, const iso_input* inputs, std::uint32_t players) {
      of(user).step(inputs, players);
      if (of(user).in_step != nullptr) of(user).in_step(of(user));
    };
    game.rolled_back = [](void* user, std::int32_t) { ++of(user).rollbacks; };
    game.confirmed = [](void* user, std::int32_t, std::uint64_t hash) { of(user).hashes.push_back(hash); };
    if (!by_callbacks) {
      game.block = state;
      game.block_size = sizeof state;
      return game;
    }
    game.save = [](void* user, std::uint32_t slot) {
      if (static_cast<int>(slot) > of(user).largest_slot) of(user).largest_slot = static_cast<int>(slot);
      std::memcpy(of(user).saved[slot % 128], of(user).state, kSize);
    };
    game.load = [](void* user, std::uint32_t slot) { std::memcpy(of(user).state, of(user).saved[slot % 128], kSize); };
    game.hash = [](void* user) {
      std::uint8_t seen[kSize];
      std::memcpy(seen, of(user).state, kSize);
      if (of(user).blind < kSize) seen[of(user).blind] = 0;
      return iso_hash_bytes(seen, kSize);
    };
    game.write = [](void* user, void* bytes, std::size_t room) {
      if (room >= kSize) std::memcpy(bytes, of(user).state, kSize);
      return kSize;
    };
    game.read = [](void* user, const void* bytes, std::size_t size) -> std::int32_t {
      if (size != kSize) return 1;
      std::memcpy(of(user).state, bytes, kSize);
      return 0;
    };
    return game;
  }
};

inline iso_session_config tally_config(iso_session_mode mode) {
  iso_session_config config;
  iso_session_config_init(&config);
  config.mode = mode;
  std::strcpy(config.name, "tally");
  std::strcpy(config.input_text, "what: uint8");
  return config;
}
inline std::uint8_t tally_input(std::int32_t frame, int player) {
  return static_cast<std::uint8_t>(frame / (3 + player) * 37 + player);
}

/// One event after another; kind ISO_EVENT_NONE: there is none.
inline iso_session_event poll_event(iso_session* session) {
  iso_session_event event{};
  event.size = sizeof event;
  if (iso_session_poll_event(session, &event) != ISO_OK) event.kind = ISO_EVENT_NONE;
  return event;
}

}  // namespace isostep::test
