// A toy game for the tests of saving, hashing and replaying: a few counters, a random number, a moving point.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "isostep/math/vec3.hpp"
#include "isostep/state/concepts.hpp"
#include "isostep/state/diff.hpp"
#include "isostep/state/hash.hpp"
#include "isostep/state/record.hpp"
#include "isostep/state/verify.hpp"

namespace toy {

using namespace isostep;

enum class Mood : std::uint16_t { calm, cross };

template <class S> struct Thing {
  Vec3<S> velocity;
  S charge;
  std::uint32_t visits;
  Mood mood;
  std::uint8_t marks[2];

  ISO_FIELDS(velocity, charge, visits, mood, marks)
};
static_assert(kHasNoPadding<Thing<float>> && kHasNoPadding<Thing<Q32_32>>);

/// Twelve bytes of fields in sixteen of memory.
struct Padded {
  std::uint64_t big;
  bool flag;
  std::int8_t small;
  std::int16_t middle;

  ISO_FIELDS(big, flag, small, middle)
};
static_assert(!kHasNoPadding<Padded> && kPackedSize<Padded> == 12);

struct Input {
  std::uint8_t push = 0;
  std::uint8_t spawn = 0;
  friend bool operator==(const Input&, const Input&) = default;
};

class Game {
 public:
  using Input = toy::Input;
  using Thing = toy::Thing<Q32_32>;
  static constexpr std::uint32_t kThingCap = 64;
  struct Snapshot {
    std::uint64_t random;
    std::uint64_t frames;
    std::vector<Thing> things;
  };

  /// The game is another one, by one bit, from this frame on.
  std::uint64_t bug_at = ~std::uint64_t{0};

  void save(Snapshot& to) const { to = {random_, frames_, things_}; }
  void load(const Snapshot& from) {
    random_ = from.random;
    frames_ = from.frames;
    things_ = from.things;
  }
  std::uint64_t hash() const {
    HashCombiner combiner;
    combiner.add(random_);
    combiner.add(frames_);
    combiner.add(hash_records(things_.data(), things_.size()));
    return combiner.value();
  }
  void write_portable(Writer& writer) const {
    writer.write(random_);
    writer.write(frames_);
    writer.write_array(things_);
  }
  Result<void> read_portable(Reader& reader) {
    const auto random = reader.read<std::uint64_t>();
    const auto frames = reader.read<std::uint64_t>();
    std::vector<Thing> things;
    reader.read_array(things, kThingCap);
    for (const Thing& thing : things) {
      if (thing.mood > Mood::cross) reader.fail(ErrorCode::invalid, "a mood that does not exist");
    }
    if (reader.ok()) {
      random_ = random;
      frames_ = frames;
      things_ = things;
    }
    return reader.result("toy");
  }
  /// A frame is the inputs of all players, two bytes each.
  Result<void> step_recorded(Bytes input) {
    Reader reader(input);
    std::vector<Input> inputs(input.size() / 2);
    for (Input& one : inputs) {
      reader.read(one.push);
      reader.read(one.spawn);
      if (one.spawn > 1) reader.fail(ErrorCode::invalid, "spawn is 0 or 1");
    }
    reader.expect_end();
    if (!reader.ok()) return reader.result("toy input");
    const std::vector<InputStatus> statuses(inputs.size(), InputStatus::confirmed);
    step({inputs, statuses});
    return {};
  }
  void step(InputView<Input> inputs) {
    for (std::size_t i = 0; i < inputs.size(); ++i) {
      random_ = random_ * 6364136223846793005u + 1442695040888963407u;
      if (inputs[i].spawn == 1 && things_.size() < kThingCap) {
        things_.push_back({Vec3<Q32_32>::zero(), 1, 0, {}, {1, 2}});
      }
      if (things_.empty()) continue;
      Thing& thing = things_[(random_ >> 33) % things_.size()];
      thing.velocity.x += Q32_32(0.25) * Q32_32(inputs[i].push);
      thing.visits += 1;
      thing.mood = inputs[i].push > 100 ? Mood::cross : Mood::calm;
    }
    ++frames_;
    if (frames_ > bug_at && !things_.empty()) things_[0].charge += Q32_32::from_raw(1);
  }

  std::vector<Thing>& things() { return things_; }
  std::uint64_t frames() const { return frames_; }

 private:
  std::uint64_t random_ = 1;
  std::uint64_t frames_ = 0;
  std::vector<Thing> things_;
};
static_assert(Simulation<Game> && PortableState<Game> && ReplayableSimulation<Game>);

}  // namespace toy
