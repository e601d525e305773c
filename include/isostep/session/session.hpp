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

/// One thing that the game must do: see RequestKind. `inputs` are set for `step` and valid until the next advance().
template <class Input> struct Request {
  RequestKind kind;
  Frame frame;
  InputView<Input> inputs;
};

/// Makes the session that `config` asks for. `recording` is the match of a SessionMode::replay and must outlive the
/// session. A `config` with a problem makes a refused session, whose event names the field.
std::unique_ptr<SessionCore> make_session_core(const SessionConfig& config, const InputRules& rules, Bytes recording);

/// A session of `Game`, which models Simulation. It has no sockets, no clock and no threads. In a running match it
/// allocates only what the game's own save allocates. Joins, returns, repairs, a new host and saved matches allocate
/// more. A turn of the game's loop:
///
///     transport's events  -> connected, disconnected, receive
///     session.add_local_input(player, input);
///     drive(session, game, now);                    // or advance() and the requests by hand
///     while (auto out = session.poll_send(now)) ... -> transport
///     while (auto event = session.poll_event()) ...
///
/// Faults of the network, of peers and of the caller become events and counts, never undefined behaviour.
template <class Game, class Predictor = typename DefaultPredictor<typename Game::Input>::Type> class Session {
 public:
  using Input = typename Game::Input;

  explicit Session(const SessionConfig& config, Bytes recording = {})
      : Session(config, input_rules<Input, Predictor>(), recording) {}
  /// Takes inputs whose size and prediction are known only at run time, such as those of the C interface.
  Session(const SessionConfig& config, const InputRules& rules, Bytes recording)
      : core_(make_session_core(config, rules, recording)), states_(static_cast<std::size_t>(core_->config().kept)) {
    const std::size_t steps = states_.size() * 2 + 8;
    requests_.reserve(steps * 2 + 8);
    values_.reserve(steps * static_cast<std::size_t>(core_->config().players));
    statuses_.reserve(steps * static_cast<std::size_t>(core_->config().players));
  }

  // From the transport.
  /// `incoming`: the peer opened the connection. On a host all connections are incoming.
  void connected(PeerId peer, Time now, bool incoming = false) {
    if (incoming) core_->accepted(peer, latest(now));
    else core_->connected(peer, latest(now));
  }
  void disconnected(PeerId peer, Time now) { core_->disconnected(peer, latest(now)); }
  void receive(PeerId peer, Channel channel, Bytes bytes, Time now) {
    core_->receive(peer, channel, bytes, latest(now));
  }
  /// Returns the next machine to which the transport must connect, each once: the SessionConfig::address of its
  /// session. The transport reports the outcome by the functions above, or reports nothing.
  std::optional<Address> poll_connect() { return core_->poll_connect(); }
  /// Returns the next bytes to send. Call it until it returns nothing. The bytes are valid until the next call.
  std::optional<Outgoing> poll_send(Time now) { return core_->poll_send(latest(now)); }

  /// Sets the player's input for the next frame. Until that frame is stepped, a later input replaces an earlier one.
  /// Returns false if the player is not local or not in the match now, or if the input is invalid.
  bool add_local_input(int player, const Input& input) {
    std::uint8_t bytes[kInputCap];
    const std::size_t size = InputCodec<Input>::encode(input, bytes);
    return core_->add_local_input(player, {bytes, size});
  }
  /// Returns true if no input of the local player waits for the next frame. A game of orders adds one only then.
  bool wants_input(int player) const { return core_->wants_input(player); }
  /// Client: takes a state of the host's again, as a joining client does, and keeps its seat. It is for a client that
  /// is outvoted, which SessionConfig::repair does automatically, or whose game wants it. Kind::repaired reports the
  /// end. The observers of drive() keep what they saw until they are told `restarted`, so write the desync bundle
  /// before that. Returns false if not in the match, or if a repair is under way.
  bool resync() { return core_->resync(); }
  /// Host: starts the match although some seats are empty.
  void start(Time now) { core_->start(latest(now)); }
  /// With `migration`, when the match stalls because no majority is here, or when the host is lost: continues with the
  /// machines that are here, on this one. Call it only if you know that the other machines play nowhere else, for
  /// nothing else prevents a split match. Returns false if the match runs without it, or if this machine has no part in
  /// the match or no `seed`.
  bool go_on(Time now) { return core_->go_on(latest(now)); }

  /// Host, between two drives: writes the match in its newest final state, with its players' seats, for
  /// SessionConfig::saved_match of another process. Fails if the match has not begun, or the game has no portable form.
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
  /// pause() and unpause() stop and continue the match on all machines before the same frame, as events report. The
  /// host decides. A client asks it, see SessionConfig::players_set_tempo. Returns false if not possible now.
  bool pause() { return core_->control() != nullptr && core_->control()->pause(true); }
  bool unpause() { return core_->control() != nullptr && core_->control()->pause(false); }
  /// Sets the speed, 4 to 16 [1/8 of the match's rate], in the same way. In a pause it is the speed after the pause. On
  /// the host it also returns false if most_packets is below twice the new rate.
  bool set_speed(int eighths) { return core_->control() != nullptr && core_->control()->set_speed(eighths); }

  /// Proposes a vote of all players for the local `player`, see SessionConfig::votes. One vote runs at a time. What
  /// passes is carried out. False: not now, or invalid. The host counts the clients' proposals that it rejects.
  bool propose(int player, const Proposal& proposal) {
    return core_->control() != nullptr && core_->control()->propose(player, proposal);
  }
  /// Votes for a local player in the open ballot; its last vote counts. False: none is open, or it has no vote in it.
  bool vote(int player, bool yes) { return core_->control() != nullptr && core_->control()->vote(player, yes); }

  /// Host with SessionConfig::asks_admission: returns the next applicant that waits, each once. An answer after
  /// `silence` is too late. admit() returns false if the applicant is gone, or refused because no seat is free.
  std::optional<Applicant> poll_applicant() {
    return core_->admission() == nullptr ? std::nullopt : core_->admission()->poll_applicant();
  }
  bool admit(std::uint64_t applicant) { return core_->admission() != nullptr && core_->admission()->admit(applicant); }
  /// Returns false if the applicant is gone or `reason` is not printable ASCII of at most kReplayValueCap characters.
  bool refuse(std::uint64_t applicant, std::string_view reason) {
    return core_->admission() != nullptr && core_->admission()->refuse(applicant, reason);
  }
  /// Host: ends the connection of the player's machine, if it has one, with that reason. Its token is void, its seats
  /// are free. Returns false for an empty seat, a seat of the host's own, or an invalid reason (see refuse).
  bool kick(int player, std::string_view reason) {
    return core_->admission() != nullptr && core_->admission()->kick(player, reason);
  }
  /// Kicks the peer of a connection in the same way, also a spectator.
  bool kick_peer(PeerId peer, std::string_view reason) {
    return core_->admission() != nullptr && core_->admission()->kick_peer(peer, reason);
  }
  /// Host: returns the peer in this seat. Nothing if the seat is kept for an absent player, or is the host's own.
  std::optional<PeerId> peer_of(int player) const {
    return core_->admission() == nullptr ? std::nullopt : core_->admission()->peer_of(player);
  }

  /// Returns what the game must do now: all of it, in this order. It is the low level under drive().
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
  /// Reports the hash of a state after its `save`.
  void saved(Frame state, std::uint64_t hash) { core_->saved(state, hash); }
  /// Reports that a `capture` was carried out, also if the game has no portable form.
  void captured() { core_->captured(); }
  /// Reports the outcome of a `restore`.
  void restored(bool ok) { core_->restored(ok); }
  /// Reports a byte of the state that the hash does not cover, found by a `probe`.
  void unhashed(Frame state, std::size_t byte) { core_->unhashed(state, byte); }
  std::vector<std::uint8_t>& portable() { return core_->portable(); }
  /// Returns the snapshot of state `frame`: `save` writes it, `load` reads it.
  typename Game::Snapshot& state(Frame frame) { return states_[static_cast<std::size_t>(frame) % states_.size()]; }

  std::optional<SessionCore::Confirmed> poll_confirmed() { return core_->poll_confirmed(); }
  std::optional<SessionEvent> poll_event() { return core_->poll_event(); }
  /// [us] until the next frame is due. A loop may sleep so long while the network is silent.
  Time wait(Time now) const { return core_->wait(now); }

  SessionPhase phase() const { return core_->phase(); }
  /// The token identifies this player after a crash: see SessionConfig::token. 0: not seated yet.
  std::uint64_t token() const { return core_->token(); }
  /// The progress of a snapshot: on a client of the one that it receives, on a host of the one that `peer` is sent.
  SnapshotProgress snapshot_progress(PeerId peer = 0) const { return core_->snapshot_progress(peer); }
  /// The first player of this machine; -1: none, or none yet.
  int local_player() const { return core_->local_player(); }
  /// All local players, a bit each: inputs are added for them here. On a client they join and leave together.
  std::uint32_t local_players() const { return core_->local_players(); }
  const SessionConfig& config() const { return core_->config(); }
  const SessionStats& stats() const { return core_->stats(); }
  /// The next frame to be stepped; the game is in the state of that number.
  Frame current() const { return core_->current(); }
  /// States up to this one are final.
  Frame confirmed() const { return core_->confirmed(); }
  /// Returns a player's input of a frame that is at most `kept` frames old; Input{} if the player was absent.
  Input input(Frame frame, int player) const {
    Input value{};
    InputCodec<Input>::decode(core_->input(frame, player).bytes, value);
    return value;
  }
  InputStatus status(Frame frame, int player) const { return core_->input(frame, player).status; }

 private:
  /// Returns a time that never runs backwards, as cores need it. A caller may read its clock twice in a turn.
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

/// An observer that does nothing. An observer has any of the members that drive() lists. Observers combines several.
struct NoObserver {};

/// Combines several observers, which are called in their order.
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
/// A sync test flips one bit in so many bytes of each state. It covers 10 kB in some 40 s of play.
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
/// Flips bits of the portable state. If the game accepts and keeps a changed byte, its hash must change too.
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

/// Carries out a request that is no `step`, and calls `observer` as drive() does: for callers that step the game.
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
///   rolled_back(f)                  the state is that before frame f again
///   restarted(f)                    the state was replaced from elsewhere; it is that before frame f
///   confirmed(f, hash)              frame f is final: once each, ascending, after restarted(f) from there; hash is
///                                   that of the state after it
/// Returns the number of steps, including those of frames that are stepped again.
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
