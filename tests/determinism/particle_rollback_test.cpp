// Rollback of particles is exact: whatever was commanded, a world that is loaded has the future of one that never was.
// SPDX-License-Identifier: MIT
#include <algorithm>

#include "determinism/particle_mess.hpp"
#include "sample.hpp"

namespace isostep::test {
namespace particle_rollback_test {

template <class S> class ParticleRollback : public ::testing::Test {
 protected:
  using Snapshot = typename ParticleWorld<S>::Snapshot;
};
TYPED_TEST_SUITE(ParticleRollback, AllScalars);

TYPED_TEST(ParticleRollback, from_every_frame_of_a_hail_of_commands_ten_frames_come_out_the_same_twice) {
  using S = TypeParam;
  for (const std::uint32_t way : {1u, 4u, 7u, 13u}) {
    ParticleWorld<S> w(settings_of_way<S>(way));
    build_particle_mess(w);
    typename ParticleWorld<S>::Snapshot snapshot;
    ParticleActivity activity;
    for (std::uint64_t frame = 0; frame < 100; ++frame) {
      if (!wants_whole() && frame % 4 != 0) {  // a sample goes back from every fourth
        play(w, frame, &activity);
        continue;
      }
      w.save(snapshot);
      const std::uint64_t saved = w.hash();
      const std::vector<std::uint64_t> first = play_on(w, frame, 10);
      w.load(snapshot);
      ASSERT_EQ(w.hash(), saved) << "way " << way << " frame " << frame;
      if (frame % 3 == 0) {
        ASSERT_EQ(play_on(w, frame, 10), first) << "way " << way << " frame " << frame;
        w.load(snapshot);
      }
      ASSERT_EQ(play(w, frame, &activity), first[0]) << "way " << way << " frame " << frame;
    }
    activity.expect_busy();
  }
}

TYPED_TEST(ParticleRollback, a_snapshot_continues_equal_in_a_world_with_another_past) {
  using S = TypeParam;
  for (std::uint32_t way = 0; way < kParticleWays; ++way) {
    ParticleWorld<S> w(settings_of_way<S>(way)), dirty(settings_of_way<S>(way)), fresh(settings_of_way<S>(way));
    build_particle_mess(w);
    build_particle_mess(dirty);
    play_on(dirty, 1000, 60);
    typename ParticleWorld<S>::Snapshot snapshot;
    for (std::uint64_t frame = 0; frame < 60; frame += 20) {
      w.save(snapshot);
      dirty.load(snapshot);
      fresh.load(snapshot);
      ASSERT_EQ(dirty.hash(), w.hash());
      const std::vector<std::uint64_t> expected = play_on(w, frame, 20);
      ASSERT_EQ(play_on(dirty, frame, 20), expected) << "way " << way << " frame " << frame;
      ASSERT_EQ(play_on(fresh, frame, 20), expected) << "way " << way << " frame " << frame;
      ASSERT_TRUE(bytes_of(dirty) == bytes_of(w));
      play_on(dirty, 5000 + frame, 10);
    }
    EXPECT_GT(w.counts().contacts, 0u);
  }
}

TYPED_TEST(ParticleRollback, the_portable_form_rebuilt_in_a_new_world_continues_equal) {
  using S = TypeParam;
  for (std::uint32_t way = 0; way < kParticleWays; ++way) {
    ParticleWorld<S> w(settings_of_way<S>(way));
    const ParticleMess m = build_particle_mess(w);
    play_on(w, 0, 50);
    ASSERT_GT(w.counts().contacts, 0u) << "the form must carry contacts";
    ASSERT_FALSE(w.state().lifetimes.empty());
    ASSERT_TRUE(w.apply_force(w.particles()[2], vec<S>(1, 2, 3))) << describe(w.fault());
    ParticleTouch<S> touch = {};
    touch.particle = w.particles()[5];
    touch.normal.y = Unit<S>(-1);
    ASSERT_TRUE(w.touch(touch));
    const std::vector<std::uint8_t> bytes = bytes_of(w);
    ParticleWorld<S> rebuilt;
    build_particle_mess(rebuilt);
    Reader reader(bytes);
    ASSERT_TRUE(rebuilt.read_portable(reader).ok());
    EXPECT_EQ(reader.remaining(), 0u);
    ASSERT_EQ(rebuilt.hash(), w.hash());
    EXPECT_TRUE(bytes_of(rebuilt) == bytes);
    ASSERT_EQ(play_on(rebuilt, 50, 40), play_on(w, 50, 40)) << "way " << way;
    EXPECT_EQ(rebuilt.contains(m.balls[0]), w.contains(m.balls[0])) << "ids are state";
  }
}

TYPED_TEST(ParticleRollback, a_command_log_replays_to_equal_hashes) {
  using S = TypeParam;
  for (const std::uint32_t way : {1u, 9u, 12u}) {
    ParticleWorld<S> w(settings_of_way<S>(way)), replayed(settings_of_way<S>(way));
    std::vector<std::uint8_t> log;
    w.record_to(&log);
    EXPECT_TRUE(w.records_to(&log));
    build_particle_mess(w);
    std::size_t recorded = 0;
    for (std::uint64_t frame = 0; frame < 100; ++frame) {
      const std::uint64_t hash = play(w, frame);
      ASSERT_TRUE(replayed.step_recorded(log).ok()) << frame;
      ASSERT_EQ(replayed.hash(), hash) << "way " << way << " frame " << frame;
      recorded += log.size();
      log.clear();
    }
    EXPECT_GT(recorded, 10000u);
    EXPECT_GT(w.counts().contacts, 0u);
  }
}

TYPED_TEST(ParticleRollback, two_snapshots_taken_in_turn_do_not_disturb_one_another) {
  using S = TypeParam;
  ParticleWorld<S> a(settings_of_way<S>(1)), b(settings_of_way<S>(1));
  build_particle_mess(a);
  build_particle_mess(b);
  play_on(a, 0, 40);
  play_on(b, 700, 40);
  typename ParticleWorld<S>::Snapshot of_a, of_b;
  a.save(of_a);
  b.save(of_b);
  const std::vector<std::uint64_t> future_a = play_on(a, 40, 20), future_b = play_on(b, 740, 20);
  EXPECT_NE(future_a, future_b);
  ParticleWorld<S> other(settings_of_way<S>(1));
  for (int round = 0; round < 3; ++round) {
    EXPECT_TRUE(other.load(of_a));
    EXPECT_EQ(play_on(other, 40, 20), future_a);
    EXPECT_TRUE(other.load(of_b));
    EXPECT_EQ(play_on(other, 740, 20), future_b);
    std::swap(round % 2 == 0 ? a : b, other);
  }
}

TYPED_TEST(ParticleRollback, snapshots_of_nothing_or_of_other_settings_are_refused) {
  using S = TypeParam;
  ParticleWorld<S> w(settings_of_way<S>(1));
  build_particle_mess(w);
  play_on(w, 0, 10);
  typename ParticleWorld<S>::Snapshot saved;
  w.save(saved);
  EXPECT_GT(saved.bytes(), w.counts().particles * sizeof(S) * 6);
  const std::uint64_t hash = w.hash();
  typename ParticleWorld<S>::Snapshot moved = std::move(saved);
  play_on(w, 10, 5);
  const std::uint64_t later = w.hash();
  const auto expect_refused = [&](const auto& snapshot) {
    const std::uint64_t loads = w.loads();
    EXPECT_FALSE(w.load(snapshot));
    EXPECT_EQ(w.fault(), Fault::bad_snapshot);
    EXPECT_STREQ(w.fault().command, "load");
    EXPECT_EQ(w.hash(), later);
    EXPECT_EQ(w.loads(), loads);
  };
  expect_refused(saved);  // moved from
  expect_refused(typename ParticleWorld<S>::Snapshot());
  typename ParticleWorld<S>::Snapshot of_other;
  ParticleWorld<S>(settings_of_way<S>(8)).save(of_other);
  expect_refused(of_other);
  EXPECT_TRUE(w.load(moved));
  EXPECT_EQ(w.hash(), hash);
  EXPECT_TRUE(w.set_gravity(vec<S>(0, -1, 0)));
  EXPECT_TRUE(w.load(moved)) << "gravity may differ";
  EXPECT_EQ(w.hash(), hash);
}

TYPED_TEST(ParticleRollback, loading_empties_events_and_keeps_lanes_and_command_log) {
  using S = TypeParam;
  ParticleWorld<S> w(settings_of_way<S>(1));
  build_particle_mess(w);
  std::vector<std::uint8_t> log;
  w.record_to(&log);
  ASSERT_TRUE(w.use_simd(Simd::scalar));
  typename ParticleWorld<S>::Snapshot snapshot;
  w.save(snapshot);
  std::uint64_t frame = 0;
  while (w.events().contact_begin.empty() && frame < 60) play(w, frame++);
  ASSERT_FALSE(w.events().contact_begin.empty());
  const std::uint64_t loads = w.loads();
  w.load(snapshot);
  EXPECT_EQ(w.loads(), loads + 1);
  EXPECT_TRUE(w.events().contact_begin.empty() && w.events().expired.empty() && w.events().yielded.empty() &&
              w.events().touch_impulses.empty());
  EXPECT_STREQ(w.simd_name(), "scalar");
  const std::size_t before = log.size();
  EXPECT_TRUE(w.set_gravity(vec<S>(0, -9, 0)));
  EXPECT_GT(log.size(), before);
}

TYPED_TEST(ParticleRollback, a_trace_names_every_stage_of_a_step_and_is_the_same_again) {
  using S = TypeParam;
  ParticleWorld<S> w(settings_of_way<S>(1));
  build_particle_mess(w);
  play_on(w, 0, 40);
  typename ParticleWorld<S>::Snapshot snapshot;
  w.save(snapshot);
  std::vector<std::uint64_t> trace, again;
  std::vector<ParticleStage> stages;
  ParticleStageObserver observer;
  observer.user = &stages;
  observer.after = [](void* user, ParticleStage stage, const StageView&) {
    static_cast<std::vector<ParticleStage>*>(user)->push_back(stage);
  };
  w.trace_to(&trace);
  w.step(observer);
  w.trace_to(&again);
  w.load(snapshot);
  w.step();
  w.trace_to(nullptr);
  ASSERT_EQ(trace.size(), kParticleStages + 1u);
  EXPECT_EQ(again, trace);
  EXPECT_EQ(trace.back(), w.hash());
  EXPECT_NE(trace[0], trace[2]) << "the sub-steps move things";
  ASSERT_EQ(stages.size(), kParticleStages);
  for (std::uint32_t i = 0; i < kParticleStages; ++i) EXPECT_EQ(static_cast<std::uint32_t>(stages[i]), i);
}

}  // namespace particle_rollback_test
}  // namespace isostep::test
