// Scenes as JSON.
// SPDX-License-Identifier: MIT
#include "node_json.hpp"

#include "engine.hpp"

namespace isostep::bench {

using Json = nlohmann::json;

namespace {

using bench::json_of;

Json json_of(Quat<double> q) { return {q.x, q.y, q.z, q.w}; }

/// Heights go by columns.
void add_surface(const PeerSurface& of, Json& json) {
  json["corners"] = of.corners;
  for (const Vec3<double>& point : of.points) json["points"].push_back(json_of(point));
  json["cells"] = {of.rows - 1, of.columns - 1};
  json["size"] = json_of(of.middle() * 2.0);
  Json heights = Json::array();
  for (std::uint32_t i = 0; i < of.columns; ++i) {
    for (std::uint32_t k = 0; k < of.rows; ++k) heights.push_back(of.heights[k * of.columns + i]);
  }
  json["heights"] = std::move(heights);
}
Json json_of(const PeerPart& part) {
  Json points = Json::array();
  for (const Vec3<double>& point : part.points) points.push_back(json_of(point));
  Json json = {{"type", kShapeNames[static_cast<std::size_t>(part.type)]},
               {"points", points},
               {"half_extents", json_of(part.half_extents)},
               {"radius", part.radius},
               {"half_height", part.half_height},
               {"normal", json_of(part.normal)},
               {"offset", part.offset},
               {"position", json_of(part.position)},
               {"orientation", json_of(part.orientation)}};
  if (part.surface != nullptr) add_surface(*part.surface, json);
  return json;
}

Json json_of(const PeerEnd& end) { return {{"anchor", json_of(end.position)}, {"axes", json_of(end.orientation)}}; }
/// A rope may go slack, a rod may not; a servo is a hinge with a spring.
const char* name_of(const PeerJoint& joint) {
  if (JointType::slider < joint.type) throw scenes::SceneError("", "a joint that engines in Node are not asked for");
  if (joint.type == JointType::hinge && joint.is_spring) return "servo";
  if (joint.type != JointType::distance) return kJointNames[static_cast<std::size_t>(joint.type)];
  if (joint.is_spring) return "spring";
  return joint.lower > 0 ? "rod" : "rope";
}

Json json_of(const std::vector<scenes::DrawnLine>& lines) {
  Json json = Json::array();
  for (const auto& [from, way] : lines) json.push_back({from.x, from.y, from.z, way.x, way.y, way.z});
  return json;
}

}  // namespace

Json json_of(Vec3<double> v) { return {v.x, v.y, v.z}; }

Json json_of(const PeerBody& body) {
  const char* type = body.type == BodyType::static_     ? "fixed"
                     : body.type == BodyType::kinematic ? "kinematic"
                                                        : "dynamic";
  Json json = {{"type", type},
               {"position", json_of(body.position)},
               {"orientation", json_of(body.orientation)},
               {"velocity", json_of(body.velocity)},
               {"angular_velocity", json_of(body.angular_velocity)},
               {"mass", body.mass},
               {"inertia", json_of(body.inertia)},
               {"friction", body.friction},
               {"restitution", body.restitution},
               {"gravity_scale", body.gravity_scale},
               {"linear_damping", body.linear_damping},
               {"angular_damping", body.angular_damping},
               {"group", body.group},
               {"collide", body.collide},
               {"fast", body.fast},
               {"parts", Json::array()}};
  for (const PeerPart& part : body.parts) json["parts"].push_back(json_of(part));
  return json;
}

Json json_of(const PeerJoint& joint) {
  return {{"type", name_of(joint)},
          {"rest", joint.rest},
          {"stiffness", joint.stiffness},
          {"damping", joint.damping},
          {"motor", joint.has_motor ? Json{joint.motor_speed, joint.motor_force} : Json()},
          {"limits", joint.is_limited ? Json{joint.lower, joint.upper} : Json()},
          {"a", joint.a},
          {"b", joint.b},
          {"on_a", json_of(joint.on_a)},
          {"on_b", json_of(joint.on_b)},
          {"shortest", joint.lower},
          {"length", joint.upper},
          {"cone", joint.cone},
          {"collide", joint.collide}};
}
Json json_of(const PeerForce& force) { return {{"body", force.body}, {"force", json_of(force.force)}}; }
Json json_of(const PeerGear& gear) {
  return {{"joint_a", gear.joint_a}, {"joint_b", gear.joint_b}, {"ratio_a", gear.ratio_a}, {"ratio_b", gear.ratio_b}};
}
Json json_of(const scenes::DrawnQueries& drawn) {
  return {{"rays", json_of(drawn.rays)},
          {"casts", json_of(drawn.casts)},
          {"list_rays", kListRays},
          {"radius", scenes::kCastRadius},
          {"half_extents", {scenes::kCastHalf.x, scenes::kCastHalf.y, scenes::kCastHalf.z}},
          {"overlap_radius", scenes::kOverlapRadius}};
}

bool is_uniform(const std::vector<PeerBody>& bodies) {
  for (const PeerBody& body : bodies) {
    if (body.friction != bodies.front().friction) return false;
  }
  return true;
}

}  // namespace isostep::bench
