// The command log, a frame as bytes: commands, each its number in its world's closed list and its content, and where
// among them the world stepped. CommandJournal appends to it, CommandRecorder writes it to a replay. Fields are in the
// short form (pack.hpp), but for those of shapes and heights: an id is two bytes for as long as worlds are small, and a
// log has one form.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <utility>

#include "isostep/core/result.hpp"
#include "isostep/state/archive.hpp"

namespace isostep {

/// Marks in a command log that the world stepped. No command has this number.
inline constexpr std::uint8_t kStepMarker = 0xff;

/// The most steps in one frame. A marker is one byte, so a few bytes of a frame could keep its player busy for hours.
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

/// The place of each command in a list, as base classes. They take one instantiation for the list and one for each
/// place; a search through a std::variant takes as many for every command.
template <std::size_t I, class C> struct Numbered {};
template <class Indices, class... Commands> struct NumbersOf;
template <std::size_t... I, class... Commands>
struct NumbersOf<std::index_sequence<I...>, Commands...> : Numbered<I, Commands>... {
  /// Reads the command of this number and calls visit(command). Returns false if there is none.
  template <class Visit> static ISO_INLINE bool visit_read(std::size_t number, Reader& reader, Visit& visit) {
    return (... || (number == I && read_one<Commands>(reader, visit)));
  }

 private:
  template <class C, class Visit> static ISO_INLINE bool read_one(Reader& reader, Visit& visit) {
    C command = {};
    if constexpr (WritesItself<C>) {
      command.read(reader);
    } else {
      reader.read_short(command);
    }
    if (reader.ok()) visit(std::as_const(command));
    return true;
  }
};
template <class List> struct Numbers;
template <class C, std::size_t I> constexpr std::uint8_t number_in(const Numbered<I, C>*) { return I; }
/// The number of a command in a list.
template <class C, class List>
inline constexpr std::uint8_t kNumberOf = number_in<C>(static_cast<const Numbers<List>*>(nullptr));
}  // namespace detail

/// The closed list of a world's commands: a command's place in it is its number. A macro that writes the list puts a
/// comma before each command, so the first argument is not used. It is no std::variant: each conversion to one of a
/// hundred commands takes the compiler a second.
template <class Unused, class... Commands> struct CommandTypes {
  static_assert((detail::Recordable<Commands> && ...), "a command lacks `fields`, or `write` and `read`");
  static constexpr std::size_t kCount = sizeof...(Commands);
  static_assert(kCount < kStepMarker);
};

namespace detail {
template <class Unused, class... Commands>
struct Numbers<CommandTypes<Unused, Commands...>> : NumbersOf<std::index_sequence_for<Commands...>, Commands...> {};
}  // namespace detail

/// Writes a command of the list: its number and its content.
template <class List, class C> ISO_INLINE void write_command(Writer& writer, const C& command) {
  writer.write(detail::kNumberOf<C, List>);
  if constexpr (detail::WritesItself<C>) {
    command.write(writer);
  } else {
    writer.write_short(command);
  }
}

/// Calls visit(command) with the next command, as the type that it is. Bytes that are no command are not visited, and
/// the reader has then failed.
template <class List, class Visit> ISO_INLINE void read_command(Reader& reader, Visit&& visit) {
  const auto number = reader.read<std::uint8_t>();
  const bool known = detail::Numbers<List>::visit_read(number, reader, visit);
  if (reader.ok() && !known) reader.fail(ErrorCode::invalid, "no command has this number");
}

/// Steps a world in place of its own `step`, for code that watches stages while a command log is played.
struct Stepper {
  void (*step)(void* user);
  void* user;
};

/// Plays a frame's command log from front to back. `apply(command)` gets each command as the type that it is, and
/// returns whether it was accepted. What comes before an error was done.
template <class List, class Apply, class Step>
ISO_INLINE Result<void> play_commands(Bytes log, Apply&& apply, Step&& step) {
  Reader reader(log);
  std::uint32_t steps = 0;
  while (reader.remaining() > 0) {
    if (log[reader.offset()] != kStepMarker) {
      read_command<List>(reader, [&](const auto& command) ISO_INLINE_LAMBDA {
        if (!apply(command)) reader.fail(ErrorCode::corrupt, "a recorded command was refused");
      });
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
