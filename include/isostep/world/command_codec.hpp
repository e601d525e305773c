// A frame as bytes: commands, each its number in the list and its fields, and where among them the world stepped.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <utility>

#include "isostep/state/archive.hpp"
#include "isostep/world/checks.hpp"
#include "isostep/world/command.hpp"

namespace isostep {

/// Stands in a tape where the world stepped; no command will have this number.
inline constexpr std::uint8_t kStepMarker = 0xff;
static_assert(std::variant_size_v<Command<float>> < kStepMarker);

/// Steps in one frame, at most: a marker is one byte, so a frame's bytes alone could keep whoever plays them for hours.
inline constexpr std::uint32_t kFrameStepCap = 64;
inline constexpr char kTooManySteps[] = "more steps than a frame may have";

namespace detail {
template <class C, class Variant> struct IndexOf;
template <class C, class... Rest> struct IndexOf<C, std::variant<C, Rest...>> {
  static constexpr std::uint8_t kValue = 0;
};
template <class C, class First, class... Rest> struct IndexOf<C, std::variant<First, Rest...>> {
  static constexpr std::uint8_t kValue = 1 + IndexOf<C, std::variant<Rest...>>::kValue;
};

template <class S> void write_fields(Writer& writer, const AddShape<S>& command) {
  writer.write_array(command.children);
}
template <class S, class C> void write_fields(Writer& writer, const C& command) { writer.write(command); }
template <class S> void read_fields(Reader& reader, AddShape<S>& command) {
  reader.read_array(command.children, kMaxChildren);
}
template <class S, class C> void read_fields(Reader& reader, C& command) { reader.read(command); }
}  // namespace detail

template <class S, class C> void write_command(Writer& writer, const C& command) {
  writer.write(detail::IndexOf<C, Command<S>>::kValue);
  detail::write_fields<S>(writer, command);
}

/// Nothing, and a reader that has failed, for bytes that are no command.
template <class S> std::optional<Command<S>> read_command(Reader& reader) {
  const auto kind = reader.read<std::uint8_t>();
  std::optional<Command<S>> command;
  const auto try_kind = [&]<std::size_t I>() {
    if (kind != I) return;
    std::variant_alternative_t<I, Command<S>> alternative{};
    detail::read_fields<S>(reader, alternative);
    if (reader.ok()) command = std::move(alternative);
  };
  [&]<std::size_t... I>(std::index_sequence<I...>) { (try_kind.template operator()<I>(), ...); }
  (std::make_index_sequence<std::variant_size_v<Command<S>>>{});
  if (reader.ok() && !command) reader.fail(ErrorCode::invalid, "no command has this number");
  return command;
}

/// A frame's tape from front to back: `apply(command)` says whether it was accepted. What comes before an error was
/// done.
template <class S, class Apply, class Step> Result<void> play_tape(Bytes tape, Apply&& apply, Step&& step) {
  Reader reader(tape);
  std::uint32_t steps = 0;
  while (reader.remaining() > 0) {
    if (tape[reader.offset()] != kStepMarker) {
      const std::optional<Command<S>> command = read_command<S>(reader);
      if (command && !apply(*command)) reader.fail(ErrorCode::corrupt, "a recorded command was refused");
    } else if (steps++ == kFrameStepCap) {
      reader.fail(ErrorCode::limit, kTooManySteps);
    } else {
      reader.read<std::uint8_t>();
      step();
    }
  }
  return reader.result("commands");
}

}  // namespace isostep
