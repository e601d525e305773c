/* The scene of hello.cpp in C99: a crate, an impulse, a rollback and a ray, over 32.32 fixed point.
   SPDX-License-Identifier: MIT */
#include <stdio.h>

#include "isostep.h"

#define ISO(call) \
  if ((call) != ISO_OK) return fprintf(stderr, "%s\n", iso_last_error()), 1

static int64_t n(double value) { return iso_q32_from_double(value); }

int main(void) {
  iso_q32_settings settings;
  iso_q32_box ground, crate;
  iso_q32_body_definition floor, box;
  iso_q32_ray_cast ray;
  iso_q32_ray_hit hit;
  iso_world* world;
  iso_snapshot* frame;
  iso_body body;
  uint64_t hash;
  uint8_t found;
  int i, equal;

  iso_q32_settings_init(&settings); /* the defaults: 60 Hz, 8 sub-steps, gravity (0, -10, 0) */
  iso_q32_box_init(&ground);
  iso_q32_box_init(&crate);
  iso_q32_body_definition_init(&floor);
  iso_q32_body_definition_init(&box);
  iso_q32_ray_cast_init(&ray);
  ground.half_extents.x = ground.half_extents.z = n(50);
  ground.half_extents.y = n(1);
  crate.half_extents.x = crate.half_extents.y = crate.half_extents.z = n(0.5);

  /* README: begin */
  ISO(iso_q32_world_create(&settings, &world));
  ISO(iso_q32_add_box(world, &ground, &floor.shape));
  ISO(iso_q32_add_box(world, &crate, &box.shape));
  floor.position.y = n(-1);
  box.position.y = n(2);
  box.type = ISO_BODY_TYPE_DYNAMIC;
  box.user_data = 42;
  ISO(iso_q32_body_create(world, &floor, &body));
  ISO(iso_q32_body_create(world, &box, &body));
  ISO(iso_q32_body_apply_impulse(world, body, &(iso_q32_vec3){0, n(3), 0}, NULL));

  ISO(iso_snapshot_create(world, &frame));
  ISO(iso_world_save(world, frame));
  for (i = 0; i < 120; ++i) ISO(iso_world_step(world, NULL));
  hash = iso_world_hash(world); /* the same on every machine, and in every language */

  ISO(iso_world_load(world, frame)); /* same ids, same future */
  for (i = 0; i < 120; ++i) ISO(iso_world_step(world, NULL));
  equal = iso_world_hash(world) == hash;
  /* README: end */

  ray.origin.y = n(5);
  ray.translation.y = n(-10);
  ISO(iso_q32_cast_ray(world, &ray, &hit, &found));
  printf("%016llx %s\n", (unsigned long long)hash, equal ? "equal after rollback" : "DIFFERENT after rollback");
  ISO(iso_snapshot_destroy(frame));
  ISO(iso_world_destroy(world));
  return equal && found && hit.body == body ? 0 : 1;
}
