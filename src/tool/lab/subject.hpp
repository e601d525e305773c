// The subject of a run of the laboratory: a scene with its trial, its simpler models, and the digest by which results
// are known.
// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "models.hpp"
#include "scenes/trials/trial.hpp"

namespace isostep::tool::lab {

struct Subject {
  std::string name;  // of the scene, or its file
  scenes::Scene scene;
  const scenes::Trial* trial = nullptr;
  Offer<scenes::Scene> spheres;
  Offer<ParticlePlan> particles;
  std::string version;  // of the engine's results, of what is run and judged, and of the build's speed
};
inline constexpr const char* kModels[] = {"rigid", "spheres", "particles"};

/// Throws ToolError 64 or 66.
Subject subject_of(const std::string& name_or_file);
/// Returns the reason of a refusal; empty: the model is offered.
const std::string& refusal_of(const Subject& subject, const std::string& model);

/// The frames at a rate that take as long as so many steps at the scene's own rate (-1: as many as the scene has).
int frames_at(const scenes::Scene& scene, int frames, int hz);

}  // namespace isostep::tool::lab
