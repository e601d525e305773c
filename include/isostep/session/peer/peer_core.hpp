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

/// In: time, inputs as they are known, and hashes of states. Out: the frames to be stepped, and events. Keeps: all that
/// a host takes over from the client that it was, and the other way round.
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

  /// An event of now; 0xff: of no player.
  void tell_of(SessionEvent::Kind kind, int player = 0xff);
  /// The frame that would be next, but for frames that are stepped again on the way there.
  Frame present() const { return catches_up_to_ > current() ? catches_up_to_ : current(); }
  bool is_paused() const { return tempos_.in_force().is_paused; }
  /// Everything up to here; goes on from there with the same state.
  void go_back(Frame state);
  /// How early the input of the frame before `end` came, the newest of `player`.
  void note_arrival(int player, Frame end, Time now);
  bool is_after_pause(Time now) const { return turns_.is_after_pause(clock_, pace_, now); }
  /// All frames take longer by `stretch`, for `player`'s machine: tells the caller when that changes.
  void go_at_pace_of(int player, int stretch);

  static constexpr int kDueSteps = 2;                // in one advance: a caller that comes late is forgiven one frame
  static constexpr Time kTellBlocked = kSecond / 5;  // [us] before a wait is worth an event
  /// [1/256 period] 40 frames a second where there should be 60: who cannot do so many does not play.
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
  /// Once a frame of time: how early inputs come, and whether rollbacks are too dear.
  void observe(Time now);
  void step_due(Time now);
  void settle();
  /// Players who come and go do so in a frame, the same one on all peers.
  void tell_who_plays(Frame frame);

  TurnWatch turns_;
  LocalInputs inputs_;
  Frame limit_ = 0;            // of what may be settled, as of the last plan
  std::uint64_t fresh_ = 0;    // frames that were stepped for the first time
  Time next_observation_ = 0;  // [us]
  bool asked_start_ = false;
  bool is_misused_ = false;  // states are missing: from the newest final one once more
};

/// The client was elected.
std::unique_ptr<SessionCore> become_host(PeerCore&& client, Succession&& succession, Time now);
/// The host has been left behind, or gives way.
std::unique_ptr<SessionCore> become_client(PeerCore&& host, Retreat&& retreat, Time now);

}  // namespace isostep
