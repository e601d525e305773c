// A match of a C++ host with clients in other languages, each in a process of its own, across a simulated network. In
// virtual time, turn by turn, so that it is one and the same match however slow the machines are.
// SPDX-License-Identifier: MIT
//
// usage: match_host SCALAR PROFILE FRAMES FOLDER COMMAND...
//
// SCALAR: f32, f64, q16, q32. Each COMMAND runs a client. Succeeds when all peers have the same hash after each of the
// first FRAMES frames, and the match did something; then FOLDER has the world's recording of each: host.replay,
// client1.replay ... A client reads from its standard input and writes to its output, little-endian:
//   in:  the input's schema u64, players u32
// then by turns
//   in:  now u64 [us], arrivals u32, of each: kind u8, channel u8, size u32, bytes; kinds are those of ArrivalKind
//   out: messages u32, of each: channel u8, size u32, bytes; final frames u32, of each: frame u32, hash u64
// and when the match is over
//   in:  now u64, all bits set
//   out: rollbacks u32, size u32 and its recording, of that size
// after which it exits with 0. A client also exits, with another status, on what no sound match has: a desync, a
// refusal, a lost host.
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <map>
#include <memory>
#include <set>
#include <stdexcept>
#include <string>

#include "client_process.hpp"
#include "isostep/replay/session_recorder.hpp"
#include "pucks.hpp"
#include "transport/pump.hpp"
#include "transport/simulated_network.hpp"

namespace isostep::test {
namespace {

using transport::SimulatedNetwork;

constexpr Time kTurn = 8000;               // [us]
constexpr Time kPatience = 300 * kSecond;  // of virtual time, for all frames
constexpr Time kOver = ~Time{0};
constexpr std::uint32_t kLeastRollbacks = 100;  // of each client

struct Words {
  const char* profile;
  Frame frames;
  std::string folder;
  std::vector<std::string> commands;
};

/// A peer's hashes of the frames that count, by frame.
using Hashes = std::map<Frame, std::uint64_t>;

struct Client {
  Client(const std::string& command, SimulatedNetwork::Port its_port) : process(command), port(its_port) {}
  ClientProcess process;
  SimulatedNetwork::Port port;
  Hashes hashes;  // of its final frames
};

void write_file(const std::string& path, const std::vector<std::uint8_t>& bytes) {
  std::ofstream out(path, std::ios::binary);
  out.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  if (!out.flush()) throw std::runtime_error("cannot write " + path);
}

/// The turn's time, and what has arrived at the client.
void send_turn(Client& client, Time now) {
  std::vector<std::uint8_t> arrivals;
  const auto put = [&](const auto& value) {
    const auto* const bytes = reinterpret_cast<const std::uint8_t*>(&value);
    arrivals.insert(arrivals.end(), bytes, bytes + sizeof value);
  };
  std::uint32_t count = 0;
  for (; const auto arrival = client.port.receive(); ++count) {
    put(static_cast<std::uint8_t>(arrival->kind));
    put(static_cast<std::uint8_t>(arrival->channel));
    put(static_cast<std::uint32_t>(arrival->bytes.size()));
    arrivals.insert(arrivals.end(), arrival->bytes.begin(), arrival->bytes.end());
  }
  client.process.put(now);
  client.process.put(count);
  client.process.put_bytes(arrivals.data(), arrivals.size());
  client.process.flush();
}

/// Takes what a client sends, and the frames that are final for it.
void take_turn(Client& client) {
  ClientProcess& from = client.process;
  for (auto left = from.take<std::uint32_t>(); left > 0; --left) {
    const auto channel = static_cast<Channel>(from.take<std::uint8_t>());
    const std::vector<std::uint8_t> bytes = from.take_bytes(from.take<std::uint32_t>());
    static_cast<void>(client.port.send(0, channel, bytes).ok());  // the host has hung up: the client will hear of it
  }
  for (auto left = from.take<std::uint32_t>(); left > 0; --left) {
    const auto frame = static_cast<Frame>(from.take<std::uint32_t>());
    client.hashes.emplace(frame, from.take<std::uint64_t>());
  }
}

template <class S> class Match {
 public:
  explicit Match(const Words& words)
      : words_(words),
        game_(static_cast<int>(words.commands.size()) + 1),
        session_(host_config_of(game_)),
        history_(game_.world, {.frames = static_cast<std::size_t>(session_.config().kept), .states = false}),
        recorder_(history_, sink_to(file_), "pucks") {
    const transport::NetworkProfile profile = transport::parse_profile(words.profile).value();
    for (const std::string& command : words.commands) {
      const auto line = network_.add_client(profile);
      clients_.push_back(std::make_unique<Client>(command, network_.port(line)));
      clients_.back()->process.put(InputCodec<Push>::schema());
      clients_.back()->process.put(static_cast<std::uint32_t>(game_.pucks.size()));
      network_.connect(line);
    }
  }

  void play() {
    for (Time now = 0; !is_over(); now += kTurn) {
      if (now > kPatience) throw std::runtime_error("the match does not come to its end");
      network_.advance_to(now);
      for (const auto& client : clients_) send_turn(*client, now);
      take_own_turn(now);
      for (const auto& client : clients_) take_turn(*client);
    }
    compare();
    finish();
  }

  void confirmed(Frame frame, std::uint64_t hash) { hashes_.emplace(frame, hash); }  // drive() calls this

 private:
  bool has_all(const Hashes& hashes) const { return !hashes.empty() && hashes.rbegin()->first >= words_.frames - 1; }
  bool is_over() const {
    bool over = has_all(hashes_);
    for (const auto& client : clients_) over = over && has_all(client->hashes);
    return over;
  }
  void take_own_turn(Time now) {
    SimulatedNetwork::Port port = network_.port(SimulatedNetwork::kHost);
    transport::deliver(port, session_, now);
    session_.add_local_input(0, push_of(session_.current(), 0));
    drive(session_, game_, now, Observers(history_, recorder_, *this));
    transport::dispatch(port, session_, now);
    while (const std::optional<SessionEvent> event = session_.poll_event()) {
      if (event->kind == SessionEvent::Kind::desync) throw std::runtime_error("a peer has another state");
    }
  }

  void compare() const {
    std::set<std::uint64_t> different;
    for (Frame frame = 0; frame < words_.frames; ++frame) {
      const std::uint64_t hash = hashes_.at(frame);
      different.insert(hash);
      for (const auto& client : clients_) {
        const auto theirs = client->hashes.find(frame);
        if (theirs == client->hashes.end() || theirs->second != hash)
          throw std::runtime_error("frame " + std::to_string(frame) + " differs: " + client->process.command());
      }
    }
    if (different.size() < static_cast<std::size_t>(words_.frames) / 2) throw std::runtime_error("nothing moves");
    if (game_.user.touches < game_.pucks.size()) throw std::runtime_error("the pucks do not touch");
  }

  /// Collects the recordings.
  void finish() {
    if (!recorder_.finish().ok()) throw std::runtime_error("the host's recording is not sound");
    write_file(words_.folder + "/host.replay", file_);
    std::printf("%d frames are equal on %zu peers, %u touches\n", static_cast<int>(words_.frames), clients_.size() + 1,
                game_.user.touches);
    int number = 0;
    for (const auto& client : clients_) {
      ClientProcess& process = client->process;
      process.put(kOver);
      process.flush();
      const auto rollbacks = process.take<std::uint32_t>();
      const std::vector<std::uint8_t> recording = process.take_bytes(process.take<std::uint32_t>());
      write_file(words_.folder + "/client" + std::to_string(++number) + ".replay", recording);
      process.expect_success();
      std::printf("%u rollbacks: %s\n", rollbacks, process.command().c_str());
      if (rollbacks < kLeastRollbacks) throw std::runtime_error("the match was too easy: " + process.command());
    }
  }

  const Words& words_;
  Pucks<S> game_;
  Session<Pucks<S>> session_;
  FrameHistory<S> history_;
  std::vector<std::uint8_t> file_;
  SessionRecorder<S> recorder_;
  SimulatedNetwork network_{{.seed = 11}};
  std::vector<std::unique_ptr<Client>> clients_;
  Hashes hashes_;
};

int play(std::string_view scalar, const Words& words) {
  if (scalar == "f32") Match<float>(words).play();
  else if (scalar == "f64") Match<double>(words).play();
  else if (scalar == "q16") Match<Q16_16>(words).play();
  else if (scalar == "q32") Match<Q32_32>(words).play();
  else return 64;
  return 0;
}

}  // namespace
}  // namespace isostep::test

int main(int count, char** words) {
  if (count < 6) return 64;
  std::signal(SIGPIPE, SIG_IGN);  // a client that has ended is told by `write`
  try {
    return isostep::test::play(words[1], {words[2], std::atoi(words[3]), words[4], {words + 5, words + count}});
  } catch (const std::exception& error) {
    std::fprintf(stderr, "match_host: %s\n", error.what());
    return 1;
  }
}
