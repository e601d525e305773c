// The command log, a frame as bytes: commands, each its number in its world's closed list and its content, and where
// among them the world stepped. CommandJournal appends to it, CommandRecorder writes it to a replay.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>
#include <variant>

#include "isostep/core/result.hpp"
#include "isostep/state/archive.hpp"

namespace isostep {

/// Stands in a command log where the world stepped; no command has this number.
inline constexpr std::uint8_t kStepMarker = 0xff;

/// Steps in one frame, at most: a marker is one byte, so a frame's bytes alone could keep whoever plays them for hours.
inline constexpr std::uint32_t kFrameStepCap = 64;
inline constexpr char kTooManySteps[] = "more steps than a frame may have";

namespace detail {
/// A command whose length varies: it has write(Writer&) const and read(Reader&) of its own. The others have `fields`.
template <class C>
concept WritesItself = requires(C& command, const C& same, Writer& writer, Reader& reader) {
  same.write(writer);
  command.read(reader);
};

template <class C>
concept Recordable = HasFields<C> || WritesItself<C>;

template <class Unused, class... Commands> struct CommandVariantOf {
  static_assert((Recordable<Commands> && ...), "a command lacks `fields`, or `write` and `read`");
  using Type = std::variant<Commands...>;
};

template <class C, class Variant> struct IndexOf;
template <class C, class... Rest> struct IndexOf<C, std::variant<C, Rest...>> {
  static constexpr std::uint8_t kValue = 0;
};
template <class C, class First, class... Rest> struct IndexOf<C, std::variant<First, Rest...>> {
  static constexpr std::uint8_t kValue = 1 + IndexOf<C, std::variant<Rest...>>::kValue;
};

template <std::size_t I, class Variant>
ISO_INLINE void read_if(std::size_t number, Reader& reader, std::optional<Variant>& command) {
  if (number != I) return;
  auto& alternative = *std::get_if<I>(&command.emplace(std::in_place_index<I>));
  if constexpr (WritesItself<std::variant_alternative_t<I, Variant>>) {
    alternative.read(reader);
  } else {
    reader.read(alternative);
  }
  if (!reader.ok()) command.reset();
}
template <class Variant, std::size_t... I>
ISO_INLINE void read_any(std::size_t number, Reader& reader, std::optional<Variant>& command,
                         std::index_sequence<I...>) {
  (read_if<I>(number, reader, command), ...);
}
}  // namespace detail

/// The closed list of a world's commands: a command's place in it is its number. A macro that writes the list puts a
/// comma before each, so what stands before the first comma is not used.
template <class Unused, class... Commands>
using CommandVariant = typename detail::CommandVariantOf<Unused, Commands...>::Type;

/// `Variant` is such a list.
template <class Variant, class C> ISO_INLINE void write_command(Writer& writer, const C& command) {
  static_assert(std::variant_size_v<Variant> < kStepMarker);
  writer.write(detail::IndexOf<C, Variant>::kValue);
  if constexpr (detail::WritesItself<C>) {
    command.write(writer);
  } else {
    writer.write(command);
  }
}

/// Nothing, and a reader that has failed, for bytes that are no command.
template <class Variant> ISO_INLINE std::optional<Variant> read_command(Reader& reader) {
  const auto number = reader.read<std::uint8_t>();
  std::optional<Variant> command;
  detail::read_any(number, reader, command, std::make_index_sequence<std::variant_size_v<Variant>>{});
  if (reader.ok() && !command) reader.fail(ErrorCode::invalid, "no command has this number");
  return command;
}

/// A frame's command log from front to back: `apply(command)` says whether it was accepted. What comes before an error
/// was done.
template <class Variant, class Apply, class Step>
ISO_INLINE Result<void> play_commands(Bytes log, Apply&& apply, Step&& step) {
  Reader reader(log);
  std::uint32_t steps = 0;
  while (reader.remaining() > 0) {
    if (log[reader.offset()] != kStepMarker) {
      const std::optional<Variant> command = read_command<Variant>(reader);
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
