/* A client of a match in C: see host.cpp for what it reads and writes.
   SPDX-License-Identifier: MIT

   usage: match_client_SCALAR [forgets]. The game of one that forgets is another from frame 50 on. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "puck_game.h"

static void fail(const char* why) {
  fprintf(stderr, "match_client: %s\n", why);
  exit(1);
}
static void must(iso_status status) {
  if (status != ISO_OK) fail(iso_last_error());
}
static void take(void* to, size_t size) {
  if (size != 0 && fread(to, size, 1, stdin) != 1) fail("the host has ended");
}
static void put(const void* from, size_t size) {
  if (size != 0 && fwrite(from, size, 1, stdout) != 1) fail("the host has ended");
}

static void take_arrivals(iso_session* session, uint64_t now) {
  static uint8_t bytes[ISO_RELIABLE_CAP];
  uint32_t count, size;
  uint8_t head[2]; /* kind, channel */
  for (take(&count, sizeof count); count > 0; --count) {
    take(head, sizeof head);
    take(&size, sizeof size);
    if (size > sizeof bytes) fail("a message is too long");
    take(bytes, size);
    if (head[0] == 0) must(iso_session_connected(session, 0, now, 0));
    if (head[0] == 1) must(iso_session_disconnected(session, 0, now));
    if (head[0] == 2) must(iso_session_receive(session, 0, head[1], bytes, size, now));
  }
}

static void put_messages(iso_session* session, uint64_t now) {
  static uint8_t all[1 << 20];
  size_t end = 0;
  uint32_t count = 0;
  iso_outgoing outgoing;
  const uint8_t* bytes;
  must(iso_outgoing_init(&outgoing));
  for (must(iso_session_poll_send(session, now, &outgoing, &bytes)); bytes != NULL;
       must(iso_session_poll_send(session, now, &outgoing, &bytes))) {
    if (outgoing.length == 0) continue;
    if (end + 5 + outgoing.length > sizeof all) fail("too many messages in a turn");
    all[end] = (uint8_t)outgoing.channel;
    memcpy(all + end + 1, &outgoing.length, 4);
    memcpy(all + end + 5, bytes, outgoing.length);
    end += 5 + outgoing.length;
    ++count;
  }
  put(&count, sizeof count);
  put(all, end);
}

/* What no sound match has. */
static void look_at_events(iso_session* session) {
  iso_session_event event;
  must(iso_session_event_init(&event));
  do {
    must(iso_session_poll_event(session, &event));
    if (event.kind == ISO_EVENT_DESYNC) fail("a desync");
    if (event.kind == ISO_EVENT_REFUSED) fail(event.key);
    if (event.kind == ISO_EVENT_LOST_HOST) fail("the host is lost");
  } while (event.kind != ISO_EVENT_NONE);
}

static void put_finals(const puck_game* game, int32_t* told) {
  const uint32_t count = (uint32_t)(game->count - *told);
  put(&count, sizeof count);
  for (; *told < game->count; ++*told) {
    const uint32_t frame = (uint32_t)(game->first + *told);
    put(&frame, sizeof frame);
    put(&game->hashes[*told], sizeof game->hashes[*told]);
  }
}

static void put_recording(const puck_machine* machine) {
  const uint32_t rollbacks = (uint32_t)machine->game.rollbacks;
  size_t size = 0;
  uint32_t length;
  void* bytes;
  if (iso_session_recorded(machine->session, ISO_RECORD_WORLD, NULL, &size) != ISO_SMALL_BUFFER) fail("no recording");
  bytes = malloc(size);
  if (bytes == NULL) fail("no memory");
  must(iso_session_recorded(machine->session, ISO_RECORD_WORLD, bytes, &size));
  length = (uint32_t)size;
  put(&rollbacks, sizeof rollbacks);
  put(&length, sizeof length);
  put(bytes, size);
  free(bytes);
}

int main(int argc, char** argv) {
  static puck_machine machine;
  iso_session_config config;
  uint32_t players;
  uint64_t now;
  int32_t told = 0;
  puck_config(ISO_ROLLBACK, &config);
  take(&config.input_schema, sizeof config.input_schema);
  take(&players, sizeof players);
  config.players = (int32_t)players;
  must(puck_machine_create(&machine, &config, 0));
  machine.game.forgets = argc > 1 && strcmp(argv[1], "forgets") == 0;
  must(iso_session_record(machine.session, ISO_RECORD_WORLD, NULL));
  for (take(&now, sizeof now); now != UINT64_MAX; take(&now, sizeof now)) {
    take_arrivals(machine.session, now);
    must(puck_machine_play(&machine, now));
    put_messages(machine.session, now);
    put_finals(&machine.game, &told);
    fflush(stdout);
    look_at_events(machine.session);
  }
  put_recording(&machine);
  fflush(stdout);
  must(puck_machine_destroy(&machine));
  return 0;
}
