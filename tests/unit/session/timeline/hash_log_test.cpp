// HashLog: what is chained, what is forgotten, and how long it is kept.
// SPDX-License-Identifier: MIT
#include "isostep/session/timeline/hash_log.hpp"

#include <gtest/gtest.h>

#include "isostep/state/hash.hpp"

namespace isostep {
namespace hash_log_test {

std::uint64_t hash_of(std::uint64_t a, std::uint64_t b) {
  std::uint8_t bytes[16];
  store_le(bytes, a);
  store_le(bytes + 8, b);
  return hash_bytes(bytes, sizeof bytes);
}
/// Two words added to a combiner that is empty.
std::uint64_t link(std::uint64_t chain, std::uint64_t hash) { return hash_of(hash_of(0, chain), hash); }
std::uint64_t state_hash(Frame state) { return 1000u + static_cast<std::uint64_t>(state) * 7; }

TEST(HashLog, ChainsTheStatesThatAreFinal) {
  HashLog log(16);
  EXPECT_EQ(log.settled().frame, kNoFrame);
  EXPECT_FALSE(log.has_chain(0));
  log.restart({0, 5}, 5);
  EXPECT_EQ(log.settled().chain, 5u);
  std::uint64_t chain = 5;
  for (Frame state = 1; state < 10; ++state) {
    EXPECT_FALSE(log.settle_next(100)) << "its hash is not there yet";
    log.report(state, state_hash(state));
    EXPECT_FALSE(log.settle_next(state - 1)) << "it is not final";
    EXPECT_TRUE(log.settle_next(state));
    chain = link(chain, state_hash(state));
    EXPECT_EQ(log.settled().frame, state);
    EXPECT_EQ(log.settled().chain, chain);
    EXPECT_EQ(log.chain(state), chain);
    EXPECT_EQ(log.hash(state), state_hash(state));
  }
}

TEST(HashLog, OneHashThatDiffersChangesEveryChainAfterIt) {
  HashLog a(64), b(64);
  for (HashLog* log : {&a, &b}) {
    log->restart({0, 1}, 1);
    for (Frame state = 1; state < 20; ++state) {
      log->report(state, state_hash(state) + (log == &b && state == 7 ? 1 : 0));
      log->settle_next(state);
    }
  }
  for (Frame state = 0; state < 20; ++state) EXPECT_EQ(a.chain(state) == b.chain(state), state < 7) << state;
}

TEST(HashLog, AStateThatIsMadeAnewIsChainedWithItsNewHash) {
  HashLog log(16);
  log.restart({0, 0}, 0);
  for (Frame state = 1; state <= 5; ++state) log.report(state, 1);
  EXPECT_TRUE(log.settle_next(2));
  log.forget_from(2);
  EXPECT_FALSE(log.settle_next(5));
  log.report(2, 77);
  log.report(3, 78);
  EXPECT_TRUE(log.settle_next(5));
  EXPECT_TRUE(log.settle_next(5));
  EXPECT_FALSE(log.settle_next(5)) << "4 and 5 were forgotten too";
  EXPECT_EQ(log.settled().chain, link(link(link(0, 1), 77), 78));
}

TEST(HashLog, WhatIsFinalIsNeitherForgottenNorReplaced) {
  HashLog log(16);
  log.restart({0, 0}, 0);
  for (Frame state = 1; state <= 3; ++state) log.report(state, state_hash(state));
  while (log.settle_next(3)) {}
  log.forget_from(1);
  log.report(2, 99);
  EXPECT_EQ(log.settled().frame, 3);
  EXPECT_TRUE(log.has_chain(2));
  EXPECT_EQ(log.hash(2), state_hash(2));
}

TEST(HashLog, KeepsAsManyAsItHasPlacesForTheNewestIncluded) {
  HashLog log(8);
  log.restart({0, 0}, 0);
  for (Frame state = 1; state <= 20; ++state) {
    log.report(state, state_hash(state));
    log.settle_next(state);
  }
  for (Frame state = 0; state <= 30; ++state) EXPECT_EQ(log.has_chain(state), state > 12 && state <= 20) << state;
  EXPECT_FALSE(log.has_chain(kNoFrame));
  EXPECT_FALSE(log.has_chain(kLastFrame));
  // Hashes that are not final take the places of the oldest that are.
  log.report(21, 1);
  log.report(22, 2);
  for (Frame state = 0; state <= 30; ++state) EXPECT_EQ(log.has_chain(state), state > 14 && state <= 20) << state;
  for (Frame state = 15; state <= 20; ++state) EXPECT_EQ(log.hash(state), state_hash(state));
}

TEST(HashLog, StartsAnewAnywhere) {
  HashLog log(8);
  log.restart({0, 0}, 0);
  for (Frame state = 1; state <= 5; ++state) log.report(state, 1);
  log.restart({1000, 42}, 43);
  EXPECT_EQ(log.settled().frame, 1000);
  EXPECT_EQ(log.chain(1000), 42u);
  EXPECT_EQ(log.hash(1000), 43u);
  EXPECT_FALSE(log.has_chain(999));
  EXPECT_FALSE(log.has_chain(5));
  EXPECT_FALSE(log.settle_next(2000));
  log.report(1001, 44);
  EXPECT_TRUE(log.settle_next(2000));
  EXPECT_EQ(log.settled().chain, link(42, 44));
}

}  // namespace hash_log_test
}  // namespace isostep
