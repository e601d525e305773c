// The tool on a kind of world that is not rigid bodies, and on files whose kind this build lacks.
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cstdio>
#include <string>

#include "own_folder.hpp"
#include "tool/command_line.hpp"
#include "tool/diff/diff_bundles.hpp"
#include "tool/verify/checked_file.hpp"
#include "unit/state/toy_world.hpp"

namespace toy {

void diff_states(const ToyWorld::State& a, const ToyWorld::State& b, DiffReport& report) {
  diff_value("state", a, b, report);
}
std::string owner_of(const ToyWorld::State&, std::string_view) { return "the toy"; }

}  // namespace toy

namespace isostep {

template <> struct WorldTraits<toy::ToyWorld> {
  static constexpr std::string_view kName = "toys";
  static constexpr std::uint32_t kPortableId = 0;
  static constexpr std::span<const char* const> kStages = toy::kToyStages;
};

namespace tool {
namespace other_world_test {

using toy::Buffer;
using toy::Push;
using toy::EveryToyCommand;
using toy::ToyWorld;

Buffer log_of(std::uint32_t before, std::uint32_t between) {
  Buffer log;
  Writer writer(log);
  write_command<EveryToyCommand>(writer, Push{before, 0});
  log.push_back(kStepMarker);
  write_command<EveryToyCommand>(writer, Push{between, 0});
  log.push_back(kStepMarker);
  return log;
}

/// Five frames; in the last two the first push is `other`.
Buffer recording(std::uint32_t other) {
  ToyWorld world;
  Buffer file;
  CommandRecorder<ToyWorld> recorder(world, sink_to(file));
  EXPECT_TRUE(recorder.begin("toys").ok());
  for (int frame = 0; frame < 5; ++frame) {
    world.apply(Push{frame < 3 ? 1 : other, 0});
    world.step();
    EXPECT_TRUE(recorder.end_frame().ok());
  }
  EXPECT_TRUE(recorder.finish().ok());
  return file;
}

class OtherWorld : public OwnFolder {
 protected:
  static std::string output(int expected, const std::vector<const char*>& words) {
    testing::internal::CaptureStdout();
    testing::internal::CaptureStderr();
    EXPECT_EQ(run_command_line(static_cast<int>(words.size()), words.data()), expected);
    std::fflush(stdout);
    const std::string out = testing::internal::GetCapturedStdout();
    return out + testing::internal::GetCapturedStderr();
  }
};

TEST_F(OtherWorld, IsPlayedStageByStageWithStagesOfItsOwn) {
  const Buffer log_a = log_of(5, 7), log_b = log_of(5, 8);
  PlayedFrame<ToyWorld> a(ToyWorld{}, log_a), b(ToyWorld{}, log_b);
  ASSERT_TRUE(a.playable() && b.playable());
  ASSERT_EQ(a.trace().size(), 6u);
  const StagePlace place = place_of<ToyWorld>(a.trace(), b.trace());
  EXPECT_EQ(place.text(), "step 2 of the frame, stage commands");
  EXPECT_EQ(a.state_at(place).sum, 5u * 31 + 1 + 7) << "after the push, before the step";
  std::vector<std::uint64_t> turned(a.trace().begin(), a.trace().end());
  turned[2] ^= 1;
  const StagePlace fold = place_of<ToyWorld>(a.trace(), turned);
  EXPECT_EQ(fold.text(), "step 1 of the frame, stage fold");
  EXPECT_EQ(a.state_at(fold).sum, 5u * 31 + 1);
  EXPECT_EQ(a.state_at(fold).tick, 1u);
  turned[2] ^= 1;
  turned[4] ^= 1;
  EXPECT_EQ(a.state_at(place_of<ToyWorld>(a.trace(), turned)).tick, 2u) << "counted, not yet folded";
}

TEST_F(OtherWorld, HasItsRecordingsCompared) {
  const Input a(file("a", recording(1))), b(file("b", recording(2)));
  testing::internal::CaptureStdout();
  EXPECT_EQ(diff_bundles<ToyWorld>(a, b), exit_status::kDifferent);
  std::fflush(stdout);
  const std::string out = testing::internal::GetCapturedStdout();
  EXPECT_NE(out.find("frame 3, stage commands\n  the commands or steps of this frame differ\n  state.sum: "),
            std::string::npos)
      << out;
  EXPECT_NE(out.find(" [the toy]\n"), std::string::npos) << out;
}

TEST_F(OtherWorld, ThatThisBuildLacksIsNamed) {
  const Buffer bytes = recording(1);
  const CheckedReplay checked = check_replay(bytes);
  EXPECT_EQ(checked.result.outcome, VerifyOutcome::incompatible);
  EXPECT_EQ(describe(checked.result),
            "INCOMPATIBLE: world is \"toys\" in the replay, \"rigid bodies, particles\" here");
  const std::string toys = file("toys.replay", bytes), rigid = path("rigid.replay");
  output(0, {"isostep", "run", "S1x5", "--frames", "2", "--record", rigid.c_str()});
  EXPECT_NE(output(2, {"isostep", "verify", toys.c_str()}).find("0 of 1 verified"), std::string::npos);
  EXPECT_NE(output(2, {"isostep", "diff", toys.c_str(), toys.c_str()}).find("of a world that this build lacks"),
            std::string::npos);
  EXPECT_EQ(output(1, {"isostep", "diff", toys.c_str(), rigid.c_str()}), "the kinds of world differ\n");
}

}  // namespace other_world_test
}  // namespace tool
}  // namespace isostep
