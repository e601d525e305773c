// The command line from outside: words in, exit status, streams and files out.
// SPDX-License-Identifier: MIT
#include "unit/tool/command_line.hpp"

#include <gtest/gtest.h>

#include <cerrno>
#include <csignal>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <regex>
#include <string>
#include <system_error>
#include <vector>

#include "built.hpp"

#if defined(__unix__)
#include <sys/resource.h>
#endif

namespace isostep::tool {
namespace command_line_test {

namespace fs = std::filesystem;

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
TEST_F(CommandLine, AnyRecordingCanBeWatched) {
  record("r");
  ASSERT_EQ(run({"run", "cloth", "--frames", "12", "--record", path("cloth")}).status, 0);
  expect_one_line(run({"run", path("r")}), 64, "--html");
  expect_one_line(run({"run", path("r"), "--html", path("p"), "--substeps", "3"}), 64, "as it was recorded");
  const Answer answer = run({"run", path("r"), "--html", path("r.html")});
  if (answer.status == 69) {
    expect_one_line(answer, 69, "npm");
    return;
  }
  EXPECT_EQ(answer.status, 0) << answer.err;
  EXPECT_NE(read("r.html").find("\"frames\":71"), std::string::npos);
  EXPECT_EQ(run({"run", path("cloth"), "--html", path("cloth.html"), "--frames", "5"}).status, 0);
  EXPECT_NE(read("cloth.html").find("\"frames\":6"), std::string::npos);
  const Answer both = run({"diff", path("r"), path("r"), "--html", path("both.html")});
  EXPECT_EQ(both.status, 0) << both.err;
  EXPECT_NE(both.out.find("the same: 70 frames\npage "), std::string::npos) << both.out;
  EXPECT_NE(read("both.html").find("\"divergence\""), std::string::npos);
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
  expect_one_line(run({"run", "S1", "--projection", "magic"}), 64, "--projection");
  expect_one_line(run({"run", "bridge", "--projection", "linear"}), 64, "--projection is for rigid bodies");
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
  for (const char* option : {"--record", "--hashes", "--dump", "--save", "--html"}) {
    // Half a year of frames: it is said before the run.
    const Answer answer = run({"run", "S1x5", "--frames", "1000000000", option, nowhere});
    expect_one_line(answer, 74, "no/such/folder: ");
  }
}

#if defined(__unix__)
/// Files of this process may be no longer.
class FileSizeLimit {
 public:
  explicit FileSizeLimit(rlim_t bytes) : signal_(std::signal(SIGXFSZ, SIG_IGN)) {
    getrlimit(RLIMIT_FSIZE, &before_);
    const rlimit now = {bytes, before_.rlim_max};
    setrlimit(RLIMIT_FSIZE, &now);
  }
  ~FileSizeLimit() {
    setrlimit(RLIMIT_FSIZE, &before_);
    std::signal(SIGXFSZ, signal_);
  }

 private:
  void (*signal_)(int);
  rlimit before_ = {};
};

TEST_F(CommandLine, ARecordingThatCannotBeWrittenNamesFileAndCauseAndLeavesWhatWasThere) {
  record("r");
  const std::string old = read("r");
  ASSERT_GT(old.size(), 1024u);
  {
    const FileSizeLimit limit(1024);
    expect_one_line(run({"run", "S1x5", "--frames", "70", "--scalar", "double", "--record", path("r")}), 74,
                    path("r") + ": " + std::generic_category().message(EFBIG));
  }
  EXPECT_EQ(read("r"), old);
  EXPECT_EQ(files(), 1u);
  if (fs::exists("/dev/full")) {
    expect_one_line(run({"run", "S1x5", "--frames", "1", "--record", "/dev/full"}), 74,
                    "/dev/full: " + std::generic_category().message(ENOSPC));
  }
}
#endif

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
                          "\"joint_error_max\":0",  "\"signorini\":",        "\"coulomb\":0.0",
                          "\"dissipation\":",       "\"energy_start\":",     "\"energy_end\":",
                          "\"asleep_at\":null",     "\"faults\":0",          "\"lost\":0}\n"}) {
    const std::size_t found = answer.out.find(key, at);
    ASSERT_NE(found, std::string::npos) << key << " in " << answer.out;
    at = found;
  }
}

TEST_F(CommandLine, TellsWhatPassedAWallAndWhichBlobsAWorldHolds) {
  const std::string wall = run({"run", "S13", "--frames", "2", "--json"}).out;
  EXPECT_NE(wall.find(",\"through\":0}\n"), std::string::npos) << wall;
  const std::string ground = run({"run", "S16", "--frames", "1", "--json"}).out;
  EXPECT_NE(ground.find("\"lost\":0,\"blobs\":[{\"shape\":\"mesh\",\"id\":\""), std::string::npos) << ground;
  EXPECT_NE(ground.find("{\"shape\":\"hull\",\"id\":\""), std::string::npos) << ground;
  const Answer table = run({"run", "S16", "--frames", "1"});
  EXPECT_NE(table.out.find("lost          0\nblobs         1 of type hull: "), std::string::npos) << table.out;
}

TEST_F(CommandLine, EndsOverlapsByTheProjectionThatIsNamed) {
  ISO_NEEDS_BOOK();
  for (const std::string projection : {"nonlinear", "linear", "relaxed", "velocity_based"}) {
    const Answer answer =
        run({"run", "S1x5", "--frames", "2", "--solver", "worst_first", "--projection", projection, "--json"});
    EXPECT_EQ(answer.status, 0) << projection;
    EXPECT_NE(answer.out.find("\"projection\":\"" + projection + "\""), std::string::npos) << answer.out;
    const Answer table = run({"run", "S1x5", "--frames", "2", "--solver", "worst_first", "--projection", projection});
    EXPECT_NE(table.out.find("worst_first " + projection), std::string::npos) << table.out;
  }
  expect_one_line(run({"run", "S1x5", "--frames", "2", "--projection", "linear"}), 64, "for --solver worst_first");
}

TEST_F(CommandLine, SolvesByTheSolverThatIsNamed) {
  const std::string standard = run({"run", "S1x5", "--frames", "12", "--json"}).out;
  for (const std::string solver : {"pgs", "worst_first", "direct"}) {
    if (left_out(*solver_named(solver)) != nullptr) continue;
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

TEST_F(CommandLine, RefusesEmptyWordsThatNameAProverAFileOrADirectory) {
  record("a");
  for (const std::string& blank : std::vector<std::string>{"", " \t"}) {
    expect_one_line(run({"diff", "--stages", "--prover-a", blank, path("a")}), 64, "--prover-a");
    expect_one_line(run({"diff", "--stages", "--prover-b", blank, path("a")}), 64, "--prover-b");
    expect_one_line(run({"regenerate", "--recordings", "--dir", blank}), 64, "--dir");
    for (const char* option : {"--load", "--save", "--record", "--hashes", "--dump", "--html"})
      expect_one_line(run({"run", "S1x5", "--frames", "1", option, blank}), 64, option);
  }
  expect_one_line(run({"regenerate", "nonsense"}), 64, "nonsense");
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
  const std::string set =
      std::to_string(5 + std::size(isostep::test::kBuiltSolvers));  // one for each solver of rigid bodies
  const std::regex row("\nq32\\.32 +scalar +" + set + " of " + set + " recordings, ");
  EXPECT_TRUE(std::regex_search(table.out, row)) << table.out;
  EXPECT_NE(table.out.find("\nsound: isostep "), std::string::npos) << table.out;
  const auto json = nlohmann::json::parse(run({"selfcheck", "--json"}).out);
  EXPECT_TRUE(json.at("sound").get<bool>());
  EXPECT_TRUE(json.at("failure").is_null());
  EXPECT_GE(json.at("parts").size(), 4u);
}

/// Recorded anew they are the files that the library carries, byte for byte, whoever records.
TEST_F(CommandLine, RecordsTheSetOfTheSelfCheckAsItIsCommitted) {
  ISO_NEEDS_BOOK();
  const Answer answer = run({"regenerate", "--recordings", "--dir", path("set")});
  ASSERT_EQ(answer.status, 0) << answer.err;
  std::size_t files = 0;
  for (const auto& entry : fs::directory_iterator(fs::path(ISOSTEP_SOURCE_DIR) / "replays" / "selfcheck")) {
    ++files;
    const std::string name = entry.path().filename().string();
    ASSERT_TRUE(fs::exists(fs::path(path("set")) / name)) << name << ": renew the set by ./isostep regenerate";
    EXPECT_TRUE(read("set/" + name) == content_of(entry.path())) << name << ": renew it by ./isostep regenerate";
  }
  EXPECT_NE(answer.out.find(std::to_string(files) + " of " + std::to_string(files) + " recordings"), std::string::npos)
      << answer.out;
}

}  // namespace command_line_test
}  // namespace isostep::tool
