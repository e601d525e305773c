// HostCore: the peer that fixes what was played: it seats players, passes inputs on, and serves late joiners.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/session/agreement/repair.hpp"
#include "isostep/session/host/ballot_box.hpp"
#include "isostep/session/host/deadline.hpp"
#include "isostep/session/host/figures.hpp"
#include "isostep/session/host/guests.hpp"
#include "isostep/session/host/input_flow.hpp"
#include "isostep/session/host/inquiry.hpp"
#include "isostep/session/host/leadership.hpp"
#include "isostep/session/host/line_judge.hpp"
#include "isostep/session/host/match_pace.hpp"
#include "isostep/session/host/seats.hpp"
#include "isostep/session/host/snapshot_desk.hpp"
#include "isostep/session/host/tempo_desk.hpp"
#include "isostep/session/peer/datagrams.hpp"
#include "isostep/session/peer/peer_core.hpp"

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
  bool running() const override { return started_; }
  void ask_start() override;
  void hash_known(Frame state, std::uint64_t hash) override;
  void before_steps(Time now) override;
  void before_frame(Time now) override;
  void after_steps() override;
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
  void begin(Time now);
  /// It goes on with a match that was saved.
  bool is_resumed() const { return resumed_.frame != kNoFrame; }
  bool all_are_here() const;
  /// Once a frame of time, for what changes no faster: who is silent, lags, or is far away.
  void tend(Time now);
  void tend(Guest& guest, Time now);
  void tend_inquiry(Time now);
  /// The host answers a guest once a second.
  void answer_asks(Guest& guest, Time now);
  void answer(std::uint8_t player, const Ask& ask);
  /// Does what has passed. False: it was not to be said.
  bool voted(BallotBox::Effect effect);

  void take_datagram(Guest& guest, Bytes bytes, Time now);
  void take_inputs(Guest& guest, const InputSlice& slice, Time now);
  /// False: it is malformed, or not to be said now.
  bool take_message(Guest& guest, Bytes bytes, Time now);
  bool take_vote(const Guest& guest, MessageKind kind, Bytes message);
  bool take_repaired(Guest& guest, Bytes bytes);
  bool take_progress(Guest& guest, Bytes message, Time now);
  std::optional<Outgoing> next_message(Guest& guest, Time now);
  std::optional<Outgoing> next_datagram(Guest& guest, Time now);
  Welcome welcome_for(Guest& guest);

  void greet(Guest& guest, Bytes message);
  /// Why it cannot take part at all; of no key: it can.
  Refusal mismatch_of(const Hello& hello) const;
  /// As a spectator or to a seat, if there is room; else it is refused.
  bool let_in(Guest& guest);
  void seat(Guest& guest, std::uint32_t wanted);
  void go_live(Guest& guest, Frame start);
  void open_seats(Guest& guest, Time now);
  void refuse(Guest& guest, const Refusal& refusal);
  /// What it says is heard no more; it is told why, and its connection ends.
  void send_away(Guest& guest, const Refusal& refusal);
  void unseat(Guest& guest);
  void drop(Guest& guest);
  /// Inputs of absent players are final up to here.
  Frame horizon() const;

  SecretNumbers numbers_;
  Seats seats_;
  Guests guests_;
  Datagrams datagrams_{config_, streams_, hashes_, clock_, stats_};
  Leadership leadership_{config_, seats_, guests_, streams_, stats_, message_};
  InputFlow flow_{config_, seats_, streams_};
  Deadline deadline_{config_, seats_, guests_, streams_, slack_, clock_, stats_};
  LineJudge lines_{config_, seats_, guests_, clock_, slack_, delay_, thrift_};
  MatchPace match_pace_{seats_, guests_, pace_, kMostStretch};
  Figures figures_{seats_, guests_, flow_, stats_};
  Inquiry inquiry_{seats_};
  BallotBox ballot_box_{config_, seats_, ballot_};
  TempoDesk tempo_desk_{config_, tempos_.announced()};
  SnapshotDesk snapshots_{config_, hashes_, portable_};
  std::uint64_t match_;
  bool started_ = false, must_start_ = false;
  HashReport resumed_;  // where the saved match goes on; kNoFrame: it is none
  std::uint64_t resumed_hash_ = 0;
  std::uint32_t sequels_ = 0;
  std::uint64_t applicants_ = 0;  // how many there were
  Time refusals_until_ = 0;       // [us] when all those are over that were told, at one a second
  Time next_tending_ = 0;         // [us]
  Time turn_at_ = 0;              // [us] of the last tending
  Time steps_down_at_ = 0;        // [us] our states are wrong, and another machine is to be the host; 0: no
  bool is_too_slow_ = false;      // for what the others can do
};

}  // namespace isostep
