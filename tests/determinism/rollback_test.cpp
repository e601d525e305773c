// Rollback is exact: whatever was commanded, a world saved and loaded has the future of one that never was.
// SPDX-License-Identifier: MIT

#include <algorithm>

#include "determinism/mess.hpp"
#include "sample.hpp"

namespace isostep::test {
namespace rollback_test {

template <class S> class Rollback : public ::testing::Test {
 protected:
  using Snapshot = typename World<S>::Snapshot;
  static std::vector<std::uint64_t> play_on(World<S>& w, std::uint64_t from, std::uint64_t count) {
    std::vector<std::uint64_t> hashes;
    for (std::uint64_t f = from; f < from + count; ++f) hashes.push_back(play(w, f));
    return hashes;
  }
};
TYPED_TEST_SUITE(Rollback, AllScalars);

TYPED_TEST(Rollback, from_every_frame_of_a_hail_of_commands_ten_frames_come_out_the_same_twice) {
  using S = TypeParam;
  World<S> w(settings<S>(-10, 60, 4));
  build_mess(w);
  typename World<S>::Snapshot snapshot;
  Activity activity;
  for (std::uint64_t frame = 0; frame < 600; ++frame) {
    if (!wants_whole() && frame % 4 != 0) {  // a sample goes back from every fourth
      play(w, frame, &activity);
      continue;
    }
    w.save(snapshot);
    const std::uint64_t saved = w.hash();
    const std::vector<std::uint64_t> first = this->play_on(w, frame, 10);
    w.load(snapshot);
    ASSERT_EQ(w.hash(), saved) << "frame " << frame;
    if (frame % 3 == 0) {
      ASSERT_EQ(this->play_on(w, frame, 10), first) << "frame " << frame;
      w.load(snapshot);
    }
    ASSERT_EQ(play(w, frame, &activity), first[0]) << "frame " << frame;
  }
  EXPECT_GT(activity.contacts, 40u);
  EXPECT_GT(activity.sleepers, 10u);
  EXPECT_GT(activity.woke, 10u);
  EXPECT_GT(activity.begins, 100u);
  EXPECT_GT(activity.sensed, 3u);
  EXPECT_GT(activity.joints, 6u);
  EXPECT_GT(activity.accepted, 250u);
  EXPECT_GT(activity.refused, 20u);
  EXPECT_GT(activity.spread, 3);
}

TYPED_TEST(Rollback, a_snapshot_continues_equal_in_a_world_with_another_past) {
  using S = TypeParam;
  World<S> w(settings<S>(-10, 60, 4)), dirty(settings<S>(-3, 60, 4)), fresh(settings<S>(0, 60, 4));
  build_mess(w);
  build_mess(dirty, {3, 1, -2});
  dirty.add_shape(Sphere<S>{S(3)});
  for (std::uint64_t f = 1000; f < 1150; ++f) play(dirty, f);
  typename World<S>::Snapshot snapshot;
  for (std::uint64_t frame = 0; frame < 400; frame += 40) {
    w.save(snapshot);
    dirty.load(snapshot);
    fresh.load(snapshot);
    ASSERT_EQ(dirty.hash(), w.hash());
    const std::vector<std::uint64_t> expected = this->play_on(w, frame, 40);
    ASSERT_EQ(this->play_on(dirty, frame, 40), expected) << frame;
    ASSERT_EQ(this->play_on(fresh, frame, 40), expected) << frame;
    ASSERT_EQ(bytes_of(dirty), bytes_of(w));
    for (std::uint64_t f = 5000 + frame; f < 5020 + frame; ++f) play(dirty, f);
  }
  EXPECT_GT(w.counts().contacts, 20u);
}

TYPED_TEST(Rollback, the_portable_form_rebuilt_in_a_new_world_continues_equal) {
  using S = TypeParam;
  World<S> w(settings<S>(-10, 60, 4));
  build_mess(w);
  this->play_on(w, 0, 280);
  ASSERT_GT(w.counts().asleep, 0u) << "the form must carry sleepers";
  ASSERT_GT(w.counts().joints, 0u);
  ASSERT_TRUE(w.apply_force(w.bodies()[2], vec<S>(1, 2, 3))) << describe(w.fault());
  const std::vector<std::uint8_t> bytes = bytes_of(w);
  World<S> rebuilt;
  build_mess(rebuilt, {5, 0, 0});
  Reader reader(bytes);
  ASSERT_TRUE(rebuilt.read_portable(reader).ok());
  EXPECT_EQ(reader.remaining(), 0u);
  ASSERT_EQ(rebuilt.hash(), w.hash());
  EXPECT_EQ(bytes_of(rebuilt), bytes);
  EXPECT_EQ(this->play_on(rebuilt, 280, 100), this->play_on(w, 280, 100));
}

TYPED_TEST(Rollback, a_command_log_replays_to_equal_hashes) {
  using S = TypeParam;
  World<S> w(settings<S>(-10, 60, 4)), replayed(settings<S>(-10, 60, 4));
  std::vector<std::uint8_t> log;
  w.record_to(&log);
  build_mess(w);
  std::size_t recorded = 0;
  for (std::uint64_t frame = 0; frame < 330; ++frame) {
    if (frame / 60 % 5 != 4) hail(w, frame);
    w.step();
    ASSERT_TRUE(replayed.step_recorded(log).ok()) << frame;
    ASSERT_EQ(replayed.hash(), w.hash()) << frame;
    recorded += log.size();
    log.clear();
  }
  EXPECT_GT(recorded, 10000u);
  EXPECT_GT(w.counts().contacts, 20u);
}

TYPED_TEST(Rollback, two_snapshots_taken_in_turn_do_not_disturb_one_another) {
  using S = TypeParam;
  World<S> a(settings<S>(-10, 60, 4)), b(settings<S>(-10, 60, 4));
  build_mess(a);
  build_mess(b, {1, 2, 3});
  this->play_on(a, 0, 250);
  this->play_on(b, 700, 250);
  typename World<S>::Snapshot of_a, of_b;
  a.save(of_a);
  b.save(of_b);
  const std::vector<std::uint64_t> future_a = this->play_on(a, 250, 30), future_b = this->play_on(b, 950, 30);
  EXPECT_NE(future_a, future_b);
  World<S> other(settings<S>(0, 60, 4));
  for (int round = 0; round < 3; ++round) {
    other.load(of_a);
    EXPECT_EQ(this->play_on(other, 250, 30), future_a);
    other.load(of_b);
    EXPECT_EQ(this->play_on(other, 950, 30), future_b);
    std::swap(round % 2 == 0 ? a : b, other);
  }
}

TYPED_TEST(Rollback, saving_on_either_side_of_falling_asleep_and_waking_changes_nothing) {
  using S = TypeParam;
  World<S> w(settings<S>(-10, 60, 4));
  const Mess<S> m = build_mess(w);
  w.destroy(m.rotor);
  std::vector<typename World<S>::Snapshot> snapshots;
  std::vector<std::uint64_t> hashes, ticks;
  int slept = 0, woke = 0;
  // A stack sleeps; a shove wakes it; it sleeps again.
  const auto frame = [&](World<S>& x) {
    if (x.tick() == 200) x.apply_impulse(m.moving[40], vec<S>(0.5, 0, 0));
    if (x.tick() == 320) x.destroy(m.moving[36]);
    x.step();
    return x.hash();
  };
  for (int i = 0; i < 520; ++i) {
    typename World<S>::Snapshot before;
    w.save(before);
    hashes.push_back(frame(w));
    const bool change = !w.events().fell_asleep.empty() || !w.events().woke.empty();
    slept += w.events().fell_asleep.empty() ? 0 : 1;
    woke += w.events().woke.empty() ? 0 : 1;
    if (change) {
      snapshots.push_back(std::move(before));
      ticks.push_back(w.tick() - 1);
      snapshots.emplace_back();
      w.save(snapshots.back());
      ticks.push_back(w.tick());
    }
  }
  ASSERT_GE(slept, 2);
  ASSERT_GE(woke, 2);
  World<S> other(settings<S>(5, 60, 4));
  for (std::size_t i = snapshots.size(); i-- > 0;) {
    other.load(snapshots[i]);
    ASSERT_EQ(other.tick(), ticks[i]);
    for (std::uint64_t k = ticks[i]; k < std::min<std::uint64_t>(ticks[i] + 60, hashes.size()); ++k) {
      ASSERT_EQ(frame(other), hashes[k]) << "from tick " << ticks[i] << " at " << k;
    }
  }
}

TYPED_TEST(Rollback, loading_empties_events_and_keeps_lanes_and_command_log) {
  using S = TypeParam;
  World<S> w(settings<S>(-10, 60, 4));
  build_mess(w);
  std::vector<std::uint8_t> log;
  w.record_to(&log);
  ASSERT_TRUE(w.use_simd(Simd::scalar));
  typename World<S>::Snapshot snapshot;
  w.save(snapshot);
  this->play_on(w, 0, 30);
  w.load(snapshot);
  EXPECT_TRUE(w.events().contact_begin.empty() && w.events().woke.empty() && w.events().sensor_begin.empty());
  EXPECT_STREQ(w.simd_name(), "scalar");
  const std::size_t before = log.size();
  EXPECT_TRUE(w.set_gravity(vec<S>(0, -9, 0)));
  EXPECT_GT(log.size(), before);
}

}  // namespace rollback_test
}  // namespace isostep::test
