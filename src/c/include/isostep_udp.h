/* Sessions across UDP, by ENet: libisostep_udp, which is a library of its own so that libisostep needs none. POSIX and
   Windows; not for browsers. Not secret; who can forge what: src/transport/README.md. IPv4 only.
   SPDX-License-Identifier: MIT */
#ifndef ISOSTEP_UDP_H
#define ISOSTEP_UDP_H

#include "isostep.h"

#if defined(_WIN32) && defined(ISO_BUILD_UDP)
#define ISO_UDP_API __declspec(dllexport)
#else
#define ISO_UDP_API ISO_API
#endif

#ifdef __cplusplus
extern "C" {
#endif

typedef struct iso_udp iso_udp;

typedef struct iso_udp_settings {
  uint32_t size;
  uint32_t max_peers;            /* of who listens: config.max_peers + max_strangers */
  uint32_t max_peers_an_address; /* players behind one router share its address */
  uint32_t events_per_poll;      /* the rest waits for the next turn */
  uint32_t datagrams_per_peer;   /* in one turn; more are dropped */
  uint32_t reserved1;
  uint64_t timeout;            /* [us] a peer that acknowledges nothing is given up after this */
  uint64_t unacknowledged_cap; /* [bytes] sent reliably to one peer; above that its connection ends */
  char bind_address[72];       /* empty: every interface */
  uint8_t key[16]; /* random bytes that all machines of the match have and nobody else; all zeros: there is none */
} iso_udp_settings;
ISO_UDP_API iso_status iso_udp_settings_init_sized(iso_udp_settings* settings, size_t size);

typedef struct iso_udp_statistics {
  uint32_t size;
  uint32_t reserved1;
  uint64_t packets_sent;
  uint64_t bytes_sent; /* of UDP's payload, as all here */
  uint64_t packets_received;
  uint64_t bytes_received;
  uint64_t implausible; /* packets thrown away before ENet saw them: forged, sent again, or of no peer's kind */
  uint64_t refused;     /* messages on the wrong channel or above its cap */
  uint64_t flooded;     /* datagrams above datagrams_per_peer */
  uint64_t socket_errors;
} iso_udp_statistics;

/* Accepts connections: a host, or a machine that may follow one. Port 0 lets the system choose. `settings`: null for
   the defaults. ISO_REFUSED: `problem` (or null) gets a sentence of at most `room` bytes with its zero. */
ISO_UDP_API iso_status iso_udp_listen(uint16_t port, const iso_udp_settings* settings, iso_udp** out, char* problem,
                                      size_t room);
/* Accepts none, and connects to one host. A name is looked up at once, which may block. */
ISO_UDP_API iso_status iso_udp_connect(const char* address, uint16_t port, const iso_udp_settings* settings,
                                       iso_udp** out, char* problem, size_t room);
/* Tells connected peers so, without waiting for what is unacknowledged. Null is allowed. */
ISO_UDP_API iso_status iso_udp_destroy(iso_udp* udp);

/* One more connection, beside or after the first. */
ISO_UDP_API iso_status iso_udp_connect_to(iso_udp* udp, const char* address, uint16_t port);
/* Tries the address asked for last again: after ISO_EVENT_LOST_HOST. */
ISO_UDP_API iso_status iso_udp_connect_again(iso_udp* udp);
ISO_UDP_API uint16_t iso_udp_port(const iso_udp* udp); /* of who listens */

/* What has arrived goes into the session; what it has to say goes out, also to addresses that it names
   ("192.0.2.7:4000", iso_session_config.address). */
ISO_UDP_API iso_status iso_udp_deliver(iso_udp* udp, iso_session* session, uint64_t now);
ISO_UDP_API iso_status iso_udp_dispatch(iso_udp* udp, iso_session* session, uint64_t now);
/* Blocks until a packet arrives or this time [us] is over, rounded down to whole milliseconds. */
ISO_UDP_API iso_status iso_udp_wait(iso_udp* udp, uint64_t longest);
ISO_UDP_API iso_status iso_udp_get_statistics(const iso_udp* udp, iso_udp_statistics* out);

#ifdef __cplusplus
}
#endif

ISO_C_INLINE_INIT(udp_settings)

#endif
