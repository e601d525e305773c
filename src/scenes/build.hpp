// The build of a world from a scene: every number enters the scalar once, and a refusal of the world is told with its
// place.
// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "isostep/world/world.hpp"
#include "scene.hpp"

namespace isostep::scenes {

/// The ids in the scene's order.
template <class S> struct Built {
  std::vector<BodyId> bodies;
  std::vector<JointId> joints;
};

/// Throws SceneError when gravity is no number of S, or rates are beyond Settings'.
template <class S> Settings<S> settings_of(const Scene& scene);
/// Builds into a world that is empty. A body's user data is its place in the order of creation, from 1. Throws
/// SceneError.
template <class S> Built<S> build(const Scene& scene, World<S>& world);

/// One body more; `place` is what errors name. Throws SceneError.
template <class S>
BodyId add_body(World<S>& world, const SceneBody& body, std::uint64_t user_data, const std::string& place);
/// The number, or a SceneError.
template <class S> S value_of(const Number& number, const std::string& place);

#define ISO_EXTERN(S)                                                                                 \
  extern template Settings<S> settings_of<S>(const Scene&);                                           \
  extern template Built<S> build<S>(const Scene&, World<S>&);                                         \
  extern template BodyId add_body<S>(World<S>&, const SceneBody&, std::uint64_t, const std::string&); \
  extern template S value_of<S>(const Number&, const std::string&);
ISO_FOR_EACH_SCALAR(ISO_EXTERN)
#undef ISO_EXTERN

}  // namespace isostep::scenes
