// HostCore: the peer that fixes what was played: it seats players, passes inputs on, and serves late joiners.
// SPDX-License-Identifier: MIT
#pragma once

#include <bit>

#include "isostep/session/failover.hpp"
#include "isostep/session/peer_core.hpp"
#include "isostep/session/repair.hpp"
#include "isostep/session/stall_budget.hpp"
#include "isostep/session/tenure.hpp"
#include "isostep/session/turn_rate.hpp"

namespace isostep {

/// Every input becomes final here: when it arrives, or when the host goes on without its player. Because all inputs
/// pass through one machine, nobody can tell two peers two things, and who is in the match is never in dispute.
class HostCore : public PeerCore {
 public:
  HostCore(const SessionConfig& config, const InputRules& rules);
  /// A match that was saved.
  HostCore(const SessionConfig& config, const InputRules& rules, SavedMatch&& saved);
  /// A client that follows its host: with the same inputs, frames and seats.
  HostCore(PeerCore&& client, Succession&& succession, Time now);

  void connected(PeerId peer, Time now) override;
  void disconnected(PeerId peer, Time now) override;
  void receive(PeerId peer, Channel channel, Bytes bytes, Time now) override;
  std::optional<Outgoing> poll_send(Time now) override;
  std::unique_ptr<SessionCore> succeed(Time now) override;
  void start(Time) override { must_start_ = true; }
  bool go_on(Time now) override;
  void restored(bool ok) override;
  std::optional<SavedMatch> save_match() const override;
  std::uint64_t token() const override { return own_token_; }
  std::uint32_t local_players() const override { return hosted_; }
  SnapshotProgress snapshot_progress(PeerId peer) const override;
  bool pause(bool on) override;
  bool set_speed(int speed) override;
  bool propose(int player, const Proposal& proposal) override;
  bool vote(int player, bool yes) override;
  std::optional<Applicant> poll_applicant() override;
  bool admit(std::uint64_t applicant) override;
  bool refuse(std::uint64_t applicant, std::string_view reason) override;
  bool kick(int player, std::string_view reason) override;
  bool kick_peer(PeerId peer, std::string_view reason) override;
  std::optional<PeerId> peer_of(int player) const override;

 protected:
  bool is_local(int player) const override { return (hosted_ >> player & 1) != 0; }
  Frame sends_until(int player, const PeerLink& link) const override;
  bool running() const override { return started_; }
  void ask_start() override;
  void hash_known(Frame state, std::uint64_t hash) override;
  void before_steps(Time now) override;
  void before_frame(Time now) override;
  void after_steps() override { serve_snapshots(); }
  void capture_lost() override;
  void observe_delay() override;
  /// A frame that no majority has may be otherwise in the match that goes on without us.
  Frame final_limit() const override {
    const Frame limit = PeerCore::final_limit();
    return config_.migration > 0 && tenure_.final_end() < limit ? tenure_.final_end() : limit;
  }
  void paused(Time now) override;
  void blocked(Time now) override;
  void unblocked(Time now) override;

 private:
  struct Seat {
    bool is_taken = false;
    int link = -1;  // -1: its player is away
    std::uint64_t token = 0;
    std::uint64_t proof = 0;
    std::uint64_t life = 0;  // of its player's process: see Roster
    bool has_left = false;   // it hung up, and was not cut off
    Time left_at = 0;        // [us]
    /// Of what its player came back with, while it may not have read the new one: the connection may end before.
    std::uint64_t former_proof = 0;
    bool is_kept = false;                  // it was played on, and its player knows a token: it is reserved for that
    Time idle = 0;                         // [us] since it was open, or else taken, in turns of ours
    bool is_open = false;                  // inputs are awaited
    StallBudget lost;                      // time that others waited for it
    Time shut_until = 0;                   // [us] its player watches
    Frame replaced = 0, replaced_end = 0;  // inputs from .. until, of which its player does not know yet; 0: none
    bool is_late = false;                  // the newest input was replaced
    Frame late_end = 0;                    // of the inputs that came after they were replaced: what follows the newest
    StallBudget replaced_for;              // time in which its inputs were replaced though it was heard
    std::uint32_t replaced_told = 0;       // inputs, of stats().players
    Time tells_replaced_at = 0;            // [us] not before
  };
  /// A client, on its way in.
  struct Guest : PeerLink {
    Guest() {
      for (Frame& frame : held_back) frame = kNoFrame;
    }
    enum class Stage : std::uint8_t { connected, applies, needs_snapshot, receives_snapshot, live, refused };
    Stage stage = Stage::connected;
    Application wish;
    std::uint64_t applicant = 0;  // its number, while the game decides
    bool is_shown = false;        // to the game
    std::vector<std::uint8_t> credential;
    Address address;
    Time lease_from = 0;  // [us] when we said the newest that it has heard; 0: nothing
    bool must_enroll = false;
    bool must_tell_ballot = false;
    std::optional<Ask> asks_pause, asks_speed;  // the last of each that is not answered yet
    Time may_ask_at = 0;                        // [us] others are answered then
    std::uint32_t enrolled = 0;                 // the roster that it has
    std::uint32_t players = 0;                  // its seats, a bit each: they are taken, open and close together
    int player = -1;                            // the first of them; -1: a spectator
    bool must_welcome = false, must_open = false, must_close = false;
    int figures_left = 0;     // players whose figures it is told next, one with each datagram
    bool is_ready = false;    // asked to play
    Time too_slow_since = 0;  // [us]
    bool is_far = false;      // its line is worse than the others'
    bool is_too_far = false;  // no delay covers it: it watches
    Time covered_at = 0;      // [us] when one did
    // Our frame when it was last not sent all inputs of a player.
    Frame held_back[kMaxPlayers];
    Frame opens = kNoFrame;
    Frame start = 0;                 // the state from which it goes on
    std::uint64_t start_chain = 0;   // without a snapshot: as it said itself
    HashReport partial;              // the snapshot of which it has some bytes from before; kNoFrame: of none
    std::uint32_t partial_size = 0;  // [bytes]
    SnapshotTransfer transfer;
    Refusal refusal{};
    bool must_inquire = false, must_tell_statements = false;
    RepairService repair;
    HashReport report;
    std::size_t next_reporter = 0;  // whose report it hears of next

    bool has_spoken = false;            // it says something that is for this match
    Frame due[kMaxPlayers] = {};        // what it has to acknowledge before more is due: first frames beyond
    Time due_since = 0;                 // [us]
    Time had_all_at = 0;                // [us] when it lacked nothing, or came
    Time back_at = 0;                   // [us] when it was heard again after a long silence
    Time more_at = 0;                   // [us] who does not acknowledge is sent nothing before
    Frame first_end[kMaxPlayers] = {};  // what the last period's first datagram left out
    bool takes_bursts = false;          // it had the one before that when it was sent
    Time probe_every = kFirstProbe;     // [us] kept when it goes: its place may be taken by who is no better
  };
  static constexpr Time kFirstProbe = kSecond / 10;  // [us]
  static constexpr Time kFreeStart = 5 * kSecond;    // [us] of a match, in which delays find out how long the lines are

  void begin(Time now);
  // --- a match that was saved, in host_resume.cpp ---
  bool is_resumed() const { return resumed_.frame != kNoFrame; }
  bool all_are_here() const;
  // --- votes, in host_votes.cpp ---
  std::uint32_t present_players() const;
  bool open_ballot(int player, const Proposal& proposal);
  bool count_votes(const Votes& votes, std::uint32_t of);
  void ballot_changed();
  void tend_ballot(Time now);
  void carry_out(const Proposal& proposal);
  void take_vote(Guest& guest, MessageKind kind, Bytes message);
  // --- pauses and speeds, in host_tempo.cpp ---
  bool wish_tempo(const Tempo& tempo);
  Tempo latest_wish() const { return has_wish_ ? wished_ : announced(); }
  void grant_tempo();
  void take_ask(Guest& guest, Bytes message);
  /// The host answers a guest once a second.
  void answer_asks(Guest& guest, Time now);
  void answer(const Guest& guest, const Ask& ask);
  /// Once a frame of time, for what changes no faster: who is silent, lags, or is far away.
  void tend_guests(Time now);
  /// Those that a connection ever had: few, of many places.
  std::span<Guest> guests() { return {guests_.data(), used_}; }
  std::span<const Guest> guests() const { return {guests_.data(), used_}; }
  /// One roster after the other: the next when a majority has this one.
  void keep_roster();
  Roster drafted() const;
  void replace_roster(const Roster& next);
  /// Those who are with us are all of the match from now on.
  void reform_roster(std::uint64_t group);
  /// Its place in the roster, as a voter.
  int voter_of(const Guest& guest) const;
  /// Inputs before this frame are there.
  Frame end_at(const Guest& guest) const;
  /// Fills followers_ for each machine of the roster.
  void look_at_followers(Time now);
  /// The guest echoes when it heard us: it waits for us for a lease from then on.
  void renew_lease(Guest& guest, const PacketHeader& header, Time now);
  /// Us and those voters that `is_counted`, as places in the roster, a bit each.
  template <class Predicate> std::uint64_t group(const Predicate& is_counted) const;
  std::uint64_t followers_here(Time now) const;
  std::unique_ptr<SessionCore> retreat(Time now, bool is_outvoted);

  // --- among machines that differ, in host_verdict.cpp ---
  void tend_inquiry(Time now);
  void open_inquiry(Time now);
  void conclude_inquiry(Time now);
  /// Can the others go on without us, at one that is not among these (machines as in a Verdict)?
  bool could_others(std::uint64_t unfit) const;
  bool take_repair(Guest& guest, MessageKind kind, Bytes bytes);
  bool take_statement(const Guest& guest, Bytes bytes);
  void tend_repair(Guest& guest, Time now);
  /// All of the state has arrived there.
  void has_repair(Guest& guest, Time now);
  /// It gets none.
  void end_repair(Guest& guest);
  std::optional<Outgoing> next_repair_message(Guest& guest, Time now);
  /// Waits for the next snapshot, or is on the way to have this one: into the match, or in it.
  static bool needs_snapshot(const Guest& guest) {
    return guest.stage == Guest::Stage::needs_snapshot || guest.repair.stage == RepairService::Stage::needs;
  }
  static bool receives_snapshot(const Guest& guest) {
    return guest.stage == Guest::Stage::receives_snapshot || guest.repair.stage == RepairService::Stage::receives;
  }

  /// Its players go on where their inputs end, and are told those that they do not know to be final.
  void resume(Guest& guest);
  void greet(Guest& guest, Bytes message);
  bool is_refused(Guest& guest, const Hello& hello);
  /// As a spectator or to a seat, if there is room; else it is refused.
  bool let_in(Guest& guest);
  Guest* applicant_of(std::uint64_t number);
  /// Whose token this is, a bit each: a machine's players have the same.
  std::uint32_t players_of(std::uint64_t token) const;
  static int first_of(std::uint32_t players) { return players == 0 ? -1 : std::countr_zero(players); }
  static bool has(const Guest& guest, int player) { return (guest.players >> player & 1) != 0; }
  /// As many as it asks for, a bit each; 0: these are not to be had, and the guest is refused.
  std::uint32_t find_seats(Guest& guest);
  std::uint32_t wanted_seats(Guest& guest, std::uint32_t own);
  std::uint32_t any_seats(Guest& guest, std::uint32_t own);
  /// A seat that clients may have.
  bool is_guests(int player) const { return player >= 0 && player < players() && !is_local(player); }
  /// Of a client's player that is neither there nor expected to come back.
  bool is_free(int player) const;
  bool is_away(int player) const;
  void take_seats(Guest& guest, std::uint32_t wanted);
  void free_seat(int player);
  /// What it says is heard no more; it is told why, and its connection ends.
  void send_away(Guest& guest, std::string_view key, std::string_view theirs, std::string_view ours);
  /// Spectators leave room for the players.
  bool has_room_for_spectator() const;
  /// Once a turn: for how long seats are not played on, and who does not greet.
  void tend_places(Time now);
  /// Players who act on the welcome have read the token in it.
  void keep_seats(Guest& guest);
  void go_live(Guest& guest, Frame start);
  void take_packet(Guest& guest, const Packet& packet, Time now);
  void take_inputs(Guest& guest, const InputSlice& slice, Time now);
  void open_seats(Guest& guest, Time now);
  /// All of its machine.
  void close_seat(int player);
  void close_seats(Guest& guest);
  /// Likewise, and its players watch for `exclusion`.
  void leave_out(Guest& guest, Time now);
  /// Its players' seats are free for who comes next.
  void unseat(Guest& guest);
  void drop(Guest& guest);
  /// Who holds the match up spends its patience of a minute, whether at once or bit by bit, and then watches.
  void charge(Time now);
  /// Nobody plays on seats that are not open, up to the horizon.
  void fill_absent();
  void serve_snapshots();
  /// Can the snapshot that we have be sent to one more? Makes room for a newer one where that is fair.
  bool may_share_snapshot();
  /// Of the same snapshot, from before it was cut off.
  bool has_part(const Guest& guest) const {
    return guest.partial.frame == snapshot_.frame && guest.partial.chain == snapshot_.chain;
  }
  void take_progress(Guest& guest, Bytes message, Time now);
  /// While a snapshot is under way datagrams only measure the line.
  void measure(Guest& guest, const PacketHeader& header, Time now);
  void begin_transfer(Guest& guest);
  std::optional<Outgoing> next_piece(Guest& guest, Time now);
  void clear(Guest& guest);
  /// Inputs that it has not acknowledged.
  bool lacks_inputs(const Guest& guest) const;
  bool is_unproven(const Guest& guest) const;
  bool acknowledges(const Guest& guest, Time now) const;
  /// It has acknowledged all of the datagram with which a period began. A spectator that is far behind is sent more
  /// only then, and costs no more than four times what it acknowledges and kStalledRate; a player's inputs are urgent.
  bool has_first(const Guest& guest) const;
  /// Puts out who acknowledges nothing for too long.
  void judge_acknowledgements(Guest& guest, Time now);
  /// How many frames of each player the next datagram may bring; 0: none is due.
  Frame most_frames(const Guest& guest, Time now) const;
  void was_sent(Guest& guest, std::size_t bytes, Time now);
  /// Its players are in their seats, and their inputs are awaited.
  bool is_in_match(const Guest& guest) const {
    return guest.stage == Guest::Stage::live && guest.player >= 0 && seats_[guest.player].is_open;
  }
  /// [us] round trips beyond this are their players' own affair: who has a worse line runs later, and nobody waits.
  Time farthest_that_counts() const { return farthest_; }
  Time judge_farthest() const;
  void judge_lines(Time now);
  /// Who is farther than any delay covers loses all of its inputs, and watches.
  void judge_distance(Guest& guest, Time now);
  /// All go as fast as the slowest machine can, if that is fast enough.
  void choose_pace(Time now);
  /// [1/256 period] by which frames last longer here.
  int own_stretch() const { return turn_rate_.stretch() > pace_.stretch() ? turn_rate_.stretch() : pace_.stretch(); }
  /// A host that is too slow to be a guest is too slow to be the host, where another can be.
  void judge_own_pace(Time now);
  /// stats().players, and when they are told.
  void keep_figures(Time now);
  /// Inputs after the deadline: the guess is final.
  void replace_late(Time now);
  void replace_next(int player, Frame due, Time now);
  void tell_replaced(int player, Time now);
  /// All inputs of the slice came too late: by how much, its player has to know to send them earlier.
  void note_replaced(const InputSlice& slice, Time now);
  /// Inputs of others before this frame are shown to it.
  Frame shown_until(const Guest& guest) const;
  void note_held_back(Guest& guest);
  /// Lately: then what it says of that player's inputs speaks of its own.
  bool was_held_back(const Guest& guest, int player) const;
  /// How early its inputs come, as it should know it.
  Frame told_slack(const Guest& guest, int player) const;
  /// How early `player`'s inputs reach all others, as far as that is the affair of its delay.
  Frame slack_of(int player) const;
  /// What the numbers that are drawn are for: those of one purpose tell nothing of another's.
  enum class Purpose : std::uint64_t { match, token, life };
  /// The n-th number for `purpose`, which only who knows the seed can compute. Never 0.
  std::uint64_t draw(Purpose purpose, std::uint64_t n) const;
  /// Inputs of absent players are final up to here.
  Frame horizon() const;
  /// What lies ahead of us takes the place of what others may still lack: of a short log little.
  Frame bounded(Frame ahead) const { return ahead < config_.history / 4 ? ahead : config_.history / 4; }
  std::optional<Outgoing> next_message(Guest& guest, Time now);
  std::optional<Outgoing> next_datagram(Guest& guest, Time now);
  void refuse(Guest& guest, std::string_view key, std::string_view theirs, std::string_view ours);
  void tell_refusal(const Refusal& refusal);

  std::uint32_t hosted_;  // players of this machine, a bit each
  bool started_ = false, must_start_ = false;
  Roster roster_;
  std::uint64_t own_token_ = 0;  // with which our players come back to who follows us
  std::uint64_t own_life_ = 0;
  std::uint32_t first_term_ = 1;  // a match that was saved has had others
  Tenure tenure_;
  Follower followers_[kMaxPlayers + 1];  // by their places in the roster
  bool is_over_ = false;                 // somebody knows of a later host
  Roster inherited_;                     // that we took over: its members were let in before
  TurnRate turn_rate_;
  Inquiry inquiry_;
  Time steps_down_at_ = 0;    // [us] our states are wrong, and another machine is to be the host; 0: no
  Time own_slow_since_ = 0;   // [us] our steps are too dear
  bool is_too_slow_ = false;  // for what the others can do
  Seat seats_[kMaxPlayers];
  std::vector<Guest> guests_;
  std::size_t used_ = 0;                                   // of them
  Time next_tending_ = 0;                                  // [us]
  Time farthest_ = 0;                                      // [us] see farthest_that_counts
  std::uint64_t tokens_ = 0, lives_ = 0, applicants_ = 0;  // how many there were
  Time turn_at_ = 0;                                       // [us]
  std::uint64_t match_;
  bool is_ballot_told_ = true;
  Time ballot_told_at_ = 0;                // [us]
  std::uint32_t ballots_ = 0;              // how many there were
  Time ballot_until_ = 0;                  // [us]
  Time may_propose_at_[kMaxPlayers] = {};  // [us]
  HashReport resumed_;                     // where the saved match goes on; kNoFrame: it is none
  std::uint64_t resumed_hash_ = 0;
  std::uint32_t sequels_ = 0;
  Tempo wished_;
  bool has_wish_ = false;
  Time refusals_until_ = 0;  // [us] when all those are over that were told, at one a second
  Time blocked_since_ = 0;
  Time charged_at_ = 0;         // [us]
  Time figures_at_ = 0;         // [us] when figures are told again
  Time began_ = 0;              // [us]
  Time due_from_ = 0;           // [us] nobody is late before that
  Time reports_from_ = 0;       // [us] before that, what guests say of lateness speaks of a pause of ours
  bool reports_count_ = false;  // in this turn

  // The one snapshot that is being sent; whoever needs another waits until nobody needs this one.
  HashReport snapshot_;
  std::uint64_t snapshot_hash_ = 0;
  Frame held_until_ = 0;  // who was cut off while it arrived may come back for the rest
  std::size_t next_guest_ = 0;
};

}  // namespace isostep
