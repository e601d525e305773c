// SessionConfig: which session, with whom, and how patient; by this alone a team switches between them.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "isostep/session/protocol/address.hpp"
#include "isostep/session/timeline/frame.hpp"
#include "isostep/state/replay_header.hpp"

namespace isostep {

enum class SessionMode : std::uint8_t {
  lockstep,   // a frame is stepped when all its inputs are known
  rollback,   // a frame is stepped when it is due; wrong guesses are stepped again
  spectator,  // no player; steps what is known, and catches up when behind
  sync_test,  // one machine: every frame is rolled back, stepped again and compared
  replay      // plays a recorded match
};

inline constexpr Frame kMostDelay = 60;     // [frames] an input waits at most: a second
inline constexpr Frame kMostDeadline = 60;  // [frames]

struct SessionConfig {
  SessionMode mode = SessionMode::rollback;
  bool host = false;  // others connect to us; the host fixes what was played
  int players = 2;
  /// Host: so many players, the first ones, play here; 0: a dedicated host. Client: the number of seats that it asks
  /// for, all or none; 0 counts as 1, and a spectator asks for none. Sync test: all players play here.
  int local_players = 1;
  int hz = 60;  // [1/s]

  Frame window = 8;       // rollback: frames stepped on guesses; sync test: frames rolled back
  Frame delay = 2;        // [frames] an input waits at first
  Frame least_delay = 0;  // it adapts between these; equal: it does not
  Frame most_delay = 20;  // with a deadline up to half a second, where inputs would be replaced otherwise
  /// [frames] Host: an input that is late by so many is replaced by the guess. A client is sent the others' inputs of a
  /// frame only after its own has reached the host, so nobody gains by waiting for them. 0: none.
  Frame deadline = 0;

  Time silence = 4 * kSecond;     // [us] without a word from a peer until it counts as lost
  Time patience = 5 * kSecond;    // [us] that one player may make the others wait within a minute; then it is left out
  Time exclusion = 60 * kSecond;  // [us] for so long: it watches meanwhile
  Frame kept = 64;  // states kept to find the cause of a divergence in, more than window, delay and latency
  /// [frames] of inputs that are kept: a snapshot must reach a late joiner within them. Two minutes bring 5 MB at 50
  /// kB/s. The memory is history * (players * (3 + the longest input) + 24) bytes: 0.6 MB for eight players of 4 bytes.
  Frame history = 7200;
  /// A client whose state is at most so many frames old steps them all. A client with an older one is sent a snapshot.
  Frame most_replayed = 1200;
  int max_peers = 16;  // whom the host serves: the players, and as many spectators as they leave room for
  /// Connections beside those, at a host, a relay or a client with `migration`: of peers without a hello, or refused.
  /// The sum of both is the transport's limit and above every PeerId. More strangers than that lock players out.
  int max_strangers = 48;
  std::uint32_t snapshot_cap = 64u << 20;  // [bytes] of a portable snapshot that a client accepts
  std::uint32_t most_packets = 8 * 60;  // [1/s] datagrams, and messages, accepted of one peer; more are dropped unread

  /// Host: the secret from which match number and tokens are computed. Draw all its bits for every match from the
  /// system's source of random numbers, for a session has none. Whoever guesses it, for example one made from a clock,
  /// knows every player's token. 0, the default, is refused.
  std::uint64_t seed = 0;
  /// [us] of silence from the host after which the clients go on without it, with one of them as the host. 0: never. It
  /// takes three machines, and each that may become the host has an address and a seed.
  Time migration = 0;
  bool relays = false;  // spectator: it serves up to max_peers further ones, who connect to it as to a host
  /// Relay: it and all whom it serves see the match so many frames late. Ten minutes are 36000 frames and need a
  /// history of 72200: 5.8 MB for eight players of 4 bytes.
  Frame broadcast_delay = 0;
  Address address;  // where the others' transports reach ours: text for SessionCore::poll_connect of theirs
  /// A client whose states a majority finds wrong takes a state of the host's automatically, see Session::resync. With
  /// `migration`, a host whose own states are found wrong gives way to another machine.
  bool repair = false;
  Time reservation = 60 * kSecond;  // [us] host: a seat that was played on is kept so long for its player's token
  bool asks_admission = false;      // host: its game decides whom it lets in, see Session::poll_applicant
  bool votes = false;               // host: who plays may propose a vote, see Session::propose
  /// Host: continues this match, see Session::save_match. Frames are stepped when the players of all its seats are
  /// back, or after Session::start.
  std::vector<std::uint8_t> saved_match;
  bool players_set_tempo =
      false;  // host: who plays may pause and set the speed; else the host's game is asked, by events
  /// Client: the Session::token() of a former process of this player, which the host may still take for alive. This
  /// process gets its seat. 0: a new player.
  std::uint64_t token = 0;
  int seat = -1;  // client: this seat, and those after it for further players of ours, or none; -1: any
  std::vector<std::uint8_t> credential;  // client: for the host's game, at most kCredentialCap
  /// Values that must be equal on all peers, by name: make_replay_header(identity_of_world(...)) and what the game
  /// adds. The session adds the layout of the input, its rate and the number of players.
  ReplayHeader identity;
};

/// Returns the first rule that `config` breaks, as the field's name and its valid values; null if it breaks none.
const char* problem_of(const SessionConfig& config);

}  // namespace isostep
