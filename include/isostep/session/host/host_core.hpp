// HostCore: the peer that fixes what was played: it seats players, passes inputs on, and serves late joiners.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/session/host/deadline.hpp"
#include "isostep/session/host/figures.hpp"
#include "isostep/session/host/host_control.hpp"
#include "isostep/session/host/line_judge.hpp"
#include "isostep/session/host/match_pace.hpp"
#include "isostep/session/host/repair_desk.hpp"
#include "isostep/session/host/snapshot_desk.hpp"
#include "isostep/session/peer/datagrams.hpp"
#include "isostep/session/peer/peer_core.hpp"

namespace isostep {

/// Every input becomes final here: when it arrives, or when the host goes on without its player. All inputs pass
/// through one machine, so nobody can tell two peers different things, and who is in the match is never in dispute.
class HostCore : public PeerCore {
 public:
  HostCore(const SessionConfig& config, const InputRules& rules);
  /// Continues a saved match.
  HostCore(const SessionConfig& config, const InputRules& rules, SavedMatch&& saved);
  /// Turns an elected client into the host, with the same inputs, frames and seats.
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
  MatchControl* control() override { return &control_; }
  AdmissionControl* admission() override { return &admission_; }

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
  /// With `migration`, a frame that no majority has may differ in the match that goes on without us.
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
  /// Draws the host's own token and life.
  void know_ourselves();
  /// Returns true if it continues a saved match.
  bool is_resumed() const { return resumed_.frame != kNoFrame; }
  bool all_are_here() const;
  /// Looks for guests that are silent, lag or are far away. Called once per frame of time, since it changes no faster.
  void tend(Time now);
  void tend(Guest& guest, Time now);
  void tend_inquiry(Time now);

  void take_datagram(Guest& guest, Bytes bytes, Time now);
  void take_inputs(Guest& guest, const InputSlice& slice, Time now);
  /// Takes a message. Returns false if it is malformed, or not allowed now.
  bool take_message(Guest& guest, Bytes bytes, Time now);
  bool take_progress(Guest& guest, Bytes message, Time now);
  std::optional<Outgoing> next_message(Guest& guest, Time now);
  std::optional<Outgoing> next_datagram(Guest& guest, Time now);
  Welcome welcome_for(Guest& guest);

  void drop(Guest& guest);

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
  SnapshotDesk snapshots_{config_, hashes_, portable_};
  HostParts parts_{config_, seats_, guests_, timeline_, stats_, events_, started_, turn_at_};
  Boarding boarding_{parts_, flow_, hashes_, streams_, clock_, leadership_.roster(), ballot_};
  Departures departures_{seats_, inquiry_, views_};
  Admission admission_{parts_, numbers_, leadership_, hashes_, resumed_, boarding_, departures_};
  HostControl control_{parts_, ballot_, tempos_.announced(), admission_};
  RepairDesk repairs_{parts_, inquiry_, views_, streams_};
  std::uint64_t match_;
  bool started_ = false, must_start_ = false;
  HashReport resumed_;  // where the saved match goes on; kNoFrame: it is none
  std::uint64_t resumed_hash_ = 0;
  Time next_tending_ = 0;     // [us]
  Time turn_at_ = 0;          // [us] of the last tending
  Time steps_down_at_ = 0;    // [us] our states are wrong, and another machine is to be the host; 0: no
  bool is_too_slow_ = false;  // for what the others can do
};

}  // namespace isostep
