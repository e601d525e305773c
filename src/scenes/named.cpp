// The list of named scenes, and their variants.
// SPDX-License-Identifier: MIT
#include "named.hpp"

#include "book/book.hpp"
#include "cars.hpp"
#include "peers/peers.hpp"
#include "street.hpp"
#include "trials/trial.hpp"
#include "walkers.hpp"

namespace isostep::scenes {
namespace {

Scene sleeping(Scene scene) {
  scene.allow_sleep = true;
  return scene;
}
Scene small_stack() { return stack(5); }
Scene half_stack() { return stack(10); }
Scene tall_stack() { return stack(20); }
Scene sleeping_stack() { return sleeping(stack(20)); }
Scene full_pile() { return pile(1000); }
Scene small_pile() { return pile(200); }
Scene full_hull_pile() { return hull_pile(1000); }
Scene small_hull_pile() { return hull_pile(200); }
Scene mesh_terrain() { return terrain(false); }
Scene field_terrain() { return terrain(true); }
Scene thin_on_mesh() { return thin_bodies(false); }
Scene thin_on_field() { return thin_bodies(true); }
Scene sliders_on_mesh() { return sliders(false); }
Scene sliders_on_field() { return sliders(true); }
Scene bullets_at_a_wall() { return bullets(BulletTarget::wall); }
Scene bullets_at_a_sheet() { return bullets(BulletTarget::sheet); }
Scene bullets_at_plates() { return bullets(BulletTarget::plates); }
Scene swinging_chain() { return chain(false); }
Scene hanging_chain() { return chain(true); }
Scene sleeping_pyramid() {
  Scene scene = sleeping(pyramid());
  scene.frames = 900;
  return scene;
}

Scene mixed_by(SolverName solver) {
  Scene scene = mixed();
  scene.solver = solver;
  return scene;
}
Scene mixed_pgs() { return mixed_by(SolverName::pgs); }
Scene mixed_worst_first() { return mixed_by(SolverName::worst_first); }
Scene mixed_direct() { return mixed_by(SolverName::direct); }
Scene mixed_avbd() { return mixed_by(SolverName::avbd); }
Scene mixed_admm() { return mixed_by(SolverName::admm); }

Scene right_turn() { return flight(Turn::right); }
Scene left_turn() { return flight(Turn::left); }
Scene under_sail() { return sailing(true); }
Scene becalmed() { return sailing(false); }
Scene crowd_blast() { return blast(500); }
#define ISO_COARSE(name, Structure) \
  Scene coarse_##name() { return coarse(BroadPhaseName::name); }
ISO_FOR_EACH_BROAD_PHASE(ISO_COARSE)
#undef ISO_COARSE
#define ISO_COARSE(name, Structure)                                                             \
  {"coarse_" #name, "bodies near and far, of many sizes, found by " #name, coarse_##name, true, \
   left_out(BroadPhaseName::name)},

constexpr NamedScene kScenes[] = {
    {"S1", "20 unit boxes stacked", tall_stack},
    {"S1x5", "5 unit boxes stacked", small_stack},
    {"S1x10", "10 unit boxes stacked", half_stack},
    {"S1s", "S1 with sleep", sleeping_stack},
    {"S2", "a wall of 210 boxes", wall},
    {"S3", "a square pyramid of 1240 boxes", pyramid},
    {"S4", "1000 boxes, spheres and capsules fall into a pit", full_pile},
    {"S4s", "the first 200 bodies of S4", small_pile},
    {"S5", "4000 spheres fall into a pit", rain},
    {"S6", "a chain of 50 links swings with a heavy ball", swinging_chain},
    {"S6v", "the chain hangs at rest", hanging_chain},
    {"S7", "50 ragdolls fall into a pit", ragdolls},
    {"S8", "S3 with sleep", sleeping_pyramid},
    {"S9", "600 bodies in a turning drum, replaced one by one", mixer},
    {"S10", "1000 hulls fall into a pit", full_hull_pile},
    {"S10s", "the first 200 bodies of S10", small_hull_pile},
    {"S11", "200 hulls, capsules and spheres fall on a mesh of hills", mesh_terrain},
    {"S12", "S11 on a height field", field_terrain},
    {"S14", "1000 bodies hover over the hills, for rays and casts", scattered},
    {"S15", "300 thin boxes fall on the hills", thin_on_mesh, false},
    {"S15h", "S15 on a height field", thin_on_field, false},
    {"S16", "40 bodies slide over a flat mesh", sliders_on_mesh},
    {"S16h", "S16 on a height field", sliders_on_field},
    {"S13", "1000 bullets and spinning rods at a thin wall", bullets_at_a_wall, false},
    {"S13m", "S13 at a sheet of triangles", bullets_at_a_sheet, false},
    {"S13d", "S13 with each at a plate of its own", bullets_at_plates, false},
    {"S17", "64 cars drive, brake and steer", cars},
    {"S18c", "200 characters walk over the pile of S4", walkers},
    {"street", "four cars and four walkers in the town, driven by bots", street, false},
    {"S20", "S7 with the limits of a body's joints", limited_ragdolls},
    {"figures", "160 figures of 23 parts fall in a heap on the hills", figures, false},
    {"large_pyramid", "a triangle of 5050 boxes, a hundred high", large_pyramid, false},
    {"many_pyramids", "196 triangles of 55 boxes", many_pyramids},
    {"convex_pile", "5120 boulders fall in a heap", convex_pile, false},
    {"junkyard", "10 584 rocks in a yard, and a pillar that pushes them around", junkyard, false},
    {"human_rain", "300 figures with springs and friction in their joints fall on rings", human_rain, false},
    {"jolt_pyramid", "a square pyramid of 1240 boxes, half a metre apart", jolt_pyramid},
    {"max_bodies", "131 072 boxes fall in rows", max_bodies},
    {"convex_on_land", "1764 boxes, spheres, capsules and hulls fall on land 300 m wide", convex_on_land, false},
    {"crossers", "100 characters cross a field of crates, stairs and posts", crossers},
    {"trees", "50 trees of 22 hulls fall on a mesh of 30 000 quads", trees, false},
    {"joint_grid", "a curtain of 10 000 balls and 19 700 joints", joint_grid},
    {"washer", "8000 cubes in a drum that turns and has no ends", washer},
    {"large_world", "10 000 tiles, 10 km wide, and 100 balls", large_world, false},
    {"town", "a mesh of streets, houses, stairs, ramps, a hill; who falls, rolls, tumbles, is shot", town, false},
    {"yard", "the same on static hulls, placed by a seed", yard, false},
    {"mixed", "bodies, joints, sensors and sleep, made and destroyed", mixed},
    {"mixed_pgs", "the same, solved by projected Gauss-Seidel", mixed_pgs},
    {"mixed_worst_first", "the same, the worst contact first", mixed_worst_first, true,
     left_out(SolverName::worst_first)},
    {"mixed_direct", "the same, all contacts at once", mixed_direct},
    {"mixed_avbd", "the same, body by body against penalties", mixed_avbd},
    {"mixed_admm", "the same, all contacts at once by splitting", mixed_admm},
    {"flight", "an aircraft flies level and then to the right", right_turn},
    {"flight_left", "flight mirrored", left_turn},
    {"sail", "a boat sails across the wind", under_sail},
    {"becalmed", "the boat without wind", becalmed},
    {"bigballistic", "artillery and pistol rounds at two cubes", ballistics},
    {"explosion", "a charge among five boxes and five balls", rubble},
    {"blast", "a charge among 500 boxes", crowd_blast},
    {"catenary", "50 links hang between two hooks", catenary},
    {"top", "a top spins on its point", top},
    {"hinge", "a door swings on a level hinge", pendulum_door},
    {"piston", "a crank drives a block along a line", piston},
    {"fracture", "a ball breaks a cube in eight, and eight again", broken_cube},
    {"materials", "balls at eight boxes, wood, glass and stone", materials, false},
    {"tower", "a ball at a tower of 100 boxes that break", breakable_tower},
    {"sledges", "sledges along, askew of and across their runners", sledges},
    {"slopes", "crates on slopes of 20, 25 and 30 degrees", slopes},
    ISO_FOR_EACH_BROAD_PHASE(ISO_COARSE){"elements", "the fewest bodies that ask for one of every record", elements},
    {"rolling", "balls roll on, against four resistances", rolling},
    {"medley", "the fewest bodies that ask for every part of the engine", medley},
};

}  // namespace

std::span<const NamedScene> named_scenes() { return kScenes; }

bool is_in_range(std::string_view scene, std::string_view scalar) {
  for (const NamedScene& entry : kScenes) {
    if (scene == entry.name) return entry.narrow || scalar != "q16.16";
  }
  return true;
}
std::optional<Scene> find_scene(std::string_view name) {
  for (const NamedScene& entry : kScenes) {
    if (name != entry.name) continue;
    Scene scene = entry.make();
    scene.name = entry.name;
    return scene;
  }
  if (const Trial* trial = find_trial(name)) {
    Scene scene = trial->make();
    scene.name = trial->name;
    return scene;
  }
  return std::nullopt;
}

}  // namespace isostep::scenes
