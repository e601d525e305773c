// Queries, events and shapes in C tell what the same world tells in C++.
// SPDX-License-Identifier: MIT
#include <limits>

#include "c/convert.hpp"
#include "game.hpp"
#include "isostep/world/world.hpp"

namespace isostep::test {
namespace queries_test {

using namespace isostep::c;
using S = Q32_32;

/// The world of a game in C++.
World<S> in_cpp(Q32Game& game) {
  const std::vector<std::uint8_t> state =
      bytes_of([&](void* to, std::size_t* size) { return iso_world_write(game.world, to, size); });
  World<S> world;
  Reader reader(state);
  EXPECT_TRUE(world.read_portable(reader).ok());
  EXPECT_EQ(world.hash(), iso_world_hash(game.world));
  return world;
}
template <class InC, class Cpp> void expect_same(const InC& in_c, const Cpp& cpp) {
  InC expected;
  static_assert(sizeof expected == extent_of<Cpp>().size);
  put_plain(&expected, cpp);
  EXPECT_EQ(std::memcmp(&in_c, &expected, sizeof expected), 0);
}

TEST(CQueries, AreThoseOfCpp) {
  Q32Game game;
  game.step(40);
  const World<S> cpp = in_cpp(game);
  iso_q32_ray_cast ray;
  iso_q32_ray_cast_init(&ray);
  ray.origin.y = Q32Game::whole(9);
  ray.translation.y = Q32Game::whole(-20);
  iso_q32_ray_hit hit, all[8];
  std::uint8_t found = 0;
  ASSERT_EQ(iso_q32_cast_ray(game.world, &ray, &hit, &found), ISO_OK);
  ASSERT_EQ(found, 1);
  EXPECT_EQ(hit.body, game.lid);
  expect_same(hit, *cpp.cast_ray({S(0), S(9), S(0)}, {S(0), S(-20), S(0)}));
  std::size_t count = 0;
  ASSERT_EQ(iso_q32_cast_ray_all(game.world, &ray, all, 8, &count), ISO_OK);
  EXPECT_EQ(count, 3u);
  ASSERT_EQ(iso_q32_cast_ray_all(game.world, &ray, all, 1, &count), ISO_SMALL_BUFFER);
  EXPECT_EQ(count, 3u);
  expect_same(all[0], *cpp.cast_ray({S(0), S(9), S(0)}, {S(0), S(-20), S(0)}));
  // The filter's list: without the lid the crate is first.
  const iso_body ignored[] = {game.lid, 0};
  ray.filter.ignore_all.at = ignored;
  ray.filter.ignore_all_count = 2;
  ASSERT_EQ(iso_q32_cast_ray(game.world, &ray, &hit, &found), ISO_OK);
  EXPECT_EQ(hit.body, game.crate);

  iso_q32_ray_cast rays[2] = {ray, ray};
  rays[1].origin.x = Q32Game::whole(40);
  iso_q32_ray_hit hits[4];
  ASSERT_EQ(iso_q32_cast_rays(game.world, rays, 2, hits, 2), ISO_OK) << iso_last_error();
  EXPECT_EQ(hits[0].body, game.crate);
  EXPECT_EQ(hits[1].body, game.ground);
  EXPECT_EQ(hits[2].body, 0u);
  rays[1].size -= 8;
  EXPECT_EQ(iso_q32_cast_rays(game.world, rays, 2, hits, 2), ISO_WRONG_SIZE);
  ray.origin.y = std::numeric_limits<std::int64_t>::max();
  EXPECT_EQ(iso_q32_cast_ray(game.world, &ray, &hit, &found), ISO_FAULT_OUT_OF_RANGE);
  EXPECT_EQ(iso_q32_cast_ray(game.world, &ray, &hit, &found), ISO_FAULT_OUT_OF_RANGE) << "the same fault once more";

  iso_q32_sphere ball;
  iso_q32_sphere_init(&ball);
  ball.radius = Q32Game::half();
  iso_q32_overlap_query near;
  iso_q32_overlap_query_init(&near);
  ASSERT_EQ(iso_q32_sphere_primitive(&ball, &near.primitive), ISO_OK);
  near.pose.position.y = Q32Game::whole(1);
  iso_overlap_hit overlaps[4];
  ASSERT_EQ(iso_q32_overlap_shape(game.world, &near, overlaps, 4, &count), ISO_OK);
  std::vector<OverlapHit> expected;
  cpp.overlap_shape(Sphere<S>{S(0.5)}.primitive(), {{S(0), S(1), S(0)}, Quat<Unit<S>>::identity()}, expected);
  ASSERT_EQ(count, expected.size());
  ASSERT_GT(count, 0u);
  for (std::size_t i = 0; i < count; ++i) expect_same(overlaps[i], expected[i]);

  iso_q32_point_query point;
  iso_q32_point_query_init(&point);
  point.point.y = Q32Game::whole(8);
  point.max_distance = Q32Game::whole(10);
  iso_q32_closest_body closest;
  ASSERT_EQ(iso_q32_closest_point(game.world, &point, &closest, &found), ISO_OK);
  ASSERT_EQ(found, 1);
  expect_same(closest, *cpp.closest_point({S(0), S(8), S(0)}, S(10)));
}

TEST(CQueries, EventsComeAsArrays) {
  Q32Game game;
  std::size_t begins = 0, slept = 0, count = 0;
  std::int64_t hardest = 0;
  for (int i = 0; i < 600; ++i) {
    game.step(1);
    const iso_q32_contact_begin* touches = nullptr;
    ASSERT_EQ(iso_q32_contact_begins(game.world, &touches, &count), ISO_OK);
    begins += count;
    for (std::size_t k = 0; k < count; ++k) {
      EXPECT_TRUE(iso_body_exists(game.world, touches[k].a));
      if (touches[k].impulse > hardest) hardest = touches[k].impulse;
    }
    const iso_body* asleep = nullptr;
    ASSERT_EQ(iso_fell_asleep(game.world, &asleep, &count), ISO_OK);
    slept += count;
  }
  EXPECT_GT(begins, 0u);
  EXPECT_GT(hardest, Q32Game::whole(1));
  EXPECT_EQ(slept, 2u);
  const iso_render_pose* poses = nullptr;
  ASSERT_EQ(iso_world_poses(game.world, 0.5f, &poses, &count), ISO_OK);
  EXPECT_EQ(iso_world_poses(game.world, 2.0f, &poses, &count), ISO_FAULT_BAD_ARGUMENT);
  iso_world_counts counts;
  iso_world_counts_init(&counts);
  ASSERT_EQ(iso_world_get_counts(game.world, &counts), ISO_OK);
  EXPECT_EQ(counts.asleep, 2u);
  EXPECT_EQ(counts.joints, 1u);
}

TEST(CShapes, AreBakedAddedAndChanged) {
  Q32Game game;
  const double heights[9] = {0, 0, 0, 0, 0.25, 0, 0, 0, 0};
  iso_height_sheet sheet;
  iso_height_sheet_init(&sheet);
  sheet.columns = sheet.rows = 3;
  sheet.heights.at = heights;
  iso_blob *field = nullptr, *again = nullptr, *hull = nullptr;
  ASSERT_EQ(iso_blob_create_height_field(&sheet, nullptr, ISO_BLOB_HOME_CARRIED, &field), ISO_OK) << iso_last_error();
  const std::vector<std::uint8_t> file =
      bytes_of([&](void* to, std::size_t* size) { return iso_blob_write(field, to, size); });
  ASSERT_EQ(iso_blob_read(file.data(), file.size(), ISO_BLOB_HOME_CARRIED, &again), ISO_OK) << iso_last_error();
  std::uint64_t low = 0, high = 0, low_again = 0, high_again = 1;
  ASSERT_EQ(iso_blob_get_name(field, &low, &high), ISO_OK);
  ASSERT_EQ(iso_blob_get_name(again, &low_again, &high_again), ISO_OK);
  EXPECT_EQ(low, low_again);
  EXPECT_EQ(high, high_again);
  EXPECT_EQ(iso_blob_read(file.data(), file.size() - 1, ISO_BLOB_HOME_CARRIED, &hull), ISO_CORRUPT);
  iso_shape shape = 0;
  ASSERT_EQ(iso_add_blob(game.world, again, &shape), ISO_OK) << iso_last_error();
  EXPECT_EQ(iso_blob_destroy(field), ISO_OK);
  EXPECT_EQ(iso_blob_destroy(again), ISO_OK);

  iso_height_patch patch;
  iso_height_patch_init(&patch);
  patch.column = patch.row = 1;
  patch.columns = patch.rows = 1;
  const std::int16_t lower[] = {5};
  patch.heights.at = lower;
  ASSERT_EQ(iso_set_heights(game.world, shape, 0, &patch), ISO_OK) << iso_last_error();
  iso_height_grid grid;
  iso_height_grid_init(&grid);
  const std::int16_t* now = nullptr;
  const std::uint8_t* materials = nullptr;
  ASSERT_EQ(iso_get_heights(game.world, shape, 0, &grid, &now, &materials), ISO_OK);
  EXPECT_EQ(grid.columns, 3u);
  EXPECT_EQ(now[4], 5);
  patch.columns = 9;
  EXPECT_GT(iso_set_heights(game.world, shape, 0, &patch), 0);

  const std::int64_t one = Q32Game::whole(1);
  const iso_q32_vec3 points[] = {{0, 0, 0}, {one, 0, 0}, {0, one, 0}, {0, 0, one}};
  EXPECT_EQ(iso_q32_blob_create_hull(points, 3, ISO_BLOB_HOME_CARRIED, &hull), ISO_FAULT_BAD_SHAPE);
  ASSERT_EQ(iso_q32_blob_create_hull(points, 4, ISO_BLOB_HOME_CARRIED, &hull), ISO_OK) << iso_last_error();
  iso_q32_child parts[2] = {};
  parts[0].primitive.type = ISO_SHAPE_TYPE_HULL;
  parts[0].primitive.blob = 1;
  parts[0].pose.orientation.w = iso_q32_unit_from_double(1);
  iso_q32_sphere ball;
  iso_q32_sphere_init(&ball);
  ball.radius = Q32Game::half();
  ASSERT_EQ(iso_q32_sphere_primitive(&ball, &parts[1].primitive), ISO_OK);
  parts[1].pose = parts[0].pose;
  const iso_blob* const blobs[] = {hull};
  ASSERT_EQ(iso_q32_add_compound(game.world, parts, 2, blobs, 1, &game.box), ISO_OK) << iso_last_error();
  const iso_body made = game.create(20, ISO_BODY_TYPE_DYNAMIC);
  iso_q32_child told[2];
  std::size_t count = 0;
  ASSERT_EQ(iso_q32_body_get_children(game.world, made, told, 2, &count), ISO_OK);
  EXPECT_EQ(count, 2u);
  EXPECT_EQ(told[1].primitive.radius, Q32Game::half());
  EXPECT_GT(iso_q32_add_compound(game.world, parts, 2, nullptr, 0, &shape), 0) << "a blob that nobody brings";
  EXPECT_EQ(iso_blob_destroy(hull), ISO_OK);
}

TEST(CShapes, AMeshHasMaterialsOfItsOwn) {
  Q32Game game;
  const double points[] = {-4, 0, -4, 4, 0, -4, 4, 0, 4, -4, 0, 4};
  const std::uint32_t vertices[] = {0, 2, 1, 0, 3, 2};
  iso_triangles quad;
  iso_triangles_init(&quad);
  quad.point_count = 4;
  quad.triangle_count = 2;
  quad.points.at = points;
  quad.vertices.at = vertices;
  const std::uint8_t numbers[] = {1, 0};
  const double table[] = {0.5, 0, 0.25, 1};
  iso_surface_materials materials;
  iso_surface_materials_init(&materials);
  materials.count = materials.table_count = 2;
  materials.numbers.at = numbers;
  materials.table.at = table;
  iso_blob* mesh = nullptr;
  ASSERT_EQ(iso_blob_create_mesh(&quad, &materials, ISO_BLOB_HOME_ASSET, &mesh), ISO_OK) << iso_last_error();
  iso_shape_type type = 0;
  ASSERT_EQ(iso_blob_get_type(mesh, &type), ISO_OK);
  EXPECT_EQ(type, std::uint32_t{ISO_SHAPE_TYPE_MESH});
  ASSERT_EQ(iso_add_blob(game.world, mesh, &game.box), ISO_OK) << iso_last_error();
  const iso_body ground = game.create(-6, ISO_BODY_TYPE_STATIC);
  iso_q32_ray_cast ray;
  iso_q32_ray_cast_init(&ray);
  ray.origin = {Q32Game::whole(2), 0, Q32Game::whole(-1)};
  ray.translation.y = Q32Game::whole(-20);
  iso_q32_ray_hit hit;
  std::uint8_t found = 0;
  ASSERT_EQ(iso_q32_cast_ray(game.world, &ray, &hit, &found), ISO_OK);
  ASSERT_EQ(found, 1);
  EXPECT_EQ(hit.body, ground);
  EXPECT_EQ(hit.material, numbers[hit.triangle]);
  // A state names an asset and does not carry it: who reads it must have been given it.
  const std::vector<std::uint8_t> state =
      bytes_of([&](void* to, std::size_t* size) { return iso_world_write(game.world, to, size); });
  Q32Game other;
  EXPECT_EQ(iso_world_read(other.world, state.data(), state.size()), ISO_CORRUPT);
  ASSERT_EQ(iso_world_add_asset(other.world, mesh), ISO_OK);
  EXPECT_EQ(iso_world_read(other.world, state.data(), state.size()), ISO_OK) << iso_last_error();
  EXPECT_EQ(iso_world_hash(other.world), iso_world_hash(game.world));
  // Bad geometry and bad materials.
  const std::uint32_t beyond[] = {0, 2, 9, 0, 3, 2};
  quad.vertices.at = beyond;
  iso_blob* none = nullptr;
  EXPECT_EQ(iso_blob_create_mesh(&quad, nullptr, ISO_BLOB_HOME_CARRIED, &none), ISO_FAULT_BAD_SHAPE);
  quad.vertices.at = vertices;
  const double slippery[] = {-1, 0, 0, 0};
  materials.table.at = slippery;
  EXPECT_EQ(iso_blob_create_mesh(&quad, &materials, ISO_BLOB_HOME_CARRIED, &none), ISO_FAULT_BAD_SHAPE);
  EXPECT_EQ(none, nullptr);
  EXPECT_EQ(iso_blob_destroy(mesh), ISO_OK);
}

TEST(CJoints, AreAskedAndSet) {
  Q32Game game;
  iso_q32_joint_properties properties;
  iso_q32_joint_properties_init(&properties);
  ASSERT_EQ(iso_q32_joint_get(game.world, game.joint, &properties), ISO_OK);
  EXPECT_EQ(properties.type, std::uint32_t{ISO_JOINT_TYPE_HINGE});
  EXPECT_EQ(properties.flags, std::uint32_t{ISO_JOINT_FLAG_LIMIT});
  EXPECT_EQ(properties.upper, Q32Game::lean());
  properties.flags |= ISO_JOINT_FLAG_MOTOR;
  properties.max_force = Q32Game::whole(3);
  EXPECT_EQ(iso_q32_joint_set(game.world, game.joint, &properties), ISO_OK) << iso_last_error();
  std::int64_t position = 1;
  EXPECT_EQ(iso_q32_joint_get_position(game.world, game.joint, &position), ISO_OK);
  EXPECT_EQ(position, 0);
  iso_q32_coupling gears;
  iso_q32_coupling_init(&gears);
  ASSERT_EQ(iso_q32_coupling_gears(game.joint, 12, game.joint, 36, &gears), ISO_OK);
  EXPECT_EQ(gears.ratio_b, Q32Game::whole(36));
  EXPECT_EQ(iso_q32_coupling_screw(game.joint, 0, game.joint, &gears), ISO_FAULT_BAD_ARGUMENT);

  iso_q32_ragdoll_bone bones[2];
  for (iso_q32_ragdoll_bone& bone : bones) {
    ASSERT_EQ(iso_q32_ragdoll_bone_init(&bone), ISO_OK);
    bone.shape = game.box;
    bone.mass = Q32Game::whole(2);
  }
  bones[0].pose.position.y = Q32Game::whole(10);
  bones[1].pose.position.y = Q32Game::whole(11);
  bones[1].joint.position.y = Q32Game::whole(10);
  bones[1].parent = 0;
  bones[1].swing_x = bones[1].swing_y = Q32Game::half();
  bones[1].lower = -Q32Game::half();
  bones[1].upper = Q32Game::half();
  iso_body bodies[2] = {0, 0};
  iso_joint joints[2] = {1, 0};
  ASSERT_EQ(iso_q32_add_ragdoll(game.world, bones, 2, nullptr, bodies, joints), ISO_OK) << iso_last_error();
  EXPECT_TRUE(iso_body_exists(game.world, bodies[1]));
  EXPECT_EQ(joints[0], 0u);
  EXPECT_TRUE(iso_joint_exists(game.world, joints[1]));
  bones[1].parent = 5;
  EXPECT_GT(iso_q32_add_ragdoll(game.world, bones, 2, nullptr, bodies, joints), 0);
}

TEST(CLibrary, SaysWhatItIs) {
  EXPECT_STREQ(iso_version(), "0.1.0");
  EXPECT_NE(iso_behaviour_version(), 0u);
  EXPECT_STREQ(iso_status_text(ISO_OK), "success");
  EXPECT_STREQ(iso_status_text(-77), "unknown status");
  EXPECT_STREQ(iso_scalar_name(ISO_SCALAR_Q32), "q32.32");
  EXPECT_EQ(iso_scalar_name(9), nullptr);
  EXPECT_EQ(iso_has_scalar(9), 0);
  EXPECT_EQ(iso_q16_to_double(iso_q16_from_double(-2.5)), -2.5);
  EXPECT_EQ(iso_q32_unit_to_double(iso_q32_unit_from_double(0.5)), 0.5);
  iso_selfcheck_result result;
  iso_selfcheck_result_init(&result);
  ASSERT_EQ(iso_selfcheck(&result), ISO_OK);
  EXPECT_EQ(result.sound, 1) << result.text;
  EXPECT_GT(result.frames, 100u);
}

}  // namespace queries_test
}  // namespace isostep::test
