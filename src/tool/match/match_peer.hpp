// MatchPeer<S>: one machine of a match over UDP: game, session, transport, and all that watches them.
// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "commands.hpp"
#include "isostep/replay/desync_bundle.hpp"
#include "isostep/replay/session_recorder.hpp"
#include "isostep/session/observers/event_log.hpp"
#include "isostep/session/session.hpp"
#include "scenes/match.hpp"
#include "tool/common/files.hpp"
#include "tool/common/tool.hpp"
#include "transport/enet_transport.hpp"
#include "transport/pump.hpp"

namespace isostep::tool {

inline constexpr char kMatchScene[] = "match";

/// The header that all peers of a match must have alike, beside what the session adds.
template <class S> ReplayHeader match_identity(const scenes::Match<S>& game) {
  Result<ReplayHeader> header = make_replay_header(identity_of_world(game.world().settings(), kMatchScene));
  if (!header) throw ToolError(exit_status::kSoftware, std::string(header.error().message.view()));
  header.value().set("pile", std::to_string(game.settings().pile), true);
  header.value().set("match_seed", std::to_string(game.settings().seed), true);
  return header.value();
}

template <class S> class MatchPeer {
 public:
  using Game = scenes::Match<S>;

  /// `own_address`: where the others reach the transport. `inputs`: frame by frame, instead of the bot's; empty: the
  /// bot plays.
  MatchPeer(const PeerOptions& options, const Address& own_address, std::vector<scenes::MatchInput> inputs,
            transport::EnetTransport& transport)
      : options_(options),
        inputs_(std::move(inputs)),
        transport_(transport),
        game_(settings_of(options)),
        session_(config_of(options, own_address, game_)),
        history_(game_.world(), {.frames = static_cast<std::size_t>(session_.config().kept), .stages = options.trace}) {
    if (!options.record.empty()) {
      file_.emplace(options.record);
      recorder_.emplace(history_, file_->sink(), kMatchScene);
    }
  }

  /// Everything that one turn of a game's loop does.
  void turn(Time now) {
    transport_.poll();
    while (const std::optional<transport::Arrival> arrival = transport_.receive()) take(*arrival, now);
    reconnect(now);
    for (int p = 0; p < options_.players; ++p) {
      if (session_.wants_input(p)) session_.add_local_input(p, input_of(p));
    }
    drive(session_, game_, now, *this);
    transport::dispatch(transport_, session_, now);
    transport_.flush();
    while (const std::optional<SessionEvent> event = session_.poll_event()) report(*event);
    report_progress();
    while (const auto notice = sounds_.poll()) {
      if (notice->kind == NoticeKind::confirmed) ++sounds_confirmed_;
      if (notice->kind == NoticeKind::retracted) ++sounds_retracted_;
    }
  }
  Time wait(Time now) const { return session_.wait(now); }
  /// This peer is the host by now: with migration a client may become it.
  bool is_host() const { return session_.config().host; }
  /// A host stays until the others have what they need, but not for ever.
  bool is_over(Time now);

  // drive() calls these.
  void before_step(Frame frame) {
    started_at_ = thread_milliseconds();
    sounds_.before_step(frame);
    history_.before_step(frame);
    if (recorder_) recorder_->before_step(frame);
    if (frame == options_.fault) flip_a_bit();
  }
  void after_step(Frame frame) {
    for (const scenes::MatchEvent& event : game_.events()) sounds_.tell(event);
    sounds_.after_step(frame);
    history_.after_step(frame);
    step_ms_ += thread_milliseconds() - started_at_;
  }
  void rolled_back(Frame frame) {
    sounds_.rolled_back(frame);
    history_.rolled_back(frame);
    if (recorder_) recorder_->rolled_back(frame);
  }
  void restarted(Frame frame) {
    sounds_.restarted(frame);
    history_.restarted(frame);
    if (recorder_) recorder_->restarted(frame);
    first_ = frame;
    hashes_.clear();
    say("goes on from a snapshot, before frame " + std::to_string(frame));
  }
  void confirmed(Frame frame, std::uint64_t hash) {
    if (frame >= options_.frames) return;  // alike on all peers: the match ends here
    sounds_.confirmed(frame, hash);
    history_.confirmed(frame, hash);
    if (recorder_) recorder_->confirmed(frame, hash);
    hashes_.push_back(hash);
    if (hashes_.size() == 1) say("frame " + std::to_string(frame) + " is final, the first one here");
    if (has_new_host_) say("frame " + std::to_string(frame) + " is final, the first one with the new host");
    has_new_host_ = false;
  }

  /// Files are written if a frame is final; an exit status.
  int finish(Time played);

 private:
  static scenes::MatchSettings settings_of(const PeerOptions& options) {
    return {.players = options.players, .pile = options.pile, .seed = options.match_seed};
  }
  static SessionConfig config_of(const PeerOptions& options, const Address& own_address, const Game& game);
  scenes::MatchInput input_of(int player) const;
  void take(const transport::Arrival& arrival, Time now);
  void reconnect(Time now);
  void report(const SessionEvent& event);
  /// Reports the progress of a snapshot, and the machines that the match could go on at.
  void report_progress();
  std::string name() const;
  /// A line on stderr.
  void say(const std::string& line) const;
  void write_desync_bundle(const SessionEvent& event);
  void flip_a_bit();
  void write_files();
  void print_summary(Time played) const;

  PeerOptions options_;
  std::vector<scenes::MatchInput> inputs_;
  transport::EnetTransport& transport_;
  Game game_;
  Session<Game> session_;
  FrameHistory<S> history_;
  EventLog<scenes::MatchEvent> sounds_;
  std::optional<ReplayFile> file_;
  std::optional<SessionRecorder<S>> recorder_;
  std::vector<std::uint64_t> hashes_;
  Frame first_ = 0;  // of hashes_
  bool desynced_ = false, gave_up_ = false, has_met_ = false;
  bool must_reconnect_ = false;
  bool has_new_host_ = false;      // of which no frame is final yet
  std::uint32_t told_tenths_ = 0;  // of a snapshot
  int told_machines_ = 0;
  Time reconnect_at_ = 0, alone_since_ = 0, done_at_ = 0;
  std::uint64_t sounds_confirmed_ = 0, sounds_retracted_ = 0;
  double started_at_ = 0, step_ms_ = 0;
};

}  // namespace isostep::tool
