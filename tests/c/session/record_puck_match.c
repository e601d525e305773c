/* Plays a match of two and writes the client's recording of the world to the file that is named.
   SPDX-License-Identifier: MIT */
#include <stdio.h>
#include <stdlib.h>

#include "puck_game.h"

int main(int argc, char** argv) {
  static puck_machine host, client;
  iso_session_config config;
  iso_network* network;
  uint64_t now;
  size_t size = 0;
  void* bytes;
  FILE* file;
  iso_status status;
  if (argc != 2) return 64;
  puck_config(ISO_ROLLBACK, &config);
  status = puck_machine_create(&client, &config, 0);
  config.host = 1;
  config.seed = 4;
  if (status == ISO_OK) status = puck_machine_create(&host, &config, 1);
  if (status == ISO_OK) status = iso_session_record(client.session, ISO_RECORD_WORLD, "two pucks");
  if (status == ISO_OK) status = iso_network_create(2, &network);
  if (status == ISO_OK) status = iso_network_add_client(network, "latency=80,jitter=20,loss=5", &client.endpoint);
  if (status == ISO_OK) status = iso_network_connect(network, client.endpoint, 0);
  for (now = 0; status == ISO_OK && client.game.count < 600 && now < 30000000; now += 1000) {
    status = iso_network_advance_to(network, now);
    if (status == ISO_OK) status = puck_machine_turn(&host, network, now);
    if (status == ISO_OK) status = puck_machine_turn(&client, network, now);
  }
  if (status == ISO_OK && iso_session_recorded(client.session, ISO_RECORD_WORLD, NULL, &size) != ISO_SMALL_BUFFER) {
    status = ISO_REFUSED;
  }
  bytes = malloc(size);
  if (status == ISO_OK) status = iso_session_recorded(client.session, ISO_RECORD_WORLD, bytes, &size);
  if (status != ISO_OK) {
    fprintf(stderr, "%s\n", iso_last_error());
    return 1;
  }
  file = fopen(argv[1], "wb");
  if (file == NULL || fwrite(bytes, 1, size, file) != size || fclose(file) != 0) return 1;
  free(bytes);
  puck_machine_destroy(&client);
  puck_machine_destroy(&host);
  iso_network_destroy(network);
  printf("%d frames, %d rollbacks\n", (int)client.game.count, (int)client.game.rollbacks);
  return client.game.rollbacks > 20 ? 0 : 1;
}
