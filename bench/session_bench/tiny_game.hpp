// TinyGame: a number that every input shapes, and two players for it: for what depends on the session alone.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/core/random.hpp"
#include "isostep/state/concepts.hpp"
#include "scenes/match.hpp"

namespace isostep::bench {

/// The inputs are those of the match: four bytes.
class TinyGame {
 public:
  using Input = scenes::MatchInput;
  using Snapshot = std::uint64_t;

  void step(InputView<Input> inputs) {
    for (std::size_t p = 0; p < inputs.size(); ++p) {
      const Input& in = inputs[p];
      const std::uint64_t word = static_cast<std::uint8_t>(in.push_x) | static_cast<unsigned>(in.buttons) << 8 |
                                 static_cast<unsigned>(in.aim) << 16;
      number_ = (number_ ^ word) * 6364136223846793005u + static_cast<std::uint8_t>(in.push_z);
    }
  }
  void save(Snapshot& to) const { to = number_; }
  void load(const Snapshot& from) { number_ = from; }
  std::uint64_t hash() const { return number_; }

 private:
  std::uint64_t number_ = 1;
};

/// The worst that four bytes can do: others in every frame.
inline scenes::MatchInput restless_input(int player, Frame frame) {
  Pcg32 random = Pcg32::seeded(static_cast<std::uint64_t>(frame) * 8 + static_cast<std::uint64_t>(player));
  const std::uint32_t drawn = random.next();
  return {static_cast<std::int8_t>(drawn), static_cast<std::int8_t>(drawn >> 8),
          static_cast<std::uint8_t>(drawn >> 16 & 127), static_cast<std::uint8_t>(drawn >> 24)};
}

}  // namespace isostep::bench
