// SecretNumbers: the host's match numbers, tokens and lives, which only who knows its seed can compute.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/core/bytes.hpp"
#include "isostep/session/protocol/siphash.hpp"

namespace isostep {

/// Never 0. Numbers of one purpose tell nothing of another's.
class SecretNumbers {
 public:
  explicit SecretNumbers(std::uint64_t seed) : seed_(seed) {}
  /// Of the n-th sequel of a match.
  std::uint64_t match(std::uint64_t n) const { return draw(Purpose::match, n); }
  std::uint64_t next_token() { return draw(Purpose::token, tokens_++); }
  std::uint64_t next_life() { return draw(Purpose::life, lives_++); }
  /// That were given out.
  std::uint64_t tokens() const { return tokens_; }
  void go_on_after(std::uint64_t tokens) { tokens_ = tokens; }

 private:
  enum class Purpose : std::uint64_t { match, token, life };

  std::uint64_t draw(Purpose purpose, std::uint64_t n) const {
    std::uint8_t words[24] = {};
    store_le(words, static_cast<std::uint64_t>(purpose));
    store_le(words + 8, n);
    for (std::uint64_t again = 0;; ++again) {
      store_le(words + 16, again);
      if (const std::uint64_t number = siphash_2_4({seed_, 0}, words)) return number;
    }
  }

  std::uint64_t seed_;
  std::uint64_t tokens_ = 0, lives_ = 0;  // how many there were
};

}  // namespace isostep
