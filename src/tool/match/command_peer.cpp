// isostep peer: one machine of a match over UDP, played by a bot.
// SPDX-License-Identifier: MIT
#include <atomic>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <random>
#include <sstream>
#include <thread>

#include "isostep/world/state.hpp"
#include "match_peer.hpp"
#include "network.hpp"
#include "transport/udp_relay.hpp"

namespace isostep::tool {
namespace {

constexpr Time kTryAgain = kSecond / 2;   // [us] between attempts to reach a host
constexpr Time kPatience = 20 * kSecond;  // [us] without a host, or that a host which is done stays for the others
constexpr Time kGoodbye = kSecond;        // [us] in which a leaving client's last word may be repeated
constexpr Time kLongestSleep = 10000;     // [us]

/// From the system: nobody else can know it.
std::uint64_t secret_seed() {
  std::random_device random;
  std::uint64_t seed = 0;
  while (seed == 0) seed = std::uint64_t{random()} << 32 | random();
  return seed;
}

Time patience_of(const PeerOptions& options) {
  return options.patience == 0 ? kPatience : static_cast<Time>(options.patience) * kSecond;
}

const char* name_of(SessionEvent::Kind kind) {
  switch (kind) {
    case SessionEvent::Kind::started: return "started";
    case SessionEvent::Kind::joined: return "joined";
    case SessionEvent::Kind::left: return "left";
    case SessionEvent::Kind::waiting_for: return "waiting";
    case SessionEvent::Kind::resumed: return "resumed";
    case SessionEvent::Kind::paused: return "paused";
    case SessionEvent::Kind::unpaused: return "unpaused";
    case SessionEvent::Kind::speed_changed: return "another speed";
    case SessionEvent::Kind::asks_pause: return "asks for a pause";
    case SessionEvent::Kind::asks_unpause: return "asks to go on";
    case SessionEvent::Kind::asks_speed: return "asks for another speed";
    case SessionEvent::Kind::vote: return "vote";
    case SessionEvent::Kind::vote_passed: return "vote passed";
    case SessionEvent::Kind::vote_failed: return "vote failed";
    case SessionEvent::Kind::slowed_by: return "slowed by";
    case SessionEvent::Kind::full_speed: return "full speed";
    case SessionEvent::Kind::refused: return "refused";
    case SessionEvent::Kind::lost_host: return "lost the host";
    case SessionEvent::Kind::desync: return "DESYNC";
    case SessionEvent::Kind::bad_snapshot: return "bad snapshot";
    case SessionEvent::Kind::misuse: return "misuse";
    case SessionEvent::Kind::unhashed: return "unhashed state";
    case SessionEvent::Kind::seeks_host: return "host gone, seeking another";
    case SessionEvent::Kind::new_host: return "new host";
    case SessionEvent::Kind::deposed: return "no longer the host";
  }
  return "?";
}

/// One line a frame: push_x push_z buttons aim. After the last line nothing is pressed.
std::vector<scenes::MatchInput> read_inputs(const std::string& path) {
  const std::vector<std::uint8_t> bytes = read_file(path);
  std::istringstream lines(std::string(bytes.begin(), bytes.end()));
  std::vector<scenes::MatchInput> inputs;
  for (std::string line; std::getline(lines, line);) {
    std::istringstream words(line);
    int x = 0, z = 0, buttons = 0, aim = 0;
    const bool whole = static_cast<bool>(words >> x >> z >> buttons >> aim) && (words >> std::ws).eof();
    scenes::MatchInput input;
    input.push_x = static_cast<std::int8_t>(x);
    input.push_z = static_cast<std::int8_t>(z);
    input.buttons = static_cast<std::uint8_t>(buttons);
    input.aim = static_cast<std::uint8_t>(aim);
    const bool in_range = x >= -128 && x < 128 && z >= -128 && z < 128 && buttons >= 0 && buttons < 256 && aim >= 0 &&
                          aim < 256 && input.valid();
    if (!whole || !in_range) {
      throw ToolError(exit_status::kUsage, path + ":" + std::to_string(inputs.size() + 1) +
                                               ": expected push_x push_z (-128..127) buttons (0..127) aim (0..255)");
    }
    inputs.push_back(input);
  }
  return inputs;
}

/// The profile of one peer's own line, between it and the address it believes to speak to.
class OwnRelay {
 public:
  OwnRelay(const Address& target, const std::string& profile, std::uint64_t seed)
      : relay_(expect(transport::UdpRelay::open({.target_address = target.host,
                                                 .target_port = target.port,
                                                 .profile = profile_of(profile),
                                                 .seed = seed}),
                      "relay")),
        thread_([this] { static_cast<void>(relay_.run(stop_).ok()); }) {}
  ~OwnRelay() {
    stop_ = true;
    thread_.join();
  }
  Address address() const { return {"127.0.0.1", relay_.port()}; }

 private:
  std::atomic<bool> stop_ = false;
  transport::UdpRelay relay_;
  std::thread thread_;
};

}  // namespace

template <class S> SessionConfig MatchPeer<S>::config_of(const PeerOptions& options, const Game& game) {
  SessionConfig config;
  config.mode = options.spectate   ? SessionMode::spectator
                : options.lockstep ? SessionMode::lockstep
                                   : SessionMode::rollback;
  config.host = options.listen >= 0;
  config.players = options.players;
  config.local_players = config.host && !options.spectate ? 1 : 0;
  if (config.host && options.spectate) config.mode = options.lockstep ? SessionMode::lockstep : SessionMode::rollback;
  config.window = options.window;
  config.delay = options.delay;
  if (options.patience != 0) config.silence = config.patience = patience_of(options);
  if (options.reservation >= 0) config.reservation = static_cast<Time>(options.reservation) * kSecond;
  config.seed = secret_seed();
  config.identity = match_identity(game);
  if (const char* problem = problem_of(config)) throw ToolError(exit_status::kUsage, problem);
  return config;
}

template <class S> void MatchPeer<S>::take(const transport::Arrival& arrival, Time now) {
  switch (arrival.kind) {
    case transport::ArrivalKind::connected:
      has_met_ = true;
      session_.connected(arrival.peer, now);
      break;
    case transport::ArrivalKind::disconnected:
      session_.disconnected(arrival.peer, now);
      if (options_.listen < 0) reconnect_at_ = now + kTryAgain;
      break;
    case transport::ArrivalKind::message: session_.receive(arrival.peer, arrival.channel, arrival.bytes, now); break;
  }
}

template <class S> void MatchPeer<S>::reconnect(Time now) {
  if (options_.listen >= 0) return;
  if (must_reconnect_) reconnect_at_ = now + kTryAgain;
  must_reconnect_ = false;
  if (session_.stats().peers > 0 || alone_since_ == 0) alone_since_ = now;
  if (now > alone_since_ + patience_of(options_)) gave_up_ = true;
  if (reconnect_at_ == 0 || now < reconnect_at_) return;
  reconnect_at_ = 0;
  static_cast<void>(transport_.connect_again().ok());
}

template <class S> scenes::MatchInput MatchPeer<S>::input_of(int player) const {
  const Frame frame = session_.current();
  if (options_.inputs.empty()) return scenes::bot_input(options_.bot, player, frame);
  const auto i = static_cast<std::size_t>(frame);
  return i < inputs_.size() ? inputs_[i] : scenes::MatchInput{};
}

template <class S> void MatchPeer<S>::report(const SessionEvent& event) {
  std::string line = "frame " + std::to_string(session_.current()) + ": " + name_of(event.kind);
  if (event.kind == SessionEvent::Kind::refused) {
    line += ": " + std::string(event.field.key.view()) + " is \"" + std::string(event.field.in_file.view()) +
            "\" on the client, \"" + std::string(event.field.here.view()) + "\" on the host";
    // A seat becomes free when the host gives up its player, or no longer keeps it; nothing else changes by waiting.
    must_reconnect_ = event.field.key.view() == "seats";
    if (options_.listen < 0 && !must_reconnect_) gave_up_ = true;
  } else if (event.kind == SessionEvent::Kind::waiting_for) {
    line += " for player";
    for (int p = 0; p < options_.players; ++p) {
      if ((event.players >> p & 1) != 0) line += " " + std::to_string(p);
    }
  } else if (event.kind == SessionEvent::Kind::desync) {
    line += ": " + (event.player == 0xff ? std::string("the host") : "player " + std::to_string(event.player)) +
            " has another history: alike up to state " + std::to_string(event.agreed) + ", not at state " +
            std::to_string(event.frame);
    desynced_ = true;
  } else if (event.player != 0xff) {
    line += ": player " + std::to_string(event.player) + " from frame " + std::to_string(event.frame);
  }
  must_reconnect_ = must_reconnect_ || event.kind == SessionEvent::Kind::lost_host;
  say(line);
  if (event.kind == SessionEvent::Kind::desync) write_desync_bundle(event);
}

/// "host", "player 1" or "client": several peers may write to one terminal.
template <class S> std::string MatchPeer<S>::name() const {
  if (options_.listen >= 0) return "host";
  return session_.local_player() < 0 ? "client" : "player " + std::to_string(session_.local_player());
}

template <class S> void MatchPeer<S>::say(const std::string& line) const {
  std::fprintf(stderr, "isostep peer %s: %s\n", name().c_str(), line.c_str());
}

template <class S> void MatchPeer<S>::write_desync_bundle(const SessionEvent& event) {
  if (options_.bundle.empty()) return;
  ReplayFile file(options_.bundle);
  const std::uint32_t player = session_.local_player() < 0 ? 0xff : static_cast<std::uint32_t>(session_.local_player());
  // The state after which the peers part is one of these, however far apart two reports came.
  const auto states = static_cast<std::uint32_t>(event.frame - event.agreed);
  file.check(
      write_bundle(file.sink(), history_, kMatchScene, {.player = player, .agreed = event.agreed, .states = states}));
  file.close();
  say("wrote " + options_.bundle + "; compare it with the other peer's: isostep diff A B");
  options_.bundle.clear();
}

/// What a memory fault does: the lowest bit of a position, behind the world's back. Of a velocity, friction may take it
/// back within the step.
template <class S> void MatchPeer<S>::flip_a_bit() {
  auto& states = const_cast<WorldState<S>&>(game_.world().state()).awake.states;
  if (states.empty()) return;
  auto& x = states[states.size() / 2].centre.x;
  x = from_bits<std::remove_reference_t<decltype(x)>>(to_bits(x) ^ 1u);
}

template <class S> bool MatchPeer<S>::is_over(Time now) {
  if (gave_up_) return true;
  if (session_.confirmed() < first_ || session_.confirmed() < options_.frames) return false;
  if (options_.listen < 0) return true;
  if (done_at_ == 0) done_at_ = now;
  return session_.stats().peers == 0 || now > done_at_ + patience_of(options_);
}

template <class S> void MatchPeer<S>::write_files() {
  if (!options_.hashes.empty()) {
    std::string text;
    for (std::size_t i = 0; i < hashes_.size(); ++i) {
      text += std::to_string(first_ + static_cast<Frame>(i)) + " " + hex(hashes_[i]) + "\n";
    }
    write_file(options_.hashes, text);
  }
  if (!recorder_) return;
  file_->check(recorder_->finish());
  file_->close();
}

template <class S> void MatchPeer<S>::print_summary(Time played) const {
  const SessionStats& stats = session_.stats();
  const double seconds = static_cast<double>(played) / 1e6;
  std::uint64_t rollbacks = 0, deepest = 0;
  for (std::uint64_t depth = 0; depth < 65; ++depth) {
    rollbacks += stats.rollbacks[depth];
    if (stats.rollbacks[depth] != 0) deepest = depth;
  }
  const double kb = static_cast<double>(stats.bytes_out) / 1000 / seconds;
  const double ms_per_step = step_ms_ / static_cast<double>(stats.steps);
  if (!options_.json) {
    std::printf("%zu frames final, last hash %s; %llu rollbacks, deepest %llu; %.1f KB/s sent; %.3f ms a step%s\n",
                hashes_.size(), hex(hashes_.back()).c_str(), static_cast<unsigned long long>(rollbacks),
                static_cast<unsigned long long>(deepest), kb, ms_per_step, desynced_ ? "; DESYNC" : "");
    return;
  }
  const nlohmann::ordered_json json = {{"scalar", ScalarTraits<S>::kName},
                                       {"player", session_.local_player()},
                                       {"first", first_},
                                       {"frames", hashes_.size()},
                                       {"hash", hex(hashes_.back())},
                                       {"rollbacks", rollbacks},
                                       {"deepest", deepest},
                                       {"depths", std::vector<std::uint64_t>(stats.rollbacks, stats.rollbacks + 65)},
                                       {"steps", stats.steps},
                                       {"waits", stats.waits},
                                       {"round_trip_ms", static_cast<double>(stats.round_trip) / 1000},
                                       {"delay", stats.delay},
                                       {"kb_per_s", kb},
                                       {"ms_per_step", ms_per_step},
                                       {"events_confirmed", sounds_confirmed_},
                                       {"events_retracted", sounds_retracted_},
                                       {"desync", desynced_},
                                       {"seconds", seconds}};
  std::printf("%s\n", json.dump().c_str());
}

template <class S> int MatchPeer<S>::finish(Time played) {
  if (!hashes_.empty()) {
    write_files();
    print_summary(played);
  }
  if (desynced_) return exit_status::kDifferent;
  if (!gave_up_) return interrupted() ? exit_status::kInterrupted : exit_status::kOk;
  const bool refused = session_.phase() == SessionPhase::refused;
  throw ToolError(exit_status::kNoInput, refused    ? "the host refused this peer"
                                         : has_met_ ? "the host is gone"
                                                    : "no host answers");
}

namespace {

/// A host that hears nothing would wait for its timeout.
void say_goodbye(transport::EnetTransport& transport) {
  transport.disconnect(0);
  for (const Time end = steady_now() + kGoodbye; steady_now() < end;) {
    transport.poll();
    transport.wait(kLongestSleep);
  }
}

template <class S> int play(const PeerOptions& options, transport::EnetTransport& transport) {
  MatchPeer<S> peer(options, options.inputs.empty() ? std::vector<scenes::MatchInput>{} : read_inputs(options.inputs),
                    transport);
  const Time start = steady_now();
  for (Time now = start;; now = steady_now()) {
    if (interrupted()) break;
    peer.turn(now);
    if (peer.is_over(now)) break;
    const Time wait = peer.wait(steady_now());
    transport.wait(wait < kLongestSleep ? wait : kLongestSleep);
  }
  const Time end = steady_now();
  if (options.listen < 0) say_goodbye(transport);
  return peer.finish(end - start);
}

}  // namespace

int command_peer(const PeerOptions& options) {
  if ((options.listen >= 0) == !options.connect.empty()) {
    throw ToolError(exit_status::kUsage, "a peer either listens or connects: --listen PORT or --connect HOST:PORT");
  }
  if (options.listen >= 0 && !options.profile.empty()) {
    throw ToolError(exit_status::kUsage, "--profile belongs to the peers that connect");
  }
  for (const std::string& path : {options.hashes, options.bundle, options.port_file}) expect_writable(path);
  std::optional<OwnRelay> relay;
  std::optional<transport::EnetTransport> transport;
  transport::EnetSettings patient;
  if (options.patience != 0) patient.timeout = patience_of(options);
  if (options.listen >= 0) {
    const auto port = static_cast<std::uint16_t>(options.listen);
    transport.emplace(expect(transport::EnetTransport::listen(port, patient), "port " + std::to_string(port)));
    write_port(options.port_file, transport->port());
    std::fprintf(stderr, "isostep peer: listening on port %u\n", static_cast<unsigned>(transport->port()));
  } else {
    Address address = parse_address(options.connect);
    if (!options.profile.empty()) {
      relay.emplace(address, options.profile, options.bot);
      address = relay->address();
    }
    transport.emplace(expect(transport::EnetTransport::connect(address.host, address.port, patient), options.connect));
  }
  int status = exit_status::kUsage;
  const bool found =
      with_scalar(options.scalar, [&](auto tag) { status = play<typename decltype(tag)::Type>(options, *transport); });
  if (!found) throw ToolError(exit_status::kUsage, "this build lacks the scalar " + options.scalar);
  return status;
}

}  // namespace isostep::tool
