// A scene and its bodies as JSON, for the engines in Node.
// SPDX-License-Identifier: MIT
#pragma once

#include <nlohmann/json.hpp>
#include <vector>

#include "peer_scene.hpp"
#include "scenes/queries.hpp"

namespace isostep::bench {

nlohmann::json json_of(Vec3<double> v);
nlohmann::json json_of(const PeerBody& body);
nlohmann::json json_of(const PeerJoint& joint);
nlohmann::json json_of(const PeerForce& force);
nlohmann::json json_of(const PeerGear& gear);
nlohmann::json json_of(const scenes::DrawnQueries& drawn);
/// Every body has the same friction: then any rule for pairs says the same.
bool is_uniform(const std::vector<PeerBody>& bodies);

}  // namespace isostep::bench
