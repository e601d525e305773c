/* The scene of hello.cpp in C99: a crate, an impulse and a rollback, over 32.32 fixed point.
   SPDX-License-Identifier: MIT */
/* README: begin */
#include <isostep.h>
#include <stdio.h>

#define N(x) iso_q32_from_double(x)
#define ISO(call) \
  if ((call) != ISO_OK) return fprintf(stderr, "%s\n", iso_last_error()), 1

int main(void) {
  iso_q32_settings settings;
  iso_q32_box ground, crate;
  iso_q32_body_definition floor, box;
  iso_world* world;
  iso_snapshot* frame;
  iso_body body;
  uint64_t hash;
  int i, equal;

  iso_q32_settings_init(&settings); /* the defaults: 60 Hz, 8 sub-steps, gravity (0, -10, 0) */
  iso_q32_box_init(&ground);
  iso_q32_box_init(&crate);
  iso_q32_body_definition_init(&floor);
  iso_q32_body_definition_init(&box);
  ground.half_extents = (iso_q32_vec3){N(50), N(1), N(50)};
  crate.half_extents = (iso_q32_vec3){N(0.5), N(0.5), N(0.5)};
  floor.position.y = N(-1);
  box.position.y = N(2);
  box.type = ISO_BODY_TYPE_DYNAMIC;
  box.user_data = 42;

  ISO(iso_q32_world_create(&settings, &world));
  ISO(iso_q32_add_box(world, &ground, &floor.shape));
  ISO(iso_q32_add_box(world, &crate, &box.shape));
  ISO(iso_q32_body_create(world, &floor, &body));
  ISO(iso_q32_body_create(world, &box, &body));
  ISO(iso_q32_body_apply_impulse(world, body, &(iso_q32_vec3){0, N(3), 0}, NULL));

  ISO(iso_snapshot_create(world, &frame));
  ISO(iso_world_save(world, frame));
  for (i = 0; i < 120; ++i) ISO(iso_world_step(world, NULL));
  hash = iso_world_hash(world); /* the same on every machine, and in every language */

  ISO(iso_world_load(world, frame)); /* same ids, same future */
  for (i = 0; i < 120; ++i) ISO(iso_world_step(world, NULL));
  equal = iso_world_hash(world) == hash;

  printf("%016llx %s\n", (unsigned long long)hash, equal ? "equal after rollback" : "DIFFERENT after rollback");
  ISO(iso_snapshot_destroy(frame));
  ISO(iso_world_destroy(world));
  return equal ? 0 : 1;
}
/* README: end */
