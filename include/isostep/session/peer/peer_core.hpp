// PeerCore: what host and client share: prediction and rollback, local inputs, datagrams, and comparing state hashes.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/session/pace/frame_clock.hpp"
#include "isostep/session/pace/input_delay.hpp"
#include "isostep/session/pace/rollback_thrift.hpp"
#include "isostep/session/pace/step_pace.hpp"
#include "isostep/session/peer/local_inputs.hpp"
#include "isostep/session/peer/machine_views.hpp"
#include "isostep/session/peer/peer_link.hpp"
#include "isostep/session/peer/session_core.hpp"
#include "isostep/session/peer/tempo_track.hpp"
#include "isostep/session/timeline/hash_log.hpp"

namespace isostep {

class PeerCore : public SessionCore {
 public:
  PeerCore(const SessionConfig& config, const InputRules& rules);
  PeerCore(PeerCore&&) = default;

  bool add_local_input(int player, Bytes input) override;
  bool wants_input(int player) const override;
  Time wait(Time now) const override;

 protected:
  /// What is taken for the input after the stream's newest; valid until `buffer` is written to.
  Bytes guess_next(const InputStream& stream, std::uint8_t (&buffer)[kInputCap]) const;
  /// Is it a player of ours, in the match?
  virtual bool is_local(int player) const = 0;
  /// Inputs of this player travel to that peer before this frame; 0: none.
  virtual Frame sends_until(int player, const PeerLink& link) const = 0;
  bool sends(int player, const PeerLink& link) const { return sends_until(player, link) > 0; }
  virtual bool running() const = 0;
  /// How many frames may be stepped on guesses.
  virtual Frame window() const { return config_.mode == SessionMode::rollback ? config_.window : 0; }
  /// States up to this one cannot change any more.
  virtual Frame final_limit() const;
  /// Far behind: frames are stepped as fast as calls of advance come, not when they are due.
  virtual bool hurries(Time) const { return false; }
  virtual void before_steps(Time) {}
  virtual void before_frame(Time) {}
  virtual void after_steps() {}
  /// Once a frame of time: tells delay_ how early our inputs reach the others.
  virtual void observe_delay() = 0;
  /// [frames] by which this player's inputs come before they are needed; 0 where nothing is known of it.
  virtual Frame early(int player) const {
    return slack_[player].value() == RecentLeast::kNothing ? 0 : slack_[player].value();
  }
  virtual void blocked(Time) {}
  virtual void unblocked(Time) {}
  /// No turn was taken for so long that what happened meanwhile says nothing of the others.
  virtual void paused(Time) {}

  /// The state with which all begins is made, and saved.
  virtual void ask_start() { act(RequestKind::save, 0); }
  void plan(Time now) override;
  void hash_known(Frame state, std::uint64_t hash) override;

  /// No delay covers such a line: a player's inputs come after the deadline whatever its machine does.
  bool is_beyond(Time round_trip) const;
  /// The same of a line of which that was said: a sixteenth less does not change it again.
  bool is_still_beyond(Time round_trip) const { return is_beyond(round_trip + round_trip / 16); }
  /// An event of now; 0xff: of no player.
  void tell_of(SessionEvent::Kind kind, int player = 0xff);
  /// The match runs: told once, whoever hosts it and however often we come back to it.
  void tell_started();
  /// First frame of which some input is missing.
  Frame known_end() const;
  /// Everything up to here; goes on from there with the same state.
  void go_back(Frame state);

  /// The datagram for this peer, in buffer_, with at most `most` frames of a player.
  Bytes compose(PeerLink& link, PacketHeader header, Time now, Frame most = kSliceFrames);
  /// Counts, guards against floods, reads; false: to be ignored.
  bool accept_datagram(PeerLink& link, Bytes bytes, Time now, Packet& packet);
  bool accept_message(PeerLink& link, Bytes bytes, Time now);
  void take_header(PeerLink& link, const PacketHeader& header, Time now);
  /// How early the input of the frame before `end` came, the newest of `player`.
  void note_arrival(int player, Frame end, Time now);
  /// Since the last turn. Then nobody knows when what is read now arrived.
  bool is_after_pause(Time now) const;
  /// All frames take longer by `stretch`, for `player`'s machine: tells the caller when that changes.
  void go_at_pace_of(int player, int stretch);
  int slowest() const { return slowest_; }
  /// The match stands, for these players (a bit each) or for the host's machine: tells the caller when that changes.
  void stands_for(std::uint32_t players);
  /// How the vote stands.
  void tell_ballot();
  /// Nobody counts it any more.
  void end_ballot();
  Ballot ballot_;
  /// The host: from the first frame on that nobody can have stepped when it hears of it.
  void announce(Tempo tempo);
  const Tempo& announced() const { return tempos_.announced(); }
  const Tempo& tempo() const { return tempos_.in_force(); }
  bool is_paused() const { return tempo().is_paused; }
  void goes_on();
  /// As last told; 0: nobody.
  std::uint32_t waits_for() const { return stands_ ? waits_for_ : 0; }
  static constexpr int kDueSteps = 2;                // in one advance: a caller that comes late is forgiven one frame
  static constexpr Time kTellBlocked = kSecond / 5;  // [us] before a wait is worth an event
  /// [1/256 period] 40 frames a second where there should be 60: who cannot do so many does not play.
  static constexpr int kMostStretch = 128;
  /// After a pause of ours: reports speak of our being late and not of the line.
  void forgive_own_pause(Time now);

  /// The frame that would be next, but for frames that are stepped again on the way there.
  virtual Frame present() const { return current(); }

  void take_hash(std::size_t reporter, const HashReport& report) { views_.hear(reporter, report); }
  /// Its states are others from now on.
  void was_repaired(std::size_t machine, Frame after) { views_.was_repaired(machine, after); }
  /// Tells the caller whom a majority finds wrong, each once.
  Verdict tell_verdict(const Statements& statements);

  std::vector<InputStream> streams_;
  HashLog hashes_;
  FrameClock clock_;
  StepPace pace_;
  InputDelay delay_;
  RollbackThrift thrift_;
  RecentLeast slack_[kMaxPlayers];
  MachineViews views_;
  TempoTrack tempos_;
  std::vector<std::uint8_t> message_;
  bool is_present_[kMaxPlayers] = {};  // in the newest final frame
  bool has_start_ = false;             // the first state's hash is known
  bool is_blocked_ = false;

 private:
  void misused() override;
  void roll_back(Frame to);
  void follow_tempo(Time now);
  void take_up(const Tempo& tempo, Time now);
  bool may_step() const;
  void settle();
  /// Players who come and go do so in a frame, the same one on all peers.
  void tell_who_plays(Frame frame);

  LocalInputs inputs_;
  Frame limit_ = 0;            // of what may be settled, as of the last plan
  Frame stepped_again_ = 0;    // frames of the last turn
  std::uint64_t fresh_ = 0;    // frames that were stepped for the first time
  Time next_observation_ = 0;  // [us] when observe_delay is called again
  Time last_turn_ = 0;         // [us] of plan
  Time forgiven_until_ = 0;    // [us] no other pause of ours is forgiven before
  bool has_turned_ = false;
  int slowest_ = 0xff;  // as last told
  bool stands_ = false;
  std::uint32_t waits_for_ = 0;
  bool is_start_told_ = false;
  bool asked_start_ = false;
  bool is_misused_ = false;  // states are missing: from the newest final one once more
  std::uint8_t buffer_[kDatagramCap];
};

}  // namespace isostep
