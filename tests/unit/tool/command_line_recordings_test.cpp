// The command line's recordings: written, verified, refused, compared.
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <regex>
#include <string>
#include <vector>

#include "isostep/core/crc32c.hpp"
#include "isostep/replay/replay_check.hpp"
#include "isostep/state/replay_format.hpp"
#include "tool/common/files.hpp"
#include "tool/common/tool.hpp"
#include "tool/verify/goldens.hpp"
#include "unit/tool/command_line.hpp"

namespace isostep::tool {
namespace command_line_recordings_test {

namespace fs = std::filesystem;

TEST_F(CommandLine, VerifiesWhatItRecorded) {
  record("a.replay");
  fs::create_directories(folder_ / "deep");
  fs::copy(path("a.replay"), path("deep/b.replay"));
  const Answer answer = run({"verify", folder_.string()});
  EXPECT_EQ(answer.status, 0);
  EXPECT_NE(answer.out.find("VERIFIED 70 frames"), std::string::npos);
  EXPECT_NE(answer.out.find("2 of 2 verified"), std::string::npos);
  const Answer json = run({"verify", "--json", "--jobs", "2", folder_.string()});
  EXPECT_EQ(json.out.rfind("{\"files\":[{\"path\":", 0), 0u);
  EXPECT_NE(json.out.find("\"verified\":2,\"exit\":0}\n"), std::string::npos);
}

/// A chunk's checksum follows its payload; so a changed hash needs a new one to be believed at all.
std::string with_changed_hash(std::string bytes) {
  const std::size_t chunk = bytes.find("HASH");
  bytes[chunk + 12 + 12] = static_cast<char>(bytes[chunk + 12 + 12] ^ 1);
  const auto* data = reinterpret_cast<const std::uint8_t*>(bytes.data());
  const std::size_t size = 12 + load_le<std::uint32_t>(data + chunk + 4);
  std::uint8_t crc[4];
  store_le(crc, crc32c(Bytes(data + chunk, size)));
  bytes.replace(chunk + size, 4, reinterpret_cast<const char*>(crc), 4);
  const std::size_t done = bytes.size() - 32;
  data = reinterpret_cast<const std::uint8_t*>(bytes.data());
  std::uint8_t digest[8];
  store_le(digest, hash_bytes(data, done));
  bytes.replace(done + 12 + 8, 8, reinterpret_cast<const char*>(digest), 8);
  store_le(crc, crc32c(Bytes(reinterpret_cast<const std::uint8_t*>(bytes.data()) + done, 28)));
  bytes.replace(done + 28, 4, reinterpret_cast<const char*>(crc), 4);
  return bytes;
}

TEST_F(CommandLine, TellsTheOutcomesOfVerifyApart) {
  record("good.replay");
  const std::string good = read("good.replay");
  write("diverged.replay", with_changed_hash(good));
  std::string other = good;
  other[8] = 9;
  write("incompatible.replay", other);
  write("truncated.replay", good.substr(0, good.size() - 20));
  other = good;
  other[good.size() / 2] = static_cast<char>(other[good.size() / 2] ^ 1);
  write("corrupt.replay", other);
  write("empty.replay", "");

  EXPECT_EQ(run({"verify", path("good.replay")}).status, 0);
  EXPECT_EQ(run({"verify", path("diverged.replay")}).status, 1);
  EXPECT_NE(run({"verify", path("diverged.replay")}).out.find("DIVERGED at frame 0"), std::string::npos);
  const int preamble = run({"verify", path("incompatible.replay")}).status;
  EXPECT_TRUE(preamble == 2 || preamble == 4) << preamble;  // the version is under a checksum of its own
  EXPECT_EQ(run({"verify", path("truncated.replay")}).status, 3);
  EXPECT_EQ(run({"verify", path("corrupt.replay")}).status, 4);
  EXPECT_EQ(run({"verify", path("empty.replay")}).status, 3);
  EXPECT_EQ(run({"verify", path("good.replay"), path("diverged.replay"), path("corrupt.replay")}).status, 4);
  EXPECT_EQ(run({"verify", path("good.replay"), path("diverged.replay")}).status, 1);
  expect_one_line(run({"diff", path("good.replay"), path("empty.replay")}), 4, "neither a replay nor");
}

TEST_F(CommandLine, VerifyLeavesOutNoRecordingOfADirectory) {
  record("good.replay");
  fs::create_symlink(path("nowhere"), path("lost.replay"));
  const Answer answer = run({"verify", folder_.string()});
  EXPECT_EQ(answer.status, 66);
  EXPECT_NE(answer.out.find("1 of 2 verified"), std::string::npos) << answer.out;
}

/// What was true of them when they were written: every frame's hash is the golden's, and the scene is built by the
/// commands of frame 0.
TEST_F(CommandLine, RecordsFromTheEmptyWorldOnWhatTheGoldensSay) {
  const std::string file = content_of(fs::path(ISOSTEP_SOURCE_DIR) / "replays" / "goldens.txt");
  int seen = 0;
  for (const std::string_view line : golden_lines(file)) {
    const Golden golden = parse_golden(line).value();
    if (golden.scene != "mixed" && golden.scene != "springs" && golden.scene != "ballistic") continue;
    ++seen;
    const std::string frames = std::to_string(golden.frames);
    ASSERT_EQ(run({"run", golden.scene, "--scalar", golden.scalar, "--frames", frames, "--record", path("r")}).status,
              0);
    const std::vector<std::uint8_t> bytes = read_file(path("r"));
    const ReplayReader replay(bytes);
    std::vector<std::uint64_t> hashes;
    for (std::size_t i = 0; i < replay.frame_count(); ++i) hashes.push_back(replay.frame(i).hash);
    EXPECT_EQ(text_of(golden_of(golden.scene, golden.scalar, hashes)), line);
    EXPECT_EQ(replay.keyframes().size(), 1u);
    EXPECT_EQ(replay.keyframes().at(0).frames, golden.frames);
    EXPECT_LT(replay.state().size(), 400u) << "settings and nothing else";
    EXPECT_GT(replay.frame(0).input.size(), 150u);
  }
  EXPECT_EQ(seen, 12);
}

/// Its first frame creates 131 072 bodies: 36 MB of commands in the widest scalar.
TEST_F(CommandLine, RecordsTheLargestScene) {
  ASSERT_EQ(run({"run", "max_bodies", "--scalar", "q32.32", "--frames", "1", "--record", path("r")}).status, 0);
  const Answer answer = run({"verify", path("r")});
  EXPECT_EQ(answer.status, 0) << answer.out;
  EXPECT_NE(answer.out.find("VERIFIED 1 frame"), std::string::npos) << answer.out;
}

/// A golden that differs between two marks is found by its digest, one that differs at a mark there.
TEST_F(CommandLine, VerifiesEveryLineOfAFileOfGoldens) {
  const std::string file = content_of(fs::path(ISOSTEP_SOURCE_DIR) / "replays" / "goldens.txt");
  Golden golden;
  for (const std::string_view line : golden_lines(file)) {
    golden = parse_golden(line).value();
    if (golden.scene == "S1x5" && golden.scalar == "q32.32") break;
  }
  ASSERT_EQ(golden.frames, 120u);
  const std::string good = text_of(golden);
  ++golden.digest;
  const std::string digest_differs = text_of(golden);
  ++golden.marks[0];
  const std::string mark_differs = text_of(golden);
  write("goldens.txt", good + "\n" + digest_differs + "\n" + mark_differs + "\nnonsense\n");
  const Answer answer = run({"verify", folder_.string()});
  EXPECT_EQ(answer.status, 4);
  for (const char* said : {"goldens.txt:S1x5 +q32\\.32 +VERIFIED 120 frames\n", "DIVERGED at frame 119: .*digests",
                           "DIVERGED at frame 59: ", "goldens.txt:nonsense +CORRUPT at byte 0", "\n1 of 4 verified"}) {
    EXPECT_TRUE(std::regex_search(answer.out, std::regex(said))) << said << "\n" << answer.out;
  }
  write("goldens.txt", good + "\njunk\n");
  EXPECT_EQ(run({"verify", path("goldens.txt")}).status, 4);
  write("goldens.txt", digest_differs);
  EXPECT_EQ(run({"verify", path("goldens.txt")}).status, 1);
  write("goldens.txt", "S0" + good.substr(4));
  EXPECT_EQ(run({"verify", path("goldens.txt")}).status, 2);
  write("goldens.txt", good);
  EXPECT_EQ(run({"verify", path("goldens.txt")}).status, 0);
  write("goldens.txt", "");
  EXPECT_EQ(run({"verify", path("goldens.txt")}).status, 4);
}

TEST_F(CommandLine, PrintsTheHashOfEveryGoldenFrame) {
  ASSERT_EQ(run({"run", "S1x5", "--scalar", "q16.16", "--frames", "120", "--hashes", path("h")}).status, 0);
  const Answer answer = run({"verify", "--goldens", "S1x5"});
  EXPECT_EQ(answer.status, 0);
  const std::string hashes = read("h");
  std::string lines;
  for (const std::string_view line : golden_lines(hashes)) lines += "q16.16 " + std::string(line) + "\n";
  EXPECT_NE(answer.out.find(lines), std::string::npos);
  EXPECT_EQ(std::count(answer.out.begin(), answer.out.end(), '\n'), 480);
  expect_one_line(run({"verify", "--goldens", "S0"}), 64, "no scene 'S0'");
  expect_one_line(run({"verify"}), 64, "wants paths, or --goldens SCENE");
}

TEST_F(CommandLine, RecordsNothingOfNoFrames) {
  expect_one_line(run({"run", "S1x5", "--frames", "0", "--record", path("r")}), 64, "a recording needs a frame");
  EXPECT_EQ(files(), 0u);
}

TEST_F(CommandLine, RecordsFromALoadedStateOn) {
  ASSERT_EQ(run({"run", "mixed", "--frames", "20", "--save", path("s")}).status, 0);
  ASSERT_EQ(run({"run", "mixed", "--load", path("s"), "--frames", "20", "--record", path("r")}).status, 0);
  ASSERT_EQ(run({"run", "mixed", "--frames", "40", "--hashes", path("h")}).status, 0);
  const std::vector<std::uint8_t> file = read_file(path("r"));
  const ReplayReader replay(file);
  const Bytes start = replay.state();
  EXPECT_EQ(std::vector<std::uint8_t>(start.begin(), start.end()), read_file(path("s")));
  const std::string hashes = read("h");
  const std::vector<std::string_view> lines = golden_lines(hashes);
  ASSERT_EQ(replay.frame_count(), 20u);
  ASSERT_EQ(lines.size(), 40u);
  for (std::size_t i = 0; i < 20; ++i)
    EXPECT_EQ(std::to_string(20 + i) + " " + hex(replay.frame(i).hash), lines[20 + i]);
  EXPECT_EQ(check_replay(file).result.outcome, VerifyOutcome::verified);
}

TEST_F(CommandLine, FindsTheFieldInWhichSnapshotsDiffer) {
  write("scene.json", R"({"gravity": [0, 0, 0], "bodies": [
    {"type": "dynamic", "velocity": [1, 2, 3], "shapes": [{"type": "sphere", "radius": 0.5}]}]})");
  ASSERT_EQ(run({"run", path("scene.json"), "--frames", "0", "--save", path("a")}).status, 0);
  std::string other = read("scene.json");
  other.replace(other.find("2, 3"), 1, "4");
  write("scene.json", other);
  ASSERT_EQ(run({"run", path("scene.json"), "--frames", "0", "--save", path("b")}).status, 0);
  EXPECT_EQ(run({"diff", path("a"), path("a")}).status, 0);
  const Answer answer = run({"diff", path("a"), path("b")});
  EXPECT_EQ(answer.status, 1);
  EXPECT_EQ(
      answer.out.rfind("  bodies[0].velocity.y: 2 | 4 (0x40000000 | 0x40800000), 8388608 ulp apart [body slot 0]\n", 0),
      0u)
      << answer.out;
}

/// One scene with and without the script that replaces a body at frame 4.
TEST_F(CommandLine, FindsTheFrameInWhichReplaysPart) {
  ASSERT_EQ(run({"scenes", "--write", path("scenes")}).status, 0);
  std::string plain = read("scenes/S9.json");
  const std::string script = ", \"script\": \"mixer\"";
  ASSERT_NE(plain.find(script), std::string::npos);
  plain.erase(plain.find(script), script.size());
  write("plain.json", plain);
  ASSERT_EQ(run({"run", "S9", "--frames", "6", "--record", path("a.replay")}).status, 0);
  ASSERT_EQ(run({"run", path("plain.json"), "--frames", "6", "--record", path("b.replay")}).status, 0);
  EXPECT_EQ(run({"diff", path("a.replay"), path("a.replay")}).out, "the same: 6 frames\n");
  const Answer answer = run({"diff", path("a.replay"), path("b.replay")});
  EXPECT_EQ(answer.status, 1);
  EXPECT_EQ(answer.out.rfind("frame 4, stage commands\n  the commands or steps of this frame differ\n"
                             "  body_slots[1].generation: 2 | 1 ",
                             0),
            0u)
      << answer.out;
}

TEST_F(CommandLine, BlamesTheRecordingThatIsNotReproduced) {
  record("a.replay");
  write("b.replay", with_changed_hash(read("a.replay")));
  const Answer answer = run({"diff", path("a.replay"), path("b.replay")});
  EXPECT_EQ(answer.status, 1);
  EXPECT_EQ(answer.out.rfind("frame 0: recorded as ", 0), 0u);
  EXPECT_NE(answer.out.find("B was made by something that behaves otherwise"), std::string::npos);
}

TEST_F(CommandLine, StagesThatAgreeDoNotHideHashesThatWereRecordedOtherwise) {
  record("a.replay");
  write("b.replay", with_changed_hash(read("a.replay")));
  const Answer two = run({"diff", "--stages", path("a.replay"), path("b.replay")});
  EXPECT_EQ(two.status, 1);
  EXPECT_EQ(two.out, run({"diff", path("a.replay"), path("b.replay")}).out);
  const Answer one = run({"diff", "--stages", path("b.replay")});
  EXPECT_EQ(one.status, 1);
  EXPECT_EQ(one.out.rfind("frame 0: recorded as ", 0), 0u) << one.out;
  EXPECT_NE(one.out.find(" here: it was made by something that behaves otherwise\n"), std::string::npos) << one.out;
  EXPECT_EQ(run({"diff", "--stages", path("a.replay")}).out, "the same: 70 frames, stage by stage\n");
}

TEST_F(CommandLine, StagesOfOtherScalarsOrWorldsAreNotCompared) {
  record("float");
  record("double", {"--scalar", "double"});
  ASSERT_EQ(run({"run", "springs", "--frames", "2", "--record", path("springs")}).status, 0);
  const Answer scalars = run({"diff", "--stages", path("float"), path("double")});
  EXPECT_EQ(std::to_string(scalars.status) + " " + scalars.out, "1 the scalars differ\n");
  const Answer worlds = run({"diff", "--stages", path("float"), path("springs")});
  EXPECT_EQ(std::to_string(worlds.status) + " " + worlds.out, "1 the kinds of world differ\n");
}

TEST_F(CommandLine, SaysThatARecordingIsCutOffBeforeItComparesStages) {
  record("whole");
  const std::string whole = read("whole");
  write("cut", whole.substr(0, whole.size() - 20));
  const Answer answer = run({"diff", "--stages", path("cut")});
  EXPECT_NE(answer.err.find("cut is cut off: what is left of it is compared\n"), std::string::npos) << answer.err;
  EXPECT_EQ(answer.out, "the same: 70 frames, stage by stage\n");
  EXPECT_EQ(answer.status, 0);
}

}  // namespace command_line_recordings_test
}  // namespace isostep::tool
