// A ball that a player at the other end of a slow line kicks, and the floor that it hits.
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <array>

#include "event_log_ledger.hpp"
#include "isostep/state/concepts.hpp"
#include "isostep/world/world.hpp"

namespace isostep {
namespace event_log_ball_test {

struct Touch {
  BodyId a, b;
  float impulse;
  friend bool operator==(const Touch& x, const Touch& y) { return x.a == y.a && x.b == y.b; }
};

struct Court {
  World<float> world{{.gravity = {0, -10, 0}}};
  BodyId ball;

  Court() {
    world.create({.shape = world.add_shape(HalfSpace<float>{{0, 1, 0}, 0})});
    BodyDefinition<float> definition{.type = BodyType::dynamic, .shape = world.add_shape(Sphere{0.5})};
    definition.position = {0, 2, 0};
    definition.material.restitution = 0.6f;
    definition.report_contacts = true;
    ball = world.create(definition);
  }
  template <class Emit> void step(int kick, Emit&& emit) {
    world.apply_impulse(ball, {0, static_cast<float>(kick) * world.mass(ball), 0});
    world.step();
    for (const ContactBegin<float>& touch : world.events().contact_begin) emit({touch.a, touch.b, touch.impulse});
  }
};
/// The ball is kicked up, left alone, pushed down, in turns that no frame rate divides.
int kick_at(Frame frame) { return frame % 7 == 0 ? (frame / 7 * 5 + frame / 49) % 9 - 4 : 0; }

TEST(EventLog, ABallThatIsRolledBackHitsTheFloorAsOftenAsInAStraightRun) {
  constexpr Frame kFrames = 1500, kLate = 6;
  std::vector<std::pair<Frame, Touch>> straight;
  Court court;
  for (Frame frame = 0; frame < kFrames; ++frame) {
    court.step(kick_at(frame), [&](const Touch& touch) { straight.push_back({frame, touch}); });
  }
  ASSERT_GT(straight.size(), 20u);

  // Kicks arrive kLate frames late and are predicted as none.
  Court client;
  EventLog<Touch> log;
  Ledger<Touch> ledger;
  std::array<Snapshot<World<float>>, kLate + 1> saved;
  std::size_t emitted = 0;
  const auto advance = [&](Frame frame, int kick) {
    client.world.save(saved[static_cast<std::size_t>(frame) % saved.size()]);
    log.before_step(frame);
    client.step(kick, [&](const Touch& touch) { emitted += log.tell(touch); });
    log.after_step(frame);
  };
  for (Frame frame = 0; frame < kFrames + kLate; ++frame) {
    const Frame known = frame - kLate;
    if (known >= 0 && kick_at(known) != 0) {
      client.world.load(saved[static_cast<std::size_t>(known) % saved.size()]);
      log.rolled_back(known);
      for (Frame past = known; past < frame; ++past) advance(past, past == known ? kick_at(past) : 0);
    }
    advance(frame, 0);
    if (known >= 0) log.confirmed(known, 0);
    ledger.take(log);
  }
  log.finish();
  ledger.take(log);
  ledger.expect_lives();

  ASSERT_EQ(ledger.confirmed.size(), straight.size());
  for (std::size_t i = 0; i < straight.size(); ++i) {
    EXPECT_EQ(ledger.confirmed[i].first, straight[i].first);
    EXPECT_EQ(ledger.confirmed[i].second, straight[i].second);
    EXPECT_EQ(ledger.confirmed[i].second.impulse, straight[i].second.impulse);
  }
  EXPECT_EQ(ledger.played, straight.size() + ledger.taken_back);
  EXPECT_GT(emitted, ledger.played) << "no contact was stepped twice: the test shows nothing";
  EXPECT_GT(ledger.moved, 0u) << "no contact moved: the test shows nothing";
  EXPECT_GT(ledger.taken_back, 0u) << "no contact was foreseen wrongly: the test shows nothing";
}

}  // namespace event_log_ball_test
}  // namespace isostep
