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

/// A record of one of the kinds of ISO_FOR_EACH_RECORD. Its members in a file are the fields of the engine's record:
/// numbers, vectors, rotations, flags; matrices as three rows; bodies as their places in the scene, -1 for none;
/// choices as words.
SceneRecord read_record(const JsonNode& node, const std::string& place, std::size_t bodies);
std::string text_of(const SceneRecord& record);
/// Into a world that has the scene's bodies. Throws SceneError.
template <class S> void add_records(World<S>& world, const Scene& scene, const std::vector<BodyId>& bodies);

#define ISO_EXTERN(S) extern template void add_records<S>(World<S>&, const Scene&, const std::vector<BodyId>&);
ISO_FOR_EACH_SCALAR(ISO_EXTERN)
#undef ISO_EXTERN

}  // namespace isostep::scenes
