// Toy: a game of a few whole numbers, for tests of sessions that need many frames and no physics.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "isostep/core/random.hpp"
#include "isostep/session/timeline/frame.hpp"
#include "isostep/state/archive.hpp"
#include "isostep/state/concepts.hpp"
#include "isostep/state/hash.hpp"

namespace isostep::test {

struct ToyInput {
  std::int8_t push = 0, pull = 0;
  std::uint16_t word = 0;

  friend bool operator==(const ToyInput&, const ToyInput&) = default;
  ISO_FIELDS(push, pull, word)
};

/// Every bit of every input, and who is away, shapes all that follows.
struct ToyState {
  std::uint64_t tick = 0;
  std::uint64_t places[kMaxPlayers] = {};
  std::uint64_t absences[kMaxPlayers] = {};

  ISO_FIELDS(tick, places, absences)
};

class Toy {
 public:
  using Input = ToyInput;
  struct Snapshot {
    ToyState state;
    std::vector<std::uint64_t> ballast;
  };

  /// `ballast` words make the portable form as long as a test needs.
  explicit Toy(std::size_t ballast = 0) : ballast_(ballast) {}

  void step(InputView<ToyInput> inputs) {
    if (seats_ < inputs.size()) seats_ = inputs.size();
    for (std::size_t p = 0; p < inputs.size(); ++p) {
      const ToyInput& input = inputs[p];
      std::uint64_t& place = state.places[p];
      if (inputs.status(p) == InputStatus::disconnected) ++state.absences[p];
      place += static_cast<std::uint64_t>(input.push * 3 + input.pull) + input.word;
      place = place * 6364136223846793005u + state.places[(p + 1) % kMaxPlayers] + state.absences[p];
    }
    if (!ballast_.empty()) ballast_[state.tick % ballast_.size()] += state.places[0];
    ++state.tick;
  }
  void save(Snapshot& to) const {
    to.state = state;
    to.ballast = ballast_;
  }
  void load(const Snapshot& from) {
    state = from.state;
    ballast_ = from.ballast;
  }
  std::uint64_t hash() const {
    std::uint8_t packed[kPackedSize<ToyState>];
    pack(packed, state);
    HashCombiner combiner;
    combiner.add(hash_bytes(packed, sizeof packed));
    if (!ballast_.empty()) combiner.add(hash_bytes(ballast_.data(), ballast_.size() * sizeof ballast_[0]));
    return combiner.value();
  }
  void write_portable(Writer& writer) const {
    // Writes the seats that play, and not the many that could: snapshots are as short as in a small game.
    const auto seats = static_cast<std::uint8_t>(seats_);
    writer.write(state.tick);
    writer.write(seats);
    for (std::size_t p = 0; p < seats_; ++p) {
      writer.write(state.places[p]);
      writer.write(state.absences[p]);
    }
    for (const std::uint64_t word : ballast_) writer.write(word);
  }
  Result<void> read_portable(Reader& reader) {
    ToyState read;
    std::vector<std::uint64_t> words(ballast_.size());
    reader.read(read.tick);
    const auto seats = reader.read<std::uint8_t>();
    if (seats > kMaxPlayers) reader.fail(ErrorCode::invalid, "more seats than there can be");
    for (std::size_t p = 0; p < seats && reader.ok(); ++p) {
      reader.read(read.places[p]);
      reader.read(read.absences[p]);
    }
    for (std::uint64_t& word : words) reader.read(word);
    if (!reader.ok()) return reader.result("toy");
    state = read;
    seats_ = seats;
    ballast_ = words;
    return {};
  }

  ToyState state;

 private:
  std::size_t seats_ = 0;  // that were played on; the others are zero
  std::vector<std::uint64_t> ballast_;
};

/// Holds an input for some frames, as people do, so that guesses are right at times.
inline ToyInput toy_input(std::uint64_t seed, int player, Frame frame) {
  const auto hold = static_cast<Frame>(5 + player);
  Pcg32 random = Pcg32::seeded(seed * 1000003u + static_cast<std::uint64_t>(player) * 7919u +
                               static_cast<std::uint64_t>(frame / hold));
  const std::uint32_t drawn = random.next();
  return {static_cast<std::int8_t>(drawn), static_cast<std::int8_t>(drawn >> 8),
          static_cast<std::uint16_t>(drawn >> 16)};
}

}  // namespace isostep::test
