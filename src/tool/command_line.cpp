// The command line: options in, an exit status out, errors as one line on stderr.
// SPDX-License-Identifier: MIT
#include "command_line.hpp"

#include <CLI/CLI.hpp>
#include <cstdio>
#include <exception>
#include <functional>
#include <iostream>

#include "isostep/core/version.hpp"
#include "isostep/particles/settings.hpp"
#include "tool/common/scene_game.hpp"
#include "tool/common/tool.hpp"
#include "tool/demo/commands.hpp"
#include "tool/diff/commands.hpp"
#include "tool/lab/commands.hpp"
#include "tool/lab/report/report.hpp"
#include "tool/lab/tolerance.hpp"
#include "tool/match/commands.hpp"
#include "tool/run/commands.hpp"
#include "tool/verify/commands.hpp"

namespace {

namespace tool = isostep::tool;

constexpr int kMostFrames = 1'000'000'000;

template <std::size_t N> std::vector<std::string> names_in(const char* const (&names)[N]) {
  return {std::begin(names), std::end(names)};
}

/// A word that is there and says nothing: a variable of somebody's script that is not set.
std::string refuse_blank(const std::string& word) {
  return word.find_first_not_of(" \t\n") == std::string::npos ? "is empty" : "";
}

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
    add_peer();
    add_relay();
    add_demo();
    add_lab();
    add_selfcheck();
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
    command->add_option("--scalar", scalar, "the number type")
        ->check(CLI::IsMember(isostep::scalar_names()))
        ->capture_default_str();
  }
  /// Of a file or a directory: a name.
  static CLI::Option* add_path(CLI::App* command, const char* name, std::string& path, const char* what) {
    return command->add_option(name, path, what)->check(refuse_blank, "");
  }
  static void add_frames(CLI::App* command, int& frames) {
    command->add_option("--frames", frames, "how many; the scene's own count otherwise")
        ->check(CLI::Range(0, kMostFrames));
  }

  void add_scenes() {
    CLI::App* command = add("scenes", "list the named scenes", [this] { return tool::command_scenes(scenes_); });
    command->add_flag("--json", scenes_.json, "one JSON object");
    add_path(command, "--write", scenes_.write, "write each as a scene file into this directory");
  }
  void add_run() {
    CLI::App* command = add("run", "run a scene and measure it", [this] { return tool::command_run(run_); });
    command->add_option("scene", run_.scene, "a named scene, a scene file, or with --html a recording")->required();
    add_scalar(command, run_.scalar);
    add_frames(command, run_.frames);
    command->add_option("--hz", run_.game.hz, "steps per second [the scene's]")->check(CLI::Range(10, 1000));
    command->add_option("--substeps", run_.game.substeps, "per step [the scene's]")->check(CLI::Range(1, 64));
    command->add_option("--solver", run_.game.solver, "how contacts are solved [the scene's]")
        ->check(CLI::IsMember(names_in(isostep::kSolverNames)));
    command->add_option("--integrator", run_.game.integrator, "how particles are integrated [the scene's]")
        ->check(CLI::IsMember(names_in(isostep::kIntegratorNames)));
    command->add_option("--stepping", run_.game.stepping, "how particles' sub-steps end [the scene's]")
        ->check(CLI::IsMember(names_in(isostep::kSteppingNames)));
    command->add_option("--threads", run_.threads, "that share the work; never changes a bit")
        ->check(CLI::Range(1, 64))
        ->capture_default_str();
    command->add_option("--simd", run_.simd, "lanes to use, or the widest narrower ones; never changes a bit")
        ->check(CLI::IsMember(names_in(isostep::kSimdNames)))
        ->capture_default_str();
    add_path(command, "--load", run_.load, "begin with this portable snapshot");
    add_path(command, "--save", run_.save, "write a portable snapshot of the end");
    add_path(command, "--record", run_.record, "write a replay");
    add_path(command, "--hashes", run_.hashes, "write the hash after each frame");
    add_path(command, "--dump", run_.dump, "write the last frame's bodies as JSON");
    CLI::Option* html = add_path(command, "--html", run_.html, "write a page that plays the run in a browser");
    command->add_option("--html-every", run_.html_every, "steps from one frame of the page to the next")
        ->check(CLI::Range(1, kMostFrames))
        ->needs(html)
        ->capture_default_str();
    CLI::Option* beside = command->add_option("--beside", run_.beside, "play the run in this number type beside it")
                              ->check(CLI::IsMember(isostep::scalar_names()))
                              ->needs(html);
    command->add_option("--beside-tolerance", run_.beside_tolerance, "metres beyond which a body has parted")
        ->check(CLI::Range(0.001, 1000.0))
        ->needs(beside)
        ->capture_default_str();
    command->add_flag("--json", run_.json, "one JSON object");
  }
  void add_verify() {
    CLI::App* command =
        add("verify", "replay files and compare every frame's hash", [this] { return tool::command_verify(verify_); });
    command->add_option("paths", verify_.paths, "replays, golden lists, or directories of them")->required();
    command->add_option("--jobs", verify_.jobs, "files at a time")->check(CLI::Range(1, 256))->capture_default_str();
    command->add_flag("--json", verify_.json, "one JSON object");
    command->add_option("--max-seconds", verify_.max_seconds, "stop after so long")->check(CLI::Range(0.001, 1e6));
    command->add_option("--max-memory", verify_.max_memory, "stop where replaying takes more MiB (Linux)")
        ->check(CLI::Range(1, 1 << 24));
    command->footer(
        "Exits with the worst: 0 verified, 1 diverged, 2 incompatible, 3 truncated, 4 corrupt, 5 stopped by a limit.");
  }
  void add_diff() {
    CLI::App* command =
        add("diff", "what differs first in two replays, desync bundles or snapshots: frame, stage, field",
            [this] { return tool::command_diff(diff_); });
    command->add_option("a", diff_.a, "a replay, a desync bundle or a portable snapshot")->required();
    command->add_option("b", diff_.b, "another of the same kind; with --stages it may be left out: a once more");
    CLI::Option* stages = command->add_flag("--stages", diff_.stages,
                                            "of replays: look at what every stage leaves, prepared numbers too");
    command->add_option("--prover-a", diff_.prover_a, "command line of a prover that plays a, in place of this program")
        ->needs(stages)
        ->check(refuse_blank, "");
    command->add_option("--prover-b", diff_.prover_b, "the same for b")->needs(stages)->check(refuse_blank, "");
    add_path(command, "--html", diff_.html, "write a page that plays both recordings side by side")->excludes(stages);
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
    CLI::App* command =
        add("rebake", "rewrite the golden hashes, on purpose", [this] { return tool::command_rebake(rebake_); });
    add_path(command, "--dir", rebake_.directory, "where to [the repository]");
    command->add_flag("--recordings", rebake_.record, "instead the self-check's recordings, of this build's behaviour");
    command->footer("./isostep rebake does both, and builds in between: the behaviour is a digest of the lists.");
  }
  void add_selfcheck() {
    CLI::App* command =
        add("selfcheck", "is this build and machine sound", [this] { return tool::command_selfcheck(selfcheck_); });
    command->add_flag("--verbose", selfcheck_.verbose, "a table of what was replayed");
    command->add_flag("--json", selfcheck_.json, "one JSON object");
  }
  void add_peer() {
    CLI::App* command =
        add("peer", "one machine of a match over UDP, played by a bot", [this] { return tool::command_peer(peer_); });
    command->add_option("--listen", peer_.listen, "host on this UDP port (0: any)")->check(CLI::Range(0, 65535));
    command->add_option("--connect", peer_.connect, "HOST:PORT of the host");
    add_path(command, "--port-file", peer_.port_file, "write the host's port here");
    command->add_option("--players", peer_.players, "of the match")->check(CLI::Range(1, 8))->capture_default_str();
    command->add_flag("--spectate", peer_.spectate, "watch; a host that watches is a dedicated one");
    command->add_flag("--lockstep", peer_.lockstep, "wait for inputs instead of guessing them");
    add_scalar(command, peer_.scalar);
    command->add_option("--frames", peer_.frames, "leave when so many are final")
        ->check(CLI::Range(1, 1 << 24))
        ->capture_default_str();
    command->add_option("--window", peer_.window, "frames that may be guessed")
        ->check(CLI::Range(0, 30))
        ->capture_default_str();
    command->add_option("--delay", peer_.delay, "frames that an input waits, at first")
        ->check(CLI::Range(0, 20))
        ->capture_default_str();
    command->add_option("--pile", peer_.pile, "bodies in the arena")->check(CLI::Range(0, 4000))->capture_default_str();
    command->add_option("--match-seed", peer_.match_seed, "of the arena")->capture_default_str();
    command->add_option("--bot", peer_.bot, "seed of this peer's player")->capture_default_str();
    add_path(command, "--inputs", peer_.inputs,
             "inputs instead of the bot's: push_x push_z buttons aim, a line a frame");
    command->add_option(
        "--profile", peer_.profile,
        "what this peer's line does: a name (lan wifi mobile severe ...) or latency=100,jitter=30,loss=5");
    add_path(command, "--hashes", peer_.hashes, "write the hash after each frame");
    add_path(command, "--record", peer_.record, "write a replay");
    add_path(command, "--bundle", peer_.bundle, "on a desync, write what `isostep diff` needs");
    command->add_flag("--trace", peer_.trace, "hash every stage, so that a bundle can name it");
    command->add_option("--fault", peer_.fault, "a drill: before this frame one bit of one body flips on this peer");
    command
        ->add_option("--patience", peer_.patience, "seconds until a silent peer is lost [5], no host is given up [20]")
        ->check(CLI::Range(1, 3600));
    command->add_flag("--json", peer_.json, "one JSON object");
    command->footer("Exits with 0, or 1 after a desync, or 66 when there is no host.");
  }
  void add_relay() {
    CLI::App* command =
        add("relay", "a bad network between real processes", [this] { return tool::command_relay(relay_); });
    command->add_option("--listen", relay_.listen, "UDP port (0: any)")
        ->check(CLI::Range(0, 65535))
        ->capture_default_str();
    command->add_option("--target", relay_.target, "HOST:PORT to which packets go on")->required();
    command->add_option("--profile", relay_.profile, "a name, or items like latency=100,jitter=30,loss=5")
        ->capture_default_str();
    command->add_option("--seed", relay_.seed, "of everything that goes wrong")->capture_default_str();
    add_path(command, "--port-file", relay_.port_file, "write the port here");
  }
  void add_demo() {
    CLI::App* command = add("demo", "a match over a bad line and a few scenes, in every scalar",
                            [this] { return tool::command_demo(demo_); });
    add_path(command, "--out", demo_.out, "keep the recordings in this directory");
  }
  void add_lab() {
    CLI::App* lab =
        app_.add_subcommand("lab", "the cheapest scalar, solver, sub-steps and model that hold a scene's tolerance");
    lab->callback([this, lab] {
      if (!lab->get_subcommands().empty()) return;
      if (lab_.all && lab->count("--limit") == 0) lab_.limit = tool::lab::ReportOptions{}.limit;
      chosen_ = [this] { return tool::command_lab(lab_); };
    });
    lab->require_subcommand(0, 1);
    lab_.tolerance = tool::lab::kDefaultTolerance;
    add_lab_sweep(lab);
    add_lab_report(lab);
    CLI::App* springs = lab->add_subcommand(
        "springs", "stiffness against integrator and scalar: stable, bounded or exploded, energy after 10 s, time");
    springs->callback([this] { chosen_ = [this] { return tool::command_lab_springs(lab_springs_); }; });
    springs->add_flag("--quick", lab_springs_.quick, "fewer stiffnesses, and steps timed once");
    springs->add_option("--out", lab_springs_.out, "write springs.tsv and, by gnuplot, springs.svg here");
    springs->add_flag("--json", lab_springs_.json, "one JSON object");
  }

  void add_lab_report(CLI::App* lab) {
    lab->add_flag("--all", lab_.all, "instead of one scene the report: every scene and trial, report.html in --out");
    lab->add_flag("--short", lab_.is_short, "with --all: a small set of them");
    lab->add_option("--peers", lab_.peers, "with --all: the program that runs other engines (isostep_peers)");
  }
  void add_lab_sweep(CLI::App* lab) {
    lab->add_option("scene", lab_.scene, "a named scene, or a scene file");
    lab->add_option("--tolerance", lab_.tolerance, "5mm, or penetration=2mm,joint=1mm,deviation=5cm,energy=0.1,stands")
        ->capture_default_str();
    lab->add_option("--scalars", lab_.scalars, "with commas between them [all]")
        ->delimiter(',')
        ->allow_extra_args(false);
    lab->add_option("--solvers", lab_.solvers, "[all]")->delimiter(',')->allow_extra_args(false);
    lab->add_option("--models", lab_.models, "rigid, spheres, particles [those that the scene offers]")
        ->delimiter(',')
        ->allow_extra_args(false);
    lab->add_option("--substeps", lab_.substeps, "[1,2,4,8,16,32]")
        ->delimiter(',')
        ->allow_extra_args(false)
        ->check(CLI::Range(1, 64));
    lab->add_option("--hz", lab_.hz, "steps per second [the scene's]")
        ->delimiter(',')
        ->allow_extra_args(false)
        ->check(CLI::Range(10, 1000));
    lab->add_option("--frames", lab_.frames, "at the scene's rate, which other rates match in time [the scene's]")
        ->check(CLI::Range(1, kMostFrames));
    lab->add_option("--limit", lab_.limit, "seconds of CPU time after which a run is given up")
        ->check(CLI::Range(0.01, 1e6))
        ->capture_default_str();
    lab->add_option("--jobs", lab_.jobs, "runs at a time [one a core]")->check(CLI::Range(1, 256));
    lab->add_option("--out", lab_.out, "directory of results.jsonl, where what is done is not done again")
        ->capture_default_str();
    lab->add_flag("--fresh", lab_.fresh, "run again what is done");
    add_path(lab, "--csv", lab_.csv, "write every run as a table");
    lab->add_flag("--json", lab_.json, "one JSON object");
  }

  CLI::App& app_;
  std::function<int()> chosen_;
  tool::ScenesOptions scenes_;
  tool::RunOptions run_;
  tool::VerifyOptions verify_;
  tool::DiffOptions diff_;
  tool::SelftestOptions selftest_;
  tool::RebakeOptions rebake_;
  tool::SelfcheckOptions selfcheck_;
  tool::PeerOptions peer_;
  tool::RelayOptions relay_;
  tool::DemoOptions demo_;
  tool::LabOptions lab_;
  tool::LabSpringsOptions lab_springs_;
};

int fail(int status, std::string message) {
  for (char& c : message) {
    if (c == '\n') c = ' ';
  }
  std::cerr << "isostep: " << message << "\n";
  return status;
}

/// `status`, where all that was printed has arrived.
int delivered(int status) {
  std::cout.flush();
  const bool written = std::cout.good() && std::fflush(stdout) == 0;
  return written ? status : fail(tool::exit_status::kOutput, "standard output cannot be written");
}

int parse_and_run(int argc, const char* const* argv) {
  CLI::App app("Deterministic 3D physics: the same inputs give the same bits.", "isostep");
  CommandLine commands(app);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) return delivered(app.exit(error));
    return fail(tool::exit_status::kUsage, std::string(error.what()) + " (isostep --help)");
  }
  tool::catch_interrupt();
  return delivered(commands.execute());
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
