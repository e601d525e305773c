/* SPDX-License-Identifier: MIT */
#include "puck_game.h"

#include <string.h>

#define TRY(call)                      \
  do {                                 \
    const iso_status tried = (call);   \
    if (tried != ISO_OK) return tried; \
  } while (0)

/* F(settings) is iso_q32_settings, or that of another scalar. */
#ifndef PUCK_FAMILY
#define PUCK_FAMILY q32
#endif
#define JOINED(family, name) iso_##family##_##name
#define OF(family, name) JOINED(family, name)
#define F(name) OF(PUCK_FAMILY, name)
#define N(value) F(from_double)(value)

iso_status puck_game_create(puck_game* game, int32_t players) {
  F(settings) settings;
  F(box) box;
  F(sphere) sphere;
  F(body_definition) body;
  int n;
  memset(game, 0, sizeof *game);
  game->hashed = sizeof game->touches;
  game->players = players;
  TRY(F(settings_init)(&settings));
  TRY(F(world_create)(&settings, &game->world));
  TRY(F(box_init)(&box));
  box.half_extents.x = box.half_extents.z = N(20);
  box.half_extents.y = N(1);
  TRY(F(body_definition_init)(&body));
  TRY(F(add_box)(game->world, &box, &body.shape));
  body.position.y = N(-1);
  TRY(F(body_create)(game->world, &body, &game->pucks[0]));
  TRY(F(sphere_init)(&sphere));
  sphere.radius = N(0.5);
  TRY(F(add_sphere)(game->world, &sphere, &body.shape));
  body.type = ISO_BODY_TYPE_DYNAMIC;
  body.report_contacts = 1;
  body.position.y = N(1);
  for (n = 0; n < players && n < PUCK_PLAYERS; ++n) {
    body.position.x = N(4 * n - 2);
    TRY(F(body_create)(game->world, &body, &game->pucks[n]));
  }
  return ISO_OK;
}

iso_status puck_game_destroy(puck_game* game) { return iso_world_destroy(game->world); }

iso_status puck_game_step(puck_game* game, const iso_input* inputs) {
  const F(contact_begin)* begins = NULL;
  size_t count = 0;
  int n;
  for (n = 0; n < game->players; ++n) {
    F(vec3) impulse = {0, 0, 0};
    impulse.x = (int8_t)inputs[n].bytes[0] * N(0.125);
    if (game->forgets && game->forgotten % 50 == 49) impulse.x += N(0.125);
    TRY(F(body_apply_impulse)(game->world, game->pucks[n], &impulse, NULL));
  }
  TRY(iso_world_step(game->world, NULL));
  TRY(F(contact_begins)(game->world, &begins, &count));
  game->touches += (uint32_t)count;
  ++game->forgotten;
  return ISO_OK;
}

static void step(void* user, int32_t frame, const iso_input* inputs, uint32_t players) {
  puck_game* const game = (puck_game*)user;
  (void)frame;
  if (players >= (uint32_t)game->players) puck_game_step(game, inputs);
}
static void confirmed(void* user, int32_t frame, uint64_t hash_after) {
  puck_game* const game = (puck_game*)user;
  if (game->count == 0) game->first = frame;
  if (frame != game->first + game->count || game->count >= PUCK_FRAMES) return;
  game->hashes[game->count++] = hash_after;
}
static void restarted(void* user, int32_t frame) {
  (void)frame;
  ++((puck_game*)user)->restarts;
}
static void rolled_back(void* user, int32_t frame) {
  (void)frame;
  ++((puck_game*)user)->rollbacks;
}
static void save(void* user, uint32_t slot) {
  puck_game* const game = (puck_game*)user;
  if (slot < PUCK_SLOTS) game->saved[slot] = game->touches;
}
static void load(void* user, uint32_t slot) {
  puck_game* const game = (puck_game*)user;
  if (slot < PUCK_SLOTS) game->touches = game->saved[slot];
}
static uint64_t hash(void* user) {
  const puck_game* const game = (const puck_game*)user;
  return iso_hash_bytes(&game->touches, game->hashed);
}
static size_t write(void* user, void* bytes, size_t room) {
  const puck_game* const game = (const puck_game*)user;
  if (room >= sizeof game->touches) memcpy(bytes, &game->touches, sizeof game->touches);
  return sizeof game->touches;
}
static int32_t read(void* user, const void* bytes, size_t size) {
  puck_game* const game = (puck_game*)user;
  if (size != sizeof game->touches) return 1;
  memcpy(&game->touches, bytes, size);
  return 0;
}

void puck_game_describe(puck_game* game, int by_callbacks, iso_game* out) {
  iso_game_init(out);
  out->world = game->world;
  out->user = game;
  out->step = step;
  out->restarted = restarted;
  out->rolled_back = rolled_back;
  out->confirmed = confirmed;
  if (by_callbacks) {
    out->save = save;
    out->load = load;
    out->hash = hash;
    out->write = write;
    out->read = read;
  } else {
    out->block = &game->touches;
    out->block_size = sizeof game->touches;
  }
}

int8_t puck_way(int32_t current, int32_t player) { return (int8_t)(current / (11 + 6 * player) % 3 - 1); }

void puck_config(uint32_t mode, iso_session_config* out) {
  iso_session_config_init(out);
  out->mode = mode;
  strcpy(out->name, "pucks");
  strcpy(out->input_text, "way: int8");
}

iso_status puck_machine_create(puck_machine* machine, const iso_session_config* config, int by_callbacks) {
  iso_game game;
  memset(machine, 0, sizeof *machine);
  machine->by_callbacks = by_callbacks;
  TRY(puck_game_create(&machine->game, config->players));
  puck_game_describe(&machine->game, by_callbacks, &game);
  return iso_session_create(config, &game, NULL, 0, &machine->session);
}

iso_status puck_machine_destroy(puck_machine* machine) {
  TRY(iso_session_destroy(machine->session));
  return puck_game_destroy(&machine->game);
}

/* What iso_session_drive does by callbacks. */
static iso_status pull(puck_machine* machine, uint64_t now) {
  iso_request request = {.size = sizeof request};
  TRY(iso_session_advance(machine->session, now));
  do {
    TRY(iso_session_next(machine->session, &request));
    switch (request.kind) {
      case ISO_STEP: TRY(puck_game_step(&machine->game, iso_session_inputs(machine->session, NULL))); break;
      case ISO_ROLLED_BACK: ++machine->game.rollbacks; break;
      case ISO_RESTARTED: ++machine->game.restarts; break;
      case ISO_FRAME_CONFIRMED: confirmed(&machine->game, request.frame, request.hash); break;
      default: break;
    }
  } while (request.kind != ISO_NOTHING);
  return ISO_OK;
}

iso_status puck_machine_play(puck_machine* machine, uint64_t now) {
  const int32_t player = iso_session_local_player(machine->session);
  if (player >= 0) {
    const int8_t way = puck_way(iso_session_current(machine->session), player);
    /* Refused while it is not in the match. */
    iso_session_add_local_input(machine->session, player, &way, 1);
  }
  return machine->by_callbacks ? iso_session_drive(machine->session, now, NULL) : pull(machine, now);
}

iso_status puck_machine_turn(puck_machine* machine, iso_network* network, uint64_t now) {
  TRY(iso_network_deliver(network, machine->endpoint, machine->session, now));
  TRY(puck_machine_play(machine, now));
  return iso_network_dispatch(network, machine->endpoint, machine->session, now);
}

iso_status puck_match(uint32_t mode, const char* profile, int by_callbacks, puck_machine* host, puck_machine* client) {
  iso_session_config config;
  iso_network* network = NULL;
  uint64_t now;
  puck_config(mode, &config);
  config.most_delay = 40; /* lockstep: the way between the players */
  TRY(puck_machine_create(client, &config, by_callbacks));
  config.host = 1;
  config.seed = 20;
  TRY(puck_machine_create(host, &config, by_callbacks));
  TRY(iso_network_create(1, &network));
  TRY(iso_network_add_client(network, profile, &client->endpoint));
  TRY(iso_network_connect(network, client->endpoint, 0));
  for (now = 0; host->game.count < PUCK_FRAMES || client->game.count < PUCK_FRAMES; now += 1000) {
    if (now > 120000000) return ISO_REFUSED;
    TRY(iso_network_advance_to(network, now));
    TRY(puck_machine_turn(host, network, now));
    TRY(puck_machine_turn(client, network, now));
  }
  return iso_network_destroy(network);
}
