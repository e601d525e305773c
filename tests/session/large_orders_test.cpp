// Orders of kilobytes: whole, once, in turn and in the same frame everywhere, while the match goes on evenly.
// SPDX-License-Identifier: MIT
#include <map>

#include "isostep/session/observers/large_order.hpp"
#include "isostep/state/composite.hpp"
#include "session/pace_watch.hpp"
#include "session/recorded_play.hpp"

namespace isostep::test {
namespace large_orders_test {

struct Unit {
  std::uint8_t command = 0;
  friend bool operator==(const Unit&, const Unit&) = default;
  ISO_FIELDS(command)
};

/// The fate of all orders.
struct CommandState {
  std::uint64_t digest = 0;
  std::uint32_t tick = 0, orders = 0, out_of_turn = 0;
  ISO_FIELDS(digest, tick, orders, out_of_turn)
};
/// Every byte of every order shapes all that follows.
struct Commanders : Composite<CommandState, OrderAssembly> {
  using Input = WithOrders<CommandList<Unit, 8>>;
  void step(InputView<Input> inputs) {
    CommandState& state = world;
    for (std::size_t p = 0; p < inputs.size(); ++p) {
      for (const Unit& unit : inputs[p].brief) state.digest = state.digest * 31 + unit.command;
      const Bytes order = user.take(inputs, p);
      if (order.empty()) continue;
      // It begins with its place among its player's orders.
      state.out_of_turn += load_le<std::uint32_t>(order.data()) + 1 == user.completed(static_cast<int>(p)) ? 0 : 1;
      state.digest = state.digest * 31 + hash_bytes(order.data(), order.size());
      ++state.orders;
    }
    ++state.tick;
  }
};

/// Every machine's player gives orders of 8 KB, from time to time; what is in them does not repeat.
struct OrdersMatch {
  static constexpr std::size_t kSize = 8 << 10;  // [bytes]

  OrdersMatch(const SessionConfig& config, std::string_view line, std::uint64_t seed = 1)
      : match(
            config, [] { return std::make_unique<Commanders>(); },
            [this](int player, Frame frame) { return input(player, frame); }, seed) {
    watch_machine(match.host());
    for (int p = 1; p < config.players; ++p) watch_machine(match.add(profile(line)));
  }
  void watch_machine(Machine<Commanders>& machine) {
    senders.push_back(std::make_unique<OrderSender<Commanders>>(machine.session, machine.game->user));
    const std::size_t i = senders.size() - 1;
    machine.was_confirmed = [this, i](Frame frame, std::uint64_t hash) { senders[i]->confirmed(frame, hash); };
    machine.restarts_at = [this, i](Frame frame) { senders[i]->restarted(frame); };
  }
  Commanders::Input input(int player, Frame frame) {
    Commanders::Input input;
    if (frame % 7 == 0) input.brief.add({static_cast<std::uint8_t>(frame)});
    for (std::size_t i = 0; i < senders.size(); ++i) {
      if (match.machine(i).session.local_player() == player && match.machine(i).plays) senders[i]->fill(input);
    }
    return input;
  }
  void give(std::size_t i, std::size_t size = kSize) {
    std::vector<std::uint8_t> order(size < 4 ? 4 : size);
    for (std::uint8_t& byte : order) byte = static_cast<std::uint8_t>(random.next());
    store_le(order.data(), given[i]++);
    EXPECT_TRUE(senders[i]->give(order));
  }
  /// Runs, and each gives an order every two seconds; [us] how long the slowest took until it was stepped at the giver.
  Time play(Time time, bool together) {
    std::map<std::size_t, Time> since;
    Time slowest = 0, next = match.now();
    const Time apart = together ? 0 : 2 * kSecond / match.size();
    std::vector<Time> due;
    for (std::size_t i = 0; i < match.size(); ++i) due.push_back(next + apart * i);
    std::vector<std::uint32_t> known = given;
    PaceWatch<Commanders> watched(match);
    match.run(time, [&] {
      watched.look();
      for (std::size_t i = 0; i < match.size(); ++i) {
        const auto player = static_cast<std::uint32_t>(match.machine(i).session.local_player());
        const bool is_here = match.machine(i).game->user.completed(static_cast<int>(player)) >= given[i];
        if (since.count(i) != 0 && is_here) {
          slowest = std::max(slowest, match.now() - since[i]);
          since.erase(i);
        }
        if (match.now() < due[i]) continue;
        due[i] += 2 * kSecond;
        EXPECT_EQ(since.count(i), 0u) << "the last one is not there yet";
        since[i] = match.now();
        give(i);
      }
      return false;
    });
    for (std::size_t i = 0; i < match.size(); ++i) {
      worst_gap = std::max(worst_gap, watched[i].worst());
      least_rate = std::min(least_rate, watched.hundred_seconds(i));
    }
    return slowest;
  }

  VirtualMatch<Commanders> match;
  std::vector<std::unique_ptr<OrderSender<Commanders>>> senders;
  std::vector<std::uint32_t> given = std::vector<std::uint32_t>(kMaxPlayers);
  Pcg32 random = Pcg32::seeded(11);
  Time worst_gap = 0;          // [us]
  Frame least_rate = 1 << 20;  // [frames/100 s]
};

class LargeOrders : public testing::TestWithParam<std::tuple<SessionMode, int, bool>> {};
INSTANTIATE_TEST_SUITE_P(Matches, LargeOrders,
                         testing::Combine(testing::Values(SessionMode::lockstep, SessionMode::rollback),
                                          testing::Values(4, 8), testing::Bool()));

TEST_P(LargeOrders, OfEightKilobytesEveryTwoSecondsAreNotNoticed) {
  const auto [mode, players, together] = GetParam();
  OrdersMatch orders(config_of(players, mode), "latency=30,jitter=5,loss=0.5");
  orders.match.run(5 * kSecond, [] { return false; });
  orders.play(6 * kSecond, together);  // delays find what the line takes
  orders.worst_gap = 0, orders.least_rate = 1 << 20;
  const SessionStats before = orders.match.host().session.stats();
  const Time slowest = orders.play(20 * kSecond, together);
  const SessionStats& after = orders.match.host().session.stats();
  std::printf("%s, %d players, %s: worst gap %d ms, %d.%02d frames/s, order after %d ms, delay %d, host %d kB/s\n",
              mode == SessionMode::lockstep ? "lockstep" : "rollback", players, together ? "together" : "in turns",
              static_cast<int>(orders.worst_gap / 1000), orders.least_rate / 100, orders.least_rate % 100,
              static_cast<int>(slowest / 1000), after.delay,
              static_cast<int>((after.bytes_out - before.bytes_out) / 20000));
  EXPECT_LE(orders.worst_gap, 50000u);
  EXPECT_GE(orders.least_rate, 5980);
  EXPECT_GT(slowest, 0u);
  expect_one_history(orders.match);
  const CommandState& state = orders.match.host().game->world;
  EXPECT_EQ(state.out_of_turn, 0u);
  EXPECT_GE(state.orders, static_cast<std::uint32_t>(players) * 12);
}

/// A trouble of an order on its way.
struct Trouble {
  const char* name;
  const char* line;
  Frame deadline;
  Frame history;  // [frames] short: who was cut off comes back by a snapshot
};
constexpr Trouble kTroubles[] = {{"cuts", "mobile", 0, 7200},
                                 {"cuts_and_snapshots", "mobile", 0, 200},
                                 {"deadline", "latency=40,jitter=40,loss=10", 4, 7200}};

class OrdersInTrouble : public testing::TestWithParam<std::tuple<SessionMode, int>> {};
INSTANTIATE_TEST_SUITE_P(Troubles, OrdersInTrouble,
                         testing::Combine(testing::Values(SessionMode::lockstep, SessionMode::rollback),
                                          testing::Range(0, 3)));

TEST_P(OrdersInTrouble, ArriveWholeOnceAndInTurn) {
  const Trouble& trouble = kTroubles[std::get<1>(GetParam())];
  SCOPED_TRACE(trouble.name);
  SessionConfig config = config_of(3, std::get<0>(GetParam()));
  config.deadline = trouble.deadline;
  config.history = trouble.history;
  config.patience = 10 * kSecond;  // who is never there for a second gives no large orders
  config.exclusion = 2 * kSecond;
  OrdersMatch orders(config, trouble.line);
  std::vector<std::uint8_t> file;
  MachineRecorder<Commanders> recorder(orders.match.host(), file);
  const auto record = orders.match.host().was_confirmed;
  orders.match.host().was_confirmed = [&](Frame frame, std::uint64_t hash) {
    orders.senders[0]->confirmed(frame, hash);
    record(frame, hash);
  };
  for (std::size_t i = 1; i < 3; ++i) orders.match.machine(i).returns = true;
  orders.match.run(3 * kSecond, [] { return false; });
  for (int n = 0; n < 12; ++n) {
    for (std::size_t i = 0; i < 3; ++i) orders.give(i, 1 + orders.random.next() % kLargeOrderCap);
    orders.match.run(kSecond + orders.random.next() % kSecond, [] { return false; });
    if (trouble.deadline == 0 && n % 3 == 1) orders.match.network().cut(orders.match.machine(1 + n % 2).endpoint);
    if (trouble.deadline == 0 && n % 4 == 2) {  // for longer than it is waited for
      orders.match.machine(2).plays = false;
      const Time away = trouble.history > 200 ? 3 * kSecond : 6 * kSecond;
      orders.match.run(away, [] { return false; });
      orders.match.machine(2).plays = true;
    }
  }
  EXPECT_TRUE(orders.match.run(60 * kSecond, [&] {
    return orders.senders[0]->waiting() + orders.senders[1]->waiting() + orders.senders[2]->waiting() == 0;
  }));
  orders.match.run(2 * kSecond, [] { return false; });
  const Commanders& game = *orders.match.host().game;
  EXPECT_EQ(game.world.out_of_turn, 0u);
  EXPECT_EQ(game.world.orders, 36u) << "each once";
  std::uint64_t missed = 0;
  for (std::size_t p = 0; p < 3; ++p) missed += orders.match.host().session.stats().players[p].replaced;
  for (Frame f = 0; f < orders.match.host().end(); ++f) missed += orders.match.host().played(f, 2) ? 0 : 1;
  EXPECT_GT(missed, 10u) << "there were frames in which a piece could be lost";
  EXPECT_TRUE(trouble.history > 200 || orders.match.machine(2).restarts > 0) << "a snapshot was meant to come";
  expect_one_history(orders.match, true);
  ASSERT_TRUE(recorder.recorder.finish().ok());
  const Played<Commanders> played = play(config, file, Commanders{});
  EXPECT_TRUE(played.events.empty());
  EXPECT_EQ(played.hashes, orders.match.host().hashes);
}

}  // namespace large_orders_test
}  // namespace isostep::test
