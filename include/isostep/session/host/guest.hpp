// Guest: what the host knows of one connection, from its first word on.
// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <vector>

#include "isostep/session/peer/peer_link.hpp"
#include "isostep/session/peer/snapshot_transfer.hpp"
#include "isostep/session/protocol/message.hpp"
#include "isostep/session/protocol/outbox.hpp"

namespace isostep {

/// Messages that are due to a guest, the most urgent first. Each is written when it is sent, from the state of then.
enum class Due : std::uint8_t {
  close,       // its connection ends
  welcome,     // it is in the match, or gets a snapshot
  roster,      // another
  ballot,      // how the vote stands
  inquiry,     // which chain has it?
  statements,  // who said what
  repaired,    // who is: see RepairService::tells
  offer,       // of a repair, or none
  open         // from when on its players play
};

/// The host's part in a client's repair, see Repair.
struct RepairService {
  enum class Stage : std::uint8_t {
    none,
    waits,  // it was served a moment ago
    needs,  // the next snapshot
    receives,
    restores  // it has all of it
  };
  Stage stage = Stage::none;
  Time next = 0;            // [us] not before: a snapshot costs the host more than it costs to ask for one
  std::uint32_t tells = 0;  // players of whom this client must hear that they are repaired, a bit each
};

/// The host's view of one connection, from its first message on.
struct Guest : PeerLink {
  /// Resets it for the next connection in its place.
  void clear() {
    const PeerId its_peer = peer;
    const Time its_probe_every = probe_every;
    *this = Guest{};
    peer = its_peer;
    probe_every = its_probe_every;
  }
  bool has(int its_player) const { return (players >> its_player & 1) != 0; }
  bool applies() const { return is_connected && stage == Stage::applies; }
  bool is_live() const { return stage == Stage::live; }
  /// Returns true if it is let in: it is in the match, or on the way.
  bool is_served() const {
    return is_connected && stage != Stage::connected && stage != Stage::applies && stage != Stage::refused;
  }
  /// Returns true for a spectator that has not shown yet that it takes what it is sent. Anybody may come and watch.
  bool is_unproven() const { return player < 0 && acked_at == 0; }
  /// It waits for the next snapshot, or receives this one: to join the match, or for a repair.
  bool needs_snapshot() const { return stage == Stage::needs_snapshot || repair.stage == RepairService::Stage::needs; }
  bool receives_snapshot() const {
    return stage == Stage::receives_snapshot || repair.stage == RepairService::Stage::receives;
  }
  /// Sends it back to a snapshot, because inputs that it lacks are gone.
  void fall_behind() {
    stage = Stage::needs_snapshot;
    due.add(Due::welcome);
    for (const Due no_more : {Due::repaired, Due::offer, Due::open}) due.drop(no_more);
    is_ready = false;
    repair = RepairService{.next = repair.next};
    opens = kNoFrame;
  }
  /// Measures the line for the transfer of a snapshot.
  void measure(const PacketHeader& header, Time now) {
    const std::uint16_t trip = static_cast<std::uint16_t>(static_cast<std::uint16_t>(now / 1000) - header.echo);
    if (header.has_echo) transfer.measured(Time{trip} * 1000, now);
  }
  /// Renews the lease: the guest waits for us for a lease from the time when we sent what it echoes.
  void renew_lease(const PacketHeader& header, Time now) {
    if (!header.has_echo || header.waited == 255) return;
    const auto said = static_cast<std::uint16_t>(header.echo - header.waited);
    const auto age = static_cast<std::uint16_t>(static_cast<std::uint16_t>(now / 1000) - said);
    if (age > 32767 || Time{age} * 1000 > now) return;
    // The clock of datagrams ticks in milliseconds.
    const Time from = now / 1000 * 1000 - Time{age} * 1000;
    if (from > lease_from) lease_from = from;
  }

  enum class Stage : std::uint8_t { connected, applies, needs_snapshot, receives_snapshot, live, refused };
  Stage stage = Stage::connected;
  Outbox<Due> due;
  Application wish;
  std::uint64_t applicant = 0;  // its number, while the game decides
  bool is_shown = false;        // to the game
  std::vector<std::uint8_t> credential;
  Address address;
  Time lease_from = 0;                        // [us] when we said the newest that it has heard; 0: nothing
  std::optional<Ask> asks_pause, asks_speed;  // the last of each that is not answered yet
  Time may_ask_at = 0;                        // [us] others are answered then
  std::uint32_t enrolled = 0;                 // the roster that it has
  std::uint32_t players = 0;                  // its seats, a bit each: they are taken, open and close together
  int player = -1;                            // the first of them; -1: a spectator
  int figures_left = 0;                       // players whose figures it is told next, one with each datagram
  bool is_ready = false;                      // asked to play
  Time too_slow_since = 0;                    // [us]
  bool is_far = false;                        // its line is worse than the others'
  bool is_too_far = false;                    // no delay covers it: it watches
  Time covered_at = 0;                        // [us] when one did
  Frame held_back_until[kMaxPlayers] = {};    // what it says of a player speaks of its own: it lacked inputs then
  Frame opens = kNoFrame;
  Frame start = 0;                 // the state from which it goes on
  std::uint64_t start_chain = 0;   // without a snapshot: as it said itself
  HashReport partial;              // the snapshot of which it has some bytes from before; kNoFrame: of none
  std::uint32_t partial_size = 0;  // [bytes]
  SnapshotTransfer transfer;
  Refusal refusal{};
  RepairService repair;
  HashReport report;
  std::size_t next_reporter = 0;  // whose report it hears of next

  bool has_spoken = false;            // it says something that is for this match
  Frame owes[kMaxPlayers] = {};       // what it has to acknowledge before more is due: first frames beyond
  Time owes_since = 0;                // [us]
  Time had_all_at = 0;                // [us] when it lacked nothing, or came
  Time back_at = 0;                   // [us] when it was heard again after a long silence
  Time more_at = 0;                   // [us] who does not acknowledge is sent nothing before
  Frame first_end[kMaxPlayers] = {};  // what the last period's first datagram left out
  bool takes_bursts = false;          // it had the one before that when it was sent
  static constexpr Time kFirstProbe = kSecond / 10;  // [us]
  Time probe_every = kFirstProbe;  // [us] kept when it goes: its place may be taken by who is no better
};

}  // namespace isostep
