// SessionCore: what every session offers, in bytes; Session<Game> puts the game's types around it.
// SPDX-License-Identifier: MIT
#pragma once

#include <bit>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "isostep/session/config.hpp"
#include "isostep/session/peer/controls.hpp"
#include "isostep/session/peer/events.hpp"
#include "isostep/session/peer/snapshot_transfer.hpp"
#include "isostep/session/protocol/message.hpp"
#include "isostep/session/protocol/player_stats.hpp"
#include "isostep/session/protocol/saved_match.hpp"
#include "isostep/session/timeline/bounded_queue.hpp"
#include "isostep/session/timeline/timeline.hpp"

namespace isostep {

/// A request to the game: the next thing that it must do.
enum class RequestKind : std::uint8_t {
  save,     // keep the state `frame`, which is the present one, and report its hash
  load,     // go back to the state `frame`
  step,     // step frame `frame`: state frame becomes state frame + 1
  capture,  // write the portable form of the kept state `frame`, for a late joiner; then be in the present one again
  restore,  // become the portable state that arrived
  probe     // sync test: see whether the hash tells of what the portable form of the state `frame` holds
};
struct SessionAction {
  RequestKind kind;
  Frame frame;
  bool as_confirmed = false;  // step: predicted inputs are shown as confirmed, which may make no difference
};

enum class SessionPhase : std::uint8_t {
  waiting,   // for the others, or for the host
  joining,   // a snapshot arrives, or the frames since
  playing,   // a player of ours is in the match; replay, sync test: running
  watching,  // as a spectator, or cut out of the match and on the way back
  seeking,   // the host is gone, and another machine follows it
  lost,      // the host is gone: connect again
  refused,   // the host will not have us: the event says why
  over       // a replay has ended
};

struct Outgoing {
  PeerId peer;
  Channel channel;
  Bytes bytes;         // until the next call
  bool close = false;  // nothing more to say: end the connection
};

struct SessionStats {
  std::uint64_t steps = 0;           // carried out, again or for the first time
  std::uint64_t rollbacks[65] = {};  // by depth [frames]
  std::uint64_t waits = 0;           // times that a due frame had to wait
  std::uint64_t datagrams_out = 0, datagrams_in = 0;
  std::uint64_t bytes_out = 0, bytes_in = 0;  // datagrams' and messages' own, without UDP/IP
  std::uint64_t refused = 0;                  // datagrams and messages that were malformed or not for us
  std::uint64_t flooded = 0;                  // dropped unread
  std::uint64_t put_out = 0;                  // host: peers that did not acknowledge what they were sent
  std::uint64_t events_lost = 0;              // the caller did not take them in time
  Time round_trip = 0;                        // [us] client: to the host; host: the slowest client's
  int peers = 0;                              // connected
  int machines = 0;                           // in the roster that we have: with migration, who decides without a host
  Frame delay = 0;                            // [frames] an input waits now
  std::uint32_t jitter = 0, loss = 0;         // [us], [permille] client: of the host's datagrams, as PlayerStats
  PlayerStats players[kMaxPlayers];
  int stretch = 0;  // [1/256 period] by which frames are longer than they should be
};

class SessionCore {
 public:
  SessionCore(const SessionConfig& config, const InputRules& rules);
  virtual ~SessionCore();
  SessionCore(const SessionCore&) = delete;
  SessionCore& operator=(const SessionCore&) = delete;

  virtual void connected(PeerId, Time) {}
  /// The peer opened the connection.
  virtual void accepted(PeerId peer, Time now) { connected(peer, now); }
  virtual void disconnected(PeerId, Time) {}
  virtual void receive(PeerId, Channel, Bytes, Time) {}
  virtual std::optional<Outgoing> poll_send(Time) { return std::nullopt; }
  /// Sets the input for the next frame. Returns false if the player is not local, not in the match, or it is invalid.
  virtual bool add_local_input(int player, Bytes input) = 0;
  /// Returns the next address to which the transport must connect, each once.
  virtual std::optional<Address> poll_connect() { return std::nullopt; }
  /// Returns the core that takes over in the same match, a host's or a client's; null: none.
  virtual std::unique_ptr<SessionCore> succeed(Time) { return nullptr; }
  /// Returns what to do now: all of it, in order, before the next call. It is valid until then.
  std::span<const SessionAction> advance(Time now);
  /// Reports the hash of a state after its `save`.
  void saved(Frame state, std::uint64_t hash);
  /// [us] until `advance` has something to do, as far as is known now.
  virtual Time wait(Time now) const = 0;

  /// Returns the input of a stepped frame that is at most `kept` frames old; else that of an absent player.
  Timeline::Used input(Frame frame, int player) const {
    const bool is_kept = frame >= 0 && frame < current() && frame >= current() - config_.kept;
    if (is_kept && player >= 0 && player < players()) return timeline_.used(frame, player);
    return {InputStatus::disconnected, Bytes(rules_.neutral, rules_.neutral_size)};
  }
  /// `capture` writes here, `restore` reads here.
  std::vector<std::uint8_t>& portable() { return portable_; }
  /// Reports that `capture` was carried out. portable() is empty if the game has no such form.
  void captured() { undone_ -= undone_ > 0 ? 1 : 0; }
  /// Reports the outcome of `restore`.
  virtual void restored(bool) {}
  /// Reports the outcome of `probe`: the hash does not cover this byte of the portable state `state`.
  virtual void unhashed(Frame, std::size_t) {}
  virtual bool resync() { return false; }
  /// Host: starts the match although seats are empty. Their players are absent until somebody joins.
  virtual void start(Time) {}
  virtual bool go_on(Time) { return false; }

  /// Host of a match that has begun: returns it without the bytes of the state `start.frame`.
  virtual std::optional<SavedMatch> save_match() const { return std::nullopt; }
  /// Returns null if there is none.
  virtual MatchControl* control() { return nullptr; }
  /// Returns null if it is no host.
  virtual AdmissionControl* admission() { return nullptr; }

  /// Returns true if the next frame takes an input that is added now. A game of orders keeps them until then.
  virtual bool wants_input(int player) const = 0;

  struct Confirmed {
    Frame frame;
    std::uint64_t hash;  // of the state after it
  };
  /// Returns the next frame that is final and was stepped with its final inputs: each once, ascending.
  std::optional<Confirmed> poll_confirmed();
  std::optional<SessionEvent> poll_event();

  SessionPhase phase() const { return phase_; }
  virtual std::uint64_t token() const { return 0; }
  /// The progress of the snapshot that we receive, or on a host of the one that `peer` is sent.
  virtual SnapshotProgress snapshot_progress(PeerId) const { return {}; }
  /// The players of this machine, a bit each; none yet: 0.
  virtual std::uint32_t local_players() const { return 0; }
  /// The first of them; -1: none.
  int local_player() const { return local_players() == 0 ? -1 : std::countr_zero(local_players()); }
  const SessionConfig& config() const { return config_; }
  const SessionStats& stats() const { return stats_; }
  /// The next frame to be stepped.
  Frame current() const { return timeline_.current(); }
  /// States up to this one are final.
  Frame confirmed() const { return confirmed_state_; }

 protected:
  SessionCore(SessionCore&&) = default;

  virtual void plan(Time now) = 0;
  /// Requests were not carried out: states that should be saved are missing.
  virtual void misused() {}
  /// Requests with a `capture` were not carried out: there is no such snapshot.
  virtual void capture_lost() {}
  /// A state's hash is known.
  virtual void hash_known(Frame state, std::uint64_t hash) = 0;

  void act(RequestKind kind, Frame frame, bool as_confirmed = false) {
    actions_.push_back({kind, frame, as_confirmed});
    if (kind == RequestKind::save || kind == RequestKind::capture) ++undone_;
    if (kind == RequestKind::step) ++stats_.steps;
    if (kind != RequestKind::capture) return;
    portable_.clear();
    is_capturing_ = true;
  }
  /// Returns true if the `capture` of this turn is not carried out yet. Peers go on waiting for the snapshot.
  bool awaits_capture() const { return is_capturing_ && portable_.empty(); }
  void tell(const SessionEvent& event) { events_.tell(event); }
  void tell(const std::optional<SessionEvent>& event) {
    if (event) tell(*event);
  }
  /// Frame `state - 1` is final, and `state` has this hash.
  void confirm(Frame state, std::uint64_t hash);
  int players() const { return config_.players; }

  SessionConfig config_;
  InputRules rules_;
  Timeline timeline_;
  SessionStats stats_;
  EventQueue events_;
  SessionPhase phase_ = SessionPhase::waiting;
  Frame confirmed_state_ = kNoFrame;
  std::vector<std::uint8_t> portable_;

 private:
  std::vector<SessionAction> actions_;
  Frame told_state_ = kNoFrame;  // the newest that poll_confirmed was given
  int undone_ = 0;               // saves and captures asked for and not reported
  bool is_capturing_ = false;    // a capture was asked for in this turn
  BoundedQueue<Confirmed> confirmed_;
};

}  // namespace isostep
