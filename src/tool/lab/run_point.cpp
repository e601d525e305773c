// Runs: a world stepped, timed and measured until its end.
// SPDX-License-Identifier: MIT
#include "run_point.hpp"

#include <algorithm>
#include <cmath>
#include <memory>

#include "articulated_run.hpp"
#include "median.hpp"
#include "particle_run.hpp"
#include "rigid_run.hpp"
#include "scenes/bars.hpp"
#include "tool/common/tool.hpp"
#include "work.hpp"

namespace isostep::tool::lab {
namespace {

constexpr double kStanding = 0.4;  // [1] of a radius of equal volume: a quarter of a box
constexpr int kReferenceSubsteps = 64;

double mean(const std::vector<double>& values) {
  double sum = 0;
  for (const double value : values) sum += value;
  return values.empty() ? 0 : sum / static_cast<double>(values.size());
}

/// The way of a body that is there from its start, in radii of a sphere of its volume.
double way_of(const Subject& subject, const scenes::Sight& start, const scenes::Sight& now, std::size_t i) {
  const Vec3<double> way = now.bodies[i].centre - start.bodies[i].centre;
  return length_of(way) / facts_of(subject.scene.bodies[i]).radius;
}

/// Watches one run, frame by frame.
template <class Run> class Watch {
 public:
  Watch(Run& run, const Subject& subject, const LabPoint& point, const Reference& reference, int frames)
      : run_(run), subject_(subject), reference_(reference), frames_(frames) {
    result_.point = point;
    start_ = run.energy();
    judge_ = subject.trial != nullptr ? subject.trial->judge(subject.scene) : scenes::benchmark_judge(subject.scene);
    if (judge_) judge_->see(run.sight(0));
  }

  LabResult run(const Cancel& cancel) {
    for (int frame = 0; frame < frames_; ++frame) {
      if (cancel()) throw Cancelled{};
      step();
      observe(frame);
    }
    finish();
    return result_;
  }

 private:
  void step() {
    run_.prepare();
    const double before = thread_milliseconds();
    const bool mended = run_.step();
    const double taken = thread_milliseconds() - before;
    ms_.push_back(taken * result_.point.hz / 60);
    result_.faults += mended ? 1 : 0;
  }
  void observe(int frame) {
    const scenes::Energy energy = run_.energy();
    gain_ = std::max(gain_, energy.total() - start_.total());
    if (frame >= frames_ - result_.point.hz) unrest_.push_back(energy.kinetic);
    result_.joint_error = std::max(result_.joint_error, run_.joint_error());
    if (judge_) judge_->see(run_.sight(result_.faults));
    const int second = std::min(result_.point.hz, frames_);
    if (frame + 1 == second && reference_.exists)
      result_.deviation = deviation_of(run_.sight(result_.faults), reference_.second);
  }
  void finish() {
    result_.frames = static_cast<int>(ms_.size());
    result_.ms_mean = mean(ms_);
    result_.ms = median({ms_.begin() + static_cast<std::ptrdiff_t>(ms_.size() / 2), ms_.end()});
    const scenes::Overlap overlap = run_.overlap();
    result_.penetration = overlap.worst;
    result_.penetration_mean = overlap.mean;
    const scenes::ContactResiduals residuals = run_.residuals();
    result_.signorini = residuals.signorini;
    result_.coulomb = residuals.coulomb;
    result_.dissipation = residuals.dissipation;
    const double mass = start_.mass > 0 ? start_.mass : 1;
    const scenes::Sight end = run_.sight(result_.faults);
    result_.energy_gain = gain_ / mass;
    result_.energy_loss = (start_.total() - end.energy.total()) / mass;
    result_.unrest = mean(unrest_) / mass;
    result_.stood = stands(subject_, reference_, end);
    if (!judge_) return;
    if (subject_.trial == nullptr) {
      result_.figure = judge_->figure();
      return;
    }
    if (!scenes::is_over(subject_.scene, end)) return;
    const scenes::Verdict verdict = verdict_of(*subject_.trial, *judge_, end);
    result_.judged = true;
    result_.survived = verdict.survived;
    result_.figure = verdict.figure;
    result_.outcome = judge_->outcome();
  }

  Run& run_;
  const Subject& subject_;
  const Reference& reference_;
  int frames_;
  std::unique_ptr<scenes::Judge> judge_;
  LabResult result_;
  scenes::Energy start_;
  double gain_ = 0;  // [J]
  std::vector<double> ms_, unrest_;
};

template <class Run>
LabResult watch(const Subject& subject, const LabPoint& point, const Reference& reference, int frames,
                const Cancel& cancel) {
  Run run(subject, point);
  return Watch<Run>(run, subject, point, reference, frames).run(cancel);
}

/// The bodies that are where they began, as far as that is asked of anything.
std::vector<std::size_t> standing_in(const Subject& subject, const scenes::Sight& start, const scenes::Sight& now,
                                     const std::vector<std::size_t>& candidates) {
  std::vector<std::size_t> standing;
  for (const std::size_t i : candidates) {
    if (way_of(subject, start, now, i) <= kStanding) standing.push_back(i);
  }
  return standing;
}
/// Trials have judges; scripts destroy bodies and make others; what joints hold is judged by their error.
std::vector<std::size_t> may_stand(const Subject& subject) {
  if (subject.trial != nullptr || subject.scene.script != scenes::Script::none) return {};
  std::vector<bool> free(subject.scene.bodies.size());
  for (std::size_t i = 0; i < free.size(); ++i) free[i] = subject.scene.bodies[i].type == BodyType::dynamic;
  for (const scenes::SceneJoint& joint : subject.scene.joints) {
    for (const int body : {joint.a, joint.b}) {
      if (body >= 0) free[static_cast<std::size_t>(body)] = false;
    }
  }
  std::vector<std::size_t> bodies;
  for (std::size_t i = 0; i < free.size(); ++i) {
    if (free[i]) bodies.push_back(i);
  }
  return bodies;
}

template <class S>
LabResult run_in(const Subject& subject, const LabPoint& point, const Reference& reference, int frames,
                 const Cancel& cancel) {
  if (point.model == kArticulation) {
    if constexpr (std::same_as<Finer<S>, S>) return watch<ArticulatedRun<S>>(subject, point, reference, frames, cancel);
    else throw scenes::SceneError("", std::string("an articulation has too few bits in ") + ScalarTraits<S>::kName);
  }
  return point.model == "particles" ? watch<ParticleRun<S>>(subject, point, reference, frames, cancel)
                                    : watch<RigidRun<S>>(subject, point, reference, frames, cancel);
}

bool nothing_collides(const scenes::Scene& scene) {
  return std::none_of(scene.bodies.begin(), scene.bodies.end(),
                      [](const scenes::SceneBody& body) { return body.type == BodyType::dynamic && body.collide; });
}

template <class S> Reference reference_in(const Subject& subject, int frames, const Cancel& cancel) {
  Reference reference;
  reference.point = reference_point(subject);
  const int second = std::min(subject.scene.hz, frames);
  if (work_of(subject, reference.point, second) > kReferenceLimit) return reference;
  RigidRun<S> run(subject, reference.point);
  reference.start = run.sight(0);
  if (work_of(subject, reference.point, frames) <= kReferenceLimit) reference.standing = may_stand(subject);
  int faults = 0;
  for (int frame = 0; frame < frames && (frame < second || !reference.standing.empty()); ++frame) {
    if (cancel()) throw Cancelled{};
    run.prepare();
    faults += run.step() ? 1 : 0;
    if (frame + 1 != second && frame + 1 != frames) continue;
    const scenes::Sight now = run.sight(faults);
    if (frame + 1 == second) {
      reference.second = now;
      reference.exists = faults == 0;
    }
    reference.standing = standing_in(subject, reference.start, now, reference.standing);
  }
  if (!reference.exists || faults != 0) reference.standing.clear();
  return reference;
}

}  // namespace

double deviation_of(const scenes::Sight& a, const scenes::Sight& b) {
  if (a.bodies.size() != b.bodies.size()) return -1;
  double sum = 0, count = 0;
  for (std::size_t i = 0; i < a.bodies.size(); ++i) {
    if (!b.bodies[i].dynamic) continue;
    const Vec3<double> way = a.bodies[i].centre - b.bodies[i].centre;
    sum += dot(way, way);
    count += 1;
  }
  return count > 0 ? std::sqrt(sum / count) : -1;
}

bool stands(const Subject& subject, const Reference& reference, const scenes::Sight& end) {
  return std::all_of(reference.standing.begin(), reference.standing.end(),
                     [&](std::size_t i) { return way_of(subject, reference.start, end, i) <= kStanding; });
}

LabPoint reference_point(const Subject& subject) {
  const bool direct = !subject.scene.joints.empty() && nothing_collides(subject.scene);
  const SolverName solver = direct ? SolverName::direct : SolverName::soft_step;
  const int substeps = std::min(kReferenceSubsteps, kMaxRate / subject.scene.hz);
  return {subject.name,
          kOwnEngine,
          ScalarTraits<double>::kName,
          kSolverNames[static_cast<std::uint32_t>(solver)],
          "rigid",
          subject.scene.hz,
          substeps};
}

Reference reference_of(const Subject& subject, int frames, const Cancel& cancel) {
  Reference reference;
  try {
    with_scalar(ScalarTraits<double>::kName,
                [&](auto tag) { reference = reference_in<typename decltype(tag)::Type>(subject, frames, cancel); });
  } catch (const scenes::SceneError&) {
    return {};
  }
  return reference;
}

LabResult run_point(const Subject& subject, const LabPoint& point, const Reference& reference, int frames,
                    const Cancel& cancel) {
  LabResult result;
  result.point = point;
  result.state = kRefused;
  result.reason = refusal_of(subject, point.model);
  if (!result.reason.empty()) return result;
  result.reason = "this build has no scalar " + point.scalar;
  try {
    with_scalar(point.scalar, [&](auto tag) {
      result = run_in<typename decltype(tag)::Type>(subject, point, reference, frames, cancel);
    });
  } catch (const scenes::SceneError& error) {
    result.reason = error.what();
  }
  return result;
}

}  // namespace isostep::tool::lab
