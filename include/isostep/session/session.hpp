// Session<Game>: lockstep, rollback, spectating, sync tests and replays behind one interface; and drive(), which plays.
// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <tuple>
#include <utility>
#include <vector>

#include "isostep/core/index.hpp"
#include "isostep/session/peer/session_core.hpp"
#include "isostep/session/timeline/input_codec.hpp"
#include "isostep/state/concepts.hpp"

namespace isostep {

/// One thing to do, in order: see RequestKind. `inputs` belong to `step` and hold until the next advance().
template <class Input> struct Request {
  RequestKind kind;
  Frame frame;
  InputView<Input> inputs;
};

/// What `config` asks for; `recording` is the match of a SessionMode::replay and must outlive the session. The
/// configuration with a problem gives a session that is refused, by the event that names the field.
std::unique_ptr<SessionCore> make_session_core(const SessionConfig& config, const InputRules& rules, Bytes recording);

/// A session of `Game`, which models Simulation. It has no sockets, no clock and no threads. In a running match it
/// allocates only what the game's own save does; joins, returns, repairs, a new host and saved matches take memory. A
/// turn of the game's loop:
///
///     transport's events  -> connected, disconnected, receive
///     session.add_local_input(player, input);
///     drive(session, game, now);                    // or advance() and the requests by hand
///     while (auto out = session.poll_send(now)) ... -> transport
///     while (auto event = session.poll_event()) ...
///
/// Faults of the network, of peers and of the caller are events and counts, never undefined.
template <class Game, class Predictor = typename DefaultPredictor<typename Game::Input>::Type> class Session {
 public:
  using Input = typename Game::Input;

  explicit Session(const SessionConfig& config, Bytes recording = {})
      : Session(config, input_rules<Input, Predictor>(), recording) {}
  /// Of inputs whose size and guess are known at run time only, as those of the C interface.
  Session(const SessionConfig& config, const InputRules& rules, Bytes recording)
      : core_(make_session_core(config, rules, recording)), states_(static_cast<std::size_t>(core_->config().kept)) {
    const std::size_t steps = states_.size() * 2 + 8;
    requests_.reserve(steps * 2 + 8);
    values_.reserve(steps * static_cast<std::size_t>(core_->config().players));
    statuses_.reserve(steps * static_cast<std::size_t>(core_->config().players));
  }

  // From the transport.
  /// `incoming`: the other side asked for the connection, as all do at a host.
  void connected(PeerId peer, Time now, bool incoming = false) {
    if (incoming) core_->accepted(peer, latest(now));
    else core_->connected(peer, latest(now));
  }
  void disconnected(PeerId peer, Time now) { core_->disconnected(peer, latest(now)); }
  void receive(PeerId peer, Channel channel, Bytes bytes, Time now) {
    core_->receive(peer, channel, bytes, latest(now));
  }
  /// To the transport: connect to this machine, as SessionConfig::address of its session says; each once. What comes
  /// of it are the events above, or nothing.
  std::optional<Address> poll_connect() { return core_->poll_connect(); }
  /// To the transport, until there is nothing more; the bytes hold until the next call.
  std::optional<Outgoing> poll_send(Time now) { return core_->poll_send(latest(now)); }

  /// For the next frame; until that is stepped a later input replaces an earlier one. False when the player is not ours
  /// or not in the match now, or the input is none.
  bool add_local_input(int player, const Input& input) {
    std::uint8_t bytes[kInputCap];
    const std::size_t size = InputCodec<Input>::encode(input, bytes);
    return core_->add_local_input(player, {bytes, size});
  }
  /// Has the last one been taken? A game of orders hands over the next only then.
  bool wants_input(int player) const { return core_->wants_input(player); }
  /// Client: takes a state of the host's, as one that joins does, and keeps its seat. It is for who is outvoted, which
  /// SessionConfig::repair does by itself, or whose game would have it. Kind::repaired tells when it is done. What
  /// the observers of drive() saw stays as it was until they are told `restarted`: write the bundle before that. False:
  /// not in the match, or under way already.
  bool resync() { return core_->resync(); }
  /// Host: begins although seats are empty.
  void start(Time now) { core_->start(latest(now)); }
  /// With `migration`, where the match stands for lack of a majority, or its host is lost: goes on with those who are
  /// here, at this machine. Whoever calls knows that the others play nowhere else, for nothing else prevents a
  /// split. False: the match goes on without, or this machine has no
  /// part in it or no `seed`.
  bool go_on(Time now) { return core_->go_on(latest(now)); }

  /// Host, between two drives: the match in its newest final state as bytes, with the seats of its players, for
  /// SessionConfig::saved_match of another process. An error when it has not begun, or the game has no portable form.
  Result<void> save_match(Game& game, std::vector<std::uint8_t>& out) {
    std::optional<SavedMatch> saved = core_->save_match();
    if (!saved) return Error{ErrorCode::invalid, "of a host whose match has begun", "save_match"};
    if constexpr (PortableState<Game>) {
      const bool is_present = saved->start.frame == current();
      if (!is_present) game.load(state(saved->start.frame));
      Writer writer(saved->state);
      game.write_portable(writer);
      if (!is_present) game.load(state(current()));
      write_saved_match(*saved, out);
      return {};
    } else {
      return Error{ErrorCode::invalid, "of a game with a portable form", "save_match"};
    }
  }
  /// The match stands still, or goes on: on all machines before the same frame, as events say. The host decides; a
  /// client in the match asks it, see SessionConfig::players_set_tempo. False: not possible now.
  bool pause() { return core_->control() != nullptr && core_->control()->pause(true); }
  bool unpause() { return core_->control() != nullptr && core_->control()->pause(false); }
  /// [1/8 of the match's rate] 4 to 16, likewise; in a pause for afterwards. False also where the host's most_packets
  /// is below twice the rate.
  bool set_speed(int eighths) { return core_->control() != nullptr && core_->control()->set_speed(eighths); }

  /// `player`, one of ours, asks all who play, see SessionConfig::votes; one vote at a time. What passes is done.
  /// False: not now, or not sound. A client's that the host does not take is counted there.
  bool propose(int player, const Proposal& proposal) {
    return core_->control() != nullptr && core_->control()->propose(player, proposal);
  }
  /// In the vote of the last event `vote`; the last word counts. False: there is none, or the player is not ours.
  bool vote(int player, bool yes) { return core_->control() != nullptr && core_->control()->vote(player, yes); }

  /// Host with SessionConfig::asks_admission: who waits for an answer, each once. One that comes after `silence` is too
  /// late. False: it has gone, or is refused all the same, for there is no seat.
  std::optional<Applicant> poll_applicant() {
    return core_->admission() == nullptr ? std::nullopt : core_->admission()->poll_applicant();
  }
  bool admit(std::uint64_t applicant) { return core_->admission() != nullptr && core_->admission()->admit(applicant); }
  /// The reason is text for people, printable ASCII of at most kReplayValueCap characters; false: it is not.
  bool refuse(std::uint64_t applicant, std::string_view reason) {
    return core_->admission() != nullptr && core_->admission()->refuse(applicant, reason);
  }
  /// Host: ends the player's connection, if it has one, with that reason. Its token is void and its seat free. False: a
  /// seat of nobody or of the host's own, or no reason as above.
  bool kick(int player, std::string_view reason) {
    return core_->admission() != nullptr && core_->admission()->kick(player, reason);
  }
  /// Likewise of a connection: a spectator's as well.
  bool kick_peer(PeerId peer, std::string_view reason) {
    return core_->admission() != nullptr && core_->admission()->kick_peer(peer, reason);
  }
  /// Host: who has this seat now. Nobody, while it is kept for a player who is away, and for the host's own players.
  std::optional<PeerId> peer_of(int player) const {
    return core_->admission() == nullptr ? std::nullopt : core_->admission()->peer_of(player);
  }

  /// What to do now, in order and all of it: the low level under drive().
  std::span<const Request<Input>> advance(Time now) {
    if (std::unique_ptr<SessionCore> next = core_->succeed(latest(now))) core_ = std::move(next);
    requests_.clear();
    values_.clear();
    statuses_.clear();
    const auto players = static_cast<std::size_t>(config().players);
    for (const SessionAction& action : core_->advance(latest(now))) {
      InputView<Input> inputs{};
      if (action.kind == RequestKind::step) {
        const std::size_t first = values_.size();
        for (std::size_t p = 0; p < players; ++p) {
          const Timeline::Used used = core_->input(action.frame, static_cast<int>(p));
          Input value{};
          InputCodec<Input>::decode(used.bytes, value);
          values_.push_back(value);
          const bool shown = action.as_confirmed && used.status == InputStatus::predicted;
          statuses_.push_back(shown ? InputStatus::confirmed : used.status);
        }
        inputs = {std::span<const Input>(values_).subspan(first),
                  std::span<const InputStatus>(statuses_).subspan(first)};
      }
      requests_.push_back({action.kind, action.frame, inputs});
    }
    return requests_;
  }
  /// After a `save`: the hash of that state.
  void saved(Frame state, std::uint64_t hash) { core_->saved(state, hash); }
  /// After a `capture`, also where the game has no portable form.
  void captured() { core_->captured(); }
  /// After a `restore`.
  void restored(bool ok) { core_->restored(ok); }
  /// After a `probe` that found one.
  void unhashed(Frame state, std::size_t byte) { core_->unhashed(state, byte); }
  std::vector<std::uint8_t>& portable() { return core_->portable(); }
  /// Where `save` puts and `load` finds state `frame`.
  typename Game::Snapshot& state(Frame frame) { return states_[static_cast<std::size_t>(frame) % states_.size()]; }

  std::optional<SessionCore::Confirmed> poll_confirmed() { return core_->poll_confirmed(); }
  std::optional<SessionEvent> poll_event() { return core_->poll_event(); }
  /// [us] until the next frame is due: how long a loop may sleep when the network is silent.
  Time wait(Time now) const { return core_->wait(now); }

  SessionPhase phase() const { return core_->phase(); }
  /// Says who we are after a crash: see SessionConfig::token. 0: not seated yet.
  std::uint64_t token() const { return core_->token(); }
  /// Of the snapshot that is under way: on a client the one that it waits for, on a host the one that `peer` is sent.
  SnapshotProgress snapshot_progress(PeerId peer = 0) const { return core_->snapshot_progress(peer); }
  /// The first player of this machine; -1: none, or none yet.
  int local_player() const { return core_->local_player(); }
  /// All of them, a bit each: those for whom inputs are added here. On a client they come and go together.
  std::uint32_t local_players() const { return core_->local_players(); }
  const SessionConfig& config() const { return core_->config(); }
  const SessionStats& stats() const { return core_->stats(); }
  /// The next frame to be stepped; the game is in the state of that number.
  Frame current() const { return core_->current(); }
  /// States up to this one are final.
  Frame confirmed() const { return core_->confirmed(); }
  /// What a player did in a frame that is at most `kept` frames old; Input{} for who was absent.
  Input input(Frame frame, int player) const {
    Input value{};
    InputCodec<Input>::decode(core_->input(frame, player).bytes, value);
    return value;
  }
  InputStatus status(Frame frame, int player) const { return core_->input(frame, player).status; }

 private:
  /// Cores reckon with times that never run backwards; a caller may read its clock twice in a turn.
  Time latest(Time now) {
    if (latest_ < now) latest_ = now;
    return latest_;
  }

  std::unique_ptr<SessionCore> core_;
  Time latest_ = 0;
  std::vector<typename Game::Snapshot> states_;
  std::vector<Request<Input>> requests_;
  std::vector<Input> values_;
  std::vector<InputStatus> statuses_;
};

/// Sees nothing. An observer has any of these members, each called as its name says; see Observers for several.
struct NoObserver {};

/// Several observers in one, called in their order.
template <class... Each> struct Observers {
  std::tuple<Each&...> each;
  explicit Observers(Each&... observers) : each(observers...) {}
};

namespace detail {
#define ISO_TELL(NAME)                                                                                             \
  template <class Observer, class... Arguments> void NAME(Observer& observer, const Arguments&... arguments) {     \
    if constexpr (requires { observer.NAME(arguments...); }) observer.NAME(arguments...);                          \
  }                                                                                                                \
  template <class... Each, class... Arguments> void NAME(Observers<Each...>& all, const Arguments&... arguments) { \
    std::apply([&](auto&... one) { (NAME(one, arguments...), ...); }, all.each);                                   \
  }
ISO_TELL(before_step)
ISO_TELL(after_step)
ISO_TELL(rolled_back)
ISO_TELL(restarted)
ISO_TELL(confirmed)
#undef ISO_TELL
}  // namespace detail

namespace detail {
/// A sync test changes so many bytes of each state, one bit each: one of 10 kB is gone through in some 40 s of play.
inline constexpr std::uint64_t kProbes = 4;

template <class Game> void write_whole(const Game& game, std::vector<std::uint8_t>& bytes) {
  bytes.clear();
  Writer writer(bytes);
  game.write_portable(writer);
}
template <class Game> bool read_whole(Game& game, const std::vector<std::uint8_t>& bytes) {
  Reader reader(bytes);
  return game.read_portable(reader).ok() && reader.remaining() == 0;
}
/// What is written is what is saved: where the game takes other bytes and keeps them, its hash must be another one.
template <class Game, class Predictor> void probe(Session<Game, Predictor>& session, Game& game, Frame frame) {
  std::vector<std::uint8_t>& bytes = session.portable();
  write_whole(game, bytes);
  const std::uint64_t hash = game.hash();
  for (std::uint64_t i = 0; i < kProbes && !bytes.empty(); ++i) {
    // Multiples of the golden ratio fill the range evenly.
    const std::uint64_t place = ((static_cast<std::uint64_t>(frame) * kProbes + i) * 0x9e3779b97f4a7c15u) >> 32;
    const std::size_t at = as_index(place * bytes.size() >> 32);
    bytes[at] ^= 1u;
    const bool unseen = read_whole(game, bytes) && game.hash() == hash;
    bytes[at] ^= 1u;
    if (!unseen) continue;
    std::vector<std::uint8_t> kept;
    write_whole(game, kept);
    if (kept != bytes) session.unhashed(frame, at);
  }
  read_whole(game, bytes);
  game.load(session.state(frame));
}
}  // namespace detail

/// Carries out a request that is no `step`, and calls `observer` as drive() does: for callers that step by themselves.
template <class Game, class Predictor, class Observer>
void carry_out(Session<Game, Predictor>& session, Game& game, const Request<typename Game::Input>& request,
               Observer& observer) {
  const Frame frame = request.frame;
  switch (request.kind) {
    case RequestKind::save:
      game.save(session.state(frame));
      session.saved(frame, game.hash());
      break;
    case RequestKind::load:
      game.load(session.state(frame));
      detail::rolled_back(observer, frame);
      break;
    case RequestKind::step: break;
    case RequestKind::capture:
      if constexpr (PortableState<Game>) {
        const bool is_present = frame == session.current();
        if (!is_present) game.load(session.state(frame));
        detail::write_whole(game, session.portable());
        if (!is_present) game.load(session.state(session.current()));
      }
      session.captured();
      break;
    case RequestKind::restore:
      if constexpr (PortableState<Game>) {
        const bool ok = detail::read_whole(game, session.portable());
        session.restored(ok);
        if (ok) detail::restarted(observer, frame);
      } else {
        session.restored(false);
      }
      break;
    case RequestKind::probe:
      if constexpr (PortableState<Game>) detail::probe(session, game, frame);
      break;
  }
}

/// Plays what is due: carries out the session's requests with the game, and calls `observer`:
///   before_step(f), after_step(f)   frame f is stepped, for the first time or again
///   rolled_back(f)                  the state is again that before frame f
///   restarted(f)                    the state is one that arrived from elsewhere, before frame f
///   confirmed(f, hash)              frame f is final: once each, ascending, after restarted(f) from there; hash is
///                                   that of the state after it
/// Returns how many frames were stepped, those again included.
template <class Game, class Predictor, class Observer = NoObserver>
int drive(Session<Game, Predictor>& session, Game& game, Time now, Observer&& observer = Observer{}) {
  int steps = 0;
  for (const Request<typename Game::Input>& request : session.advance(now)) {
    if (request.kind != RequestKind::step) {
      carry_out(session, game, request, observer);
      continue;
    }
    detail::before_step(observer, request.frame);
    game.step(request.inputs);
    detail::after_step(observer, request.frame);
    ++steps;
  }
  while (const std::optional<SessionCore::Confirmed> confirmed = session.poll_confirmed()) {
    detail::confirmed(observer, confirmed->frame, confirmed->hash);
  }
  return steps;
}

}  // namespace isostep
