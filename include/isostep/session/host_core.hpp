// HostCore: the peer that fixes what was played: it seats players, passes inputs on, and serves late joiners.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/session/host_ballot.hpp"
#include "isostep/session/host_guests.hpp"
#include "isostep/session/host_inquiry.hpp"
#include "isostep/session/host_leadership.hpp"
#include "isostep/session/host_seats.hpp"
#include "isostep/session/host_snapshots.hpp"
#include "isostep/session/host_tempo.hpp"
#include "isostep/session/peer_core.hpp"
#include "isostep/session/repair.hpp"
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
  bool go_on(Time now) override { return leadership_.go_on(now); }
  void restored(bool ok) override;
  std::optional<SavedMatch> save_match() const override;
  std::uint64_t token() const override { return leadership_.own_token(); }
  std::uint32_t local_players() const override { return seats_.hosted(); }
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
  bool is_local(int player) const override { return seats_.is_local(player); }
  Frame sends_until(int player, const PeerLink& link) const override;
  bool running() const override { return started_; }
  void ask_start() override;
  void hash_known(Frame state, std::uint64_t hash) override;
  void before_steps(Time now) override;
  void before_frame(Time now) override;
  void after_steps() override { serve_snapshots(); }
  void capture_lost() override { snapshots_.lost(guests_); }
  void observe_delay() override;
  /// A frame that no majority has may be otherwise in the match that goes on without us.
  Frame final_limit() const override {
    const Frame limit = PeerCore::final_limit();
    const Frame end = leadership_.tenure().final_end();
    return config_.migration > 0 && end < limit ? end : limit;
  }
  void paused(Time now) override;
  void blocked(Time now) override;
  void unblocked(Time now) override;

 private:
  static constexpr Time kFreeStart = 5 * kSecond;  // [us] of a match, in which delays find out how long the lines are

  void begin(Time now);
  // --- a match that was saved, in host_resume.cpp ---
  bool is_resumed() const { return resumed_.frame != kNoFrame; }
  bool all_are_here() const;
  /// Does what has passed. False: it was not to be said.
  bool voted(BallotBox::Effect effect);
  bool take_vote(const Guest& guest, MessageKind kind, Bytes message);
  bool wish_tempo(const Tempo& tempo);
  bool take_ask(Guest& guest, Bytes message);
  /// The host answers a guest once a second.
  void answer_asks(Guest& guest, Time now);
  void answer(const Guest& guest, const Ask& ask);
  /// Once a frame of time, for what changes no faster: who is silent, lags, or is far away.
  void tend_guests(Time now);
  void tend_inquiry(Time now);
  bool take_repaired(Guest& guest, Bytes bytes);
  /// Its players go on where their inputs end, and are told those that they do not know to be final.
  void resume(Guest& guest);
  void greet(Guest& guest, Bytes message);
  /// Why it cannot take part at all; of no key: it can.
  Refusal mismatch_of(const Hello& hello) const;
  /// As a spectator or to a seat, if there is room; else it is refused.
  bool let_in(Guest& guest);
  void seat(Guest& guest, std::uint32_t wanted);
  Guest* applicant_of(std::uint64_t number);
  /// Null: nobody is there.
  Guest* guest_of(int player) {
    return seats_[player].link < 0 ? nullptr : &guests_[static_cast<std::size_t>(seats_[player].link)];
  }
  const Guest* guest_of(int player) const { return const_cast<HostCore*>(this)->guest_of(player); }
  /// What it says is heard no more; it is told why, and its connection ends.
  void send_away(Guest& guest, const Refusal& refusal);
  /// Spectators leave room for the players.
  bool has_room_for_spectator() const;
  /// Once a turn: for how long seats are not played on, and who does not greet.
  void tend_places(Time now);
  void go_live(Guest& guest, Frame start);
  void take_datagram(Guest& guest, Bytes bytes, Time now);
  /// False: it is malformed, or not to be said now.
  bool take_message(Guest& guest, Bytes bytes, Time now);
  void take_packet(Guest& guest, const Packet& packet, Time now);
  void take_inputs(Guest& guest, const InputSlice& slice, Time now);
  void open_seats(Guest& guest, Time now);
  /// Its players' seats are free for who comes next.
  void unseat(Guest& guest);
  void drop(Guest& guest);
  /// Who holds the match up spends its patience of a minute, whether at once or bit by bit, and then watches.
  void charge(Time now);
  /// Nobody plays on seats that are not open, up to the horizon.
  void fill_absent();
  void serve_snapshots();
  bool take_progress(Guest& guest, Bytes message, Time now);
  Welcome welcome_for(Guest& guest);
  /// Inputs that it has not acknowledged.
  bool lacks_inputs(const Guest& guest) const;
  /// Anybody may come and watch, so a spectator has to show first that it takes what it is sent; a player has a seat.
  static bool is_unproven(const Guest& guest) { return guest.player < 0 && guest.acked_at == 0; }
  bool acknowledges(const Guest& guest, Time now) const;
  /// It has acknowledged all of the datagram with which a period began. A spectator that is far behind is sent more
  /// only then, and costs no more than four times what it acknowledges and kStalledRate; a player's inputs are urgent.
  bool has_first(const Guest& guest) const;
  /// Puts out who acknowledges nothing for too long.
  void judge_acknowledgements(Guest& guest, Time now);
  /// How many frames of each player the next datagram may bring; 0: none is due.
  Frame most_frames(const Guest& guest, Time now) const;
  void was_sent(Guest& guest, std::size_t bytes, Time now);
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
  /// Inputs of absent players are final up to here.
  Frame horizon() const;
  /// What lies ahead of us takes the place of what others may still lack: of a short log little.
  Frame bounded(Frame ahead) const { return ahead < config_.history / 4 ? ahead : config_.history / 4; }
  std::optional<Outgoing> next_message(Guest& guest, Time now);
  std::optional<Outgoing> next_datagram(Guest& guest, Time now);
  void refuse(Guest& guest, const Refusal& refusal);

  SecretNumbers numbers_;
  Seats seats_;
  Guests guests_;
  bool started_ = false, must_start_ = false;
  Leadership leadership_{config_, seats_, guests_, streams_, stats_, message_};
  TurnRate turn_rate_;
  Inquiry inquiry_{seats_};
  Time steps_down_at_ = 0;        // [us] our states are wrong, and another machine is to be the host; 0: no
  Time own_slow_since_ = 0;       // [us] our steps are too dear
  bool is_too_slow_ = false;      // for what the others can do
  Time next_tending_ = 0;         // [us]
  Time farthest_ = 0;             // [us] see farthest_that_counts
  std::uint64_t applicants_ = 0;  // how many there were
  Time turn_at_ = 0;              // [us]
  std::uint64_t match_;
  BallotBox ballot_box_{config_, seats_, ballot_};
  HashReport resumed_;  // where the saved match goes on; kNoFrame: it is none
  std::uint64_t resumed_hash_ = 0;
  std::uint32_t sequels_ = 0;
  TempoDesk tempo_desk_{config_};
  Time refusals_until_ = 0;  // [us] when all those are over that were told, at one a second
  Time blocked_since_ = 0;
  Time charged_at_ = 0;         // [us]
  Time figures_at_ = 0;         // [us] when figures are told again
  Time began_ = 0;              // [us]
  Time due_from_ = 0;           // [us] nobody is late before that
  Time reports_from_ = 0;       // [us] before that, what guests say of lateness speaks of a pause of ours
  bool reports_count_ = false;  // in this turn
  SnapshotDesk snapshots_{config_, hashes_, portable_};
};

}  // namespace isostep
