// Seeking in a replay of a world: the state of any frame, what going back costs, and stored states that lie.
// SPDX-License-Identifier: MIT
#include "isostep/replay/recorder.hpp"
#include "isostep/state/replay_seek.hpp"
#include "played_session.hpp"

namespace isostep::test {
namespace seek_test {

constexpr Frame kFrames = 600;

/// A world that counts its steps.
template <class S> struct Counting {
  using Snapshot = typename World<S>::Snapshot;
  World<S> world;
  std::uint64_t steps = 0;

  void save(Snapshot& to) const { world.save(to); }
  void load(const Snapshot& from) { world.load(from); }
  std::uint64_t hash() const { return world.hash(); }
  void write_portable(Writer& writer) const { world.write_portable(writer); }
  Result<void> read_portable(Reader& reader) { return world.read_portable(reader); }
  Result<void> step_recorded(Bytes commands) {
    ++steps;
    return world.step_recorded(commands);
  }
};

template <class S> class Seeking : public ::testing::Test {
 protected:
  /// Every hundredth frame with a stored state, right but for its place: all are that of frame 1.
  Seeking() {
    Arena<S> arena;
    Recorder<World<S>> recorder(sink_to(file));
    bool ok =
        recorder.begin(arena.world, make_replay_header(identity_of_world(arena.world.settings(), "a")).value()).ok();
    std::vector<std::uint8_t> log;
    World<S> lie;
    arena.world.record_to(&log);
    for (Frame frame = 0; frame < kFrames; ++frame) {
      log.clear();
      play_frame(arena, frame, input_of(frame));
      hashes.push_back(arena.world.hash());
      ok = recorder.frame(log, hashes.back()).ok() && ok;
      if (frame % 100 == 99) ok = recorder.keyframe(lie).ok() && ok;
    }
    EXPECT_TRUE(recorder.finish().ok() && ok);
  }

  std::vector<std::uint8_t> file;
  std::vector<std::uint64_t> hashes;  // after each frame
  Counting<S> sim;
};
TYPED_TEST_SUITE(Seeking, AllScalars);

TYPED_TEST(Seeking, any_order_of_frames_gives_the_states_that_playing_gave) {
  const ReplayReader replay(this->file);
  ASSERT_EQ(replay.keyframes().size(), 6u);
  ReplaySeeker<Counting<TypeParam>> seeker(replay, this->sim);
  for (const std::uint64_t frame : {300u, 299u, 1u, 600u, 0u, 100u, 101u, 599u, 200u, 314u, 315u, 316u, 500u}) {
    ASSERT_TRUE(seeker.seek(frame).ok()) << frame;
    EXPECT_EQ(seeker.position(), frame);
    EXPECT_EQ(this->sim.hash(), frame == 0 ? replay.state_hash() : this->hashes[frame - 1]) << frame;
    EXPECT_TRUE(seeker.agrees());
  }
}

TYPED_TEST(Seeking, going_back_costs_less_than_one_spacing_of_steps) {
  const ReplayReader replay(this->file);
  ReplaySeeker<Counting<TypeParam>> seeker(replay, this->sim, {.states = 16, .spacing = 5});
  ASSERT_TRUE(seeker.seek(kFrames).ok());
  EXPECT_EQ(this->sim.steps, static_cast<std::uint64_t>(kFrames));
  EXPECT_LE(seeker.states(), 16u);
  // 5 * 2^3 = 40 is the least spacing with at most 16 states: 0, 40 ... 600.
  EXPECT_EQ(seeker.spacing(), 40u);
  for (std::uint64_t frame = kFrames; frame-- > 0;) {
    const std::uint64_t before = this->sim.steps;
    ASSERT_TRUE(seeker.seek(frame).ok());
    ASSERT_EQ(this->sim.steps - before, frame % 40) << frame;
  }
}

TYPED_TEST(Seeking, going_forward_over_known_ground_jumps_too) {
  const ReplayReader replay(this->file);
  ReplaySeeker<Counting<TypeParam>> seeker(replay, this->sim, {.states = 1000, .spacing = 10});
  ASSERT_TRUE(seeker.seek(kFrames).ok());
  ASSERT_TRUE(seeker.seek(3).ok());
  const std::uint64_t before = this->sim.steps;
  ASSERT_TRUE(seeker.seek(407).ok());
  EXPECT_EQ(this->sim.steps - before, 7u);
  ASSERT_TRUE(seeker.seek(409).ok());
  EXPECT_EQ(this->sim.steps - before, 9u);
}

TYPED_TEST(Seeking, a_byte_budget_that_holds_one_state_keeps_the_start) {
  const ReplayReader replay(this->file);
  ReplaySeeker<World<TypeParam>> seeker(replay, this->sim.world, {.bytes = 1, .spacing = 1});
  for (const std::uint64_t frame : {90u, 45u, 120u}) {
    ASSERT_TRUE(seeker.seek(frame).ok());
    EXPECT_EQ(seeker.states(), 1u);
    EXPECT_TRUE(seeker.agrees());
  }
}

TYPED_TEST(Seeking, frames_past_the_end_are_refused_and_nothing_moves) {
  const ReplayReader replay(this->file);
  ReplaySeeker<World<TypeParam>> seeker(replay, this->sim.world);
  ASSERT_TRUE(seeker.seek(33).ok());
  EXPECT_FALSE(seeker.seek(kFrames + 1).ok());
  EXPECT_EQ(seeker.position(), 33u);
  EXPECT_TRUE(seeker.agrees());
}

TYPED_TEST(Seeking, a_frame_that_cannot_be_applied_stops_before_itself) {
  Arena<TypeParam> arena;
  std::vector<std::uint8_t> bad, log;
  Recorder<World<TypeParam>> recorder(sink_to(bad));
  const auto header = make_replay_header(identity_of_world(arena.world.settings(), "a")).value();
  ASSERT_TRUE(recorder.begin(arena.world, header).ok());
  arena.world.record_to(&log);
  std::vector<std::uint64_t> state_hashes;
  for (Frame frame = 0; frame < 30; ++frame) {
    log.clear();
    play_frame(arena, frame, input_of(frame));
    state_hashes.push_back(arena.world.hash());
    if (frame == 22) log.push_back(200);  // the number of no command
    ASSERT_TRUE(recorder.frame(log, state_hashes.back()).ok());
  }
  ASSERT_TRUE(recorder.finish().ok());
  const ReplayReader replay(bad);
  ReplaySeeker<World<TypeParam>> seeker(replay, this->sim.world, {.spacing = 10});
  EXPECT_FALSE(seeker.seek(29).ok());
  EXPECT_EQ(seeker.position(), 22u);
  EXPECT_EQ(this->sim.hash(), state_hashes[21]);
  ASSERT_TRUE(seeker.seek(7).ok());
  EXPECT_EQ(this->sim.hash(), state_hashes[6]);
}

TYPED_TEST(Seeking, a_recorded_hash_that_does_not_come_out_is_told) {
  Arena<TypeParam> arena;
  std::vector<std::uint8_t> bad, log;
  Recorder<World<TypeParam>> recorder(sink_to(bad));
  ASSERT_TRUE(
      recorder.begin(arena.world, make_replay_header(identity_of_world(arena.world.settings(), "a")).value()).ok());
  arena.world.record_to(&log);
  play_frame(arena, 0, 1);
  ASSERT_TRUE(recorder.frame(log, arena.world.hash() ^ 1).ok());
  ASSERT_TRUE(recorder.finish().ok());
  const ReplayReader replay(bad);
  ReplaySeeker<World<TypeParam>> seeker(replay, this->sim.world);
  ASSERT_TRUE(seeker.seek(0).ok());
  EXPECT_TRUE(seeker.agrees());
  ASSERT_TRUE(seeker.seek(1).ok());
  EXPECT_FALSE(seeker.agrees());
}

}  // namespace seek_test
}  // namespace isostep::test
