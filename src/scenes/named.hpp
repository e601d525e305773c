// The named scenes: benchmarks, and `mixed` for the laws of restoring.
// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <span>
#include <string_view>

#include "scene.hpp"

namespace isostep::scenes {

struct NamedScene {
  const char* name;
  const char* description;
  Scene (*make)();
  bool narrow = true;              // within the range of Q16.16
  const char* left_out = nullptr;  // why this build cannot play it
};
std::span<const NamedScene> named_scenes();
/// Finds one of these, or of the trials (trials/trial.hpp). Nothing for a name that neither has.
std::optional<Scene> find_scene(std::string_view name);
/// Returns false for a scene that is beyond the range of this scalar.
bool is_in_range(std::string_view scene, std::string_view scalar);

// Makers, one file a family.
Scene stack(int boxes);
Scene wall();
Scene pyramid();
Scene pile(int bodies);
/// The pile with hulls in place of other shapes.
Scene hull_pile(int bodies);
Scene rain();
// Terrain scenes: on a mesh, or on a height field.
Scene terrain(bool field);
Scene thin_bodies(bool field);
Scene sliders(bool field);
/// A thousand bodies over the hills, for queries: queries.hpp.
Scene scattered();
/// Scenes in the levels of levels/level.hpp.
Scene town();
Scene yard();
Scene chain(bool hanging);
Scene ragdolls();
/// The ragdolls with cones, twists and hinges that bend as far as a body's do.
Scene limited_ragdolls();
/// 100 of those, each alone 2 m above the floor, tilted by one hundredth of a turn more than the one before.
Scene tilted_ragdolls();
/// Bodies of a ragdoll: its parts follow each other.
inline constexpr std::size_t kRagdollParts = 11;
/// Bullets at a thin wall, a sheet of triangles that faces them, or, with their flag, each at a plate of its own. The
/// wall, sheet or first plate comes first, and each plate before its bullet.
enum class BulletTarget { wall, sheet, plates };
Scene bullets(BulletTarget at);
inline constexpr int kBullets = 1000;
/// [kg] The mass of the n-th bullet.
double bullet_mass(int n);
/// 160 figures of 23 parts with cones and limits fall in a heap on the hills.
Scene figures();
Scene mixer();
Scene mixed();
Scene medley();

/// The n-th body of the mixer, the first 600 inside the drum, later ones created in its middle.
SceneBody mixer_body(int n);
inline constexpr int kMixerBirthsEnd = 600;  // [frames] from then on nobody is replaced

}  // namespace isostep::scenes
