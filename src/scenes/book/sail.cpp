// The sail simulator: a hull that floats, a sail in the wind, a keel and a rudder in the water.
// SPDX-License-Identifier: MIT
#include "book.hpp"
#include "isostep/math/transform.hpp"
#include "isostep/store/state.hpp"
#include "scenes/build.hpp"
#include "scenes/shapes.hpp"

namespace isostep::scenes {
namespace {

SceneRecord surface(Point at, std::vector<Number> rows) {
  return {"aero_surface", {{"body", {0}}, {"point", {at.x, at.y, at.z}}, {"tensor", std::move(rows)}}};
}

}  // namespace

/// The bow looks along x. The sail stands at 45 degrees, its force is along its own normal: half of what a beam wind
/// gives it drives, half heels. 600 kg on 3 m^2 draw 0.2 m.
Scene sailing(bool wind) {
  Scene scene = awake(3600);
  scene.script = Script::sail;
  SceneBody hull = body_of(box_part({1.5, 0.3, 0.5}), {0, 0.25, 0});
  hull.mass = 600;
  scene.bodies.push_back(hull);
  SceneRecord sail = surface({0.2, 1.2, 0}, {-20, 0, -20, 0, 0, 0, -20, 0, -20});
  SceneRecord bottom = surface({0, -0.25, 0}, {-40, 0, 0, 0, -2000, 0, 0, 0, -100});
  SceneRecord keel = surface({0, -0.6, 0}, {0, 0, 0, 0, 0, 0, 0, 0, -1500});
  SceneRecord rudder = surface({-1.5, -0.4, 0}, {0, 0, 0, 0, 0, 0, 0, 0, -300});
  rudder.fields.push_back({"low", {0, 0, 0, 0, 0, 0, 300, 0, -300}});
  rudder.fields.push_back({"high", {0, 0, 0, 0, 0, 0, -300, 0, -300}});
  for (SceneRecord* const wet : {&bottom, &keel, &rudder}) wet->fields.push_back({"is_under_water", {1}});
  scene.records = {{"water", {{"linear_drag", {0}}, {"angular_drag", {2}}}}, sail, bottom, keel, rudder};
  if (wind) scene.records.push_back({"force_zone", {{"wind", {0, 0, 5}}}});
  return scene;
}

/// Holds the bow along x: the rudder against the heading and its change.
template <class S> void steer(World<S>& world) {
  const RecordStore<S>& records = *world.state().records;
  const auto surfaces = records.aero_surfaces.slot_map().template ids<AeroSurfaceId>();
  const auto bodies = world.state().body_slots.template ids<BodyId>();
  if (surfaces.size() < 4 || bodies.empty()) return;
  const auto number = [](double value) { return value_of<S>(value, "script"); };
  const Mat3<Unit<S>> axes = to_matrix(world.pose(bodies[0]).orientation);
  AeroSurface<S> rudder = *world.find(surfaces[3]);
  // A bow that looks to -z has turned left, about +y.
  const S off = -convert<S>(axes.column(0).z) + world.angular_velocity(bodies[0]).y;
  rudder.control = clamp(off * number(2), number(-1), number(1));
  world.set(surfaces[3], rudder);
}

#define ISO_INSTANTIATE(S) template void steer<S>(World<S>&);
ISO_FOR_EACH_SCALAR(ISO_INSTANTIATE)
#undef ISO_INSTANTIATE

}  // namespace isostep::scenes
