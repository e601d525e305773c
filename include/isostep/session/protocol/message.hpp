// What travels on the reliable channel: who may take part, the state a late joiner starts from, and when it may play.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "isostep/session/protocol/address.hpp"
#include "isostep/session/protocol/packet.hpp"
#include "isostep/state/replay_header.hpp"

namespace isostep {

enum class MessageKind : std::uint8_t {
  hello = 1,
  welcome,
  refuse,
  piece,
  progress,
  ready,
  open,
  roster,
  enrolled,
  candidate,
  known,
  support,
  redirect,
  inquiry,
  statement,
  statements,
  resync,
  offer,
  repaired,
  ask,
  propose,
  vote,
  ballot,
  farewell
};

/// A player's request to the host: a pause, its end, or a speed.
struct Ask {
  bool is_paused = false;
  std::uint8_t speed = 0;  // [1/8 of the match's rate] 0: none
};

/// A client's application for a part in the match.
struct Application {
  bool spectator = false;
  int seat = -1;                   // this one and those after it, or none; -1: any
  int seats = 1;                   // so many, for as many players on one machine; of a spectator without meaning
  std::uint64_t token = 0;         // from an earlier welcome: the same player again; 0: a new one
  std::uint64_t life = 0;          // likewise: the same process, which remembers the match; 0: it has just begun
  std::uint32_t term = 0;          // the newest of a host that it followed or supported
  HashReport have;                 // a state that it holds with its history: frame 0, or where it was cut off
  HashReport partial{0, 0};        // of the snapshot of which it has the first bytes,
  std::uint32_t partial_size = 0;  // [bytes] so many; 0: of none
};

inline constexpr std::size_t kCredentialCap = 256;  // [bytes] a signature of 64 and what it signs

/// A client's first message.
struct Hello : Application {
  Bytes credential;    // for the host's game
  Address address;     // where the others reach it, when there is no host
  Time migration = 0;  // [us] as its SessionConfig's: a match has one
  ReplayHeader identity;
};

/// The host's answer. If there is a snapshot, its pieces follow. Else the client goes on from `start`, which it has.
struct Welcome {
  std::uint64_t match = 0;
  std::uint8_t players = 0;    // of the match
  std::uint32_t hosted = 0;    // of them, a bit each: who plays on the host
  std::uint8_t player = 0xff;  // the first of the client's; 0xff: a spectator
  std::uint32_t others = 0;    // its further players, a bit each
  std::uint64_t token = 0;
  std::uint64_t life = 0;  // of the client's process, from now on
  std::uint32_t term = 0;  // the host's; 0: the match does not go on without it
  Frame term_start = 0;    // before this frame the host took over all inputs
  HashReport start;
  std::uint64_t hash = 0;           // of the state `start.frame`
  std::uint32_t snapshot_size = 0;  // [bytes]
  std::uint32_t snapshot_from = 0;  // [bytes] that the client has: the pieces begin there
  Frame opens = kNoFrame;           // the first frame that its players play, when that is known already

  /// The client's players, a bit each.
  std::uint32_t seated() const { return player == 0xff ? 0 : others | 1u << player; }
};

/// The reason: the first field that differs, or a key of the session ("protocol", "seats", "admission", "kicked").
using Refusal = HeaderMismatch;

struct Piece {
  std::uint32_t offset;  // [bytes] into the snapshot
  Bytes bytes;
};

/// These functions replace the content of `out`.
void write_hello(const Hello& hello, std::vector<std::uint8_t>& out);
void write_welcome(const Welcome& welcome, std::vector<std::uint8_t>& out);
void write_refusal(const Refusal& refusal, std::vector<std::uint8_t>& out);
void write_piece(const Piece& piece, std::vector<std::uint8_t>& out);
/// From a client: so many bytes of the snapshot have arrived.
void write_progress(std::uint32_t arrived, std::vector<std::uint8_t>& out);
/// From a client: it has caught up, and enough machines have its states (see OwnSeats). It asks to play.
void write_ready(std::vector<std::uint8_t>& out);
/// From the host: the client's players play from frame `first` on.
void write_open(Frame first, std::vector<std::uint8_t>& out);
/// From a client: it has this version of the roster.
void write_enrolled(std::uint32_t version, std::vector<std::uint8_t>& out);
/// From a machine that wants to be the next host.
struct Candidate {
  std::uint32_t term = 0;                      // for which it asks
  std::uint32_t log_term = 0;                  // of the host whose inputs it has
  std::uint32_t roster_term = 0, version = 0;  // of its roster
  Frame ends[kMaxPlayers] = {};                // the first final input of each player that it lacks
};
void write_candidate(const Candidate& candidate, std::vector<std::uint8_t>& out);
/// To a candidate: some of the inputs that it lacks, in the form of a datagram.
void write_known(Bytes packet, std::vector<std::uint8_t>& out);
/// To a candidate: it alone may be the host of this term, if it has all inputs that we know to be final, up to `ends`.
struct Support {
  std::uint32_t term = 0;
  Frame ends[kMaxPlayers] = {};
};
void write_support(const Support& support, std::vector<std::uint8_t>& out);
/// Sends the other side to the host, which is at this address.
void write_redirect(const Address& address, std::vector<std::uint8_t>& out);
/// From a host: it stops being the host, and another follows it. From a client: it looks for another host.
void write_farewell(std::vector<std::uint8_t>& out);
void write_ask(const Ask& ask, std::vector<std::uint8_t>& out);

Result<MessageKind> message_kind(Bytes message);
Result<Hello> read_hello(Bytes message);
Result<Welcome> read_welcome(Bytes message);
Result<Refusal> read_refusal(Bytes message);
Result<Piece> read_piece(Bytes message);
Result<std::uint32_t> read_progress(Bytes message);
Result<Frame> read_open(Bytes message);
Result<std::uint32_t> read_enrolled(Bytes message);
Result<Candidate> read_candidate(Bytes message);
Result<Packet> read_known(Bytes message);
Result<Support> read_support(Bytes message);
Result<Address> read_redirect(Bytes message);
Result<Ask> read_ask(Bytes message);

}  // namespace isostep
