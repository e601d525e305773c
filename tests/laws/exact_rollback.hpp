// The restore law of a scene that is played by hand.
// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "unit/world/worlds.hpp"

namespace isostep::test {

/// Plays on from here: act(world, frame) and a step, `frames` times. A snapshot and a portable form of the middle lead
/// to the same hashes. Returns them.
template <class S, class Act>
std::vector<std::uint64_t> expect_exact_rollback(World<S>& w, int frames, const Act& act) {
  const int middle = frames / 2;
  typename World<S>::Snapshot snapshot;
  std::vector<std::uint8_t> bytes;
  std::vector<std::uint64_t> hashes;
  const auto play = [&](World<S>& world, int from, const auto& see) {
    for (int i = from; i < frames; ++i) {
      if (i == middle && from == 0) {
        world.save(snapshot);
        bytes = bytes_of(world);
      }
      act(world, i);
      world.step();
      see(i, world.hash());
    }
  };
  play(w, 0, [&](int, std::uint64_t hash) { hashes.push_back(hash); });
  const auto expect_same = [&](int i, std::uint64_t hash) {
    EXPECT_EQ(hash, hashes[static_cast<std::size_t>(i)]) << i;
  };
  w.load(snapshot);
  play(w, middle, expect_same);
  World<S> read;
  Reader reader(bytes);
  EXPECT_TRUE(read.read_portable(reader).ok());
  play(read, middle, expect_same);
  return hashes;
}

}  // namespace isostep::test
