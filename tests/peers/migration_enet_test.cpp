// A match over ENet that goes on without its host: what a game needs for it is dispatch() and an address.
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <memory>

#include "enet_machine.hpp"

namespace isostep::test {
namespace migration_enet_test {

using Kind = SessionEvent::Kind;

struct Machine : RememberingMachine {
  explicit Machine(int number) : RememberingMachine(patient_config(number, 3)) {}
};

TEST(MigrationOverEnet, TheMatchGoesOnWhenItsHostTakesNoTurnsAnyMore) {
  std::unique_ptr<Machine> machines[3];
  for (int number = 0; number < 3; ++number) machines[number] = std::make_unique<Machine>(number);
  for (const int client : {1, 2}) ASSERT_TRUE(machines[client]->connect_to(*machines[0]));
  const auto run = [&](int first, const auto& done) {
    for (const Time end = steady_now() + 600 * kSecond; steady_now() < end;) {
      for (int number = first; number < 3; ++number) machines[number]->turn(steady_now());
      if (done()) return true;
      machines[first]->port.wait(1000);
    }
    return false;
  };
  ASSERT_TRUE(
      run(0, [&] { return machines[1]->session.stats().machines + machines[2]->session.stats().machines == 6; }));
  ASSERT_TRUE(run(1, [&] { return machines[1]->count(Kind::new_host) > 0 && machines[2]->count(Kind::new_host) > 0; }));
  const Frame until = std::max(machines[1]->end(), machines[2]->end()) + 60;
  ASSERT_TRUE(run(1, [&] { return machines[1]->end() > until && machines[2]->end() > until; }));
  int hosts = 0;
  for (const int client : {1, 2}) {
    hosts += machines[client]->session.config().host ? 1 : 0;
    EXPECT_EQ(machines[client]->session.phase(), SessionPhase::playing);
    EXPECT_EQ(machines[client]->count(Kind::desync), 0);
  }
  EXPECT_EQ(hosts, 1);
  for (Frame frame = 0; frame <= until; ++frame) {
    ASSERT_EQ(machines[1]->hashes.at(frame), machines[2]->hashes.at(frame)) << frame;
  }

  // The old host comes back to life, learns that it is alone, and is a player of the match that went on.
  ASSERT_TRUE(run(0, [&] {
    return !machines[0]->session.config().host && machines[0]->session.phase() == SessionPhase::playing &&
           machines[0]->end() > until;
  }));
  EXPECT_EQ(machines[0]->count(Kind::desync), 0);
}

}  // namespace migration_enet_test
}  // namespace isostep::test
