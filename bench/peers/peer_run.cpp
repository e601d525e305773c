// A peer's run: times, measures, and the trial's verdict.
// SPDX-License-Identifier: MIT
#include "peer_run.hpp"

#include <algorithm>
#include <cstdio>
#include <limits>

#include "isostep/state/hash.hpp"
#include "scenes/bars.hpp"
#include "scenes/named.hpp"
#include "scenes/published/published.hpp"
#include "scenes/scene_file.hpp"
#include "tool/lab/run_point.hpp"

namespace isostep::bench {
namespace {

using scenes::Scene;
using scenes::Sight;
using tool::lab::LabResult;

constexpr double kFrame = 1.0 / 60;  // [s] of which a record's times are

Scene scene_of(const PeerJob& job) {
  std::optional<Scene> scene = scenes::find_scene(job.scene);
  if (!scene) throw scenes::SceneError("", "no scene " + job.scene);
  return std::move(*scene);
}
/// The scene of the job's rate. A script counts frames, so it has the rate of its scene.
Scene at_rate(const Scene& scene, int hz) {
  if (scene.script != scenes::Script::none && hz != scene.hz) {
    throw scenes::SceneError("", "a scene with a script runs at its own rate of steps");
  }
  Scene made = scene;
  made.frames = tool::lab::frames_at(scene, -1, hz);
  made.hz = hz;
  return made;
}
/// Returns the bars and the measure that a run is held against, as text.
std::string bars_of(const std::string& scene) {
  const scenes::Trial* trial = scenes::find_trial(scene);
  if (trial == nullptr) return "";
  std::string text = to_text(trial->bar) + trial->measure;
  const scenes::PublishedTest* published = scenes::find_published_test(scene);
  if (published == nullptr) return text;
  for (const auto& bar : published->bars) text += std::to_string(bar.hz) + to_text(bar.must) + to_text(bar.aim);
  return text;
}

std::string hash_of(const std::string& text) {
  char digits[17];
  std::snprintf(digits, sizeof digits, "%016llx",
                static_cast<unsigned long long>(hash_bytes(text.data(), text.size())));
  return digits;
}

double per_kilogram(double energy, const Sight& sight) {
  return sight.energy.mass > 0 ? energy / sight.energy.mass : 0;
}

/// The notes of a peer's run.
class Notes {
 public:
  explicit Notes(const Sight& start) : start_(per_kilogram(start.energy.total(), start)) {}

  void see(const Sight& now, bool last_second, LabResult& result) {
    const double total = per_kilogram(now.energy.total(), now);
    result.joint_error = std::max(result.joint_error, now.joint_error);
    result.energy_gain = std::max(result.energy_gain, total - start_);
    result.energy_loss = start_ - total;
    result.faults = now.faults;
    if (!last_second) return;
    unrest_ += per_kilogram(now.energy.kinetic, now);
    result.unrest = unrest_ / ++counted_;
  }

 private:
  double start_, unrest_ = 0;
  int counted_ = 0;
};

/// `times`: [ms] of each step.
void measure_end(const Engine& engine, std::vector<double> times, LabResult& result) {
  if (times.empty()) return;
  for (double& ms : times) ms *= kFrame * result.point.hz;
  result.ms = median(std::vector<double>(times.begin() + static_cast<std::ptrdiff_t>(times.size() / 2), times.end()));
  for (const double ms : times) result.ms_mean += ms / static_cast<double>(times.size());
  try {
    const scenes::Overlap overlap = engine.overlap();
    result.penetration = overlap.worst;
    result.penetration_mean = overlap.mean;
  } catch (const scenes::SceneError&) {  // bodies where no world of ours takes them
    result.penetration = result.penetration_mean = std::numeric_limits<double>::quiet_NaN();
  }
}

/// The scene of now, and its most careful run: of a trial none, for it has a judge.
struct Careful {
  tool::lab::Subject subject;
  tool::lab::Reference reference;
};
const Careful& careful_of(const std::string& scene) {
  static Careful last;
  if (last.subject.name == scene) return last;
  last = {tool::lab::subject_of(scene), {}};
  if (last.subject.trial == nullptr) {
    last.reference = reference_of(last.subject, last.subject.scene.frames, [] { return false; });
  }
  return last;
}

void judge_end(const Careful& careful, const scenes::Judge* judge, const Sight& end, LabResult& result) {
  result.stood = stands(careful.subject, careful.reference, end);
  if (judge == nullptr) return;
  if (careful.subject.trial == nullptr) {
    result.figure = judge->figure();
    return;
  }
  const scenes::Verdict verdict = scenes::verdict_of(*careful.subject.trial, *judge, end);
  result.judged = true;
  result.survived = verdict.survived;
  result.figure = verdict.figure;
  result.outcome = judge->outcome();
}

/// Ends early where numbers are no numbers any more, for nothing that counts comes after.
void run(const PeerJob& job, LabResult& result) {
  const Careful& careful = careful_of(job.scene);  // prepared
  const scenes::Trial* trial = careful.subject.trial;
  const std::unique_ptr<scenes::Judge> judge =
      trial == nullptr ? scenes::benchmark_judge(careful.subject.scene) : trial->judge(careful.subject.scene);
  const Scene scene = at_rate(careful.subject.scene, job.hz);
  const std::unique_ptr<Engine> engine = job.maker.make(scene, {});
  Sight sight = engine->sight();
  Notes notes(sight);
  if (judge) judge->see(sight);
  std::vector<double> times;
  for (int frame = 0; frame < scene.frames && sight.faults == 0; ++frame) {
    engine->before_step(frame);
    times.push_back(engine->timed_steps(1));
    sight = engine->sight();
    notes.see(sight, frame >= scene.frames - scene.hz, result);
    if (judge && sight.faults == 0) judge->see(sight);
    if (frame + 1 == std::min(scene.hz, scene.frames) && careful.reference.exists) {
      result.deviation = tool::lab::deviation_of(sight, careful.reference.second);
    }
  }
  result.frames = static_cast<int>(times.size());
  measure_end(*engine, times, result);
  judge_end(careful, judge.get(), sight, result);
}

}  // namespace

LabRecord empty_record(const PeerJob& job) {
  LabRecord record;
  record.result.point = {job.scene, job.maker.name, "", "", "rigid", job.hz, 0};
  record.result.state = tool::lab::kRefused;
  record.version = "peers 2 " + hash_of(scenes::write_scene(scene_of(job)) + bars_of(job.scene));
  return record;
}

LabRecord lost_record(const PeerJob& job, const std::string& reason) {
  LabRecord record = empty_record(job);
  record.result.reason = reason;
  record.result.judged = scenes::find_trial(job.scene) != nullptr;
  if (record.result.judged) record.result.state = tool::lab::kDone;
  return record;
}

double work_of(const PeerJob& job) {
  const Scene scene = scene_of(job);
  return static_cast<double>(scene.bodies.size() + scene.joints.size()) * tool::lab::frames_at(scene, -1, job.hz);
}

void prepare(const PeerJob& job) { careful_of(job.scene); }

LabRecord run_peer(const PeerJob& job) {
  LabRecord record = empty_record(job);
  try {
    record.result.state = tool::lab::kDone;
    run(job, record.result);
  } catch (const NoAnswer& error) {
    record = empty_record(job);
    record.result.state = tool::lab::kHung;
    record.result.reason = error.what();
  } catch (const Lost& error) {
    record = lost_record(job, error.what());
  } catch (const std::exception& error) {
    record = empty_record(job);
    record.result.reason = error.what();
  }
  return record;
}

}  // namespace isostep::bench
