// Wrong calls: each has its status and a sentence, and changes nothing.
// SPDX-License-Identifier: MIT
#include <cstddef>
#include <limits>

#include "built.hpp"
#include "game.hpp"

namespace isostep::test {
namespace attacks_test {

/// The call has that status, says why, and leaves the world as it was.
#define EXPECT_REFUSED(game, call, expected)                        \
  do {                                                              \
    const std::uint64_t hash_before = iso_world_hash((game).world); \
    EXPECT_EQ((call), expected) << iso_last_error();                \
    EXPECT_STRNE(iso_last_error(), "");                             \
    EXPECT_EQ(iso_world_hash((game).world), hash_before);           \
  } while (false)

TEST(CAttacks, NullPointersAreRefused) {
  Q32Game game;
  iso_world* none = nullptr;
  EXPECT_EQ(iso_world_step(none, nullptr), ISO_NULL);
  EXPECT_EQ(iso_q32_world_create(nullptr, &none), ISO_NULL);
  EXPECT_EQ(iso_world_hash(nullptr), 0u);
  EXPECT_REFUSED(game, iso_q32_body_create(game.world, nullptr, &game.crate), ISO_NULL);
  iso_q32_body_definition definition;
  iso_q32_body_definition_init(&definition);
  definition.shape = game.box;
  EXPECT_REFUSED(game, iso_q32_body_create(game.world, &definition, nullptr), ISO_NULL);
  EXPECT_REFUSED(game, iso_q32_body_set_pose(game.world, game.crate, nullptr), ISO_NULL);
  EXPECT_REFUSED(game, iso_world_load(game.world, nullptr), ISO_NULL);
  EXPECT_REFUSED(game, iso_world_read(game.world, nullptr, 8), ISO_NULL);
  EXPECT_EQ(iso_world_destroy(nullptr), ISO_OK);
  EXPECT_EQ(iso_blob_destroy(nullptr), ISO_OK);
}

TEST(CAttacks, StaleAndForeignIdsAreTheWorldsFaults) {
  Q32Game game(1), other(2);
  const iso_body gone = game.create(9, ISO_BODY_TYPE_DYNAMIC);
  ASSERT_EQ(iso_body_destroy(game.world, gone), ISO_OK);
  EXPECT_REFUSED(game, iso_body_destroy(game.world, gone), ISO_FAULT_STALE_ID);
  EXPECT_REFUSED(game, iso_body_wake(game.world, 0), ISO_FAULT_NULL_ID);
  EXPECT_REFUSED(game, iso_body_wake(game.world, other.crate), ISO_FAULT_FOREIGN_ID);
  EXPECT_REFUSED(game, iso_joint_destroy(game.world, other.joint), ISO_FAULT_FOREIGN_ID);
  EXPECT_REFUSED(game, iso_remove_thruster(game.world, ~std::uint64_t{0}), ISO_FAULT_FOREIGN_ID);
  iso_fault_report report;
  iso_fault_report_init(&report);
  ASSERT_EQ(iso_world_fault(game.world, &report), ISO_OK);
  EXPECT_EQ(report.status, ISO_FAULT_FOREIGN_ID);
  EXPECT_STREQ(report.command.at, "remove_thruster");
  char text[200];
  std::size_t size = sizeof text;
  ASSERT_EQ(iso_world_fault_text(game.world, text, &size), ISO_OK);
  EXPECT_NE(std::string(text).find("remove_thruster"), std::string::npos) << text;
  iso_q32_body_state state;
  iso_q32_body_state_init(&state);
  EXPECT_EQ(iso_q32_body_get_state(game.world, gone, &state), ISO_FAULT_STALE_ID);
}

TEST(CAttacks, NumbersBeyondTheLimitsNameTheirField) {
  Q32Game game;
  iso_q32_material material;
  iso_q32_material_init(&material);
  material.friction = iso_q32_from_double(-1);
  EXPECT_REFUSED(game, iso_q32_body_set_material(game.world, game.crate, &material), ISO_FAULT_BAD_ARGUMENT);
  EXPECT_NE(std::string(iso_last_error()).find("friction"), std::string::npos) << iso_last_error();
  iso_f32_settings settings;
  iso_f32_settings_init(&settings);
  settings.gravity.y = std::numeric_limits<float>::quiet_NaN();
  iso_world* made = nullptr;
  EXPECT_EQ(iso_f32_world_create(&settings, &made), ISO_FAULT_OUT_OF_RANGE) << iso_last_error();
  EXPECT_NE(std::string(iso_last_error()).find("gravity"), std::string::npos) << iso_last_error();
  EXPECT_EQ(made, nullptr);
}

/// Found by the random caller: a grid divided by the number of cells of a box without any.
TEST(CAttacks, ABoxWhoseCornersAreSwappedIsRefused) {
  ISO_NEEDS_BOOK();
  Q32Game game;
  ASSERT_EQ(iso_world_use_broad_phase(game.world, ISO_BROAD_PHASE_GRID), ISO_OK);
  iso_q32_box_query query;
  iso_q32_box_query_init(&query);
  iso_body bodies[4];
  std::size_t count = 0;
  ASSERT_EQ(iso_q32_overlap_box(game.world, &query, bodies, 4, &count), ISO_OK) << iso_last_error();
  for (int wide = 1; wide < 40; ++wide) {
    query.box.low.x = Q32Game::whole(wide);
    query.box.high.y = Q32Game::whole(1);
    EXPECT_REFUSED(game, iso_q32_overlap_box(game.world, &query, bodies, 4, &count), ISO_FAULT_BAD_ARGUMENT);
  }
}

TEST(CAttacks, AnotherFamilyIsRefused) {
  Q32Game game;
  iso_f32_body_definition definition;
  iso_f32_body_definition_init(&definition);
  iso_body made = 0;
  EXPECT_REFUSED(game, iso_f32_body_create(game.world, &definition, &made), ISO_WRONG_SCALAR);
  iso_f64_settings settings;
  iso_f64_settings_init(&settings);
  iso_world* in_double = nullptr;
  ASSERT_EQ(iso_f64_world_create(&settings, &in_double), ISO_OK);
  iso_snapshot* snapshot = nullptr;
  ASSERT_EQ(iso_snapshot_create(in_double, &snapshot), ISO_OK);
  ASSERT_EQ(iso_world_save(in_double, snapshot), ISO_OK);
  EXPECT_REFUSED(game, iso_world_load(game.world, snapshot), ISO_WRONG_SCALAR);
  EXPECT_EQ(iso_snapshot_destroy(snapshot), ISO_OK);
  EXPECT_EQ(iso_world_destroy(in_double), ISO_OK);
}

TEST(CAttacks, SizesAreThoseOfThisAndEarlierAndLaterReleases) {
  Q32Game game;
  iso_q32_thruster thruster;
  iso_q32_thruster_init(&thruster);
  thruster.body = game.crate;
  iso_record made = 0;
  for (const std::uint32_t size : {0u, 4u, 7u, 12u, 17u, 0xffffffffu}) {
    iso_q32_thruster wrong = thruster;
    wrong.size = size;
    EXPECT_REFUSED(game, iso_q32_add_thruster(game.world, &wrong, &made), ISO_WRONG_SIZE);
  }
  // Of an earlier release that ended before `force`: the default stands for the rest.
  iso_q32_thruster early = thruster;
  early.force.x = Q32Game::whole(5);
  early.size = static_cast<std::uint32_t>(offsetof(iso_q32_thruster, force));
  ASSERT_EQ(iso_q32_add_thruster(game.world, &early, &made), ISO_OK) << iso_last_error();
  iso_q32_thruster kept;
  iso_q32_thruster_init(&kept);
  ASSERT_EQ(iso_q32_get_thruster(game.world, made, &kept), ISO_OK);
  EXPECT_EQ(kept.force.x, 0);
  EXPECT_EQ(kept.body, game.crate);
  // Of a later one: its members must be 0.
  struct Later {
    iso_q32_thruster known;
    std::uint64_t unknown[2];
  } later = {thruster, {0, 0}};
  later.known.size = sizeof later;
  EXPECT_EQ(iso_q32_set_thruster(game.world, made, &later.known), ISO_OK) << iso_last_error();
  later.unknown[1] = 1;
  EXPECT_REFUSED(game, iso_q32_set_thruster(game.world, made, &later.known), ISO_WRONG_SIZE);
  // Written: what a later release has beyond is 0, what an earlier one lacks is not touched.
  later.unknown[0] = later.unknown[1] = 7;
  ASSERT_EQ(iso_q32_get_thruster(game.world, made, &later.known), ISO_OK);
  EXPECT_EQ(later.unknown[0], 0u);
  EXPECT_EQ(later.unknown[1], 0u);
  early.force.x = 77;
  ASSERT_EQ(iso_q32_get_thruster(game.world, made, &early), ISO_OK);
  EXPECT_EQ(early.force.x, 77);
}

TEST(CAttacks, BytesThatAreNoEnumeratorNeverBecomeOne) {
  Q32Game game;
  iso_q32_body_definition definition;
  iso_q32_body_definition_init(&definition);
  definition.shape = game.box;
  iso_body made = 0;
  definition.type = 3;
  EXPECT_REFUSED(game, iso_q32_body_create(game.world, &definition, &made), ISO_BAD_ENUM);
  EXPECT_NE(std::string(iso_last_error()).find("type"), std::string::npos) << iso_last_error();
  definition.type = ISO_BODY_TYPE_STATIC;
  definition.bullet = 2;
  EXPECT_REFUSED(game, iso_q32_body_create(game.world, &definition, &made), ISO_BAD_ENUM);
  EXPECT_NE(std::string(iso_last_error()).find("bullet"), std::string::npos) << iso_last_error();
  iso_q32_hinge hinge;
  iso_q32_hinge_init(&hinge);
  hinge.has_motor = 255;
  EXPECT_REFUSED(game, iso_q32_create_hinge(game.world, &hinge, &made), ISO_BAD_ENUM);
  iso_q32_ray_cast ray;
  iso_q32_ray_cast_init(&ray);
  ray.filter.per = 9;
  iso_q32_ray_hit hit;
  std::uint8_t found = 0;
  EXPECT_REFUSED(game, iso_q32_cast_ray(game.world, &ray, &hit, &found), ISO_BAD_ENUM);
  EXPECT_REFUSED(game, iso_body_set_enabled(game.world, game.crate, 2), ISO_BAD_ENUM);
  EXPECT_REFUSED(game, iso_world_use_simd(game.world, 99), ISO_BAD_ENUM);
  EXPECT_REFUSED(game, iso_world_use_broad_phase(game.world, 99), ISO_BAD_ENUM);
}

TEST(CAttacks, HandlesThatAreNotAliveAreFound) {
  iso_tape* tape = nullptr;
  ASSERT_EQ(iso_tape_create(&tape), ISO_OK);
  EXPECT_EQ(iso_tape_destroy(tape), ISO_OK);
  EXPECT_EQ(iso_tape_destroy(tape), ISO_NOT_ALIVE);
  EXPECT_EQ(iso_tape_end_frame(tape), ISO_NOT_ALIVE);
  Q32Game game;
  EXPECT_EQ(iso_snapshot_destroy(reinterpret_cast<iso_snapshot*>(game.world)), ISO_NOT_ALIVE);
  EXPECT_EQ(iso_world_step(reinterpret_cast<iso_world*>(tape), nullptr), ISO_NOT_ALIVE);
  alignas(16) char rubbish[64] = "no handle, but memory that may be read";
  EXPECT_EQ(iso_world_step(reinterpret_cast<iso_world*>(rubbish), nullptr), ISO_NOT_ALIVE);
  EXPECT_EQ(iso_world_step(reinterpret_cast<iso_world*>(rubbish + 1), nullptr), ISO_NOT_ALIVE);
  // The next objects are not taken for the one that was.
  for (int i = 0; i < 500; ++i) {
    iso_tape* next = nullptr;
    ASSERT_EQ(iso_tape_create(&next), ISO_OK);
    ASSERT_NE(next, tape);
    ASSERT_EQ(iso_tape_destroy(next), ISO_OK);
  }
}

TEST(CAttacks, LittleRoomIsSaidAndNothingIsWritten) {
  Q32Game game;
  std::uint8_t bytes[4] = {1, 2, 3, 4};
  std::size_t size = sizeof bytes;
  EXPECT_EQ(iso_world_write(game.world, bytes, &size), ISO_SMALL_BUFFER);
  EXPECT_GT(size, sizeof bytes);
  EXPECT_EQ(bytes[0], 1);
  iso_body bodies[2] = {7, 7};
  std::size_t count = 0;
  EXPECT_EQ(iso_world_bodies(game.world, bodies, 2, &count), ISO_SMALL_BUFFER);
  EXPECT_EQ(count, 3u);
  EXPECT_EQ(bodies[0], game.ground);
  EXPECT_EQ(bodies[1], game.crate);
}

TEST(CAttacks, TruncatedAndAlteredStatesAreRefused) {
  Q32Game game, other;
  game.step(30);
  const std::vector<std::uint8_t> state =
      bytes_of([&](void* to, std::size_t* size) { return iso_world_write(game.world, to, size); });
  ASSERT_GT(state.size(), 100u);
  for (std::size_t size = 0; size < state.size(); size += 7) {
    const std::vector<std::uint8_t> cut(state.begin(), state.begin() + static_cast<std::ptrdiff_t>(size));
    EXPECT_REFUSED(other, iso_world_read(other.world, cut.data(), cut.size()), ISO_CORRUPT);
  }
  std::vector<std::uint8_t> longer = state;
  longer.push_back(0);
  EXPECT_REFUSED(other, iso_world_read(other.world, longer.data(), longer.size()), ISO_CORRUPT);
  ASSERT_EQ(iso_world_read(other.world, state.data(), state.size()), ISO_OK) << iso_last_error();
  EXPECT_EQ(iso_world_hash(other.world), iso_world_hash(game.world));
}

TEST(CAttacks, CorruptedReplaysAreTold) {
  Q32Game game;
  const std::vector<std::uint8_t> file = recording_of(game, 90);
  iso_replay_result result;
  iso_replay_result_init(&result);
  ASSERT_EQ(iso_replay_verify(file.data(), file.size(), ISO_SIMD_BEST, UINT64_MAX, &result), ISO_OK);
  EXPECT_EQ(result.outcome, std::uint32_t{ISO_VERIFY_OUTCOME_VERIFIED}) << result.text;
  EXPECT_EQ(result.frames, 90u);
  for (std::size_t at = 40; at < file.size(); at += file.size() / 23) {
    std::vector<std::uint8_t> altered = file;
    altered[at] ^= 0x10;
    ASSERT_EQ(iso_replay_verify(altered.data(), altered.size(), ISO_SIMD_SCALAR, UINT64_MAX, &result), ISO_OK);
    EXPECT_EQ(result.outcome, std::uint32_t{ISO_VERIFY_OUTCOME_CORRUPT}) << at << ": " << result.text;
  }
  ASSERT_EQ(iso_replay_verify(file.data(), file.size() - 9, ISO_SIMD_BEST, UINT64_MAX, &result), ISO_OK);
  EXPECT_EQ(result.outcome, std::uint32_t{ISO_VERIFY_OUTCOME_TRUNCATED}) << result.text;
  iso_replay* replay = nullptr;
  EXPECT_EQ(iso_replay_open("no replay", 9, &replay), ISO_CORRUPT);
  EXPECT_EQ(replay, nullptr);
}

/// A runner whose task calls the world that it works for.
struct CallingBack {
  iso_world* world;
  std::uint64_t calls = 0, refused = 0;

  static void run(void* user, std::int32_t, iso_task task, void* data) {
    auto& self = *static_cast<CallingBack*>(user);
    ++self.calls;
    self.refused += iso_world_step(self.world, nullptr) == ISO_CALLED_BACK;
    self.refused += iso_world_destroy(self.world) == ISO_CALLED_BACK;
    self.refused += iso_world_get_scalar(self.world, nullptr) == ISO_CALLED_BACK;
    task(data);
  }
};
TEST(CAttacks, CallbacksDoNotCallBack) {
  Q32Game game;
  for (int i = 0; i < 900; ++i) {  // crates on crates, enough for a step to ask for help
    iso_q32_body_definition crate;
    iso_q32_body_definition_init(&crate);
    crate.shape = game.box;
    crate.position = {Q32Game::whole(2 * (i % 30)), Q32Game::whole(10), Q32Game::whole(2 * (i / 30))};
    iso_body made = 0;
    ASSERT_EQ(iso_q32_body_create(game.world, &crate, &made), ISO_OK);
    crate.type = ISO_BODY_TYPE_DYNAMIC;
    crate.position.y = Q32Game::whole(11);
    ASSERT_EQ(iso_q32_body_create(game.world, &crate, &made), ISO_OK);
  }
  CallingBack runner = {game.world};
  ASSERT_EQ(iso_world_use_threads(game.world, CallingBack::run, &runner, 2), ISO_OK);
  game.step(5);
  EXPECT_GT(runner.calls, 0u) << "the world was too small to need help";
  EXPECT_EQ(runner.refused, 3 * runner.calls);
}

}  // namespace attacks_test
}  // namespace isostep::test
