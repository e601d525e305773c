// One judged run of a world of ours, frame by frame.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/world/world.hpp"
#include "trial.hpp"

namespace isostep::scenes {

class TrialRun {
 public:
  TrialRun(const Trial& trial, const Scene& scene)
      : trial_(&trial), judge_(trial.judge(scene)), seconds_(static_cast<double>(scene.frames) / scene.hz) {}

  /// The world as the scene was built, then after every step with that step's report.
  template <class S> void see(const World<S>& world, const StepReport& step = {}) {
    if (!step.clean()) ++faults_;
    now_ = sight_of(world, faults_);
    judge_->see(now_);
  }

  const Trial& trial() const { return *trial_; }
  /// As if the run ended now.
  Verdict verdict() const { return verdict_of(*trial_, *judge_, now_); }
  /// Whether it has been through all of the trial, whatever the rate of its steps.
  bool over() const { return now_.time > seconds_ - 1e-6; }

 private:
  const Trial* trial_;
  std::unique_ptr<Judge> judge_;
  double seconds_;  // [s] the trial's length
  int faults_ = 0;
  Sight now_;
};

}  // namespace isostep::scenes
