// SessionEvent: what a session tells its caller; and the queue in which it waits for that.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>

#include "isostep/session/agreement/ballot.hpp"
#include "isostep/session/protocol/message.hpp"
#include "isostep/session/timeline/bounded_queue.hpp"

namespace isostep {

struct SessionEvent {
  enum class Kind : std::uint8_t {
    started,        // frame: the first
    joined,         // player plays from frame on: reported when that is final, alike on all peers
    left,           // player is gone from frame on: as well
    waiting_for,    // players (a bit each) hold the match up, their inputs are missing; none: the host is silent
    resumed,        // it goes on
    replaced,       // guesses count in place of player's inputs, too late for the deadline: once a second at most
    too_far,        // no delay covers player's line under the deadline: it watches
    paused,         // from frame on, by player; 0xff: by the host's game
    unpaused,       // likewise
    speed_changed,  // likewise: `speed`
    asks_pause,     // host: player asks for it, and players_set_tempo is false: pause() or not
    asks_unpause,   // likewise
    asks_speed,     // likewise: `speed`
    vote,           // ballot: as it stands now, when it is opened, and when somebody has voted
    vote_passed,    // ballot
    vote_failed,    // ballot: also when the host that counted is gone
    slowed_by,      // all step as slowly as player's machine can: told when that begins, and when it is another's
    full_speed,     // no longer
    refused,        // field: what differs, or why not; the host reports whom it refused, and not whom it kicked
    lost_host,      // nothing was heard of it for too long, or the connection ended
    seeks_host,     // likewise, but the match goes on at another
    new_host,       // frame: where it goes on; player: the first of the host's, 0xff when it has none
    deposed,        // host: the others went on without us, or have gone: we seek their host
    desync,         // player's states differ from ours after state `agreed` and at the latest in state `frame`
    outvoted,       // player's states are wrong, as of state `frame`: more than half of all machines have others
    undecided,      // machines differ in state `frame`, and no majority says who is wrong
    repaired,       // player has a state of the host's again; its states are compared from the one after `frame` on
    bad_snapshot,   // the state that arrived has not the host's hash, or was refused, or the host has none: error
    misuse,         // requests of the last advance were not carried out
    unhashed        // sync test: the game takes another byte `ours` of the portable state `frame`, and its hash stays
  };
  Kind kind;
  std::uint8_t player = 0xff;  // 0xff: none, or the host's machine
  Frame frame = kNoFrame;
  Frame agreed = kNoFrame;
  std::uint32_t players = 0;
  Ballot ballot{};
  std::uint8_t speed = 0;              // [1/8 of the match's rate]
  std::uint64_t ours = 0, theirs = 0;  // hash chains; outvoted: player's and the majority's
  Refusal field{};
};

/// In: events. Out: the same, in order. Keeps: the newest kCapacity that the caller has not taken.
class EventQueue {
 public:
  void tell(const SessionEvent& event) { queue_.push(event); }
  std::optional<SessionEvent> poll() {
    if (queue_.empty()) return std::nullopt;
    return queue_.pop();
  }
  std::uint64_t lost() const { return queue_.lost(); }

 private:
  // Between two polls: a refusal of every connection that the defaults allow for, and as many of the match.
  static constexpr std::size_t kCapacity = 128;

  BoundedQueue<SessionEvent> queue_{kCapacity};
};

/// Returns the event that tells how the vote stands in the frame `current`.
SessionEvent event_of(const Ballot& ballot, Frame current);
/// Ends a ballot that nobody counts any more. If it was open, it has failed.
void end_ballot(Ballot& ballot, Frame current, EventQueue& events);

}  // namespace isostep
