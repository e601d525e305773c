// SessionGame: the game of a session in C: a world, a block of bytes, and state that callbacks keep, as one.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "isostep/session/session.hpp"
#include "session_world.hpp"

namespace isostep {

/// An input that is bytes: the size and the guess are in the InputRules of the session.
template <> struct InputCodec<Bytes> {
  static constexpr std::size_t kCap = kInputCap;
  static std::size_t encode(const Bytes& input, std::uint8_t* to) {
    for (std::size_t i = 0; i < input.size(); ++i) to[i] = input[i];
    return input.size();
  }
  /// Gives the bytes themselves: they are the core's and hold until its next advance().
  static bool decode(Bytes bytes, Bytes& input) {
    input = bytes;
    return true;
  }
};

namespace c {

/// Models Simulation but for `step`, which the caller does, and PortableState. It is never copied or moved: rules()
/// names it.
class SessionGame {
 public:
  using Input = Bytes;
  static constexpr std::uint32_t kNoSlot = 0xffffffffu;
  struct Snapshot {
    std::unique_ptr<SessionWorld::Slot> world;
    std::vector<std::uint8_t> block;
    std::uint32_t slot = kNoSlot;  // of the game's own
  };

  /// Takes a game and a configuration without a problem: read_game(), read_config().
  SessionGame(const iso_game& game, const iso_session_config& config);
  SessionGame(const SessionGame&) = delete;
  SessionGame& operator=(const SessionGame&) = delete;

  void save(Snapshot& to);
  bool load(const Snapshot& from);
  std::uint64_t hash() const;
  /// Writes nothing of a game without a portable form.
  void write_portable(Writer& writer) const;
  /// Reads all of it or nothing.
  Result<void> read_portable(Reader& reader);
  bool has_portable() const { return game_.save == nullptr || game_.write != nullptr; }

  InputRules rules() const;
  const iso_game& callbacks() const { return game_; }
  /// Returns null where the game has no world.
  SessionWorld* world() const { return world_.get(); }
  bool is_alive() const { return world_ == nullptr || world_->is_alive(); }

 private:
  static bool is_valid(const InputRules& rules, Bytes input);
  static std::size_t guess(const InputRules& rules, Bytes last, Frame ahead, std::uint8_t* to);
  bool read_own(Reader& reader);

  iso_game game_;
  std::unique_ptr<SessionWorld> world_;
  std::unique_ptr<SessionWorld::Slot> before_;  // of a world that is read
  std::uint32_t slots_ = 0;                     // of the game's own that were given out
  iso_session_config config_;                   // what it says of inputs
};

}  // namespace c
}  // namespace isostep
