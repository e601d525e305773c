// The command line from outside: words in, exit status, streams and files out.
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <regex>
#include <sstream>
#include <string>
#include <vector>

#include "isostep/core/crc32c.hpp"
#include "isostep/state/replay_format.hpp"
#include "isostep/world/replay_check.hpp"
#include "tool/commands.hpp"
#include "tool/files.hpp"
#include "tool/goldens.hpp"

namespace isostep::tool {
namespace {

namespace fs = std::filesystem;

struct Answer {
  int status;
  std::string out, err;
};

class CommandLine : public testing::Test {
 protected:
  void SetUp() override {
    const testing::TestInfo& info = *testing::UnitTest::GetInstance()->current_test_info();
    folder_ = fs::path(testing::TempDir()) / (std::string("isostep-") + info.name());
    fs::remove_all(folder_);
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }

  std::string path(const std::string& name) const { return (folder_ / name).string(); }
  static Answer run(std::vector<std::string> words) {
    words.insert(words.begin(), "isostep");
    std::vector<const char*> pointers;
    for (const std::string& word : words) pointers.push_back(word.c_str());
    testing::internal::CaptureStdout();
    testing::internal::CaptureStderr();
    const int status = run_command_line(static_cast<int>(pointers.size()), pointers.data());
    std::fflush(stdout);
    std::string out = testing::internal::GetCapturedStdout();
    return {status, std::move(out), testing::internal::GetCapturedStderr()};
  }
  static std::string content_of(const fs::path& place) {
    std::ifstream file(place, std::ios::binary);
    std::stringstream text;
    text << file.rdbuf();
    return text.str();
  }
  std::string read(const std::string& name) const { return content_of(path(name)); }
  void write(const std::string& name, const std::string& bytes) const {
    std::ofstream(path(name), std::ios::binary) << bytes;
  }
  std::size_t files() const {
    return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder_), fs::directory_iterator()));
  }
  /// A recording of 70 frames: two blocks.
  void record(const std::string& name, std::vector<std::string> more = {}) {
    std::vector<std::string> words = {"run", "S1x5", "--frames", "70", "--record", path(name)};
    words.insert(words.end(), more.begin(), more.end());
    ASSERT_EQ(run(words).status, 0);
  }

  fs::path folder_;
};

void expect_one_line(const Answer& answer, int status, const std::string& part) {
  EXPECT_EQ(answer.status, status);
  EXPECT_EQ(answer.out, "");
  EXPECT_NE(answer.err.find(part), std::string::npos) << answer.err;
  EXPECT_EQ(answer.err.find('\n'), answer.err.size() - 1) << answer.err;
}

TEST_F(CommandLine, WritesAPageOfARunOrSaysWhatIsMissing) {
  const Answer answer = run({"run", "S1x5", "--frames", "20", "--html", path("a.html"), "--beside", "double"});
  if (answer.status == 69) {
    expect_one_line(answer, 69, "npm");
    EXPECT_EQ(files(), 0u);
    return;
  }
  EXPECT_EQ(answer.status, 0);
  EXPECT_NE(answer.out.find("a.html"), std::string::npos) << answer.out;
  EXPECT_NE(read("a.html").find("\"frames\":21"), std::string::npos);
  const Answer silent = run({"run", "S1x5", "--frames", "20", "--json", "--html", path("b.html")});
  EXPECT_EQ(silent.out.find("b.html"), std::string::npos) << silent.out;
  EXPECT_GT(read("b.html").size(), read("a.html").size() / 2);
  const Answer lost = run({"run", "S1x5", "--frames", "1", "--html", path("none") + "/c.html"});
  EXPECT_EQ(lost.status, 74);
  EXPECT_NE(lost.err.find("none"), std::string::npos) << lost.err;
}
TEST_F(CommandLine, RefusesOptionsOfAPageWithoutOneWith64) {
  expect_one_line(run({"run", "S1x5", "--beside", "double"}), 64, "--html");
  expect_one_line(run({"run", "S1x5", "--html-every", "2"}), 64, "--html");
  expect_one_line(run({"run", "S1x5", "--html", path("a"), "--beside-tolerance", "1"}), 64, "--beside");
  expect_one_line(run({"run", "S1x5", "--html", path("a"), "--beside", "half"}), 64, "half");
  EXPECT_EQ(files(), 0u);
}

TEST_F(CommandLine, RefusesWordsThatItDoesNotKnowWith64) {
  expect_one_line(run({}), 64, "a command is missing");
  expect_one_line(run({"walk"}), 64, "walk");
  expect_one_line(run({"run"}), 64, "scene");
  expect_one_line(run({"run", "S1", "--speed", "3"}), 64, "--speed");
  expect_one_line(run({"run", "S1", "--scalar", "q8.8"}), 64, "q8.8");
  expect_one_line(run({"run", "S1", "--frames", "-1"}), 64, "--frames");
  expect_one_line(run({"run", "S1", "--frames", "many"}), 64, "--frames");
  expect_one_line(run({"run", "S1", "--substeps", "0"}), 64, "--substeps");
  expect_one_line(run({"run", "S1", "--hz", "9"}), 64, "--hz");
  expect_one_line(run({"run", "S1", "--threads", "0"}), 64, "--threads");
  expect_one_line(run({"run", "S1", "--solver", "magic"}), 64, "--solver");
  expect_one_line(run({"run", "S1", "--simd", "mmx"}), 64, "--simd");
  expect_one_line(run({"run", "S0"}), 64, "S0");
  expect_one_line(run({"verify"}), 64, "paths");
}

TEST_F(CommandLine, SaysWhatItIsForWhenAsked) {
  EXPECT_EQ(run({"--help"}).status, 0);
  EXPECT_NE(run({"run", "--help"}).out.find("--scalar"), std::string::npos);
  EXPECT_EQ(run({"--version"}).status, 0);
}

TEST_F(CommandLine, ReportsFilesThatAreNotThereWith66) {
  expect_one_line(run({"run", path("none.json")}), 66, "none.json");
  expect_one_line(run({"run", "S1x5", "--load", path("none")}), 66, "none");
  expect_one_line(run({"diff", path("a"), path("b")}), 66, "a");
  EXPECT_EQ(run({"verify", path("none.replay")}).status, 66);
  expect_one_line(run({"verify", folder_.string()}), 66, "holds no replay");
}

TEST_F(CommandLine, ReportsPlacesThatCannotBeWrittenWith74) {
  const std::string nowhere = path("no/such/folder");
  for (const char* option : {"--record", "--hashes", "--dump", "--save"}) {
    const Answer answer = run({"run", "S1x5", "--frames", "1", option, nowhere});
    expect_one_line(answer, 74, "no/such/folder");
  }
}

TEST_F(CommandLine, RefusesAWrongSceneFileAndWritesNothing) {
  write("bad.json", R"({"bodies": [{"type": "dynamic", "mass": -1, "shapes": [{"type": "sphere", "radius": 1}]}]})");
  const Answer answer = run({"run", path("bad.json"), "--record", path("r"), "--hashes", path("h"), "--dump", path("d"),
                             "--save", path("s"), "--json"});
  expect_one_line(answer, 64, "bad.json:/bodies/0/mass: ");
  EXPECT_EQ(files(), 1u);
  write("bad.json", "{\n 1}");
  expect_one_line(run({"run", path("bad.json")}), 64, "bad.json:2:2: ");
}

TEST_F(CommandLine, ReportsOneJsonObjectWithTheMembersOfTheManual) {
  const Answer answer = run({"run", "S1x5", "--frames", "12", "--scalar", "q32.32", "--substeps", "3", "--json"});
  EXPECT_EQ(answer.status, 0);
  EXPECT_EQ(answer.err, "");
  std::size_t at = 0;
  for (const char* key : {"\"scene\":\"S1x5\"",     "\"scalar\":\"q32.32\"", "\"solver\":\"soft_step\"",
                          "\"substeps\":3",         "\"threads\":1",         "\"simd\":",
                          "\"frames\":12",          "\"hash\":\"",           "\"ms_median\":",
                          "\"ms_mean\":",           "\"ms_p99\":",           "\"ms_max\":",
                          "\"ms_median_settled\":", "\"contacts\":5",        "\"points\":20",
                          "\"bodies\":6",           "\"awake\":5",           "\"penetration_max\":",
                          "\"joint_error_max\":0",  "\"energy_start\":",     "\"energy_end\":",
                          "\"asleep_at\":null",     "\"faults\":0}\n"}) {
    const std::size_t found = answer.out.find(key, at);
    ASSERT_NE(found, std::string::npos) << key << " in " << answer.out;
    at = found;
  }
}

TEST_F(CommandLine, SolvesByTheSolverThatIsNamed) {
  const std::string standard = run({"run", "S1x5", "--frames", "12", "--json"}).out;
  for (const std::string solver : {"pgs", "worst_first", "direct"}) {
    const Answer answer = run({"run", "S1x5", "--frames", "12", "--solver", solver, "--json"});
    EXPECT_EQ(answer.status, 0) << solver;
    EXPECT_NE(answer.out.find("\"solver\":\"" + solver + "\""), std::string::npos) << answer.out;
    const auto hash_of = [](const std::string& text) { return text.substr(text.find("\"hash\""), 26); };
    EXPECT_NE(hash_of(answer.out), hash_of(standard)) << solver;
  }
  expect_one_line(run({"run", "bridge", "--solver", "pgs"}), 64, "particles have no solver pgs");
}

TEST_F(CommandLine, WritesAHashForEveryFrame) {
  ASSERT_EQ(run({"run", "S1x5", "--frames", "3", "--hashes", path("h")}).status, 0);
  const std::string text = read("h");
  ASSERT_EQ(text.size(), 3u * 19);
  EXPECT_EQ(text.substr(0, 2), "0 ");
  EXPECT_EQ(text.substr(38, 2), "2 ");
  const std::string json = run({"run", "S1x5", "--frames", "3", "--json"}).out;
  EXPECT_NE(json.find(text.substr(40, 16)), std::string::npos);
}

TEST_F(CommandLine, DumpsTheBodiesInTheOrderOfTheScene) {
  write("scene.json", R"({"gravity": [0, 0, 0], "bodies": [
    {"type": "dynamic", "position": [1, 2, 3], "velocity": [0, 60, 0], "shapes": [{"type": "sphere", "radius": 0.5}]},
    {"type": "static", "position": [-0.1, 0, 0], "shapes": [{"type": "box", "half_extents": [0.5, 0.5, 0.5]}]}]})");
  ASSERT_EQ(run({"run", path("scene.json"), "--scalar", "double", "--frames", "60", "--dump", path("d")}).status, 0);
  EXPECT_EQ(read("d").rfind("{\"bodies\": [\n  {\"position\": [1, 6", 0), 0u) << read("d");
  EXPECT_NE(read("d").find("{\"position\": [-0.1, 0, 0], \"orientation\": [0, 0, 0, 1], \"velocity\": [0, 0, 0], "
                           "\"angular_velocity\": [0, 0, 0]}]}"),
            std::string::npos)
      << read("d");
}

TEST_F(CommandLine, ContinuesASnapshotAsIfItHadNeverStopped) {
  for (const char* scalar : {"float", "double", "q16.16", "q32.32"}) {
    const std::vector<std::string> base = {"run", "mixed", "--scalar", scalar};
    const auto with = [&](std::vector<std::string> more) {
      more.insert(more.begin(), base.begin(), base.end());
      return run(more).status;
    };
    ASSERT_EQ(with({"--frames", "40", "--save", path("whole")}), 0);
    ASSERT_EQ(with({"--frames", "25", "--save", path("half")}), 0);
    ASSERT_EQ(with({"--frames", "15", "--load", path("half"), "--save", path("both")}), 0);
    EXPECT_EQ(read("whole"), read("both")) << scalar;
  }
}

TEST_F(CommandLine, RefusesASnapshotThatIsNone) {
  write("junk", "junk");
  expect_one_line(run({"run", "S1x5", "--load", path("junk")}), 64, "junk");
  ASSERT_EQ(run({"run", "S1x5", "--frames", "1", "--save", path("float")}).status, 0);
  expect_one_line(run({"run", "S1x5", "--scalar", "double", "--load", path("float")}), 64, "scalar");
  write("long", read("float") + "x");
  expect_one_line(run({"run", "S1x5", "--load", path("long")}), 64, "long");
}

TEST_F(CommandLine, LanesChangeNothingButTheirName) {
  for (const char* scalar : {"float", "double", "q16.16", "q32.32"}) {
    for (const char* lanes : {"scalar", "sse2", "avx2", "avx512", "neon", "wasm", "best"}) {
      ASSERT_EQ(
          run({"run", "S4s", "--frames", "60", "--scalar", scalar, "--simd", lanes, "--hashes", path(lanes)}).status,
          0);
    }
    EXPECT_EQ(read("scalar"), read("sse2")) << scalar;
    EXPECT_EQ(read("scalar"), read("avx2")) << scalar;
    EXPECT_EQ(read("scalar"), read("avx512")) << scalar;
    EXPECT_EQ(read("scalar"), read("neon")) << scalar;
    EXPECT_EQ(read("scalar"), read("wasm")) << scalar;
    EXPECT_EQ(read("scalar"), read("best")) << scalar;
  }
}

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
}

/// What was true of them when they were written: every frame's hash is the golden list's, and the scene is built by the
/// commands of frame 0.
TEST_F(CommandLine, RecordsFromTheEmptyWorldOnWhatTheGoldenListsSay) {
  int seen = 0;
  for (const std::string scene : {"mixed", "S6", "springs", "ballistic"}) {
    for (const GoldenText& golden : golden_texts()) {
      const std::optional<GoldenName> name = parse_golden_name(golden.name);
      if (name->scene != scene || (scene == "S6" && name->scalar != "double")) continue;
      ++seen;
      ASSERT_EQ(run({"run", scene, "--scalar", name->scalar, "--frames", "60", "--record", path("r")}).status, 0);
      const std::vector<std::uint8_t> file = read_file(path("r"));
      const ReplayReader replay(file);
      ASSERT_EQ(replay.frame_count(), 60u);
      const auto expected = parse_hash_lines(golden.text).value();
      for (std::size_t i = 0; i < 60; ++i) ASSERT_EQ(replay.frame(i).hash, expected[i]) << golden.name << " " << i;
      EXPECT_EQ(replay.keyframes().size(), 1u);
      EXPECT_EQ(replay.keyframes().at(0).frames, 60u);
      EXPECT_LT(replay.state().size(), 400u) << "settings and nothing else";
      EXPECT_GT(replay.frame(0).input.size(), 150u);
    }
  }
  EXPECT_GE(seen, 4);
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
  const auto hashes = parse_hash_lines(read("h")).value();
  ASSERT_EQ(replay.frame_count(), 20u);
  for (std::size_t i = 0; i < 20; ++i) EXPECT_EQ(replay.frame(i).hash, hashes[20 + i]);
  EXPECT_EQ(check_replay(file).result.outcome, VerifyOutcome::verified);
}

TEST_F(CommandLine, VerifiesGoldenLists) {
  ASSERT_EQ(run({"run", "S1x5", "--frames", "20", "--scalar", "q16.16", "--hashes", path("S1x5.q16.16.txt")}).status,
            0);
  EXPECT_EQ(run({"verify", path("S1x5.q16.16.txt")}).status, 0);
  std::string text = read("S1x5.q16.16.txt");
  text[5 * 19 + 4] = text[5 * 19 + 4] == '0' ? '1' : '0';
  write("S1x5.q16.16.txt", text);
  const Answer answer = run({"verify", path("S1x5.q16.16.txt")});
  EXPECT_EQ(answer.status, 1);
  EXPECT_NE(answer.out.find("DIVERGED at frame 5"), std::string::npos);
  write("S1x5.q16.16.txt", text + "junk\n");
  EXPECT_EQ(run({"verify", path("S1x5.q16.16.txt")}).status, 4);
  write("S0.float.txt", "");
  EXPECT_EQ(run({"verify", path("S0.float.txt")}).status, 2);
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

TEST_F(CommandLine, RefusesEmptyWordsThatNameAProverOrADirectory) {
  record("a");
  for (const std::string& blank : std::vector<std::string>{"", " \t"}) {
    expect_one_line(run({"diff", "--stages", "--prover-a", blank, path("a")}), 64, "--prover-a");
    expect_one_line(run({"diff", "--stages", "--prover-b", blank, path("a")}), 64, "--prover-b");
    expect_one_line(run({"rebake", "--recordings", "--dir", blank}), 64, "--dir");
  }
  expect_one_line(run({"rebake", "nonsense"}), 64, "nonsense");
}

TEST_F(CommandLine, HoldsTheLawOfRestoring) {
  for (const char* scalar : {"float", "double", "q16.16", "q32.32"}) {
    const Answer answer =
        run({"selftest", "mixed", "--scalar", scalar, "--frames", "120", "--every", "9", "--rollback", "6"});
    EXPECT_EQ(answer.status, 0) << answer.out;
  }
}

TEST_F(CommandLine, ChecksItself) {
  const Answer answer = run({"selfcheck"});
  EXPECT_EQ(answer.status, 0);
  EXPECT_EQ(answer.out.rfind("sound: isostep ", 0), 0u) << answer.out;
  EXPECT_EQ(answer.out.find('\n'), answer.out.size() - 1) << answer.out;
  const Answer table = run({"selfcheck", "--verbose"});
  EXPECT_TRUE(std::regex_search(table.out, std::regex("\nq32\\.32 +scalar +8 of 8 recordings, "))) << table.out;
  EXPECT_NE(table.out.find("\nsound: isostep "), std::string::npos) << table.out;
  const auto json = nlohmann::json::parse(run({"selfcheck", "--json"}).out);
  EXPECT_TRUE(json.at("sound").get<bool>());
  EXPECT_TRUE(json.at("failure").is_null());
  EXPECT_GE(json.at("parts").size(), 4u);
}

/// Recorded anew they are the files that the library carries, byte for byte, whoever records.
TEST_F(CommandLine, RecordsTheSetOfTheSelfCheckAsItIsCommitted) {
  const Answer answer = run({"rebake", "--recordings", "--dir", path("set")});
  ASSERT_EQ(answer.status, 0) << answer.err;
  std::size_t files = 0;
  for (const auto& entry : fs::directory_iterator(fs::path(ISOSTEP_SOURCE_DIR) / "replays" / "selfcheck")) {
    ++files;
    const std::string name = entry.path().filename().string();
    ASSERT_TRUE(fs::exists(fs::path(path("set")) / name)) << name << ": renew the set by ./isostep rebake";
    EXPECT_TRUE(read("set/" + name) == content_of(entry.path())) << name << ": renew it by ./isostep rebake";
  }
  EXPECT_NE(answer.out.find(std::to_string(files) + " of " + std::to_string(files) + " recordings"), std::string::npos)
      << answer.out;
}

}  // namespace
}  // namespace isostep::tool
