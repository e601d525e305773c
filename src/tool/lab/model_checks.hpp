// Checks that decide whether bodies may be spheres or particles.
// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "body_facts.hpp"

namespace isostep::tool::lab {

/// One sphere, and nothing else.
bool is_ball(const scenes::SceneBody& body);

/// Returns an empty text, or how far in one another the spheres of equal volume would start where that is more than a
/// tenth of a radius: such a start is another scene, for it bursts.
std::string overlap_of_spheres(const scenes::Scene& scene, const std::vector<BodyFacts>& facts);

}  // namespace isostep::tool::lab
