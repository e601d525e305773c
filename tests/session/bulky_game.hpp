// Bulky: a game that is small to step and to save, and large when written down, for tests of snapshots.
// SPDX-License-Identifier: MIT
#pragma once

#include "session/toy_game.hpp"

namespace isostep::test {

/// `words` follow the state, and are checked.
struct Bulky : Toy {
  explicit Bulky(std::uint64_t its_words) : words(its_words) {}
  static std::uint64_t word(std::uint64_t i) { return i * 0x9e3779b97f4a7c15u; }
  void write_portable(Writer& writer) const {
    Toy::write_portable(writer);
    for (std::uint64_t i = 0; i < words; ++i) writer.write(word(i));
  }
  Result<void> read_portable(Reader& reader) {
    const Result<void> read = Toy::read_portable(reader);
    if (!read) return read;
    for (std::uint64_t i = 0; i < words; ++i) {
      if (reader.read<std::uint64_t>() != word(i)) reader.fail(ErrorCode::corrupt, "another word");
    }
    return reader.result("words");
  }
  std::uint64_t words;
};

}  // namespace isostep::test
