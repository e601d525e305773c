/* A game for two over a bad line, both machines in one process, in C99; rollback here, lockstep by one word.
   SPDX-License-Identifier: MIT */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "isostep.h"

enum { FRAMES = 300 };

typedef struct machine {
  iso_world* world;
  uint32_t touches;  /* what the game remembers beside its world */
  iso_body pucks[2]; /* given once and for all: no state */
  iso_session* session;
  uint32_t endpoint;
  uint64_t hashes[FRAMES]; /* of the final frames */
} machine;

static void must(iso_status status) {
  if (status == ISO_OK) return;
  fprintf(stderr, "%s\n", iso_last_error());
  exit(1);
}

static void build(machine* m) {
  const int64_t one = iso_q32_from_double(1);
  const iso_q32_box box = {.size = sizeof box, .half_extents = {20 * one, one, 20 * one}};
  const iso_q32_sphere ball = {.size = sizeof ball, .radius = one / 2};
  iso_q32_settings settings;
  iso_q32_body_definition body;
  must(iso_q32_settings_init(&settings));
  must(iso_q32_world_create(&settings, &m->world));
  must(iso_q32_body_definition_init(&body));
  must(iso_q32_add_box(m->world, &box, &body.shape));
  body.position.y = -one;
  must(iso_q32_body_create(m->world, &body, &m->pucks[0]));
  must(iso_q32_add_sphere(m->world, &ball, &body.shape));
  body.type = ISO_BODY_TYPE_DYNAMIC;
  body.report_contacts = 1;
  body.position.y = one;
  for (int n = 0; n < 2; ++n) {
    body.position.x = (4 * n - 2) * one;
    must(iso_q32_body_create(m->world, &body, &m->pucks[n]));
  }
}

/* README: begin */
static void step(machine* m, const iso_input* inputs) {
  const iso_q32_contact_begin* begins;
  size_t count;
  for (int n = 0; n < 2; ++n) {
    const iso_q32_vec3 impulse = {(int8_t)inputs[n].bytes[0] * iso_q32_from_double(0.125), 0, 0};
    must(iso_q32_body_apply_impulse(m->world, m->pucks[n], &impulse, NULL));
  }
  must(iso_world_step(m->world, NULL));
  must(iso_q32_contact_begins(m->world, &begins, &count));
  m->touches += (uint32_t)count;
}
/* README: end */

/* README: begin */
static void turn(machine* m, int player, iso_network* network, uint64_t now) {
  iso_request request = {.size = sizeof request};
  const int8_t way = (int8_t)(iso_session_current(m->session) / (11 + 6 * player) % 3 - 1);
  must(iso_network_deliver(network, m->endpoint, m->session, now));
  iso_session_add_local_input(m->session, player, &way, 1); /* refused until the match begins */
  must(iso_session_advance(m->session, now));
  do {
    must(iso_session_next(m->session, &request)); /* saves and loads by itself */
    if (request.kind == ISO_STEP) step(m, iso_session_inputs(m->session, NULL));
    if (request.kind == ISO_FRAME_CONFIRMED && request.frame < FRAMES) m->hashes[request.frame] = request.hash;
  } while (request.kind != ISO_NOTHING);
  must(iso_network_dispatch(network, m->endpoint, m->session, now));
}
/* README: end */

static void open_session(machine* m, iso_session_config* config) {
  /* World and block: saved, rolled back and hashed as one. */
  const iso_game game = {.size = sizeof game, .world = m->world, .block = &m->touches, .block_size = sizeof m->touches};
  must(iso_session_create(config, &game, NULL, 0, &m->session));
}

int main(void) {
  static machine machines[2]; /* the host, and a client */
  iso_session_config config;
  iso_session_stats stats = {.size = sizeof stats};
  iso_network* network;
  int equal = 0;
  must(iso_session_config_init(&config));
  config.mode = ISO_ROLLBACK; /* ISO_LOCKSTEP: nothing else changes */
  strcpy(config.name, "two pucks");
  must(iso_network_create(1, &network));
  must(iso_network_add_client(network, "latency=80,jitter=20,loss=5", &machines[1].endpoint));
  for (int n = 0; n < 2; ++n) {
    build(&machines[n]);
    config.host = n == 0;
    config.seed = n == 0 ? 20 : 0; /* a game draws it anew for every match */
    open_session(&machines[n], &config);
  }
  must(iso_network_connect(network, machines[1].endpoint, 0));
  for (uint64_t now = 0;
       iso_session_confirmed(machines[0].session) < FRAMES || iso_session_confirmed(machines[1].session) < FRAMES;
       now += 1000) {
    if (now > 20000000) return 1;
    must(iso_network_advance_to(network, now));
    for (int n = 0; n < 2; ++n) turn(&machines[n], n, network, now);
  }
  for (int n = 0; n < FRAMES; ++n) equal += machines[0].hashes[n] == machines[1].hashes[n];
  must(iso_session_get_stats(machines[0].session, &stats));
  printf("%d of %d frames equal; %d were stepped again\n", equal, FRAMES, (int)stats.steps - FRAMES);
  for (int n = 0; n < 2; ++n) {
    must(iso_session_destroy(machines[n].session));
    must(iso_world_destroy(machines[n].world));
  }
  must(iso_network_destroy(network));
  return equal == FRAMES && stats.steps > FRAMES + 20 ? 0 : 1;
}
