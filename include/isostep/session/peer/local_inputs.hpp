// LocalInputs: what the players of this machine have given for the next frame.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstring>

#include "isostep/session/timeline/input_codec.hpp"
#include "isostep/session/timeline/input_stream.hpp"

namespace isostep {

/// Predicts the input after the stream's newest. The result is valid until `buffer` is written to.
inline Bytes guess_next(const InputRules& rules, const InputStream& stream, std::uint8_t (&buffer)[kInputCap]) {
  const InputEntry last = stream.last();
  const Bytes before = last.absent ? Bytes(rules.neutral, rules.neutral_size) : last.bytes;
  return {buffer, rules.predict(before, 1, buffer)};
}

/// In: inputs of local players, at any time. Out: their streams, as far as the delay asks. Keeps: the last input of
/// each player, until a frame has taken it.
class LocalInputs {
 public:
  bool has(int player) const { return pending_[player].is_set; }
  void set(int player, Bytes input) {
    Pending& pending = pending_[player];
    pending.is_set = true;
    pending.size = static_cast<std::uint16_t>(input.size());
    if (!input.empty()) std::memcpy(pending.bytes, input.data(), input.size());
  }
  /// Fills the stream up to frame `end`: the newest frame takes the given input, those before it take predictions.
  void fill(int player, InputStream& stream, Frame end, const InputRules& rules) {
    if (stream.end() >= end) return;
    Pending& pending = pending_[player];
    while (stream.end() < end) {
      std::uint8_t buffer[kInputCap];
      const Bytes guessed = guess_next(rules, stream, buffer);
      const bool is_newest = stream.end() == end - 1;
      stream.append({false, is_newest && pending.is_set ? Bytes(pending.bytes, pending.size) : guessed});
    }
    pending.is_set = false;
  }

 private:
  struct Pending {
    bool is_set = false;
    std::uint16_t size = 0;
    std::uint8_t bytes[kInputCap];
  };
  Pending pending_[kMaxPlayers];
};

}  // namespace isostep
