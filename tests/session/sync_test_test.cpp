// The sync test: passes a game whose state is whole at every depth, and finds what a game forgets, in the right frame.
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <map>

#include "isostep/state/composite.hpp"
#include "isostep/store/state.hpp"
#include "sample.hpp"
#include "scenes/match.hpp"
#include "session/match_checks.hpp"
#include "session/toy_game.hpp"

namespace isostep::test {
namespace sync_test_test {

constexpr Time kPeriod = kSecond / 60 + 1;

SessionConfig config_of(Frame depth, int players = 2) {
  SessionConfig config;
  config.mode = SessionMode::sync_test;
  config.players = players;
  config.window = depth;
  return config;
}

/// The states of frames when they were stepped first, and when they were stepped last.
struct Watcher {
  struct Seen {
    int times = 0;
    int made_first = 0, made_last = 0;
  };
  std::map<Frame, Seen> frames;
  std::vector<std::uint64_t> hashes;
  int rollbacks = 0;

  void rolled_back(Frame) { ++rollbacks; }
  void confirmed(Frame, std::uint64_t hash) { hashes.push_back(hash); }
  template <class Game> void stepped(const Game& game, Frame frame) {
    int made = 0;
    for (const scenes::MatchEvent& event : game.events()) {
      made += event.kind == scenes::MatchEventKind::spawn || event.kind == scenes::MatchEventKind::vanish ? 1 : 0;
    }
    Seen& seen = frames[frame];
    if (seen.times++ == 0) seen.made_first = made;
    seen.made_last = made;
  }
};
template <class Game> struct Observer {
  Watcher& watcher;
  Game& game;
  void rolled_back(Frame frame) { watcher.rolled_back(frame); }
  void confirmed(Frame frame, std::uint64_t hash) { watcher.confirmed(frame, hash); }
  void after_step(Frame frame) { watcher.stepped(game, frame); }
};

template <class S> class SyncTest : public testing::Test {};
using Scalars = testing::Types<float, double, Q16_16, Q32_32>;
TYPED_TEST_SUITE(SyncTest, Scalars);

TYPED_TEST(SyncTest, AgreesAtEveryDepthWhereBodiesTouchAreMadeAndDestroyed) {
  using Game = scenes::Match<TypeParam>;
  constexpr Frame kFrames = 300;
  int remade = 0;
  for (Frame depth = 1; depth <= 16; depth += sampled(1, 5)) {
    SCOPED_TRACE(depth);
    const scenes::MatchSettings settings = {.players = 3, .pile = 40, .seed = 7, .substeps = 2};
    const auto bot = [depth](int player, Frame frame) {
      return scenes::bot_input(static_cast<std::uint64_t>(depth), player, frame);
    };
    Session<Game> session(config_of(depth, 3));
    Game game(settings);
    Watcher watcher;
    std::size_t contacts = 0;
    for (Time now = 0; session.current() < kFrames; now += kPeriod) {
      for (int p = 0; p < 3; ++p) session.add_local_input(p, bot(p, session.current()));
      drive(session, game, now, Observer<Game>{watcher, game});
      contacts += game.world().state().contacts.size();
    }
    while (const std::optional<SessionEvent> event = session.poll_event()) {
      EXPECT_NE(event->kind, SessionEvent::Kind::desync) << event->frame;
      EXPECT_NE(event->kind, SessionEvent::Kind::unhashed) << "byte " << event->ours;
    }
    EXPECT_GT(contacts / kFrames, 50u) << "nothing touches";
    EXPECT_GT(session.stats().rollbacks[depth], 20u) << "guesses were never wrong";
    for (const auto& [frame, seen] : watcher.frames) {
      if (frame > 0 && frame < kFrames - depth) {
        ASSERT_GT(seen.times, depth);
      }
      remade += seen.made_first != seen.made_last ? 1 : 0;
    }

    // Nothing is left behind by frames that were stepped again: the states are those of a game that never went back.
    Game alone(settings);
    int made = 0;
    for (Frame frame = 0; frame < static_cast<Frame>(watcher.hashes.size()); ++frame) {
      const scenes::MatchInput values[] = {bot(0, frame), bot(1, frame), bot(2, frame)};
      const InputStatus statuses[3] = {};
      alone.step({values, statuses});
      made += static_cast<int>(alone.events().size());
      ASSERT_EQ(watcher.hashes[static_cast<std::size_t>(frame)], alone.hash()) << frame;
    }
    EXPECT_EQ(watcher.hashes.size(), static_cast<std::size_t>(kFrames - depth));
    EXPECT_GT(made, 0);
  }
  EXPECT_GT(remade, 16) << "no body was made or destroyed in a frame that was guessed wrong";
}

// --- games that forget ---

constexpr std::uint64_t kFlaw = 100;  // [frames] the first whose outcome depends on what is forgotten

/// A member beside the state.
struct ForgetsAMember : Toy {
  std::uint64_t calls = 0;
  void step(InputView<ToyInput> inputs) {
    ++calls;
    if (state.tick == kFlaw) state.places[0] += calls;
    Toy::step(inputs);
  }
};
/// A counter outside of the game.
struct CountsOutside : Toy {
  static inline std::uint64_t calls = 0;
  void step(InputView<ToyInput> inputs) {
    ++calls;
    if (state.tick == kFlaw) state.places[0] += calls;
    Toy::step(inputs);
  }
};
/// Its sum is saved, and not loaded.
struct ForgetsToLoad : Toy {
  struct Snapshot {
    Toy::Snapshot toy;
    std::uint64_t sum = 0;
  };
  std::uint64_t sum = 0;
  void step(InputView<ToyInput> inputs) {
    sum += std::uint64_t{inputs[0].word} | 1u;
    if (state.tick == kFlaw) state.places[0] += sum;
    Toy::step(inputs);
  }
  void save(Snapshot& to) const {
    Toy::save(to.toy);
    to.sum = sum;
  }
  void load(const Snapshot& from) { Toy::load(from.toy); }
};
/// Acts on whether an input is a guess.
struct ReadsPredictions : Toy {
  void step(InputView<ToyInput> inputs) {
    if (state.tick == kFlaw && inputs.status(0) == InputStatus::predicted) state.places[0] += 1;
    Toy::step(inputs);
  }
};
/// Its bonus is saved, loaded and written, and not hashed.
struct HidesFromItsHash : Toy {
  struct Snapshot {
    Toy::Snapshot toy;
    std::uint64_t bonus = 0;
  };
  std::uint64_t bonus = 0;
  void step(InputView<ToyInput> inputs) {
    bonus += inputs[0].word;
    Toy::step(inputs);
  }
  void save(Snapshot& to) const {
    Toy::save(to.toy);
    to.bonus = bonus;
  }
  void load(const Snapshot& from) {
    Toy::load(from.toy);
    bonus = from.bonus;
  }
  void write_portable(Writer& writer) const {
    Toy::write_portable(writer);
    writer.write(bonus);
  }
  Result<void> read_portable(Reader& reader) {
    Result<void> read = Toy::read_portable(reader);
    if (read) reader.read(bonus);
    return reader.result("game");
  }
};
struct Pushes {
  std::uint32_t count = 0;
  ISO_FIELDS(count)
};
/// A game as the page of sessions shows it, which counts in its state or, forgetfully, in a member beside it.
template <bool kForgets> struct CountingGame : Composite<World<Q16_16>, Pushes> {
  using Input = ToyInput;
  BodyId ball;
  Pushes beside;

  CountingGame() {
    const ShapeId shape = world.add_shape(Sphere<Q16_16>{Q16_16(0.5)});
    ball = world.create({.type = BodyType::dynamic, .shape = shape});
  }
  void step(InputView<ToyInput>) {
    const std::uint32_t pushes = ++(kForgets ? beside : user).count;
    const bool is_flaw = world.tick() == kFlaw;
    if (is_flaw && pushes % 2 == 1) world.apply_impulse(ball, {Q16_16(1), Q16_16(0), Q16_16(0)});
    world.step();
  }
};

/// The flaws that the session tells.
template <class Game>
std::vector<SessionEvent> flaws_of(Frame depth, Frame frames, SessionEvent::Kind kind = SessionEvent::Kind::desync) {
  Session<Game> session(config_of(depth));
  Game game;
  std::vector<SessionEvent> flaws;
  for (Time now = 0; session.current() < frames; now += kPeriod) {
    for (int p = 0; p < 2; ++p) session.add_local_input(p, toy_input(2, p, session.current()));
    drive(session, game, now);
    while (const std::optional<SessionEvent> event = session.poll_event()) {
      if (event->kind == kind) flaws.push_back(*event);
    }
  }
  return flaws;
}

template <class Game> class SyncTestOfAFlaw : public testing::Test {};
using Flawed = testing::Types<ForgetsAMember, CountsOutside, ForgetsToLoad, ReadsPredictions>;
TYPED_TEST_SUITE(SyncTestOfAFlaw, Flawed);

TYPED_TEST(SyncTestOfAFlaw, NamesTheFirstStateThatComesOutOtherwise) {
  for (const Frame depth : {1, 2, 3, 8, 16}) {
    SCOPED_TRACE(depth);
    const std::vector<SessionEvent> flaws = flaws_of<TypeParam>(depth, 140);
    ASSERT_FALSE(flaws.empty());
    EXPECT_EQ(flaws[0].frame, static_cast<Frame>(kFlaw) + 1);
    EXPECT_EQ(flaws[0].agreed, static_cast<Frame>(kFlaw));
    EXPECT_NE(flaws[0].ours, flaws[0].theirs);
    EXPECT_TRUE(flaws_of<TypeParam>(depth, kFlaw).empty()) << "told before it had an effect";
  }
}

TEST(SyncTestOfAWorld, FindsUserStateThatIsNotSavedWithIt) {
  for (const Frame depth : {1, 3}) {  // an odd number of steps more: the push comes the other time
    SCOPED_TRACE(depth);
    const std::vector<SessionEvent> flaws = flaws_of<CountingGame<true>>(depth, 140);
    ASSERT_FALSE(flaws.empty());
    EXPECT_EQ(flaws[0].frame, static_cast<Frame>(kFlaw) + 1);
    EXPECT_EQ(flaws[0].agreed, static_cast<Frame>(kFlaw));
    EXPECT_TRUE(flaws_of<CountingGame<false>>(depth, 140).empty()) << "the same game, with its count in its state";
  }
}

TEST(SyncTestOfAHash, FindsWhatIsSavedAndNotHashed) {
  const std::vector<SessionEvent> flaws = flaws_of<HidesFromItsHash>(3, 60, SessionEvent::Kind::unhashed);
  ASSERT_EQ(flaws.size(), 1u) << "told once";
  Toy toy;  // as that of the state in which it was found
  const std::vector<ToyInput> inputs(2);
  const std::vector<InputStatus> statuses(2, InputStatus::confirmed);
  if (flaws[0].frame > 0) toy.step({inputs, statuses});
  std::vector<std::uint8_t> own;
  Writer writer(own);
  toy.write_portable(writer);
  EXPECT_GE(flaws[0].ours, own.size()) << "the toy's own state is hashed";
  EXPECT_LT(flaws[0].ours, own.size() + sizeof(std::uint64_t));
  EXPECT_TRUE(flaws_of<HidesFromItsHash>(3, 60).empty()) << "to look must not disturb the game";
}

TEST(SyncTestOfAWorld, FindsNothingInAWholeGame) {
  EXPECT_TRUE(flaws_of<Toy>(8, 600).empty());
  EXPECT_TRUE(flaws_of<Toy>(8, 600, SessionEvent::Kind::unhashed).empty());
}

}  // namespace sync_test_test
}  // namespace isostep::test
