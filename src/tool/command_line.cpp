// The command line: options in, an exit status out, errors as one line on stderr.
// SPDX-License-Identifier: MIT
#include <CLI/CLI.hpp>
#include <cstdio>
#include <exception>
#include <functional>
#include <iostream>

#include "commands.hpp"
#include "isostep/core/version.hpp"
#include "scene_game.hpp"
#include "tool.hpp"

namespace {

namespace tool = isostep::tool;

const std::vector<std::string> kScalars = {"float", "double", "q16.16", "q32.32"};
constexpr int kMostFrames = 1'000'000'000;

/// Every command's options, and what to do when it is chosen.
class CommandLine {
 public:
  explicit CommandLine(CLI::App& app) : app_(app) {
    app.require_subcommand(0, 1);
    app.set_version_flag("--version", std::string("isostep ") + isostep::kVersionText);
    add_scenes();
    add_run();
    add_verify();
    add_diff();
    add_selftest();
    add_rebake();
    add_demo();
    add("selfcheck", "is this build and machine sound", [] { return tool::command_selfcheck(); });
  }
  int execute() const {
    if (!chosen_) throw tool::ToolError(tool::exit_status::kUsage, "a command is missing (isostep --help)");
    return chosen_();
  }

 private:
  CLI::App* add(const char* name, const char* what, std::function<int()> action) {
    CLI::App* command = app_.add_subcommand(name, what);
    command->callback([this, action] { chosen_ = action; });
    return command;
  }
  static void add_scalar(CLI::App* command, std::string& scalar) {
    command->add_option("--scalar", scalar, "the number type")->check(CLI::IsMember(kScalars))->capture_default_str();
  }
  static void add_frames(CLI::App* command, int& frames) {
    command->add_option("--frames", frames, "how many; the scene's own count otherwise")
        ->check(CLI::Range(0, kMostFrames));
  }

  void add_scenes() {
    CLI::App* command = add("scenes", "list the named scenes", [this] { return tool::command_scenes(scenes_); });
    command->add_flag("--json", scenes_.json, "one JSON object");
    command->add_option("--write", scenes_.write, "write each as a scene file into this directory");
  }
  void add_run() {
    CLI::App* command = add("run", "run a scene and measure it", [this] { return tool::command_run(run_); });
    command->add_option("scene", run_.scene, "a named scene, or a scene file")->required();
    add_scalar(command, run_.scalar);
    add_frames(command, run_.frames);
    command->add_option("--hz", run_.hz, "steps per second [" + std::to_string(tool::kDefaultHz) + "]")
        ->check(CLI::Range(10, 1000));
    command->add_option("--substeps", run_.substeps, "per step [" + std::to_string(tool::kDefaultSubsteps) + "]")
        ->check(CLI::Range(1, 64));
    command->add_option("--solver", run_.solver, "how contacts are solved")
        ->check(CLI::IsMember({"soft_step"}))
        ->capture_default_str();
    command->add_option("--threads", run_.threads, "only 1")->check(CLI::Range(1, 1))->capture_default_str();
    command->add_option("--simd", run_.simd, "widest lanes to use; never changes a bit")
        ->check(CLI::IsMember({"best", "scalar", "sse2", "avx2"}))
        ->capture_default_str();
    command->add_option("--load", run_.load, "begin with this portable snapshot");
    command->add_option("--save", run_.save, "write a portable snapshot of the end");
    command->add_option("--record", run_.record, "write a replay");
    command->add_option("--hashes", run_.hashes, "write the hash after each frame");
    command->add_option("--dump", run_.dump, "write the last frame's bodies as JSON");
    command->add_flag("--json", run_.json, "one JSON object");
  }
  void add_verify() {
    CLI::App* command =
        add("verify", "replay files and compare every frame's hash", [this] { return tool::command_verify(verify_); });
    command->add_option("paths", verify_.paths, "replays, golden lists, or directories of them")->required();
    command->add_option("--jobs", verify_.jobs, "files at a time")->check(CLI::Range(1, 256))->capture_default_str();
    command->add_flag("--json", verify_.json, "one JSON object");
    command->footer("Exits with the worst: 0 verified, 1 diverged, 2 incompatible, 3 truncated, 4 corrupt.");
  }
  void add_diff() {
    CLI::App* command =
        add("diff", "the first frame, stage and field that differ", [this] { return tool::command_diff(diff_); });
    command->add_option("a", diff_.a, "a replay or a portable snapshot")->required();
    command->add_option("b", diff_.b, "another of the same kind")->required();
  }
  void add_selftest() {
    CLI::App* command =
        add("selftest", "the law of restoring, at every frame", [this] { return tool::command_selftest(selftest_); });
    command->add_option("scene", selftest_.scene, "a named scene, or a scene file")->required();
    add_scalar(command, selftest_.scalar);
    add_frames(command, selftest_.frames);
    command->add_option("--rollback", selftest_.rollback, "frames run again after a load")
        ->check(CLI::Range(1, 10000))
        ->capture_default_str();
    command->add_option("--every", selftest_.every, "frames from one save to the next")
        ->check(CLI::Range(1, kMostFrames))
        ->capture_default_str();
  }
  void add_rebake() {
    rebake_.directory = ISOSTEP_GOLDENS_DIR;
    CLI::App* command =
        add("rebake", "rewrite the golden hashes, on purpose", [this] { return tool::command_rebake(rebake_); });
    command->add_option("--dir", rebake_.directory, "where to");
  }
  void add_demo() {
    CLI::App* command =
        add("demo", "record and replay a few scenes in every scalar", [this] { return tool::command_demo(demo_); });
    command->add_option("--out", demo_.out, "keep the recordings in this directory");
  }

  CLI::App& app_;
  std::function<int()> chosen_;
  tool::ScenesOptions scenes_;
  tool::RunOptions run_;
  tool::VerifyOptions verify_;
  tool::DiffOptions diff_;
  tool::SelftestOptions selftest_;
  tool::RebakeOptions rebake_;
  tool::DemoOptions demo_;
};

int fail(int status, std::string message) {
  for (char& c : message) {
    if (c == '\n') c = ' ';
  }
  std::cerr << "isostep: " << message << "\n";
  return status;
}

int parse_and_run(int argc, const char* const* argv) {
  CLI::App app("Deterministic 3D physics: the same inputs give the same bits.", "isostep");
  CommandLine commands(app);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) return app.exit(error);
    return fail(tool::exit_status::kUsage, std::string(error.what()) + " (isostep --help)");
  }
  tool::catch_interrupt();
  const int status = commands.execute();
  std::cout.flush();
  const bool written = std::cout.good() && std::fflush(stdout) == 0;
  return written ? status : fail(tool::exit_status::kOutput, "standard output cannot be written");
}

}  // namespace

namespace isostep::tool {

int run_command_line(int argc, const char* const* argv) {
  try {
    return parse_and_run(argc, argv);
  } catch (const ToolError& error) {
    return fail(error.status(), error.what());
  } catch (const scenes::SceneError& error) {
    return fail(exit_status::kSoftware, error.what());
  } catch (const std::bad_alloc&) {
    return fail(exit_status::kSoftware, "out of memory");
  } catch (const std::exception& error) {
    return fail(exit_status::kSoftware, error.what());
  }
}

}  // namespace isostep::tool
