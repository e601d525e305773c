// Scenes by name or from files, ready for the laboratory.
// SPDX-License-Identifier: MIT
#include "subject.hpp"

#include "isostep/core/version.hpp"
#include "isostep/state/hash.hpp"
#include "scenes/named.hpp"
#include "scenes/scene_file.hpp"
#include "tool/common/games.hpp"
#include "tool/common/tool.hpp"

namespace isostep::tool::lab {
namespace {

#ifdef ISOSTEP_QUICK_BUILD
constexpr const char* kBuild = "-quick";
#else
constexpr const char* kBuild = "";
#endif

scenes::Scene scene_of(const std::string& name_or_file) {
  if (const auto found = scenes::find_scene(name_or_file)) return *found;
  if (ParticleGames::find(name_or_file))
    throw ToolError(exit_status::kUsage, name_or_file + " is of particles already: the laboratory is for rigid scenes");
  return load_scene_file(name_or_file);
}

std::string digest(const Subject& subject) {
  std::string text = write_scene(subject.scene);
  if (subject.trial != nullptr)
    text += subject.trial->measure + std::string(subject.trial->unit) + std::to_string(subject.trial->bar);
  return hex(behaviour_version()) + "-" + hex(hash_bytes(text.data(), text.size())) + kBuild;
}

}  // namespace

Subject subject_of(const std::string& name_or_file) {
  Subject subject;
  subject.name = name_or_file;
  subject.scene = scene_of(name_or_file);
  subject.trial = scenes::find_trial(name_or_file);
  if (subject.trial != nullptr) {
    subject.spheres.reason = subject.particles.reason = "a trial's figure is of the scene as it is";
  } else {
    try {
      subject.spheres = sphere_model(subject.scene);
      subject.particles = particle_model(subject.scene);
    } catch (const scenes::SceneError& error) {
      fail_scene(name_or_file, error);
    }
  }
  subject.version = digest(subject);
  return subject;
}

const std::string& refusal_of(const Subject& subject, const std::string& model) {
  static const std::string none;
  if (model == "spheres") return subject.spheres.reason;
  return model == "particles" ? subject.particles.reason : none;
}

int frames_at(const scenes::Scene& scene, int frames, int hz) {
  const long long own = frames < 0 ? scene.frames : frames;
  return static_cast<int>((own * hz + scene.hz / 2) / scene.hz);
}

}  // namespace isostep::tool::lab
