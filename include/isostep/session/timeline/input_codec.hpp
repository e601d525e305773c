// InputCodec: how a game's input travels: a struct with `fields`, a bounded list of commands, or the game's own form.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>
#include <type_traits>

#include "isostep/core/bytes.hpp"
#include "isostep/session/timeline/frame.hpp"
#include "isostep/state/archive.hpp"
#include "isostep/state/hash.hpp"

namespace isostep {

/// [bytes] The largest input of one player in one frame. Unacknowledged inputs are sent again with every frame, to
/// players in at most seven datagrams. If all others' inputs of a round trip exceed 8 KB, they do not keep up with 60
/// Hz. For large and rare orders use WithOrders of large_order.hpp.
inline constexpr std::size_t kInputCap = 512;

/// A list of up to N commands in one frame, for games of orders (RTS). Only `count` of them are sent.
template <class Command, std::size_t N> struct CommandList {
  static_assert(N <= 255, "the count is one byte");
  std::uint8_t count = 0;
  Command items[N] = {};

  /// Returns false if the list is full.
  ISO_INLINE bool add(const Command& command) {
    if (count >= N) return false;
    items[count++] = command;
    return true;
  }
  ISO_INLINE const Command* begin() const { return items; }
  ISO_INLINE const Command* end() const { return items + count; }
  friend ISO_INLINE bool operator==(const CommandList& a, const CommandList& b) {
    if (a.count != b.count) return false;
    for (std::size_t i = 0; i < a.count; ++i) {
      if (!(a.items[i] == b.items[i])) return false;
    }
    return true;
  }
};

namespace detail {
/// Returns a number for the meaning of a field's bits.
template <class T> constexpr std::uint32_t field_form() {
  if constexpr (std::is_same_v<T, bool>) return 1;
  else if constexpr (std::is_enum_v<T>) return 2;
  else if constexpr (std::is_integral_v<T>) return std::is_signed_v<T> ? 3 : 4;
  else return ScalarTraits<T>::kId;
}
template <class T> inline constexpr std::uint32_t kFieldForm = field_form<T>();
/// Hashes names and widths of fields in order, so that builds with different input layouts do not connect.
struct SchemaVisitor {
  HashStream* stream;
  template <class T> void operator()(const char* name, const T& value) const {
    stream->update(name, std::string_view(name).size() + 1);
    add(value);
  }
  template <class T> void add(const T& value) const {
    if constexpr (std::is_bounded_array_v<T>) {
      std::uint8_t extent[4];
      store_le(extent, std::uint32_t{std::extent_v<T>});
      stream->update(extent, sizeof extent);
      add(value[0]);
    } else if constexpr (HasFields<T>) {
      T::fields(*this, value);
    } else {
      std::uint8_t form[5] = {sizeof(T)};
      store_le(form + 1, kFieldForm<T>);
      stream->update(form, sizeof form);
    }
  }
};
struct FiniteVisitor {
  bool* finite;
  template <class T> void operator()(const char*, const T& value) const {
    if constexpr (std::is_bounded_array_v<T>) {
      for (const auto& element : value) (*this)("", element);
    } else if constexpr (HasFields<T>) {
      T::fields(*this, value);
    } else if constexpr (!std::is_integral_v<T> && !std::is_enum_v<T>) {
      *finite = *finite && is_finite(value);
    }
  }
};
/// Reads an untrusted input. Returns true if it is complete, finite, and valid by the game's own `valid()`.
template <class T> bool read_input(Reader& reader, T& value) {
  if (!reader.read(value)) return false;
  bool finite = true;
  FiniteVisitor{&finite}("", value);
  if constexpr (requires {
                  { value.valid() } -> std::convertible_to<bool>;
                })
    finite = finite && value.valid();
  return finite;
}
}  // namespace detail

/// The codec of an input. `encode` is canonical: equal inputs give equal bytes, at most kCap of them. `decode` returns
/// false for invalid bytes, and never gives the same value for different bytes. A game specialises InputCodec for
/// inputs that fit neither form below.
template <class Input> struct InputCodec {
  static_assert(HasFields<Input>, "an input has `fields`, is a CommandList, or brings an InputCodec of its own");
  static constexpr std::size_t kCap = kPackedSize<Input>;

  static std::size_t encode(const Input& input, std::uint8_t* to) {
    return static_cast<std::size_t>(pack(to, input) - to);
  }
  static bool decode(Bytes bytes, Input& input) {
    Reader reader(bytes);
    return detail::read_input(reader, input) && reader.remaining() == 0;
  }
  static std::uint64_t schema() {
    HashStream stream;
    detail::SchemaVisitor{&stream}("input", Input{});
    return stream.value();
  }
};

template <class Command, std::size_t N> struct InputCodec<CommandList<Command, N>> {
  using List = CommandList<Command, N>;
  static constexpr std::size_t kCap = 1 + N * kPackedSize<Command>;

  static std::size_t encode(const List& list, std::uint8_t* to) {
    std::uint8_t* at = to;
    const std::size_t count = list.count < N ? list.count : N;
    *at++ = static_cast<std::uint8_t>(count);
    for (std::size_t i = 0; i < count; ++i) at = pack(at, list.items[i]);
    return static_cast<std::size_t>(at - to);
  }
  static bool decode(Bytes bytes, List& list) {
    Reader reader(bytes);
    List read;
    if (!reader.read(read.count) || read.count > N) return false;
    for (std::size_t i = 0; i < read.count; ++i) {
      if (!detail::read_input(reader, read.items[i])) return false;
    }
    if (reader.remaining() != 0) return false;
    list = read;
    return true;
  }
  static std::uint64_t schema() {
    HashStream stream;
    detail::SchemaVisitor{&stream}("commands", Command{});
    const std::uint8_t cap = N;
    stream.update(&cap, 1);
    return stream.value();
  }
};

/// Predicts that the last input repeats, like a held stick: for games whose input is a state.
struct RepeatLast {
  template <class Input> static Input predict(const Input& last, Frame) { return last; }
};
/// Predicts Input{}: for command lists, since nobody gives the same order twice.
struct PredictNeutral {
  template <class Input> static Input predict(const Input&, Frame) { return Input{}; }
};
template <class Input> struct DefaultPredictor { using Type = RepeatLast; };
template <class Command, std::size_t N> struct DefaultPredictor<CommandList<Command, N>> {
  using Type = PredictNeutral;
};

/// A codec and a predictor without types, as the session's core calls them.
struct InputRules {
  std::size_t cap;       // [bytes]
  std::uint64_t schema;  // digest of the layout
  bool (*is_valid)(const InputRules& rules, Bytes input);
  std::size_t (*guess)(const InputRules& rules, Bytes last, Frame ahead, std::uint8_t* to);
  std::size_t neutral_size;
  std::uint8_t neutral[kInputCap];  // Input{}
  const void* user;                 // of those two functions

  bool valid(Bytes input) const { return is_valid(*this, input); }
  /// Predicts the input `ahead` frames after `last`. Writes at most `cap` bytes and returns how many.
  std::size_t predict(Bytes last, Frame ahead, std::uint8_t* to) const { return guess(*this, last, ahead, to); }
};

template <class Input, class Predictor = typename DefaultPredictor<Input>::Type> InputRules input_rules() {
  using Codec = InputCodec<Input>;
  static_assert(Codec::kCap <= kInputCap, "an input is at most kInputCap bytes");
  InputRules rules{};
  rules.cap = Codec::kCap;
  rules.schema = Codec::schema();
  rules.is_valid = [](const InputRules&, Bytes bytes) {
    Input input{};
    return Codec::decode(bytes, input);
  };
  rules.guess = [](const InputRules&, Bytes last, Frame ahead, std::uint8_t* to) {
    Input input{};
    Codec::decode(last, input);
    return Codec::encode(Predictor::predict(input, ahead), to);
  };
  rules.neutral_size = Codec::encode(Input{}, rules.neutral);
  return rules;
}

}  // namespace isostep
