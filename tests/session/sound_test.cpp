// Sounds: what happened is told once on every peer, however often its frame was stepped.
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <map>

#include "isostep/session/observers/event_log.hpp"
#include "scenes/match.hpp"
#include "session/match_checks.hpp"

namespace isostep::test {
namespace sound_test {

using Game = scenes::Match<Q16_16>;
using scenes::MatchEvent;

/// The events that one machine's user heard.
struct Heard {
  EventLog<MatchEvent> log;
  std::vector<std::pair<Frame, MatchEvent>> confirmed;
  struct Story {
    int predicted = 0, confirmed = 0, retracted = 0, first = 0;
  };
  std::map<std::uint32_t, Story> stories;  // by happening

  void listen() {
    while (const std::optional<Notice<MatchEvent>> notice = log.poll()) {
      Story& story = stories[notice->happening];
      story.predicted += notice->kind == NoticeKind::predicted ? 1 : 0;
      story.confirmed += notice->kind == NoticeKind::confirmed ? 1 : 0;
      story.retracted += notice->kind == NoticeKind::retracted ? 1 : 0;
      story.first += notice->first ? 1 : 0;
      if (notice->kind == NoticeKind::confirmed) confirmed.emplace_back(notice->frame, notice->event);
    }
  }
};

class Sounds : public testing::TestWithParam<std::tuple<SessionMode, const char*>> {};
INSTANTIATE_TEST_SUITE_P(Lines, Sounds,
                         testing::Combine(testing::Values(SessionMode::rollback, SessionMode::lockstep),
                                          testing::Values("latency=60,jitter=20,loss=5", "severe")));

TEST_P(Sounds, PlayOncePerHappeningAndPeer) {
  const auto [mode, line] = GetParam();
  constexpr int kPlayers = 4;
  constexpr Frame kFrames = 1500;
  SessionConfig config;
  config.mode = mode;
  config.players = kPlayers;
  const scenes::MatchSettings settings = {.players = kPlayers, .pile = 8, .substeps = 2};
  VirtualMatch<Game> match(
      config, [&] { return std::make_unique<Game>(settings); },
      [](int player, Frame frame) { return scenes::bot_input(31, player, frame); });
  for (int p = 1; p < kPlayers; ++p) match.add(profile(line));
  std::vector<std::unique_ptr<Heard>> heard;
  for (std::size_t i = 0; i < match.size(); ++i) {
    heard.push_back(std::make_unique<Heard>());
    Heard& ear = *heard.back();
    Machine<Game>& machine = match.machine(i);
    machine.will_step = [&ear](Frame frame) { ear.log.before_step(frame); };
    machine.stepped = [&ear](const Game& game, Frame frame) {
      for (const MatchEvent& event : game.events()) ear.log.tell(event);
      ear.log.after_step(frame);
    };
    machine.went_back = [&ear](Frame frame) { ear.log.rolled_back(frame); };
    machine.was_confirmed = [&ear](Frame frame, std::uint64_t hash) { ear.log.confirmed(frame, hash); };
    machine.after_turn = [&ear] { ear.listen(); };
  }
  ASSERT_TRUE(match.run_to(kFrames, 120 * kSecond));
  expect_one_history(match);

  // What a run without any network emits.
  std::vector<std::pair<Frame, MatchEvent>> truth;
  const std::unique_ptr<Game> alone = std::make_unique<Game>(settings);
  for (Frame frame = 0; frame < kFrames; ++frame) {
    std::vector<scenes::MatchInput> values;
    std::vector<InputStatus> statuses;
    for (const auto& said : match.host().at(frame)) {
      values.push_back(said.input);
      statuses.push_back(said.absent ? InputStatus::disconnected : InputStatus::confirmed);
    }
    alone->step({values, statuses});
    for (const MatchEvent& event : alone->events()) truth.emplace_back(frame, event);
  }
  ASSERT_GT(truth.size(), 100u);

  std::size_t predicted = 0, retracted = 0;
  for (std::size_t i = 0; i < heard.size(); ++i) {
    SCOPED_TRACE(i);
    Heard& ear = *heard[i];
    ear.log.finish();
    ear.listen();
    EXPECT_EQ(ear.log.lost().crowded, 0u);
    EXPECT_EQ(ear.log.lost().homeless, 0u);
    std::erase_if(ear.confirmed, [](const auto& one) { return one.first >= kFrames; });
    EXPECT_EQ(ear.confirmed, truth);
    for (const auto& [happening, story] : ear.stories) {
      EXPECT_LE(story.predicted, 1);
      EXPECT_EQ(story.confirmed + story.retracted, 1) << "either it happened or not";
      EXPECT_EQ(story.first, 1) << "played once";
      EXPECT_LE(story.retracted, story.predicted) << "what was never told is not taken back";
      predicted += static_cast<std::size_t>(story.predicted);
      retracted += static_cast<std::size_t>(story.retracted);
    }
  }
  if (mode == SessionMode::rollback) {
    EXPECT_GT(predicted, truth.size());
    EXPECT_GT(retracted, 0u) << "nothing was mispredicted: the test tests nothing";
  } else {
    // A client may step a frame before the host has accepted its own input for it. It was wrong where that came late.
    EXPECT_LE(retracted, predicted / 16);
  }
}

}  // namespace sound_test
}  // namespace isostep::test
