/* A recording made, written and verified through the C interface: what a server does with the file of a match.
   SPDX-License-Identifier: MIT */
#include <stdio.h>
#include <stdlib.h>

#include "isostep.h"

#define ISO(call) \
  if ((call) != ISO_OK) return fprintf(stderr, "%s\n", iso_last_error()), 1

/* README: begin */
/* Whatever the game does to the world between two frames is in the file, which any isostep verifies. */
static int record(iso_world* world, iso_tape* tape, iso_body ball) {
  const iso_f32_vec3 push = {20, 0, 0}; /* [N] */
  int i;
  ISO(iso_world_record(world, tape, "a pushed ball"));
  for (i = 0; i < 90; ++i) {
    ISO(iso_f32_body_apply_force(world, ball, &push, NULL));
    ISO(iso_world_step(world, NULL));
    ISO(iso_tape_end_frame(tape));
  }
  ISO(iso_tape_finish(tape));
  return 0;
}

static int verify(const void* file, size_t size) {
  iso_replay_result result;
  ISO(iso_replay_result_init(&result));
  ISO(iso_replay_verify(file, size, ISO_SIMD_BEST, UINT64_MAX, &result));
  printf("%s: %s\n", result.scene, result.text); /* a pushed ball: VERIFIED 90 frames */
  return result.outcome == ISO_VERIFY_OUTCOME_VERIFIED ? 0 : 1;
}
/* README: end */

/* README: begin */
/* Room in, need out: ask for the size, then for the bytes. */
static int portable_state(const iso_world* world, void** bytes, size_t* size) {
  *size = 0;
  if (iso_world_write(world, NULL, size) != ISO_SMALL_BUFFER) return 1;
  *bytes = malloc(*size);
  if (*bytes == NULL) return 1;
  ISO(iso_world_write(world, *bytes, size));
  return 0;
}
/* README: end */

/* README: begin */
/* Arrays belong to the world, until the next call that changes it. */
static int hardest_touch(iso_world* world, float* hardest) {
  const iso_f32_contact_begin* touches;
  size_t count, i;
  ISO(iso_f32_contact_begins(world, &touches, &count));
  for (i = 0; i < count; ++i) {
    if (touches[i].impulse > *hardest) *hardest = touches[i].impulse; /* [kg m/s] */
  }
  return 0;
}
/* README: end */

int main(void) {
  iso_f32_settings settings;
  iso_f32_sphere sphere;
  iso_f32_half_space floor;
  iso_f32_body_definition ball, ground;
  iso_world* world;
  iso_tape* tape;
  iso_body body, under;
  const void* file;
  void* state = NULL;
  size_t size, state_size;
  float hardest = 0;
  int i, failed;

  ISO(iso_f32_settings_init(&settings));
  ISO(iso_f32_sphere_init(&sphere));
  ISO(iso_f32_half_space_init(&floor));
  ISO(iso_f32_body_definition_init(&ball));
  ISO(iso_f32_body_definition_init(&ground));
  sphere.radius = 0.5f;
  floor.normal.y = 1;
  ball.type = ISO_BODY_TYPE_DYNAMIC;
  ball.report_contacts = 1;
  ball.position.y = 3;
  ISO(iso_f32_world_create(&settings, &world));
  ISO(iso_f32_add_sphere(world, &sphere, &ball.shape));
  ISO(iso_f32_add_half_space(world, &floor, &ground.shape));
  ISO(iso_f32_body_create(world, &ground, &under));
  ISO(iso_f32_body_create(world, &ball, &body));
  for (i = 0; i < 60; ++i) {
    ISO(iso_world_step(world, NULL));
    if (hardest_touch(world, &hardest) != 0) return 1;
  }
  ISO(iso_tape_create(&tape));
  failed = record(world, tape, body);
  ISO(iso_tape_bytes(tape, &file, &size));
  failed = failed || verify(file, size) || portable_state(world, &state, &state_size);
  free(state);
  ISO(iso_tape_destroy(tape));
  ISO(iso_world_destroy(world));
  return failed || !(hardest > 1);
}
