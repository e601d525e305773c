// The host of a match in C++, and the network in virtual time to its client, which is a game in C#: see MatchTest.cs.
// SPDX-License-Identifier: MIT
#include <cstdint>
#include <cstring>
#include <memory>
#include <vector>

#include "isostep/session/session.hpp"
#include "isostep/state/composite.hpp"
#include "isostep/world/recorder.hpp"
#include "transport/pump.hpp"
#include "transport/simulated_network.hpp"

namespace iso = isostep;
using iso::transport::Arrival;
using iso::transport::SimulatedNetwork;

namespace {

struct Push {
  std::int8_t way = 0;
  friend bool operator==(Push, Push) = default;
  template <class Visitor, class Self> static constexpr void fields(Visitor&& visit, Self&& self) {
    visit("way", self.way);
  }
};
struct Score {
  std::uint32_t touches = 0;
  template <class Visitor, class Self> static constexpr void fields(Visitor&& visit, Self&& self) {
    visit("touches", self.touches);
  }
};
template <class S> struct Game : iso::Composite<iso::World<S>, Score> {
  using Input = Push;
  iso::BodyId pucks[2];

  Game() {
    auto& engine = this->world;
    engine.create({.shape = engine.add_shape(iso::Box{{20, 1, 20}}), .position = {0, -1, 0}});
    const auto ball = engine.add_shape(iso::Sphere{0.5});
    for (int n : {0, 1})
      pucks[n] = engine.create({.type = iso::dynamic, .shape = ball, .position = {S(4 * n - 2), 1, 0}});
  }
  void step(iso::InputView<Input> inputs) {
    for (int n : {0, 1}) this->world.apply_impulse(pucks[n], {S(0.125) * S(inputs[n].way), 0, 0});
    this->world.step();
    this->user.touches += static_cast<std::uint32_t>(this->world.events().contact_begin.size());
  }
};

class Match {
 public:
  virtual ~Match() = default;
  virtual void turn(iso::Time now) = 0;
  SimulatedNetwork network;
  SimulatedNetwork::Port client = network.port(SimulatedNetwork::kHost);
  std::vector<std::uint64_t> hashes;  // of the host's final frames

 protected:
  explicit Match(const char* profile) {
    line_ = network.add_client(iso::transport::parse_profile(profile).value());
    client = network.port(line_);
    network.connect(line_);
  }
  iso::transport::EndpointId line_;
};

template <class S> class MatchOf final : public Match {
 public:
  explicit MatchOf(const char* profile) : Match(profile), session_(config()), port_(network.port(0)) {}
  void turn(iso::Time now) override {
    network.advance_to(now);
    iso::transport::deliver(port_, session_, now);
    session_.add_local_input(0, {static_cast<std::int8_t>((session_.current() / 11) % 3 - 1)});
    iso::drive(session_, game_, now, *this);
    iso::transport::dispatch(port_, session_, now);
  }
  void confirmed(iso::Frame, std::uint64_t hash) { hashes.push_back(hash); }  // drive() calls this

 private:
  static iso::SessionConfig config() {
    iso::SessionConfig config;
    config.mode = iso::SessionMode::rollback;
    config.identity = iso::make_replay_header(iso::identity_of_world(Game<S>().world.settings(), "two pucks")).value();
    config.host = true;
    config.seed = 20;
    return config;
  }
  Game<S> game_;
  iso::Session<Game<S>> session_;
  SimulatedNetwork::Port port_;
};

}  // namespace

#define EXPORT extern "C" __attribute__((visibility("default")))

EXPORT std::uint64_t match_schema() { return iso::InputCodec<Push>::schema(); }
EXPORT void* match_create(int is_fixed, const char* profile) {
  if (is_fixed != 0) return new MatchOf<iso::Q32_32>(profile);
  return new MatchOf<float>(profile);
}
EXPORT void match_destroy(void* match) { delete static_cast<Match*>(match); }
EXPORT void match_turn(void* match, std::uint64_t now) { static_cast<Match*>(match)->turn(now); }
EXPORT int match_confirmed(void* match) { return static_cast<int>(static_cast<Match*>(match)->hashes.size()); }
EXPORT std::uint64_t match_hash(void* match, int frame) {
  return static_cast<Match*>(match)->hashes[static_cast<std::size_t>(frame)];
}

/// The client's port. What has arrived: 0 nothing, 1 connected, 2 disconnected, 3 a message of *size bytes.
EXPORT int match_receive(void* match, std::uint32_t* peer, std::uint32_t* channel, std::uint8_t* bytes, int* size) {
  const std::optional<Arrival> arrival = static_cast<Match*>(match)->client.receive();
  if (!arrival) return 0;
  *peer = arrival->peer;
  *channel = static_cast<std::uint32_t>(arrival->channel);
  *size = static_cast<int>(arrival->bytes.size());
  if (*size != 0) std::memcpy(bytes, arrival->bytes.data(), arrival->bytes.size());
  return arrival->kind == iso::transport::ArrivalKind::connected ? 1
         : arrival->kind == iso::transport::ArrivalKind::message ? 3
                                                                 : 2;
}
EXPORT void match_send(void* match, std::uint32_t peer, std::uint32_t channel, const std::uint8_t* bytes, int size) {
  static_cast<void>(static_cast<Match*>(match)
                        ->client.send(peer, static_cast<iso::Channel>(channel), {bytes, static_cast<std::size_t>(size)})
                        .ok());
}
EXPORT void match_hang_up(void* match, std::uint32_t peer) { static_cast<Match*>(match)->client.disconnect(peer); }
