// PeerCore: what host and client share: prediction and rollback, local inputs, and comparing state hashes.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/session/agreement/failover.hpp"
#include "isostep/session/pace/frame_clock.hpp"
#include "isostep/session/pace/input_delay.hpp"
#include "isostep/session/pace/rollback_thrift.hpp"
#include "isostep/session/pace/step_pace.hpp"
#include "isostep/session/peer/local_inputs.hpp"
#include "isostep/session/peer/machine_views.hpp"
#include "isostep/session/peer/news.hpp"
#include "isostep/session/peer/peer_role.hpp"
#include "isostep/session/peer/session_core.hpp"
#include "isostep/session/peer/tempo_track.hpp"
#include "isostep/session/peer/turn_watch.hpp"
#include "isostep/session/timeline/hash_log.hpp"

namespace isostep {

/// In: time, known inputs, and hashes of states. Out: the frames to step, and events. Keeps: all that a host takes over
/// from the client that it was, and the other way round.
class PeerCore : public SessionCore, protected PeerRole {
 public:
  PeerCore(const SessionConfig& config, const InputRules& rules);
  PeerCore(PeerCore&&) = default;

  bool add_local_input(int player, Bytes input) override;
  bool wants_input(int player) const override;
  Time wait(Time now) const override;

 protected:
  Frame window() const override { return config_.mode == SessionMode::rollback ? config_.window : 0; }
  Frame final_limit() const override;
  Frame early(int player) const override {
    return slack_[player].value() == RecentLeast::kNothing ? 0 : slack_[player].value();
  }
  void ask_start() override { act(RequestKind::save, 0); }
  void plan(Time now) override;
  void hash_known(Frame state, std::uint64_t hash) override;

  /// Reports an event of the current frame. 0xff: of no player.
  void tell_of(SessionEvent::Kind kind, int player = 0xff);
  /// The frame that would be next if no frames were stepped again on the way there.
  Frame present() const { return catches_up_to_ > current() ? catches_up_to_ : current(); }
  bool is_paused() const { return tempos_.in_force().is_paused; }
  /// Goes back to a kept state, and continues from there.
  void go_back(Frame state);
  /// Notes how early the player's newest input came, which is that of the frame before `end`.
  void note_arrival(int player, Frame end, Time now);
  bool is_after_pause(Time now) const { return turns_.is_after_pause(clock_, pace_, now); }
  /// Makes all frames longer by `stretch`, for `player`'s machine, and reports when that changes.
  void go_at_pace_of(int player, int stretch);

  static constexpr int kDueSteps = 2;                // in one advance: a caller that comes late is forgiven one frame
  static constexpr Time kTellBlocked = kSecond / 5;  // [us] before a wait is worth an event
  /// [1/256 period] 40 frames a second instead of 60: a slower machine does not play.
  static constexpr int kMostStretch = 128;

  std::vector<InputStream> streams_;
  HashLog hashes_;
  FrameClock clock_;
  StepPace pace_;
  InputDelay delay_;
  RollbackThrift thrift_;
  RecentLeast slack_[kMaxPlayers];
  MachineViews views_;
  TempoTrack tempos_;
  News news_;
  Ballot ballot_;  // as it was last counted
  std::vector<std::uint8_t> message_;
  Frame catches_up_to_ = 0;  // after a repair; see present()
  bool has_start_ = false;   // the first state's hash is known
  bool is_blocked_ = false;

 private:
  void misused() override;
  void roll_back(Frame to);
  void follow_tempo(Time now);
  void take_up(const Tempo& tempo, Time now);
  /// Observes how early inputs come, and whether rollbacks are too dear. Called once per frame of time.
  void observe(Time now);
  void step_due(Time now);
  void settle();
  /// Reports players who join or leave in this frame, which is the same one on all peers.
  void tell_who_plays(Frame frame);

  TurnWatch turns_;
  LocalInputs inputs_;
  Frame limit_ = 0;            // of what may be settled, as of the last plan
  std::uint64_t fresh_ = 0;    // frames that were stepped for the first time
  Time next_observation_ = 0;  // [us]
  bool asked_start_ = false;
  bool is_misused_ = false;  // states are missing: from the newest final one once more
};

/// Turns the elected client into the host.
std::unique_ptr<SessionCore> become_host(PeerCore&& client, Succession&& succession, Time now);
/// Turns a host that was left behind, or that gives way, into a client.
std::unique_ptr<SessionCore> become_client(PeerCore&& host, Retreat&& retreat, Time now);

}  // namespace isostep
