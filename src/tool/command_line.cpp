// The words of the whole tool.
// SPDX-License-Identifier: MIT
#include "command_line.hpp"

#include "isostep/dynamics/projection.hpp"
#include "isostep/dynamics/solver_name.hpp"
#include "isostep/particles/settings.hpp"
#include "tool/bake/commands.hpp"
#include "tool/common/program.hpp"
#include "tool/common/scene_game.hpp"
#include "tool/demo/commands.hpp"
#include "tool/diff/commands.hpp"
#include "tool/lab/commands.hpp"
#include "tool/lab/published/published_report.hpp"
#include "tool/lab/report/report.hpp"
#include "tool/lab/tolerance.hpp"
#include "tool/run/commands.hpp"
#include "tool/verify/commands.hpp"

namespace isostep::tool {
namespace {

class ToolCommands {
 public:
  explicit ToolCommands(CommandLine& line) : line_(line) {
    add_scenes();
    add_run();
    add_bake();
    demo_ = add_demo_commands(line);
    add_diff();
    add_selftest();
    add_regenerate();
    add_lab();
    add_selfcheck();
  }

 private:
  void add_scenes() {
    CLI::App* command = line_.add("scenes", "list the named scenes", [this] { return command_scenes(scenes_); });
    command->add_flag("--json", scenes_.json, "one JSON object");
    CommandLine::add_path(command, "--write", scenes_.write, "write each as a scene file into this directory");
  }
  void add_run() {
    CLI::App* command = line_.add("run", "run a scene and measure it", [this] { return command_run(run_); });
    command->add_option("scene", run_.scene, "a named scene, a scene file, or with --html a recording")->required();
    CommandLine::add_scalar(command, run_.scalar);
    CommandLine::add_frames(command, run_.frames);
    command->add_option("--hz", run_.game.hz, "steps per second [the scene's]")->check(CLI::Range(kLeastHz, kMostHz));
    command->add_option("--substeps", run_.game.substeps, "per step [the scene's]")->check(CLI::Range(1, 64));
    command->add_option("--solver", run_.game.solver, "how contacts are solved [the scene's]")
        ->check(CLI::IsMember(CommandLine::names_in(kSolverNames)));
    command->add_option("--projection", run_.game.projection, "how worst_first ends overlaps [the scene's]")
        ->check(CLI::IsMember(CommandLine::names_in(kProjectionNames)));
    command->add_option("--integrator", run_.game.integrator, "how particles are integrated [the scene's]")
        ->check(CLI::IsMember(CommandLine::names_in(kIntegratorNames)));
    command->add_option("--stepping", run_.game.stepping, "how particles' sub-steps end [the scene's]")
        ->check(CLI::IsMember(CommandLine::names_in(kSteppingNames)));
    command->add_option("--threads", run_.threads, "that share the work; never changes a bit")
        ->check(CLI::Range(1, 64))
        ->capture_default_str();
    command->add_option("--simd", run_.simd, "lanes to use, or the widest narrower ones; never changes a bit")
        ->check(CLI::IsMember(CommandLine::names_in(kSimdNames)))
        ->capture_default_str();
    command->add_option("--broad-phase", run_.broad_phase, "how rigid bodies find each other; never changes a bit")
        ->check(CLI::IsMember(CommandLine::names_in(kBroadPhaseNames)))
        ->capture_default_str();
    CommandLine::add_path(command, "--load", run_.load, "begin with this portable snapshot");
    CommandLine::add_path(command, "--save", run_.save, "write a portable snapshot of the end");
    CommandLine::add_path(command, "--record", run_.record, "write a replay");
    CommandLine::add_path(command, "--hashes", run_.hashes, "write the hash after each frame");
    CommandLine::add_path(command, "--dump", run_.dump, "write the last frame's bodies as JSON");
    CLI::Option* html =
        CommandLine::add_path(command, "--html", run_.html, "write a page that plays the run in a browser");
    command->add_option("--html-every", run_.html_every, "steps from one frame of the page to the next")
        ->check(CLI::Range(1, CommandLine::kMostFrames))
        ->needs(html)
        ->capture_default_str();
    CLI::Option* beside = command->add_option("--beside", run_.beside, "play the run in this number type beside it")
                              ->check(CLI::IsMember(scalar_names()))
                              ->needs(html);
    command->add_option("--beside-tolerance", run_.beside_tolerance, "metres beyond which a body has parted")
        ->check(CommandLine::number_between(0.001, 1000.0))
        ->needs(beside)
        ->capture_default_str();
    command->add_flag("--json", run_.json, "one JSON object");
  }
  void add_bake() {
    CLI::App* command = line_.add("bake", "turn a file of polygons into a blob that scenes load",
                                  [this] { return command_bake(bake_); });
    command->add_option("file", bake_.file, "OBJ, glTF, or another format that assimp reads")->required();
    CommandLine::add_path(command, "-o,--out", bake_.out, "the blob's file")->required();
    command->add_option("--as", bake_.as, "a static surface, or a convex body")
        ->check(CLI::IsMember(std::vector<std::string>{"mesh", "hull"}))
        ->capture_default_str();
    command->add_option("--object", bake_.object, "bake the faces of this object alone [all]");
    command->add_option("--scale", bake_.scale, "metres that a unit of the file is")
        ->check(CommandLine::number_between(1e-9, 1e9))
        ->capture_default_str();
    command->add_option("--up", bake_.up, "the axis of the file that points up")
        ->check(CLI::IsMember(std::vector<std::string>{"y", "z"}))
        ->capture_default_str();
    command->add_option("--exponent", bake_.exponent, "round to steps of 2^-N m [the finest that hold all]")
        ->check(CLI::Range(0, 16));
    command->add_option("--points", bake_.points, "of a hull, at most: those that reach furthest [all]")
        ->check(CLI::Range(4, 128));
    command->add_flag("--json", bake_.json, "one JSON object");
  }
  void add_diff() {
    CLI::App* command =
        line_.add("diff", "what differs first in two replays, desync bundles or snapshots: frame, stage, field",
                  [this] { return command_diff(diff_); });
    command->add_option("a", diff_.a, "a replay, a desync bundle or a portable snapshot")->required();
    command->add_option("b", diff_.b, "another of the same kind; with --stages it may be left out: a once more");
    CLI::Option* stages = command->add_flag("--stages", diff_.stages,
                                            "of replays: look at what every stage leaves, prepared numbers too");
    command->add_option("--prover-a", diff_.prover_a, "command line of a prover that plays a, in place of this program")
        ->needs(stages)
        ->check(CommandLine::refuse_blank, "");
    command->add_option("--prover-b", diff_.prover_b, "the same for b")
        ->needs(stages)
        ->check(CommandLine::refuse_blank, "");
    CommandLine::add_path(command, "--html", diff_.html, "write a page that plays both recordings side by side")
        ->excludes(stages);
  }
  void add_selftest() {
    CLI::App* command =
        line_.add("selftest", "the law of restoring, at every frame", [this] { return command_selftest(selftest_); });
    command->add_option("scene", selftest_.scene, "a named scene, or a scene file")->required();
    CommandLine::add_scalar(command, selftest_.scalar);
    CommandLine::add_frames(command, selftest_.frames);
    command->add_option("--solver", selftest_.game.solver, "how contacts are solved [the scene's]")
        ->check(CLI::IsMember(CommandLine::names_in(kSolverNames)));
    command->add_option("--rollback", selftest_.rollback, "frames run again after a load")
        ->check(CLI::Range(1, 10000))
        ->capture_default_str();
    command->add_option("--every", selftest_.every, "frames from one save to the next")
        ->check(CLI::Range(1, CommandLine::kMostFrames))
        ->capture_default_str();
  }
  void add_regenerate() {
    CLI::App* command = line_.add("regenerate", "rewrite the golden hashes, on purpose",
                                  [this] { return command_regenerate(regenerate_); });
    CommandLine::add_path(command, "--dir", regenerate_.directory, "where to [the repository]");
    command->add_flag("--recordings", regenerate_.record,
                      "instead the self-check's recordings, of this build's behaviour");
    command->footer("./isostep regenerate does both, and builds in between: the behaviour is a digest of the goldens.");
  }
  void add_lab() {
    CLI::App* lab = line_.app().add_subcommand(
        "lab", "the cheapest scalar, solver, sub-steps and model that hold a scene's tolerance");
    lab->callback([this, lab] {
      if (!lab->get_subcommands().empty()) return;
      line_.choose([this] { return command_lab(lab_); });
    });
    lab->require_subcommand(0, 1);
    lab_.tolerance = lab::kDefaultTolerance;
    const std::vector<CLI::Option*> of_one_scene = add_lab_sweep(lab);
    add_lab_shared(lab);
    add_lab_report(lab, of_one_scene);
    CLI::App* springs = lab->add_subcommand(
        "springs", "stiffness against integrator and scalar: stable, bounded or exploded, energy after 10 s, time");
    springs->callback([this] { line_.choose([this] { return command_lab_springs(lab_springs_); }); });
    springs->add_flag("--quick", lab_springs_.quick, "fewer stiffnesses, and steps timed once");
    springs->add_option("--out", lab_springs_.out, "write springs.tsv and, by gnuplot, springs.svg here");
    springs->add_flag("--json", lab_springs_.json, "one JSON object");
  }

  /// The two reports, which take the place of `of_one_scene`, and what is of them alone.
  void add_lab_report(CLI::App* lab, const std::vector<CLI::Option*>& of_one_scene) {
    CLI::Option* const all = lab->add_flag(
        "--all", lab_.all, "instead of one scene the report: every scene and trial, report.html in --out");
    CLI::Option* const published =
        lab->add_flag("--published", lab_.published, "instead of one scene the published comparisons, repeated");
    all->excludes(published);
    for (CLI::Option* const option : of_one_scene) {
      all->excludes(option);
      published->excludes(option);
    }
    CLI::Option* const is_short =
        lab->add_flag("--short", lab_.is_short, "with --all or --published: a small set of them");
    lab->add_flag("--full", lab_.full, "with --published: steps below a millisecond too")
        ->needs(published)
        ->excludes(is_short);
    lab->add_option("--peers", lab_.peers, "with --all or --published: the program that runs other engines");
  }
  /// The options that say which runs of one scene, and how they are printed.
  std::vector<CLI::Option*> add_lab_sweep(CLI::App* lab) {
    const auto list = [lab](const char* name, auto& values, const char* text) {
      return lab->add_option(name, values, text)->delimiter(',')->allow_extra_args(false);
    };
    return {
        lab->add_option("scene", lab_.scene, "a named scene, or a scene file"),
        lab->add_option("--tolerance", lab_.tolerance,
                        "5mm, or penetration=2mm,joint=1mm,deviation=5cm,energy=0.1,stands")
            ->capture_default_str(),
        list("--scalars", lab_.scalars, "with commas between them [all]"),
        list("--solvers", lab_.solvers, "[all]"),
        list("--models", lab_.models, "rigid, spheres, particles [those that the scene offers]"),
        list("--substeps", lab_.substeps, "[1,2,4,8,16,32]")->check(CLI::Range(1, 64)),
        list("--hz", lab_.hz, "steps per second [the scene's]")->check(CLI::Range(kLeastHz, kMostHz)),
        lab->add_option("--frames", lab_.frames, "at the scene's rate, which other rates match in time [the scene's]")
            ->check(CLI::Range(1, CommandLine::kMostFrames)),
        CommandLine::add_path(lab, "--csv", lab_.csv, "write every run as a table"),
        lab->add_flag("--json", lab_.json, "one JSON object"),
    };
  }
  void add_lab_shared(CLI::App* lab) {
    lab->add_option("--limit", lab_.limit, "millions of body sub-steps: a longer run is left out")
        ->check(CommandLine::number_between(1e-3, 1e9))
        ->capture_default_str();
    lab->add_option("--jobs", lab_.jobs, "runs at a time [one a core]")->check(CLI::Range(1, 256));
    lab->add_option("--out", lab_.out, "directory of results.jsonl, where what is done is not done again")
        ->capture_default_str();
    lab->add_flag("--fresh", lab_.fresh, "run again what is done");
  }
  void add_selfcheck() {
    CLI::App* command =
        line_.add("selfcheck", "is this build and machine sound", [this] { return command_selfcheck(selfcheck_); });
    command->add_flag("--verbose", selfcheck_.verbose, "a table of what was replayed");
    command->add_flag("--json", selfcheck_.json, "one JSON object");
  }

  CommandLine& line_;
  std::shared_ptr<void> demo_;
  ScenesOptions scenes_;
  RunOptions run_;
  BakeOptions bake_;
  DiffOptions diff_;
  SelftestOptions selftest_;
  RegenerateOptions regenerate_;
  SelfcheckOptions selfcheck_;
  LabOptions lab_;
  LabSpringsOptions lab_springs_;
};

}  // namespace

int run_command_line(int argc, const char* const* argv) {
  return run_program(argc, argv, [](CommandLine& line) { return std::make_shared<ToolCommands>(line); });
}

}  // namespace isostep::tool
