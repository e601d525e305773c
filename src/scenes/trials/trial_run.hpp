// One judged run of a world of ours, frame by frame.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/world/world.hpp"
#include "trial.hpp"

namespace isostep::scenes {

class TrialRun {
 public:
  /// The scene outlives the run.
  TrialRun(const Trial& trial, const Scene& scene) : trial_(&trial), scene_(&scene), judge_(trial.judge(scene)) {}

  /// The world as the scene was built, then after every step with that step's report.
  template <class S> void see(const World<S>& world, const StepReport& step = {}) {
    if (!step.clean()) ++faults_;
    now_ = sight_of(world, faults_);
    judge_->see(now_);
  }

  const Trial& trial() const { return *trial_; }
  /// The verdict as if the run ended now.
  Verdict verdict() const { return verdict_of(*trial_, *judge_, now_); }
  std::vector<double> outcome() const { return judge_->outcome(); }
  bool over() const { return is_over(*scene_, now_); }

 private:
  const Trial* trial_;
  const Scene* scene_;
  std::unique_ptr<Judge> judge_;
  int faults_ = 0;
  Sight now_;
};

}  // namespace isostep::scenes
