// SecretNumbers: the host's match numbers, tokens and lives, which only who knows its seed can compute.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/core/bytes.hpp"
#include "isostep/session/protocol/siphash.hpp"

namespace isostep {

/// Numbers are never 0. Those of one purpose or term tell nothing of another's. So a machine that is the host again, or
/// goes on with a saved match, gives out no number twice.
class SecretNumbers {
 public:
  SecretNumbers(std::uint64_t seed, std::uint32_t term) : seed_(seed), term_(term) {}
  std::uint64_t match() const { return draw(Purpose::match, 0); }
  std::uint64_t next_token() { return draw(Purpose::token, tokens_++); }
  std::uint64_t next_life() { return draw(Purpose::life, lives_++); }

 private:
  enum class Purpose : std::uint64_t { match, token, life };

  std::uint64_t draw(Purpose purpose, std::uint64_t n) const {
    std::uint8_t words[32] = {};
    store_le(words, static_cast<std::uint64_t>(purpose));
    store_le(words + 8, std::uint64_t{term_});
    store_le(words + 16, n);
    for (std::uint64_t again = 0;; ++again) {
      store_le(words + 24, again);
      if (const std::uint64_t number = siphash_2_4({seed_, 0}, words)) return number;
    }
  }

  std::uint64_t seed_;
  std::uint32_t term_;                    // of the host
  std::uint64_t tokens_ = 0, lives_ = 0;  // how many there were
};

}  // namespace isostep
