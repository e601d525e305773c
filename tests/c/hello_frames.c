/* hello.cpp in C99, one function a family. A rollback half-way plays the first half twice.
   SPDX-License-Identifier: MIT */
#include "hello_frames.h"

#include <stddef.h>

#include "isostep.h"

#define CHECK(call) \
  if ((call) != ISO_OK) return __LINE__

/* Frames up to `count`, of which `begin` are played already. */
static int play(iso_world* world, uint64_t* hashes, int begin, int count) {
  iso_step_report report;
  int i;
  CHECK(iso_step_report_init(&report));
  for (i = begin; i < count; ++i) {
    CHECK(iso_world_step(world, &report));
    if (report.clamped_speed != 0 || report.crowded != 0) return __LINE__;
    hashes[i] = iso_world_hash(world);
  }
  return 0;
}

#define HELLO(P, N, U)                                                               \
  static int make_##P(iso_world** world) {                                           \
    iso_##P##_settings settings;                                                     \
    iso_##P##_box ground, crate;                                                     \
    iso_##P##_body_definition floor, box;                                            \
    iso_##P##_vec3 up;                                                               \
    iso_body body;                                                                   \
    CHECK(iso_##P##_settings_init(&settings));                                       \
    CHECK(iso_##P##_box_init(&ground));                                              \
    CHECK(iso_##P##_box_init(&crate));                                               \
    CHECK(iso_##P##_body_definition_init(&floor));                                   \
    CHECK(iso_##P##_body_definition_init(&box));                                     \
    ground.half_extents.x = ground.half_extents.z = iso_##P##_from_double(50);       \
    ground.half_extents.y = iso_##P##_from_double(1);                                \
    crate.half_extents.x = crate.half_extents.y = iso_##P##_from_double(0.5);        \
    crate.half_extents.z = iso_##P##_from_double(0.5);                               \
    CHECK(iso_##P##_world_create(&settings, world));                                 \
    CHECK(iso_##P##_add_box(*world, &ground, &floor.shape));                         \
    CHECK(iso_##P##_add_box(*world, &crate, &box.shape));                            \
    floor.position.y = iso_##P##_from_double(-1);                                    \
    CHECK(iso_##P##_body_create(*world, &floor, &body));                             \
    box.type = ISO_BODY_TYPE_DYNAMIC;                                                \
    box.position.y = iso_##P##_from_double(2);                                       \
    box.user_data = 42;                                                              \
    CHECK(iso_##P##_body_create(*world, &box, &body));                               \
    up.x = up.z = iso_##P##_from_double(0);                                          \
    up.y = iso_##P##_from_double(3);                                                 \
    CHECK(iso_##P##_body_apply_impulse(*world, body, &up, NULL));                    \
    return 0;                                                                        \
  }                                                                                  \
  int hello_frames_##P(uint64_t* hashes, int count) {                                \
    iso_world* world;                                                                \
    iso_snapshot* start;                                                             \
    int failed = make_##P(&world);                                                   \
    if (failed != 0) return failed;                                                  \
    CHECK(iso_snapshot_create(world, &start));                                       \
    CHECK(iso_world_save(world, start));                                             \
    failed = play(world, hashes, 0, count / 2);                                      \
    CHECK(iso_world_load(world, start));                                             \
    if (failed == 0) failed = play(world, hashes, 0, count);                         \
    CHECK(iso_snapshot_destroy(start));                                              \
    CHECK(iso_world_destroy(world));                                                 \
    return failed;                                                                   \
  }
ISO_C_SCALARS(HELLO)
