/* The library of UDP, installed: a socket that listens, and one that calls it, across this machine's loopback.
   SPDX-License-Identifier: MIT */
#include <isostep_udp.h>
#include <stdio.h>

int main(void) {
  char problem[200] = "";
  iso_udp *host, *guest;
  if (iso_udp_listen(0, NULL, &host, problem, sizeof problem) != ISO_OK) return fprintf(stderr, "%s\n", problem), 1;
  if (iso_udp_connect("127.0.0.1", iso_udp_port(host), NULL, &guest, problem, sizeof problem) != ISO_OK) {
    return fprintf(stderr, "%s\n", problem), 1;
  }
  iso_udp_destroy(guest);
  return iso_udp_destroy(host) == ISO_OK ? 0 : 1;
}
