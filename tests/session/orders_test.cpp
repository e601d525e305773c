// Lists of commands as input: none of a player's orders is lost, doubled or carried out by guess.
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "session/match_checks.hpp"
#include "session/toy_game.hpp"

namespace isostep::test {
namespace orders_test {

struct Order {
  std::uint32_t serial = 0;
  std::uint8_t unit = 0;
  friend bool operator==(const Order&, const Order&) = default;
  ISO_FIELDS(serial, unit)
};

/// Counts what it is told to do, and what came out of turn.
struct Orders {
  using Input = CommandList<Order, 12>;
  struct State {
    std::uint32_t next[kMaxPlayers] = {};
    std::uint32_t out_of_turn = 0;
    std::uint32_t units = 0;
    ISO_FIELDS(next, out_of_turn, units)
  };
  using Snapshot = State;
  State state;

  void step(InputView<Input> inputs) {
    for (std::size_t p = 0; p < inputs.size(); ++p) {
      for (const Order& order : inputs[p]) {
        state.out_of_turn += order.serial == state.next[p] ? 0 : 1;
        state.next[p] = order.serial + 1;
        state.units = state.units * 31 + order.unit;
      }
    }
  }
  void save(State& to) const { to = state; }
  void load(const State& from) { state = from; }
  std::uint64_t hash() const {
    std::uint8_t packed[kPackedSize<State>];
    pack(packed, state);
    return hash_bytes(packed, sizeof packed);
  }
};

class OrdersOverALine : public testing::TestWithParam<std::tuple<SessionMode, const char*>> {};
INSTANTIATE_TEST_SUITE_P(Lines, OrdersOverALine,
                         testing::Combine(testing::Values(SessionMode::lockstep, SessionMode::rollback),
                                          testing::Values("lan", "mobile", "severe", "duplicate", "reorder")));

TEST_P(OrdersOverALine, AreCarriedOutOnceAndInTurn) {
  const auto [mode, line] = GetParam();
  SessionConfig config;
  config.mode = mode;
  config.players = 3;
  config.patience = 60 * kSecond;  // in lockstep a severe line holds all up for a third of the time
  std::uint32_t given[kMaxPlayers] = {};
  Pcg32 random = Pcg32::seeded(6);
  // Asked only when the last list has been taken: one of eight frames, up to twelve orders.
  VirtualMatch<Orders> match(
      config, [] { return std::make_unique<Orders>(); },
      [&](int player, Frame) {
        Orders::Input list;
        const std::uint32_t drawn = random.next();
        for (std::uint32_t i = 0; drawn % 8 == 0 && i < drawn / 8 % 13; ++i) {
          list.add({given[player]++, static_cast<std::uint8_t>(random.next())});
        }
        return list;
      });
  for (int p = 1; p < 3; ++p) match.add(profile(line));
  ASSERT_TRUE(match.run_to(900, 60 * kSecond));
  // The delay changes with the line.
  for (int p = 1; p < 3; ++p) match.network().set_profile(match.machine(p).endpoint, profile("wifi"));
  ASSERT_TRUE(match.run_to(2400, 120 * kSecond));
  EXPECT_EQ(match.host().count(SessionEvent::Kind::left), 0);
  expect_one_history(match);

  Orders alone;
  for (Frame frame = 0; frame < match.host().end(); ++frame) {
    std::vector<Orders::Input> values;
    for (const auto& said : match.host().at(frame)) values.push_back(said.input);
    const std::vector<InputStatus> statuses(3, InputStatus::confirmed);
    alone.step({values, statuses});
  }
  EXPECT_EQ(alone.state.out_of_turn, 0u);
  for (std::size_t p = 0; p < 3; ++p) {
    EXPECT_GT(alone.state.next[p], 1000u);
    EXPECT_LE(alone.state.next[p], given[p]);
    EXPECT_GE(alone.state.next[p] + 12 * 40, given[p]) << "the newest are still on their way";
  }
}

}  // namespace orders_test
}  // namespace isostep::test
