// Concepts that sessions, replays and tools require of a world or a game: to be saved, loaded, hashed, stepped and
// written.
// SPDX-License-Identifier: MIT
#pragma once

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <span>

#include "isostep/state/archive.hpp"

namespace isostep {

/// After load(save(x)) any inputs give at every later frame the hash of an x that never saved. Snapshots are reused:
/// saving into one of the same size allocates nothing.
template <class T>
concept Rollbackable = std::default_initializable<typename T::Snapshot> &&
    requires(T& mutable_state, const T& state, typename T::Snapshot& to, const typename T::Snapshot& from) {
  state.save(to);
  mutable_state.load(from);
  { state.hash() } -> std::same_as<std::uint64_t>;
};

template <class T> using Snapshot = typename T::Snapshot;

/// The certainty of one player's input when a frame is stepped.
enum class InputStatus : std::uint8_t {
  confirmed,    // the player's own word
  predicted,    // a guess; the frame will be stepped again if it was wrong
  disconnected  // the player is gone: the value is Input{}
};

/// The inputs of all players for one frame, in player order.
template <class Input> struct InputView {
  std::span<const Input> values;
  std::span<const InputStatus> statuses;  // one for each input

  ISO_INLINE std::size_t size() const { return values.size(); }
  ISO_INLINE const Input& operator[](std::size_t player) const { return values[player]; }
  ISO_INLINE InputStatus status(std::size_t player) const { return statuses[player]; }
};

/// A game: `step` is exactly one tick. Its result depends on the state, the input values and who is disconnected. A
/// predicted input must have the same effect as the same input once it is confirmed.
template <class T>
concept Simulation = Rollbackable<T> && std::default_initializable<typename T::Input> &&
    std::equality_comparable<typename T::Input> && requires(T& game, InputView<typename T::Input> inputs) {
  game.step(inputs);
};

/// An object that can be written and rebuilt on any machine. A refused read leaves it as it was.
template <class T>
concept PortableState = requires(T& mutable_state, const T& state, Writer& writer, Reader& reader) {
  state.write_portable(writer);
  { mutable_state.read_portable(reader) } -> std::same_as<Result<void>>;
};

/// A simulation that can be recorded and verified. It alone decodes and applies a frame, which is opaque bytes.
template <class T>
concept ReplayableSimulation = PortableState<T> && requires(T& mutable_state, const T& state, Bytes input) {
  { mutable_state.step_recorded(input) } -> std::same_as<Result<void>>;
  { state.hash() } -> std::same_as<std::uint64_t>;
};

}  // namespace isostep
