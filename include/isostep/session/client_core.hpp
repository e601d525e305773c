// ClientCore: a player or spectator of a host's match, from the first word to late joins and returns.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/session/failover.hpp"
#include "isostep/session/former_inputs.hpp"
#include "isostep/session/peer_core.hpp"
#include "isostep/session/repair.hpp"

namespace isostep {

/// Our own inputs are final when the host says it has them; the others' when they arrive. Cut off, the client keeps its
/// history, and greets again from its newest final state: if the host still has the inputs since, no snapshot travels.
class ClientCore : public PeerCore {
 public:
  ClientCore(const SessionConfig& config, const InputRules& rules);
  /// A host that the others have left behind.
  ClientCore(PeerCore&& host, Retreat&& retreat, Time now);

  void connected(PeerId host, Time now) override;
  void accepted(PeerId peer, Time now) override;
  void disconnected(PeerId peer, Time now) override;
  void receive(PeerId host, Channel channel, Bytes bytes, Time now) override;
  std::optional<Outgoing> poll_send(Time now) override;
  std::optional<Address> poll_connect() override;
  bool go_on(Time now) override;
  std::unique_ptr<SessionCore> succeed(Time now) override;
  void restored(bool ok) override;
  bool resync() override;
  std::uint32_t local_players() const override { return own_; }
  bool pause(bool on) override { return ask({on, 0}); }
  bool set_speed(int speed) override {
    return Tempo::is_speed(speed) && ask({false, static_cast<std::uint8_t>(speed)});
  }
  bool propose(int player, const Proposal& proposal) override;
  bool vote(int player, bool yes) override;
  std::uint64_t token() const override { return token_; }
  SnapshotProgress snapshot_progress(PeerId) const override {
    if (!is_restoring_ && repair_.stage != Repair::Stage::receives) return {};
    return {static_cast<std::uint32_t>(portable_.size()), welcome_.snapshot_size};
  }

 protected:
  bool is_local(int player) const override { return is_open_ && is_own(player); }
  Frame sends_until(int player, const PeerLink&) const override {
    return is_local(player) ? streams_[static_cast<std::size_t>(player)].end() : 0;
  }
  bool running() const override { return runs_ && repair_.stage != Repair::Stage::restores; }
  Frame present() const override { return repair_.present > current() ? repair_.present : current(); }
  Frame window() const override { return is_open_ ? PeerCore::window() : 0; }
  Frame final_limit() const override;
  bool hurries(Time now) const override;
  void before_steps(Time now) override;
  void observe_delay() override;
  Frame early(int player) const override;
  void paused(Time now) override { forgive_own_pause(now); }
  void blocked(Time now) override;
  void hash_known(Frame state, std::uint64_t hash) override;

  bool is_host(PeerId peer) const { return host_.is_connected && host_.peer == peer; }
  bool is_host_link(const PeerLink& link) const { return &link == &host_; }
  /// We have the host's states, and go on from there.
  bool is_settled_in() const {
    const bool is_repaired = repair_.stage == Repair::Stage::none;
    return is_greeted_ && has_start_ && !is_restoring_ && !must_begin_ && !is_spoiled_ && is_repaired;
  }
  /// The match has begun; also while the host is away.
  bool has_begun() const { return runs_ || current() > 0; }
  std::uint64_t match() const { return welcome_.match; }
  std::uint32_t hosted() const { return welcome_.hosted; }
  /// Inputs before this frame are final, as the host says; beyond kLastFrame: all that it says is.
  Frame told_final() const { return told_final_; }

 private:
  static InputDelay::Settings lag_settings(const SessionConfig& config);
  /// `knocks`: it spoke until now, and may live.
  void lose(Time now, bool knocks);
  void take_message(MessageKind kind, Bytes bytes, Time now);
  /// For the match, or on the way to another host; false: it is none of these, or damaged.
  bool take_failover(MessageKind kind, Bytes bytes, Time now);
  /// Nothing more is said to this peer, and its connection ends.
  void hang_up(PeerId peer) { hang_ups_.push_back(peer); }
  void leave_host();

  // --- without a host, in client_failover.cpp ---
  bool can_fail_over() const {
    return config_.migration > 0 && failover_.election.target(failover_.roster, own_machine()) >= 0;
  }
  /// Our place in the roster, as a voter.
  int own_machine() const;
  /// We could be the host: we have a state of the match, and ours are right.
  bool may_stand() const;
  void seek(Time now, bool knocks);
  void begin_attempt();
  void seek_on(Time now);
  void stop_seeking();
  void went(Caller& caller);
  /// Finds the caller in the roster, and whether it has a vote.
  void recognise(Caller& caller, const Hello& hello);
  void has_new_roster();
  void tend_callers(Time now);
  void take_call(PeerId peer, Channel channel, Bytes bytes, Time now);
  bool take_support(Caller& caller, MessageKind kind, Bytes bytes, Time now);
  /// Its log is of a later host than ours: we go there, and so do who asked us.
  void yield_to(const Caller& caller, const Address& address, Time now);
  /// We ask there next; an empty address is nobody's.
  void go_to(const Address& address, Time now);
  /// Inputs that we lack as a candidate, as this machine tells them; false: it cannot be.
  bool take_known(const InputSlice& slice, int machine);
  /// A player's machine knows all inputs that the host can have had of it, and its word counts more than another's; but
  /// with a deadline the host plays what none of them said.
  bool owns_inputs() const { return failover_.roster.settings.deadline == 0; }
  /// Inputs of players who support us, and which only others know.
  void forget_untold();
  /// This machine writes the player's stream: the seat is ours and open, or opens once we begin.
  bool is_told_by_us(int player) const { return is_own(player) && (is_open_ || is_restoring_ || must_begin_); }
  /// Where the inputs of `player` end that the host has made final, as far as we know.
  Frame final_end(int player) const {
    return is_told_by_us(player) ? accepted_[player] : streams_[static_cast<std::size_t>(player)].end();
  }
  bool has_all_until(Frame end) const;
  /// Another election is about the log of the host before, while this one has not told all: its inputs are ours again.
  void take_back_former();
  /// Of the messages above, the next; nothing when there is none.
  std::optional<Outgoing> next_failover_message();
  std::optional<Outgoing> next_for_candidate();
  std::optional<Outgoing> next_for_caller();
  std::optional<Outgoing> written(PeerId to);
  /// It lacks nothing that we know to be final, or only what we still have.
  bool can_complete(const Candidate& candidate) const;
  /// For the candidate: into message_. False: it has all that we have.
  bool write_missing();

  // --- among machines that differ, in client_resync.cpp ---
  bool take_repair(MessageKind kind, Bytes bytes);
  bool take_statements(const Statements& statements);
  bool take_offer(const RepairOffer& offer);
  /// Once a turn: hands over the state that has arrived, and lets the present go on while frames are stepped again.
  void tend_repair(Time now);
  void finish_repair(std::uint64_t hash);
  std::optional<Outgoing> next_repair_message();

  void take_welcome(const Welcome& welcome, Time now);
  void take_piece(const Piece& piece);
  void take_packet(const Packet& packet, Time now);
  void take_inputs(const InputSlice& slice, Time now);
  bool ask(const Ask& ask);
  bool is_own(int player) const { return (own_ >> player & 1) != 0; }
  int seats_wished() const { return config_.local_players > 1 ? config_.local_players : 1; }
  /// The host went on without us: from the first frames on that it has not accepted.
  void cut_out();
  /// What counts as our player's input of the first frame that is not accepted: its own, or the guess where that came
  /// too late.
  void take_own(int player, const InputEntry& entry);
  void begin_at(const HashReport& start);
  void open(Frame first);
  void lean(Time now);
  /// Do we play at all on such a line?
  void judge_distance();
  /// Do the host's machine and enough others have the states that we have?
  bool is_vouched_for(Time now) const;
  void fail(SessionEvent::Kind kind, SessionPhase phase);
  /// [1/256 frame] the host's next frame, as we estimate it; less the broadcast delay of a relay.
  std::int64_t host_position(Time now) const;
  Frame frames_behind(Time now) const;
  /// [1/256 period] by which frames have to be longer for us.
  int needed_stretch() const;
  /// How early the latest of a second's inputs came, over all others.
  Frame worst_slack() const;

  PeerLink host_;
  bool runs_ = false, is_greeted_ = false, must_greet_ = false, must_ready_ = false;
  std::vector<PeerId> hang_ups_;
  std::vector<PeerId> farewells_;  // likewise, when they are told that we go: whose host we were, or who was ours
  Failover failover_;
  Repair repair_;
  Frame inquired_ = kNoFrame;  // the state of which the host asked for our hash chain
  bool asked_ready_ = false;
  bool must_ask_ = false;
  Ask ask_;
  bool must_propose_ = false;
  PlayersProposal proposal_;
  Votes votes_;            // that the host has not been told
  int player_ = -1;        // the first of ours
  std::uint32_t own_ = 0;  // ours, a bit each: they come and go together
  bool is_open_ = false;
  Frame opens_ = kNoFrame, opened_ = kNoFrame;  // the latter: as we were told before we could begin
  Frame accepted_[kMaxPlayers] = {};            // first frame of each of ours that the host lacks
  std::uint64_t token_ = 0;
  Frame told_final_ = kLastFrame + 1;  // inputs before this frame are final, as the host says
  bool keeps_inputs_ = false;          // we go on with the same host, so that what it said stays said
  FormerInputs former_;

  Welcome welcome_;
  bool is_restoring_ = false;
  bool must_begin_ = false;  // from welcome_.start, in the next plan
  HashReport partial_;       // the snapshot of which portable_ has the first bytes; kNoFrame: of none
  std::uint32_t told_ = 0;   // [bytes] of the snapshot that the host knows to have arrived
  Time next_progress_ = 0;   // [us] when it is told again
  bool is_spoiled_ = false;  // a snapshot was bad: the game may be in no state of this match
  Time near_since_ = 0;      // [us] when we first had nearly caught up; 0: not yet
  Frame base_ = 0;           // the state with which our part of the match began

  /// [frames] that we run behind the host, when our line is so much worse than the others' that they do not wait for
  /// it: their inputs are in time for who runs later.
  InputDelay lag_;
  bool is_far_ = false;        // as the host says
  bool is_too_far_ = false;    // no delay covers our line
  std::uint32_t figured_ = 0;  // players, a bit each, whose figures we know
  bool knows_way_ = false;     // the delay was told how long the way is
};

}  // namespace isostep
