/* isostep: deterministic 3D game physics, lockstep and rollback sessions. The C interface: plain C99, also valid C++.
   SPDX-License-Identifier: MIT */
#ifndef ISOSTEP_H
#define ISOSTEP_H

#include <stddef.h>
#include <stdint.h>

#ifndef ISO_API
#if defined(_WIN32)
#ifdef ISO_BUILDING_C
#define ISO_API __declspec(dllexport)
#else
#define ISO_API __declspec(dllimport)
#endif
#else
#define ISO_API __attribute__((visibility("default")))
#endif
#endif

#ifdef __cplusplus
extern "C" {
#endif

typedef struct iso_world iso_world;
typedef int32_t iso_status;
enum {
  ISO_OK = 0,
  ISO_NULL = -1,
  ISO_WRONG_SCALAR = -2,
  ISO_NO_SCALAR = -3,
  ISO_SMALL_BUFFER = -4,
  ISO_WRONG_SIZE = -5,
  ISO_CORRUPT = -6,
  ISO_NO_MEMORY = -7,
  ISO_BAD_ENUM = -8,
  ISO_NOT_ALIVE = -9,
  ISO_CALLED_BACK = -10
};

/* Sessions */

/* A session decides which frames a game steps, with whose inputs, and when: lockstep, rollback, watching, sync tests,
   replays. It has no sockets, no clock and no threads: bytes and the time go in, bytes and requests come out. See
   SESSIONS.md. Times are microseconds since any moment of the caller's choice and never run backwards; frames count
   from 0, -1 is none; sets of players are a bit each.

   Strings that come out end with a zero byte and hold until the session's next call. Structs that are filled here begin
   with `size`, which the caller sets: iso_session_event event = {.size = sizeof event}. */

typedef struct iso_session iso_session;

enum {
  ISO_REFUSED = -11, /* not now, not yours or not sound: the comment of the function and iso_session_problem say more */
  ISO_UNFINISHED = -12 /* between iso_session_advance and the last request of iso_session_next */
};

enum {
  ISO_MAX_PLAYERS = 32,
  ISO_INPUT_CAP = 512,      /* [bytes] of one player's input for one frame */
  ISO_CREDENTIAL_CAP = 256, /* [bytes] */
  ISO_DATAGRAM_CAP = 1180,  /* [bytes] of one datagram of a session */
  ISO_RELIABLE_CAP = 16384, /* [bytes] of one reliable message of a session */
  ISO_NO_PLAYER = 0xff,
  ISO_NORMAL_SPEED = 8 /* [1/8 of the match's rate] 4 to 16 may be set */
};

typedef uint32_t iso_session_mode;
enum {
  ISO_LOCKSTEP,  /* a frame is stepped when all its inputs are known */
  ISO_ROLLBACK,  /* a frame is stepped when it is due; wrong guesses are stepped again */
  ISO_SPECTATOR, /* no player; steps what is known, and catches up when behind */
  ISO_SYNC_TEST, /* one machine: every frame is rolled back, stepped again and compared */
  ISO_REPLAY     /* plays a recorded match */
};

typedef uint32_t iso_predictor;
enum {
  ISO_REPEAT_LAST,    /* a held stick stays held */
  ISO_PREDICT_NEUTRAL /* nobody gives the same order twice */
};

typedef uint32_t iso_genre;
enum {
  ISO_FIGHTING, /* two players; a frame of delay is felt */
  ISO_BRAWLER,  /* a few players on one small stage */
  ISO_RACING,   /* many players; a step is cheap, and others' cars may be corrected */
  ISO_STRATEGY, /* orders now and then; nothing that is shown may be taken back */
  ISO_SANDBOX   /* a thousand awake bodies: a step is dear */
};

typedef struct iso_session_config {
  uint32_t size;
  iso_session_mode mode;
  uint8_t host;              /* others connect to us; the host fixes what was played */
  uint8_t relays;            /* spectator: it serves up to max_peers further ones, who connect to it as to a host */
  uint8_t repair;            /* who is outvoted takes the host's state again by itself */
  uint8_t asks_admission;    /* host: its game decides whom it lets in: iso_session_poll_applicant */
  uint8_t votes;             /* host: who plays may propose a vote */
  uint8_t players_set_tempo; /* host: who plays may pause and set the speed; else the host's game is asked, by events */
  uint8_t reserved1[2];
  int32_t players;
  int32_t local_players;   /* host: how many of the first play here, 0: dedicated; client: for how many seats it asks */
  int32_t hz;              /* [1/s] */
  int32_t window;          /* [frames] rollback: stepped on guesses at most; sync test: rolled back */
  int32_t delay;           /* [frames] an input waits at first; adapts between the next two */
  int32_t least_delay;     /* [frames] */
  int32_t most_delay;      /* [frames] */
  int32_t deadline;        /* [frames] host: an input that is late by so many is replaced by the guess; 0: none */
  uint64_t silence;        /* [us] without a word from a peer until it counts as lost */
  uint64_t patience;       /* [us] that one player may make the others wait within a minute; then it is left out */
  uint64_t exclusion;      /* [us] for so long */
  int32_t kept;            /* states kept, more than window, delay and latency; iso_game.save has slots below this */
  int32_t history;         /* frames of inputs kept: how long a snapshot may take to reach a late joiner */
  int32_t most_replayed;   /* [frames] whose state is at most so old steps them all; older ones are sent a snapshot */
  int32_t max_peers;       /* whom the host serves: the players, and as many spectators as they leave room for */
  int32_t max_strangers;   /* host: connections beside those; peers are numbered below the sum of both */
  uint32_t snapshot_cap;   /* [bytes] of a snapshot that a client accepts */
  uint32_t most_packets;   /* [1/s] datagrams, and messages, accepted of one peer */
  int32_t broadcast_delay; /* [frames] relay: it and all whom it serves see the match so late */
  uint64_t seed;      /* host: 64 random bits that no other match has, and a secret: tokens come of it. 0 is refused */
  uint64_t migration; /* [us] without a word from the host until the clients go on without it; 0: never */
  uint64_t reservation;     /* [us] host: a seat that was played on is kept so long for its player's token */
  uint64_t token;           /* client: what iso_session_token gave a former process of this player; 0: a new player */
  int32_t seat;             /* client: this seat, and those after it for further players of ours, or none; -1: any */
  uint32_t credential_size; /* [bytes] */
  uint8_t credential[256];  /* client: for the host's game */
  char address[72];      /* where the others' transports reach ours, at most 64 characters: iso_session_poll_connect */
  char name[136];        /* what all peers must have alike: the game and its version, 1 to 128 characters of ASCII */
  char input_text[136];  /* likewise: names the fields of an input, at most 128 characters */
  uint64_t input_schema; /* 0: hash of input_text, sizes and neutral; else this, as of a C++ InputCodec */
  uint32_t input_least;  /* [bytes] an input has, 0 to input_cap */
  uint32_t input_cap;    /* [bytes] and at most, 1 to ISO_INPUT_CAP */
  iso_predictor predictor; /* iso_game.predict replaces it */
  uint32_t neutral_size;   /* [bytes] input_least to input_cap */
  uint8_t neutral[512];    /* what is played for who is not there */
} iso_session_config;

/* C++'s defaults; inputs of 1 byte, neutral 0. `name`, `seed` (of a host) and the input are to be set. */
ISO_API iso_status iso_session_config_init(iso_session_config* config);
/* Likewise, with mode, window, delays and deadline for a genre and so many players. */
ISO_API iso_status iso_session_config_preset(iso_session_config* config, iso_genre genre, int32_t players);
/* The first rule that it breaks, as the name of the field and what it may be; or null. */
ISO_API const char* iso_session_config_problem(const iso_session_config* config);

/* One player's input for one frame. */
typedef struct iso_input {
  uint16_t size;  /* [bytes] */
  uint8_t status; /* ISO_CONFIRMED ... */
  uint8_t reserved;
  uint8_t bytes[512]; /* zero from `size` on */
} iso_input;
/* Of an input. A game may look at ISO_DISCONNECTED, and at nothing else. */
typedef uint32_t iso_input_status;
enum {
  ISO_CONFIRMED,   /* the player's own word */
  ISO_PREDICTED,   /* a guess; the frame will be stepped again if it was wrong */
  ISO_DISCONNECTED /* the player is gone: the bytes are `neutral` */
};

/* The game: what is saved, rolled back, hashed and sent to who joins late. At least one of `world`, `block` and
   `save` is there; each in use is hashed and written in this order. All that it names outlives the session. */
typedef struct iso_game {
  uint32_t size;
  uint32_t reserved;
  iso_world* world; /* of any scalar, or null */
  void* block; /* the game's own state as one block of bytes, or null: no pointers, no padding with rubbish in it */
  size_t block_size; /* [bytes] */

  /* Callbacks, for iso_session_drive and for state of another form; each may be null. From within them nothing of the
     session may be called but what asks (it takes a const iso_session), and the world may be changed in `step` and
     `read`. They do not throw and do not jump out. */
  void* user; /* their first argument */
  /* Steps the game by one frame; its outcome depends on the state, the inputs' bytes and who is disconnected. */
  void (*step)(void* user, int32_t frame, const iso_input* inputs, uint32_t players);
  void (*rolled_back)(void* user, int32_t frame); /* the state is again that before `frame` */
  void (*restarted)(void* user, int32_t frame);   /* the state is one that arrived from elsewhere, before `frame` */
  void (*confirmed)(void* user, int32_t frame, uint64_t hash); /* `frame` is final, hash: of the state after it */
  /* State of another form: save, load and hash together, write and read together, or else nobody joins late. */
  void (*save)(void* user, uint32_t slot); /* into a place of the game's own, below config.kept */
  void (*load)(void* user, uint32_t slot); /* what was saved there last */
  uint64_t (*hash)(void* user);
  size_t (*write)(void* user, void* bytes, size_t room); /* returns the size, and writes nothing where room is less */
  int32_t (*read)(void* user, const void* bytes, size_t size); /* 0: taken; else refused, and all is as it was */
  /* Guesses the input `ahead` frames after `last` into `to`, which has input_cap bytes; returns its size. The same on
     all machines is better, and not needed. */
  size_t (*predict)(void* user, const void* last, size_t size, int32_t ahead, void* to);
  /* 0: no player can make this input; it has a size within the bounds. */
  int32_t (*valid)(void* user, const void* bytes, size_t size);
} iso_game;
ISO_API iso_status iso_game_init(iso_game* game); /* all null */
/* XXH3-64, with which `block` is hashed: for iso_game.hash. */
ISO_API uint64_t iso_hash_bytes(const void* bytes, size_t size);

/* `file`: of ISO_REPLAY the recording of a match, of a host that goes on with one what iso_session_save_match gave;
   else null. ISO_REFUSED: see iso_session_config_problem. What is wrong with a file is the event ISO_EVENT_REFUSED. */
ISO_API iso_status iso_session_create(const iso_session_config* config, const iso_game* game, const void* file,
                                      size_t file_size, iso_session** out);
/* Refused from within a callback, and then the session stays. Null is allowed. The world and the block stay. */
ISO_API iso_status iso_session_destroy(iso_session* session);
/* Of the last call that returned ISO_REFUSED or ISO_CORRUPT: why; never null. */
ISO_API const char* iso_session_problem(const iso_session* session);

/* A turn of the game's loop:

     what the transport has       -> iso_session_connected, _disconnected, _receive
     iso_session_add_local_input
     iso_session_drive                            with callbacks, or without any:
       iso_session_advance(session, now);
       while (iso_session_next(session, &request) == ISO_OK && request.kind != ISO_NOTHING)
         if (request.kind == ISO_STEP) step the game with iso_session_inputs(session, &players);
     iso_session_poll_send        -> the transport, until there is nothing more
     iso_session_poll_event                       likewise

   A transport of isostep's does the first and the last by its _deliver and _dispatch. */

typedef uint32_t iso_request_kind;
enum {
  ISO_NOTHING,        /* the turn is done */
  ISO_STEP,           /* step the game by one frame, before the next call */
  ISO_ROLLED_BACK,    /* the state is again that before `frame` */
  ISO_RESTARTED,      /* the state is one that arrived from elsewhere, before `frame` */
  ISO_FRAME_CONFIRMED /* `frame` is final, once each, ascending; `hash`: of the state after it */
};
typedef struct iso_request {
  uint32_t size;
  iso_request_kind kind;
  int32_t frame;
  uint32_t reserved;
  uint64_t hash;
} iso_request;

/* Begins the turn. */
ISO_API iso_status iso_session_advance(iso_session* session, uint64_t now);
/* The next request; saves, loads and all else is done by itself in between. */
ISO_API iso_status iso_session_next(iso_session* session, iso_request* out);
/* Of the step that was asked for, by player, until the next call; else null. */
ISO_API const iso_input* iso_session_inputs(const iso_session* session, uint32_t* players);
/* Begins a turn and carries it out with iso_game.step. `steps` (or null): how many, those again included. */
ISO_API iso_status iso_session_drive(iso_session* session, uint64_t now, uint32_t* steps);

/* For the next frame; until that is stepped a later one replaces it. Refused: not a player of ours, not in the match
   now, or `valid` refuses. */
ISO_API iso_status iso_session_add_local_input(iso_session* session, int32_t player, const void* bytes, size_t size);
/* 1: the last one has been taken. A game of orders hands over the next only then. */
ISO_API uint8_t iso_session_wants_input(const iso_session* session, int32_t player);

/* The transport's side. `incoming`: the other side asked for the connection, as all do at a host. */
typedef uint32_t iso_channel;
enum {
  ISO_DATAGRAM, /* may be lost, doubled, late or out of order */
  ISO_RELIABLE  /* arrives whole and in order, or the connection ends */
};
ISO_API iso_status iso_session_connected(iso_session* session, uint32_t peer, uint64_t now, uint8_t incoming);
ISO_API iso_status iso_session_disconnected(iso_session* session, uint32_t peer, uint64_t now);
/* Malformed bytes are counted, and otherwise without effect. */
ISO_API iso_status iso_session_receive(iso_session* session, uint32_t peer, iso_channel channel, const void* bytes,
                                       size_t size, uint64_t now);
typedef struct iso_outgoing {
  uint32_t size;
  uint32_t peer;
  iso_channel channel;
  uint32_t length; /* [bytes] 0: nothing to send, `close` alone */
  uint8_t close;   /* end the connection after it */
  uint8_t reserved1[7];
} iso_outgoing;
/* `bytes`: null when there is nothing more; they hold until the next call. */
ISO_API iso_status iso_session_poll_send(iso_session* session, uint64_t now, iso_outgoing* out, const uint8_t** bytes);
/* Connect to this machine, as iso_session_config.address of its session says; null: none. */
ISO_API iso_status iso_session_poll_connect(iso_session* session, const char** address);
/* [us] until the next frame is due: how long a loop may sleep when the network is silent. */
ISO_API uint64_t iso_session_wait(const iso_session* session, uint64_t now);

/* What players may vote on. */
typedef uint32_t iso_proposal;
enum { ISO_VOTE_PAUSE = 1, ISO_VOTE_UNPAUSE, ISO_VOTE_SPEED, ISO_VOTE_KICK, ISO_VOTE_OTHER };

typedef uint32_t iso_event_kind;
enum {
  ISO_EVENT_NONE,          /* there is none */
  ISO_EVENT_STARTED,       /* frame: the first */
  ISO_EVENT_JOINED,        /* player plays from frame on: reported when that is final, alike on all peers */
  ISO_EVENT_LEFT,          /* player is gone from frame on: as well */
  ISO_EVENT_WAITING_FOR,   /* players hold the match up, their inputs are missing; none: the host is silent */
  ISO_EVENT_RESUMED,       /* it goes on */
  ISO_EVENT_PAUSED,        /* from frame on, by player; ISO_NO_PLAYER: by the host's game */
  ISO_EVENT_UNPAUSED,      /* likewise */
  ISO_EVENT_SPEED_CHANGED, /* likewise: speed */
  ISO_EVENT_ASKS_PAUSE,    /* host: player asks for it, and players_set_tempo is 0: iso_session_pause or not */
  ISO_EVENT_ASKS_UNPAUSE,  /* likewise */
  ISO_EVENT_ASKS_SPEED,    /* likewise: speed */
  ISO_EVENT_VOTE,          /* the ballot as it stands now, when it is opened, and when somebody has voted */
  ISO_EVENT_VOTE_PASSED,   /* likewise */
  ISO_EVENT_VOTE_FAILED,   /* likewise; also when the host that counted is gone */
  ISO_EVENT_SLOWED_BY,     /* all step as slowly as player's machine can */
  ISO_EVENT_FULL_SPEED,    /* no longer */
  ISO_EVENT_REFUSED,       /* key: what differs, or why not; the host reports whom it refused */
  ISO_EVENT_LOST_HOST,     /* nothing was heard of it for too long, or the connection ended */
  ISO_EVENT_SEEKS_HOST,    /* likewise, but the match goes on at another */
  ISO_EVENT_NEW_HOST,      /* frame: where it goes on; player: the first of the host's */
  ISO_EVENT_DEPOSED,       /* host: the others went on without us, or have gone: we seek their host */
  ISO_EVENT_DESYNC,        /* player's states differ from ours after state agreed and at the latest in state frame */
  ISO_EVENT_OUTVOTED,      /* player's states are wrong, as of state frame: most machines have others */
  ISO_EVENT_UNDECIDED,     /* machines differ in state frame, and no majority says who is wrong */
  ISO_EVENT_REPAIRED,      /* player has a state of the host's again */
  ISO_EVENT_BAD_SNAPSHOT,  /* the state that arrived has another hash, was refused, or the host has none */
  ISO_EVENT_MISUSE,        /* requests of the last turn were not carried out */
  ISO_EVENT_UNHASHED       /* sync test: the game takes another byte `ours` of state frame, and its hash stays */
};
typedef struct iso_session_event {
  uint32_t size;
  iso_event_kind kind;
  uint32_t player; /* ISO_NO_PLAYER: none, or the host's machine */
  int32_t frame;
  int32_t agreed; /* [frame] */
  uint32_t players;
  uint32_t speed; /* [1/8 of the match's rate] */
  uint32_t vote;  /* its number in the match; 0: none */
  iso_proposal proposal;
  uint32_t subject;
  uint32_t proposer;
  uint32_t voters;       /* players */
  uint32_t yes;          /* players */
  uint32_t no;           /* players */
  uint64_t ours;         /* hash chains; outvoted: player's */
  uint64_t theirs;       /* and the majority's */
  char key[40];          /* refused: what differs */
  char theirs_text[136]; /* there, or in the file */
  char ours_text[136];   /* here */
} iso_session_event;
/* The session keeps the last 128: stats.events_lost. */
ISO_API iso_status iso_session_poll_event(iso_session* session, iso_session_event* out);

typedef uint32_t iso_phase;
enum {
  ISO_WAITING,       /* for the others, or for the host */
  ISO_JOINING,       /* a snapshot arrives, or the frames since */
  ISO_PLAYING,       /* a player of ours is in the match; replay, sync test: running */
  ISO_WATCHING,      /* as a spectator, or cut out of the match and on the way back */
  ISO_SEEKING,       /* the host is gone, and another machine follows it */
  ISO_LOST,          /* the host is gone: connect again */
  ISO_PHASE_REFUSED, /* the host will not have us: the event says why */
  ISO_OVER           /* a replay has ended */
};
ISO_API iso_phase iso_session_phase(const iso_session* session);
/* Says who we are after a crash: iso_session_config.token. 0: not seated yet. */
ISO_API uint64_t iso_session_token(const iso_session* session);
ISO_API int32_t iso_session_local_player(const iso_session* session);   /* the first of this machine; -1: none yet */
ISO_API uint32_t iso_session_local_players(const iso_session* session); /* all of them */
ISO_API int32_t iso_session_current(const iso_session* session);        /* the next frame to be stepped */
ISO_API int32_t iso_session_confirmed(const iso_session* session);      /* states up to this one are final */
/* What a player did in a frame that is at most `kept` frames old; ISO_DISCONNECTED for who was absent. */
ISO_API iso_status iso_session_input(const iso_session* session, int32_t frame, int32_t player, iso_input* out);
/* [bytes] Of the snapshot under way: on a client the one that it waits for, on a host the one that `peer` is sent. */
ISO_API iso_status iso_session_snapshot_progress(const iso_session* session, uint32_t peer, uint32_t* arrived,
                                                 uint32_t* size);

typedef struct iso_session_stats {
  uint32_t size;
  int32_t delay;          /* [frames] an input waits now */
  uint64_t steps;         /* carried out, again or for the first time */
  uint64_t rollbacks[65]; /* by depth [frames] */
  uint64_t waits;         /* times that a due frame had to wait */
  uint64_t datagrams_out;
  uint64_t datagrams_in;
  uint64_t bytes_out; /* datagrams' and messages' own, without UDP/IP */
  uint64_t bytes_in;
  uint64_t refused;     /* datagrams and messages that were malformed or not for us */
  uint64_t flooded;     /* dropped unread */
  uint64_t put_out;     /* host: peers that did not acknowledge what they were sent */
  uint64_t events_lost; /* the caller did not take them in time */
  uint64_t round_trip;  /* [us] client: to the host; host: the slowest client's */
  int32_t peers;        /* connected */
  int32_t machines;     /* that decide without a host, with migration */
  uint32_t jitter;      /* [us] client: of the host's datagrams */
  uint32_t loss;        /* [permille] likewise */
  int32_t stretch;      /* [1/256 period] by which frames are longer than they should be */
  uint32_t reserved1;
} iso_session_stats;
ISO_API iso_status iso_session_get_stats(const iso_session* session, iso_session_stats* out);
typedef struct iso_player_stats {
  uint32_t size;
  int32_t early;       /* [frames] by which the latest input of a second came before it was needed; negative: late */
  uint32_t replaced;   /* inputs that came after the deadline */
  uint32_t waited;     /* [us] that the others waited for it within the last minute */
  uint32_t round_trip; /* [us] to the host and back */
  uint32_t jitter;     /* [us] */
  uint32_t loss;       /* [permille] of its datagrams that the host did not get */
  uint32_t reserved1;
} iso_player_stats;
ISO_API iso_status iso_session_get_player_stats(const iso_session* session, int32_t player, iso_player_stats* out);

/* Decisions. Those of who may not make them, or not now, are refused. */
ISO_API iso_status iso_session_start(iso_session* session, uint64_t now); /* host: begins although seats are empty */
ISO_API iso_status iso_session_resync(iso_session* session); /* client: takes a state of the host's, keeps its seat */
/* The match stands still, or goes on, on all machines before the same frame. A client's is a request to the host. */
ISO_API iso_status iso_session_pause(iso_session* session);
ISO_API iso_status iso_session_unpause(iso_session* session);
ISO_API iso_status iso_session_set_speed(iso_session* session, int32_t eighths);
/* `player`, one of ours, asks all who play. `subject`: speed [1/8], whom to kick, or what the game likes. */
ISO_API iso_status iso_session_propose(iso_session* session, int32_t player, iso_proposal proposal, uint32_t subject);
/* In the vote of the last event; the last word counts. */
ISO_API iso_status iso_session_vote(iso_session* session, int32_t player, uint8_t yes);

/* Host with asks_admission: who waits for an answer, each once; id 0: none. */
typedef struct iso_applicant {
  uint32_t size;
  uint32_t peer;
  uint64_t id;
  uint8_t spectator;
  uint8_t reserved1[3];
  int32_t seat;             /* that it asks for, with those after it; -1: any */
  int32_t seats;            /* how many */
  int32_t player;           /* whose token it has shown; -1: nobody's */
  uint32_t credential_size; /* [bytes] */
  uint32_t reserved2;
  uint8_t credential[256];
} iso_applicant;
ISO_API iso_status iso_session_poll_applicant(iso_session* session, iso_applicant* out);
ISO_API iso_status iso_session_admit(iso_session* session, uint64_t applicant);
/* Reasons are printable ASCII of 1 to 128 characters, for people. */
ISO_API iso_status iso_session_refuse(iso_session* session, uint64_t applicant, const char* reason);
ISO_API iso_status iso_session_kick(iso_session* session, int32_t player, const char* reason);
ISO_API iso_status iso_session_kick_peer(iso_session* session, uint32_t peer, const char* reason);
ISO_API int32_t iso_session_peer_of(const iso_session* session,
                                    int32_t player); /* host: who has the seat; -1: nobody */

/* Host: the match in its newest final state, for iso_session_create of another process. In: room, out: need. */
ISO_API iso_status iso_session_save_match(iso_session* session, void* bytes, size_t* size);

/* Recordings of the confirmed frames, from the next frame stepped on. One of each kind at a time. */
typedef uint32_t iso_recording;
enum {
  ISO_RECORD_MATCH, /* inputs and hashes: a few kilobytes a minute, for ISO_REPLAY by who has the game */
  ISO_RECORD_WORLD  /* the world's commands and hashes: `isostep verify` plays it without the game. Of a game with a
                       world, to which nothing else records meanwhile */
};
/* `scene`: of ISO_RECORD_WORLD the name in the file, 1 to 128 characters; null: config.name. */
ISO_API iso_status iso_session_record(iso_session* session, iso_recording kind, const char* scene);
/* Ends it with the last confirmed frame; the file. Asked with too little room it stays for the next call. It has ended
   before where the session restarted from another state. */
ISO_API iso_status iso_session_recorded(iso_session* session, iso_recording kind, void* bytes, size_t* size);

/* A network in virtual time, for tests and testbeds: endpoint 0 is the host, clients follow. */
typedef struct iso_network iso_network;
ISO_API iso_status iso_network_create(uint64_t seed, iso_network** out);
ISO_API iso_status iso_network_destroy(iso_network* network);
/* `profile`: "wifi", "latency=80,jitter=20,loss=5", "lan,down.loss=2.5": [ms], [%]; up. and down. are to and from the
   host. Names: loopback lan wifi mobile severe burst duplicate reorder asymmetric constant blackout blackout-up
   blackout-down. Refused: iso_network_problem says where. */
ISO_API iso_status iso_network_add_client(iso_network* network, const char* profile, uint32_t* endpoint);
ISO_API iso_status iso_network_set_profile(iso_network* network, uint32_t client, const char* profile);
ISO_API const char* iso_network_problem(const iso_network* network);
/* Refused while the last connection between them is not over. */
ISO_API iso_status iso_network_connect(iso_network* network, uint32_t from, uint32_t to);
ISO_API iso_status iso_network_cut(iso_network* network, uint32_t client); /* both sides hear it now */
ISO_API iso_status iso_network_set_silent(iso_network* network, uint32_t endpoint,
                                          uint8_t silent);                                      /* as a pulled cable */
ISO_API iso_status iso_network_set_side(iso_network* network, uint32_t endpoint, int32_t side); /* sides do not meet */
/* Lets everything due until then happen; refused where that is in the past. */
ISO_API iso_status iso_network_advance_to(iso_network* network, uint64_t now);
/* What has arrived goes into the session; what it has to say goes out. Addresses of a migration are endpoints: "2". */
ISO_API iso_status iso_network_deliver(iso_network* network, uint32_t endpoint, iso_session* session, uint64_t now);
ISO_API iso_status iso_network_dispatch(iso_network* network, uint32_t endpoint, iso_session* session, uint64_t now);

/* End of sessions */

#ifdef __cplusplus
}
#endif

#endif
