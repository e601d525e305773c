// The prover from outside: what it verifies, what it refuses and how, and states that it hands on.
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cstdlib>
#include <filesystem>
#include <sstream>
#include <string>
#include <vector>

#include "isostep/core/scalar_names.hpp"
#include "isostep/core/version.hpp"
#include "isostep/state/replay_format.hpp"
#include "own_folder.hpp"
#include "tool/command_line.hpp"
#include "tool/common/files.hpp"

namespace isostep::tool {
namespace prover_test {

namespace fs = std::filesystem;
using Buffer = std::vector<std::uint8_t>;

constexpr int kFrames = 40;
constexpr const char* kScenes[] = {"mixed", "springs"};  // of rigid bodies and of particles

struct Answer {
  int status;
  std::string out, err;
};

class Prover : public OwnFolder {
 protected:
  std::string text(const std::string& name) const {
    const Buffer bytes = read_file(path(name));
    return {bytes.begin(), bytes.end()};
  }
  /// `input` becomes its standard input. The folder's name may have blanks.
  Answer run(std::string words, const std::string& input = {}) const {
    const std::string folder = folder_.string(), quoted = "'" + folder + "'";
    for (std::size_t at = 0; (at = words.find(folder, at)) != std::string::npos; at += quoted.size()) {
      words.replace(at, folder.size(), quoted);
    }
    write_file(path("in"), input);
    const std::string line = std::string("'" ISOSTEP_PROVER "' ") + words + " <'" + path("in") + "' >'" + path("out") +
                             "' 2>'" + path("err") + "'";
    const int raw = std::system(line.c_str());
    return {WIFEXITED(raw) ? WEXITSTATUS(raw) : -1, text("out"), text("err")};
  }
  /// The path of a new recording.
  std::string record(const char* scene, const std::string& scalar, std::vector<std::string> more = {}) const {
    const std::string file = path(std::string(scene) + "." + scalar + ".replay");
    std::vector<std::string> words = {"isostep",  "run", scene, "--scalar", scalar, "--frames", std::to_string(kFrames),
                                      "--record", file};
    words.insert(words.end(), more.begin(), more.end());
    std::vector<const char*> pointers;
    for (const std::string& word : words) pointers.push_back(word.c_str());
    testing::internal::CaptureStdout();
    EXPECT_EQ(run_command_line(static_cast<int>(pointers.size()), pointers.data()), 0);
    testing::internal::GetCapturedStdout();
    return file;
  }
  template <class Visit> void each_recording(Visit&& visit) const {
    int seen = 0;
    for (const char* scene : kScenes) {
      any_scalar([&](auto tag) {
        ++seen;
        const std::string scalar = ScalarTraits<typename decltype(tag)::Type>::kName;
        visit(record(scene, scalar), scene, scalar);
        return false;
      });
    }
    EXPECT_GE(seen, 2);
  }
};

std::vector<std::string> split(const std::string& text, char at) {
  std::vector<std::string> parts;
  std::istringstream in(text);
  for (std::string part; std::getline(in, part, at);) parts.push_back(part);
  return parts;
}
std::vector<std::vector<std::string>> table(const std::string& text) {
  std::vector<std::vector<std::string>> rows;
  for (const std::string& line : split(text, '\n')) rows.push_back(split(line, '\t'));
  return rows;
}

/// The recording as another would have made it, every checksum right.
Buffer forged(const Buffer& file, const char* behaviour, std::uint64_t bad_frame) {
  const ReplayReader replay(file);
  ReplayHeader header = replay.header();
  if (behaviour != nullptr) {
    EXPECT_TRUE(header.set("behaviour", behaviour, true));
  }
  Buffer other;
  ReplayWriter writer(sink_to(other));
  EXPECT_TRUE(writer.begin(header, replay.state(), replay.state_hash()).ok());
  for (std::uint64_t i = 0; i < replay.frame_count(); ++i) {
    const ReplayFrame frame = replay.frame(i);
    EXPECT_TRUE(writer.frame(frame.input, frame.hash ^ (i == bad_frame ? 1u : 0u)).ok());
  }
  EXPECT_TRUE(writer.finish().ok());
  return other;
}

TEST_F(Prover, VerifiesRigidBodiesAndParticlesInEveryScalar) {
  each_recording([&](const std::string& file, const std::string& scene, const std::string& scalar) {
    for (const std::string lanes : {"best", "scalar"}) {
      const Answer answer = run("--simd " + lanes + " verify " + file);
      EXPECT_EQ(answer.status, 0) << answer.out << answer.err;
      EXPECT_EQ(answer.err, "");
      const auto rows = table(answer.out);
      ASSERT_EQ(rows.size(), 2u) << answer.out;
      ASSERT_EQ(rows[0].size(), 7u) << answer.out;
      ASSERT_EQ(rows[1].size(), 7u) << answer.out;
      EXPECT_EQ(rows[0][0] + " " + rows[0][1] + " " + rows[0][2], file + " " + scene + " " + scalar);
      EXPECT_TRUE(lanes == "best" || rows[0][3] == "scalar") << rows[0][3];
      EXPECT_EQ(rows[0][4], std::to_string(kFrames));
      EXPECT_GE(std::stod(rows[0][5]), 0);
      EXPECT_EQ(rows[0][6], "VERIFIED 40 frames");
      EXPECT_EQ(rows[1][0] + " " + rows[1][4] + " " + rows[1][6], "total 40 1 of 1 verified");
    }
  });
}

TEST_F(Prover, ComparesNoMoreFramesThanItIsAskedTo) {
  const std::string file = path("bad");
  write_file(file, Bytes(forged(read_file(record("mixed", "float")), nullptr, 20)));
  EXPECT_EQ(table(run("--frames 20 verify " + file).out).at(0).at(6), "VERIFIED 20 frames");
  const Answer answer = run("verify --frames 21 " + file);
  EXPECT_EQ(answer.status, 1);
  EXPECT_EQ(table(answer.out).at(0).at(6).rfind("DIVERGED at frame 20: ", 0), 0u) << answer.out;
  EXPECT_EQ(table(answer.out).at(0).at(4), "20");
  Buffer cut = forged(read_file(record("mixed", "float")), nullptr, 20);
  cut.resize(cut.size() - 8);
  write_file(path("cut"), Bytes(cut));
  const Answer short_of_it = run("--frames 2 verify " + path("cut"));
  EXPECT_EQ(short_of_it.status, 3);
  EXPECT_EQ(table(short_of_it.out).at(0).at(4), "2") << "more were not looked at: " << short_of_it.out;
}

TEST_F(Prover, ReadsARecordingFromStandardInput) {
  const Buffer file = read_file(record("springs", "q32.32"));
  const Answer answer = run("verify -", std::string(file.begin(), file.end()));
  EXPECT_EQ(answer.status, 0) << answer.out;
  EXPECT_EQ(table(answer.out).at(0).at(4), std::to_string(kFrames));
}

TEST_F(Prover, RefusesWhatIsDamagedCutOrMadeByAnotherBehaviour) {
  const Buffer good = read_file(record("mixed", "float"));
  const auto outcome = [&](const Buffer& bytes) {
    write_file(path("file"), Bytes(bytes));
    const Answer answer = run("verify " + path("file"));
    return std::to_string(answer.status) + " " + table(answer.out).at(0).at(6);
  };
  for (std::size_t part = 1; part < 8; ++part) {
    Buffer bad = good;
    bad[part * good.size() / 8] ^= 4;
    EXPECT_EQ(outcome(bad).rfind("4 CORRUPT at byte ", 0), 0u) << outcome(bad);
    const Buffer cut(good.begin(), good.begin() + static_cast<std::ptrdiff_t>(part * good.size() / 8));
    EXPECT_EQ(outcome(cut).rfind("3 TRUNCATED at frame ", 0), 0u) << outcome(cut);
  }
  EXPECT_EQ(outcome(forged(good, nullptr, 40)), "0 VERIFIED 40 frames") << "as forged, but for nothing";
  EXPECT_EQ(outcome(forged(good, nullptr, 17)).rfind("1 DIVERGED at frame 17: ", 0), 0u);
  const std::string here(ShortText<16>().append_hex(behaviour_version()).view());
  EXPECT_EQ(outcome(forged(good, "0123456789abcdef", 40)),
            "2 INCOMPATIBLE: behaviour is \"0123456789abcdef\" in the replay, \"" + here + "\" here");
  EXPECT_EQ(outcome({}).rfind("3 TRUNCATED", 0), 0u);
}

TEST_F(Prover, TracesWhatIsLeftOfACutRecording) {
  const Buffer good = read_file(record("mixed", "float"));
  write_file(path("good"), Bytes(good));
  write_file(path("cut"), Bytes(good.data(), good.size() - 20));
  const Answer whole = run("trace " + path("good")), cut = run("trace " + path("cut"));
  EXPECT_EQ(whole.status, 0);
  EXPECT_EQ(cut.status, 3);
  EXPECT_EQ(cut.err.find('\n'), cut.err.size() - 1) << cut.err;
  EXPECT_GT(table(whole.out).size(), 10u * kFrames);
  EXPECT_TRUE(cut.out == whole.out) << "every frame is there, the end is not";
  EXPECT_EQ(run("trace --frames 3 " + path("cut")).status, 0) << "no more was asked for";
}

// Sanitizers reserve more than any limit leaves.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr bool kCanLimit = false;
#elif defined(__has_feature)
constexpr bool kCanLimit = !__has_feature(address_sanitizer) && !__has_feature(thread_sanitizer);
#else
constexpr bool kCanLimit = true;
#endif

TEST_F(Prover, EndsWithALineWhereAFileDoesNot) {
  if (!kCanLimit || !fs::exists("/dev/zero")) GTEST_SKIP() << "nothing endless, or no limit for it";
  const std::string line =
      "ulimit -v 300000; '" ISOSTEP_PROVER "' trace /dev/zero >'" + path("out") + "' 2>'" + path("err") + "'";
  const int raw = std::system(line.c_str());
  EXPECT_EQ(WIFEXITED(raw) ? WEXITSTATUS(raw) : -1, 66);
  EXPECT_EQ(text("out"), "");
  EXPECT_EQ(text("err"), "isostep_prover: does not fit in memory (/dev/zero)\n");
}

TEST_F(Prover, EndsWithTheWorstOfItsFiles) {
  const std::string good = record("mixed", "float"), none = path("none");
  const Answer answer = run("verify " + good + " " + none + " " + good);
  EXPECT_EQ(answer.status, 66);
  EXPECT_EQ(answer.err.find('\n'), answer.err.size() - 1) << answer.err;
  EXPECT_NE(answer.err.find(none), std::string::npos) << answer.err;
  const auto rows = table(answer.out);
  ASSERT_EQ(rows.size(), 4u);
  EXPECT_EQ(rows[1].at(6).rfind("UNREADABLE: ", 0), 0u);
  EXPECT_EQ(rows[3].at(4) + " " + rows[3].at(6), "80 2 of 3 verified");
}

TEST_F(Prover, SaysInOneLineWhatItDoesNotUnderstand) {
  const std::string file = record("mixed", "float");
  for (const std::string& words : std::vector<std::string>{
           "", "walk", "verify", "about now", "--simd mmx verify " + file, "--frames -1 verify " + file, "--frames",
           "--fast verify x", "snapshot " + file, "snapshot " + file + " 1x", "continue - 3",
           "--frames 0 verify " + file, "--fault 1:prepare:tick:1 verify " + file,
           "snapshot " + file + " 3 --fault 1:prepare:tick:1", "--frames 3 about", "--frames 3 snapshot " + file + " 2",
           "--frames 3 fields " + file + " 1 prepare"}) {
    const Answer answer = run(words);
    EXPECT_EQ(answer.status, 64) << words;
    EXPECT_EQ(answer.out, "") << words;
    EXPECT_EQ(answer.err.rfind("isostep_prover: ", 0), 0u) << words;
    EXPECT_EQ(answer.err.find('\n'), answer.err.size() - 1) << words << answer.err;
  }
}

TEST_F(Prover, SaysThatARecordingIsShorterThanFrame) {
  const std::string file = record("mixed", "float");
  const Answer answer = run("snapshot " + file + " 41");
  EXPECT_EQ(answer.status, 3);
  EXPECT_EQ(answer.out, "");
  EXPECT_EQ(answer.err, "isostep_prover: the recording has 40 frames (" + file + ")\n");
  EXPECT_EQ(run("continue " + file + " 41", run("snapshot " + file + " 40").out).status, 3);
  EXPECT_EQ(run("fields " + file + " 40 prepare").status, 3);
  EXPECT_EQ(run("fields " + file + " 39 preparation").status, 64);
}

TEST_F(Prover, TellsWhatItIs) {
  const Answer answer = run("about");
  EXPECT_EQ(answer.status, 0);
  std::string names;
  for (const auto& row : table(answer.out)) names += row.at(0) + (row.size() == 2 ? " " : "? ");
  EXPECT_EQ(names,
            "version behaviour compiler architecture endianness pointer_bits flt_eval_method flags arithmetic lanes "
            "scalars ");
  EXPECT_NE(answer.out.find("\narithmetic\tas IEEE 754 has it\n"), std::string::npos) << answer.out;
  const auto has_flag = [&](const std::string& name) {
    const std::string flags = " " + table(answer.out).at(7).at(1) + " ";
    return flags.find(" " + name + " ") != std::string::npos;
  };
#if defined(__SIZEOF_INT128__)
  EXPECT_TRUE(has_flag("__SIZEOF_INT128__")) << answer.out;  // of this compiler, whatever it is told
#else
  EXPECT_FALSE(has_flag("__SIZEOF_INT128__")) << answer.out;
#endif
  EXPECT_FALSE(has_flag("__wasm_simd128__")) << "what is not defined: " << answer.out;
  EXPECT_EQ(table(answer.out).at(10).at(1), joined_scalar_names(" "));
}

TEST_F(Prover, HandsAStateOnInTheMiddleOfARecording) {
  each_recording([&](const std::string& file, const std::string& scene, const std::string&) {
    for (const int frame : {0, 1, 23, kFrames}) {
      const std::string where = file + " " + std::to_string(frame);
      const Answer state = run("snapshot " + where);
      ASSERT_EQ(state.status, 0) << state.err;
      EXPECT_EQ(state.out.find('\n'), frame == 0 ? state.out.find('\n') : 64u);
      const Answer answer = run("--simd scalar continue " + where, state.out);
      EXPECT_EQ(answer.status, 0) << answer.out << answer.err;
      EXPECT_EQ(table(answer.out).at(0).at(4), std::to_string(kFrames - frame)) << scene;
    }
  });
}

/// The tool steps the scene itself and never sees the recording.
TEST_F(Prover, TakesTheSnapshotThatTheToolTakes) {
  for (const char* scene : kScenes) {
    const std::string file = record(scene, "q32.32", {"--save", path("state")});
    std::string hex;
    for (const std::uint8_t byte : read_file(path("state"))) {
      hex += "0123456789abcdef"[byte >> 4];
      hex += "0123456789abcdef"[byte & 15];
    }
    std::string lines = run("snapshot " + file + " " + std::to_string(kFrames)).out;
    std::erase(lines, '\n');
    EXPECT_EQ(lines, hex);
  }
}

TEST_F(Prover, DoesNotContinueFromAnyOtherState) {
  for (const char* scene : kScenes) {
    const std::string file = record(scene, "float");
    const std::string state = run("snapshot " + file + " 23").out;
    ASSERT_EQ(run("continue " + file + " 23", state).status, 0);
    for (std::size_t part = 0; part < 40; ++part) {
      std::string other = state;
      char& digit = other[part * (state.size() - 1) / 40];
      if (digit == '\n') continue;
      digit = digit == '0' ? '1' : '0';
      const Answer answer = run("continue " + file + " 23", other);
      EXPECT_TRUE(answer.status == 1 || answer.status == 4) << answer.status << " " << part << " " << answer.out;
      EXPECT_EQ(table(answer.out).at(0).at(0), "-") << "standard input is at fault: " << answer.out;
    }
    EXPECT_EQ(run("continue " + file + " 24", state).status, 1) << "the state of another frame";
    EXPECT_EQ(run("continue " + file + " 41", state).status, 3) << "past the recording's end";
    EXPECT_EQ(run("continue " + file + " 23", state.substr(0, state.size() - 3)).status, 4);
    EXPECT_EQ(run("continue " + file + " 23", state + "00").status, 4);
    write_file(path("bad"), Bytes(forged(read_file(file), nullptr, 30)));
    EXPECT_EQ(table(run("continue " + path("bad") + " 23", state).out).at(0).at(0), path("bad")) << "not the state";
    for (const char* text : {"", "\n", "xyz", "0"}) EXPECT_EQ(run("continue " + file + " 23", text).status, 4) << text;
  }
}

}  // namespace prover_test
}  // namespace isostep::tool
