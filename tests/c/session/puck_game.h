/* The game of tests/match/pucks.hpp in C99, and its state in two forms: as a block and by callbacks.
   SPDX-License-Identifier: MIT */
#ifndef PUCK_GAME_H
#define PUCK_GAME_H

#include "isostep.h"

#ifdef __cplusplus
extern "C" {
#endif

enum { PUCK_SLOTS = 128, PUCK_FRAMES = 3600, PUCK_PLAYERS = 4 };
typedef struct puck_game {
  iso_world* world;
  uint32_t touches;   /* what the game remembers beside its world */
  iso_body pucks[PUCK_PLAYERS]; /* given once and for all: no state */
  int32_t players;
  uint32_t forgotten; /* touches - 1 of a game that forgets: shapes the future, and is no state */
  uint8_t forgets;
  uint32_t saved[PUCK_SLOTS]; /* by callbacks */
  uint32_t hashed;            /* [bytes] of `touches` that the hash of the callbacks sees */
  int32_t restarts, rollbacks;
  int32_t first, count; /* confirmed frames whose hashes are kept */
  uint64_t hashes[PUCK_FRAMES];
} puck_game;

iso_status puck_game_create(puck_game* game, int32_t players);
iso_status puck_game_destroy(puck_game* game);
iso_status puck_game_step(puck_game* game, const iso_input* inputs);
/* The world, and `touches` as a block or by callbacks; `step` is there in either case. */
void puck_game_describe(puck_game* game, int by_callbacks, iso_game* out);
/* What each player does, of the frame that is current when it is asked. */
int8_t puck_way(int32_t current, int32_t player);
/* The configuration of two players, without host and seed. */
void puck_config(uint32_t mode, iso_session_config* out);

/* A machine of a match in virtual time. */
typedef struct puck_machine {
  puck_game game;
  iso_session* session;
  uint32_t endpoint;
  int by_callbacks; /* steps and state; else one request at a time, and a block */
} puck_machine;
iso_status puck_machine_create(puck_machine* machine, const iso_session_config* config, int by_callbacks);
iso_status puck_machine_destroy(puck_machine* machine);
/* The player's input, and all steps that are due. */
iso_status puck_machine_play(puck_machine* machine, uint64_t now);
/* The same with the network before and after it. */
iso_status puck_machine_turn(puck_machine* machine, iso_network* network, uint64_t now);

/* Host and client, a turn each every millisecond, until both have confirmed all PUCK_FRAMES. */
iso_status puck_match(uint32_t mode, const char* profile, int by_callbacks, puck_machine* host, puck_machine* client);

#ifdef __cplusplus
}
#endif

#endif
