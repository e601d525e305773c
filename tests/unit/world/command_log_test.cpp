// Command logs: what one holds, how it plays, and where a recording of it ends.
// SPDX-License-Identifier: MIT

#include "determinism/mess.hpp"
#include "isostep/replay/recorder.hpp"
#include "isostep/state/verify.hpp"

namespace isostep::test {
namespace command_log_test {

template <class S> class CommandLogs : public ::testing::Test {};
TYPED_TEST_SUITE(CommandLogs, AllScalars);

TYPED_TEST(CommandLogs, a_recording_ends_where_the_world_is_loaded) {
  using S = TypeParam;
  World<S> w;
  add_ground(w);
  std::vector<std::uint8_t> file;
  WorldRecorder<S> recorder(w, sink_to(file));
  ASSERT_TRUE(recorder.begin("a test").ok());
  typename World<S>::Snapshot snapshot;
  w.save(snapshot);
  w.step();
  EXPECT_TRUE(recorder.end_frame().ok());
  w.load(snapshot);
  w.step();
  EXPECT_FALSE(recorder.end_frame().ok());
}

TYPED_TEST(CommandLogs, a_log_that_is_damaged_is_refused) {
  using S = TypeParam;
  World<S> w(settings<S>());
  std::vector<std::uint8_t> log;
  w.record_to(&log);
  const ShapeId ball = add_ball(w, 0.5);
  const BodyId id = w.create(moving<S>(ball, {0, 0, 0}));
  w.destroy(id);
  w.step();
  for (const std::size_t cut : {std::size_t{1}, log.size() / 2, log.size() - 2}) {
    World<S> other(settings<S>());
    EXPECT_FALSE(other.step_recorded({log.data(), cut}).ok()) << cut;
    EXPECT_EQ(other.tick(), 0u);
  }
  World<S> other(settings<S>());
  const std::uint8_t unknown[] = {200};
  EXPECT_FALSE(other.step_recorded(unknown).ok());
  EXPECT_TRUE(other.step_recorded(log).ok());
  EXPECT_FALSE(other.step_recorded({log.data() + log.size() - 10, 10}).ok()) << "the body is gone: a refused command";
}

TYPED_TEST(CommandLogs, a_log_is_numbers_of_commands_their_fields_and_markers) {
  using S = TypeParam;
  World<S> w(settings<S>());
  std::vector<std::uint8_t> log, expected;
  w.record_to(&log);
  const Child<S> parts[] = {{primitive_of(Sphere<S>{S(0.5)}), Pose<S>::identity()},
                            {primitive_of(Box<S>{{S(1), S(2), S(3)}}), Pose<S>::identity()}};
  const ShapeId shape = w.add_shape(parts);
  w.step();
  w.set_gravity(vec<S>(1, 2, 3));
  w.remove_shape(shape);
  using Command = EveryCommand<S>;
  const auto number = [](std::size_t of) { return static_cast<std::uint8_t>(of); };
  Writer writer(expected);
  writer.write(number(detail::kNumberOf<AddShape<S>, Command>));
  writer.write(std::uint32_t{2});
  for (const Child<S>& part : parts) writer.write(part);
  writer.write(std::uint8_t{0xff});
  writer.write(number(detail::kNumberOf<SetGravity<S>, Command>));
  for (const int i : {1, 2, 3}) writer.write(S(i));
  writer.write(number(detail::kNumberOf<RemoveShape, Command>));
  writer.write_short(shape);
  EXPECT_EQ(shape.generation, 1u);
  EXPECT_EQ(expected.back(), 1u);
  EXPECT_EQ(log, expected);
}

TYPED_TEST(CommandLogs, a_log_keeps_the_place_of_the_step_among_the_commands) {
  using S = TypeParam;
  World<S> w(settings<S>()), other(settings<S>());
  std::vector<std::uint8_t> log;
  w.record_to(&log);
  const ShapeId ball = add_ball(w, 0.5);
  const BodyId a = w.create(moving<S>(ball, {0, 5, 0}));
  w.step();
  w.set_velocity(a, vec<S>(0, 3, 0), vec<S>(0, 0, 0));
  w.create(moving<S>(ball, {4, 5, 0}));
  ASSERT_TRUE(other.step_recorded(log).ok());
  EXPECT_EQ(other.hash(), w.hash());
  EXPECT_EQ(to_double(other.velocity(a).y), 3);
  EXPECT_EQ(other.tick(), 1u);
}

TYPED_TEST(CommandLogs, a_log_plays_any_number_of_steps_up_to_the_cap) {
  using S = TypeParam;
  for (const std::uint32_t steps : {0u, 1u, 2u, kFrameStepCap, kFrameStepCap + 1}) {
    World<S> w(settings<S>()), other(settings<S>());
    std::vector<std::uint8_t> log;
    w.record_to(&log);
    const BodyId ball = w.create(moving<S>(add_ball(w, 0.5), {0, 5, 0}));
    for (std::uint32_t i = 0; i < steps; ++i) {
      w.step();
      w.apply_impulse(ball, vec<S>(0.5, 0, 0));
    }
    const Result<void> played = other.step_recorded(log);
    EXPECT_EQ(other.tick(), std::min(steps, kFrameStepCap));
    if (steps <= kFrameStepCap) {
      EXPECT_TRUE(played.ok()) << steps;
      EXPECT_EQ(other.hash(), w.hash()) << steps;
    } else {
      EXPECT_EQ(played.error().code, ErrorCode::limit);
      EXPECT_EQ(played.error().message.view(), kTooManySteps);
    }
  }
  World<S> still(settings<S>());
  const std::uint64_t before = still.hash();
  EXPECT_TRUE(still.step_recorded({}).ok());
  EXPECT_EQ(still.hash(), before);
}

TYPED_TEST(CommandLogs, a_recording_takes_pauses_and_several_steps_and_verifies) {
  using S = TypeParam;
  World<S> w;
  std::vector<std::uint8_t> file;
  WorldRecorder<S> recorder(w, sink_to(file));
  const BodyId ball = w.create(moving<S>(add_ball(w, 0.5), {0, 5, 0}));
  ASSERT_TRUE(recorder.begin("a test").ok());
  for (const std::uint32_t steps : {0u, 1u, 2u, 0u, kFrameStepCap}) {
    w.apply_impulse(ball, vec<S>(0.25, 0, 0));
    for (std::uint32_t i = 0; i < steps; ++i) w.step();
    ASSERT_TRUE(recorder.end_frame().ok()) << steps;
  }
  ASSERT_TRUE(recorder.finish().ok());
  const ReplayReader replay(file);
  World<S> again;
  const VerifyResult result = verify_replay(replay, again, SameHeader{replay.header()});
  EXPECT_EQ(result.outcome, VerifyOutcome::verified) << describe(result);
  EXPECT_EQ(result.frames, 5u);
  EXPECT_EQ(again.tick(), 3u + kFrameStepCap);
}

TYPED_TEST(CommandLogs, a_world_that_is_moved_is_recorded_and_traced_no_longer) {
  using S = TypeParam;
  World<S> w(settings<S>());
  std::vector<std::uint8_t> log;
  std::vector<std::uint64_t> trace;
  const auto attach = [&](World<S>& world) {
    world.record_to(&log);
    world.trace_to(&trace);
    world.step();
  };
  attach(w);
  const std::size_t size = log.size(), hashes = trace.size();
  ASSERT_GT(hashes, 0u);
  World<S> moved(std::move(w));
  moved.step();
  EXPECT_FALSE(moved.records_to(&log));
  EXPECT_EQ(log.size(), size);
  EXPECT_EQ(trace.size(), hashes);
  attach(moved);
  w = std::move(moved);
  w.step();
  EXPECT_EQ(log.size(), 2 * size);
  EXPECT_EQ(trace.size(), 2 * hashes);
}

TYPED_TEST(CommandLogs, no_log_is_played_while_the_world_steps) {
  using S = TypeParam;
  World<S> w(settings<S>());
  const StageObserver observer = {[](void* user, Stage, const StageView&) {
                                    const std::uint8_t step[] = {kStepMarker};
                                    EXPECT_FALSE(static_cast<World<S>*>(user)->step_recorded(step).ok());
                                  },
                                  &w};
  w.step(observer);
  EXPECT_EQ(w.tick(), 1u);
  EXPECT_EQ(w.fault(), Fault::called_in_step);
}

TYPED_TEST(CommandLogs, a_recording_ends_before_a_frame_of_more_steps_than_the_cap) {
  using S = TypeParam;
  World<S> w;
  std::vector<std::uint8_t> file;
  WorldRecorder<S> recorder(w, sink_to(file));
  ASSERT_TRUE(recorder.begin("a test").ok());
  w.step();
  ASSERT_TRUE(recorder.end_frame().ok());
  for (std::uint32_t i = 0; i <= kFrameStepCap; ++i) w.step();
  EXPECT_EQ(recorder.end_frame().error().message.view(), kTooManySteps);
  EXPECT_FALSE(recorder.end_frame().ok());
  ASSERT_TRUE(recorder.finish().ok());
  EXPECT_EQ(ReplayReader(file).frame_count(), 1u);
}

}  // namespace command_log_test
}  // namespace isostep::test
