// Four players with a car and a walker each in the town, over bad lines: one history.
// ISOSTEP_STREET_FRAMES=36000 plays ten minutes; without it ten seconds are.
// SPDX-License-Identifier: MIT
#include "scenes/street.hpp"

#include <gtest/gtest.h>

#include "isostep/replay/recorder.hpp"
#include "isostep/state/composite.hpp"
#include "random/asked.hpp"
#include "scenes/build.hpp"
#include "scenes/named.hpp"
#include "session/match_checks.hpp"

namespace isostep::test {
namespace street_test {

struct Fallen {
  std::uint32_t jumps = 0;
  ISO_FIELDS(jumps)
};
template <class S> struct StreetGame : Composite<World<S>, Fallen> {
  using Input = scenes::StreetInput;

  StreetGame() : Composite<World<S>, Fallen>{World<S>(scenes::settings_of<S>(scene())), {}} {
    scenes::build(scene(), this->world);
  }
  void step(InputView<Input> inputs) {
    scenes::StreetInput all[scenes::kStreetPlayers];
    for (int n = 0; n < scenes::kStreetPlayers; ++n) {
      if (inputs.status(n) != InputStatus::disconnected) all[n] = inputs[n];
      this->user.jumps += (all[n].buttons & 1) != 0 ? 1 : 0;
    }
    scenes::play_street<S>(this->world, all);
    this->world.step();
  }
  static const scenes::Scene& scene() {
    static const scenes::Scene made = *scenes::find_scene("street");
    return made;
  }
};

template <class S> class Street : public testing::Test {};
using Scalars = testing::Types<float, Q32_32>;
TYPED_TEST_SUITE(Street, Scalars);

TYPED_TEST(Street, of_four_cars_and_four_walkers_is_one_history_over_bad_lines) {
  using S = TypeParam;
  const auto frames = static_cast<Frame>(asked("ISOSTEP_STREET_FRAMES", 600));
  SessionConfig config;
  config.players = scenes::kStreetPlayers;
  config.mode = SessionMode::rollback;
  config.identity = make_replay_header(identity_of_world(StreetGame<S>().world.settings(), "street")).value();
  VirtualMatch<StreetGame<S>> match(
      config, [] { return std::make_unique<StreetGame<S>>(); },
      [](int player, Frame frame) { return scenes::street_bot(player, frame); });
  for (int n = 1; n < scenes::kStreetPlayers; ++n)
    match.add(transport::parse_profile("latency=75,jitter=20,loss=5").value());
  ASSERT_TRUE(match.run_to(frames, (frames / 60 + 20) * kSecond));
  expect_one_history(match);
  std::uint64_t again = 0;  // steps of all that were taken once more
  for (std::size_t i = 0; i < match.size(); ++i) again += match.machine(i).session.stats().steps - frames;
  EXPECT_GT(again, 200u);
  // Something happened: cars drove, walkers walked.
  const World<S>& world = match.host().game->world;
  double furthest = 0;
  StreetGame<S> start;
  for (const BodyId id : world.bodies()) {
    if (world.type(id) == BodyType::static_) continue;
    const auto way = world.center_of_mass(id) - start.world.center_of_mass(id);
    furthest = std::max(furthest, std::abs(to_double(way.x)) + std::abs(to_double(way.z)));
  }
  EXPECT_GT(furthest, 3.0);
}

}  // namespace street_test
}  // namespace isostep::test
