// Records of scenes - forces, pairs of materials, breakable bodies - by the names and fields of the engine's own.
// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <string>
#include <vector>

#include "isostep/world/world.hpp"
#include "json_tree.hpp"
#include "scene.hpp"

namespace isostep::scenes {

/// A record of one of the kinds of ISO_FOR_EACH_RECORD. Its members in a file are the fields of the engine's record
/// and of its input: numbers, vectors, rotations, flags; matrices as three rows; bodies and joints as their places,
/// -1 for none; choices as words.
SceneRecord read_record(const JsonNode& node, const std::string& place, std::size_t bodies, std::size_t joints);
std::string text_of(const SceneRecord& record);
/// The ids in a world of a scene's places.
struct SceneIds {
  const std::vector<BodyId>& bodies;
  const std::vector<JointId>& joints;
};
/// Adds records to a world that has the scene's bodies and joints. Sets inputs of which a field is given. Throws
/// SceneError.
template <class S> void add_records(World<S>& world, const Scene& scene, const SceneIds& ids);

#define ISO_EXTERN(S) extern template void add_records<S>(World<S>&, const Scene&, const SceneIds&);
ISO_FOR_EACH_SCALAR(ISO_EXTERN)
#undef ISO_EXTERN

}  // namespace isostep::scenes
