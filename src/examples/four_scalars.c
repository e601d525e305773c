/* The crate of hello.cpp in C99, in every scalar that the library has: what packages are tried with.
   Prints a line for each: the family, the frame hash after 120 steps, the same after a rollback.
   SPDX-License-Identifier: MIT */
#include <inttypes.h>
#include <stdio.h>

#include "isostep.h"

#define ISO(call) \
  if ((call) != ISO_OK) return fprintf(stderr, "%s\n", iso_last_error()), 1

/* One scalar: P is the family, N its numbers. */
#define PLAY(P, N, U)                                                                                           \
  static int play_##P(void) {                                                                                   \
    iso_##P##_settings settings;                                                                                \
    iso_##P##_box box;                                                                                          \
    iso_##P##_body_definition ground, crate;                                                                    \
    iso_##P##_vec3 impulse = {0, 0, 0};                                                                         \
    iso_world* world;                                                                                           \
    iso_snapshot* frame;                                                                                        \
    iso_body body;                                                                                              \
    uint64_t hashes[2];                                                                                         \
    int run, step;                                                                                              \
    ISO(iso_##P##_settings_init(&settings));                                                                    \
    settings.hz = 60;                                                                                           \
    settings.substeps = 8;                                                                                      \
    settings.gravity.x = settings.gravity.z = iso_##P##_from_double(0);                                         \
    settings.gravity.y = iso_##P##_from_double(-10);                                                            \
    ISO(iso_##P##_world_create(&settings, &world));                                                             \
    ISO(iso_##P##_box_init(&box));                                                                              \
    ISO(iso_##P##_body_definition_init(&ground));                                                               \
    ISO(iso_##P##_body_definition_init(&crate));                                                                \
    box.half_extents.x = box.half_extents.z = iso_##P##_from_double(50);                                        \
    box.half_extents.y = iso_##P##_from_double(1);                                                              \
    ISO(iso_##P##_add_box(world, &box, &ground.shape));                                                         \
    ground.position.y = iso_##P##_from_double(-1);                                                              \
    ISO(iso_##P##_body_create(world, &ground, &body));                                                          \
    box.half_extents.x = box.half_extents.y = box.half_extents.z = iso_##P##_from_double(0.5);                  \
    ISO(iso_##P##_add_box(world, &box, &crate.shape));                                                          \
    crate.type = ISO_BODY_TYPE_DYNAMIC;                                                                         \
    crate.position.y = iso_##P##_from_double(2);                                                                \
    crate.user_data = 42;                                                                                       \
    ISO(iso_##P##_body_create(world, &crate, &body));                                                           \
    impulse.y = iso_##P##_from_double(3);                                                                       \
    ISO(iso_##P##_body_apply_impulse(world, body, &impulse, NULL));                                             \
    ISO(iso_snapshot_create(world, &frame));                                                                    \
    ISO(iso_world_save(world, frame));                                                                          \
    for (run = 0; run < 2; ++run) {                                                                             \
      ISO(iso_world_load(world, frame));                                                                        \
      for (step = 0; step < 120; ++step) ISO(iso_world_step(world, NULL));                                      \
      hashes[run] = iso_world_hash(world);                                                                      \
    }                                                                                                           \
    printf("%s %016" PRIx64 " %s\n", #P, hashes[0], hashes[0] == hashes[1] ? "equal" : "DIFFERENT");            \
    ISO(iso_snapshot_destroy(frame));                                                                           \
    ISO(iso_world_destroy(world));                                                                              \
    return hashes[0] == hashes[1] ? 0 : 1;                                                                      \
  }
ISO_C_SCALARS(PLAY)

int main(void) {
  static int (*const plays[])(void) = {
#define NAME(P, N, U) play_##P,
      ISO_C_SCALARS(NAME)};
  iso_scalar scalar;
  for (scalar = 0; scalar < 4; ++scalar) {
    if (iso_has_scalar(scalar) && plays[scalar]() != 0) return 1;
  }
  return fflush(stdout) == 0 ? 0 : 74;
}
