// Frames without a step, with several and with too many: where two peers part in them is named by step and stage.
// SPDX-License-Identifier: MIT
#include "desyncs.hpp"

namespace isostep::test {
namespace desync_steps_test {

using DesyncOfSteps = Desync;

TEST_F(DesyncOfSteps, InAFrameOfSeveralStepsIsNamedByTheStepToo) {
  using S = Q32_32;
  const auto turn = [](Arena<S>& arena) { far_body(arena).centre.z = with_bit_turned(far_body(arena).centre.z); };
  for (const int step : {0, 1, 2}) {
    const std::string place = "\nframe 37, step " + std::to_string(step + 1) + " of the frame, stage ";
    Peer<S> a, b, c;
    a.steps = b.steps = c.steps = 3;
    b.fault_step = c.fault_step = step;
    b.inside = [&](Arena<S>& arena, Stage now) {
      if (now == Stage::finalise_bodies) turn(arena);
    };
    c.between = turn;
    bundles(a, b);
    const std::string out = diff("a", "b", 1);
    expect_part(out, place + "finalise_bodies\n  ");
    expect_part(out, turned(".centre.z", S(0), a.arena.far));
    expect_part(out, "as A recorded it, not as B did\n");
    c.play(44);
    bundle(c, "c", {2, kFault - 1, 16});
    expect_part(diff("a", "c", 1), place + "commands\n  the commands of this frame agree: something else changed");
  }
}

TEST_F(DesyncOfSteps, OfCountsOfStepsIsSaid) {
  for (const bool stages : {false, true}) {
    for (const int steps : {0, 1, 2}) {
      Peer<float> a(stages), b(stages);
      a.steps = steps;
      b.steps = steps + 1;
      bundles(a, b);
      const std::string counts = std::to_string(steps) + " in A, " + std::to_string(steps + 1) + " in B\n";
      const std::string expected = "frame 37, steps: " + counts + "  the commands or steps of this frame differ\n";
      expect_part(diff("a", "b", 1), "\n" + expected + "  tick: ");
      tool::write_file(path("of a"), Bytes(a.recording));
      tool::write_file(path("of b"), Bytes(b.recording));
      EXPECT_EQ(diff("of a", "of b", 1).rfind(expected + "  tick: ", 0), 0u);
    }
  }
}

TEST_F(DesyncOfSteps, InAPauseIsNamedByItsCommands) {
  using S = Q16_16;
  for (const bool stages : {false, true}) {
    Peer<S> a(stages), b(stages), c(stages);
    a.steps = b.steps = c.steps = 0;
    b.before = [](Arena<S>& arena) { far_body(arena).velocity.x = with_bit_turned(far_body(arena).velocity.x); };
    c.before = [](Arena<S>& arena) { arena.world.set_user_data(arena.far, 77); };
    bundles(a, b);
    const std::string out = diff("a", "b", 1);
    expect_part(out, stages ? "\nframe 37, stage commands\n  the commands of this frame agree: "
                            : "\nwithin frame 37 (trace was off)\n");
    expect_part(out, turned(".velocity.x", Velocity<S>(1.5), a.arena.far));
    c.play(45);
    bundle(c, "c", {2, kFault - 1, 16});
    expect_part(diff("a", "c", 1), "\nframe 37, stage commands\n  the commands or steps of this frame differ\n");
  }
}

TEST_F(DesyncOfSteps, AfterTheLastStepIsNamedSo) {
  for (const int steps : {1, 2}) {
    Peer<float> a, b;
    a.steps = b.steps = steps;
    b.at_end = [](Arena<float>& arena) { arena.world.set_user_data(arena.far, 77); };
    bundles(a, b);
    expect_part(diff("a", "b", 1), steps == 1 ? "\nframe 37, stage commands after the step\n"
                                              : "\nframe 37, stage commands after the last step\n");
  }
}

TEST_F(DesyncOfSteps, OfMoreStepsThanAFrameMayHaveIsNamedThoughItCannotBePlayed) {
  Peer<float> a, b;
  b.steps = static_cast<int>(kFrameStepCap) + 1;
  bundles(a, b);
  const std::string out = diff("a", "b", 1);
  expect_part(out, "\nframe 37, steps: 1 in A, 65 in B\n  the commands or steps of this frame differ\n  tick: ");
  expect_part(out, "as A recorded it, not as B did\n");

  std::vector<std::uint8_t> file;
  const World<float> world;
  Recorder<World<float>> recorder(sink_to(file));
  ASSERT_TRUE(recorder.begin(world, header_of_world(world.settings(), "none", 0).value()).ok());
  ASSERT_TRUE(recorder.frame(std::vector<std::uint8_t>(kFrameStepCap + 1, kStepMarker), 0).ok());
  ASSERT_TRUE(recorder.finish().ok());
  tool::write_file(path("many"), Bytes(file));
  testing::internal::CaptureStderr();
  EXPECT_EQ(diff("many", "many", 4), "");
  expect_part(testing::internal::GetCapturedStderr(), kTooManySteps);
}

TEST_F(DesyncOfSteps, OfFilesWhoseFirstFrameIsNoFrameIsRefused) {
  Peer<float> a;
  a.play(45);
  bundle(a, "a", {0, 40, 16});
  for (const char* number : {"1073741825", "9999999999999999999", "12a", "-1"}) {
    std::vector<std::uint8_t> file;
    Recorder<World<float>> recorder(sink_to(file));
    ReplayHeader header = header_of_world(a.arena.world.settings(), "arena", 0).value();
    ASSERT_TRUE(header.set(kFirstFrameKey, number, false));
    ASSERT_TRUE(recorder.begin(a.arena.world, header).ok() && recorder.finish().ok());
    tool::write_file(path("b"), Bytes(file));
    testing::internal::CaptureStderr();
    diff("a", "b", 4);
    expect_part(testing::internal::GetCapturedStderr(), "(HEAD first_frame)");
  }
}

}  // namespace desync_steps_test
}  // namespace isostep::test
