// The handshake: who was built or set up otherwise is told in which field, and does not take part.
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "isostep/replay/recorder.hpp"
#include "isostep/session/protocol/message.hpp"
#include "session/match_checks.hpp"
#include "session/toy_game.hpp"

namespace isostep::test {
namespace handshake_test {

/// The words that both sides heard after some seconds on a line without delay.
struct Meeting {
  SessionPhase host = SessionPhase::waiting, client = SessionPhase::waiting;
  Refusal told_host, told_client;
};
template <class Game> void collect(Session<Game>& session, Refusal& refusal) {
  while (const std::optional<SessionEvent> event = session.poll_event()) {
    if (event->kind == SessionEvent::Kind::refused) refusal = event->field;
  }
}
/// `alter` may change what the client says.
template <class HostGame, class ClientGame, class Alter>
Meeting meet(SessionConfig host_config, const SessionConfig& client_config, HostGame host_game, ClientGame client_game,
             Alter alter) {
  host_config.host = true;
  host_config.seed = 1;
  Session<HostGame> host(host_config);
  Session<ClientGame> client(client_config);
  Meeting meeting;
  host.connected(3, 0);
  client.connected(0, 0);
  bool closed = false;
  for (Time now = 0; now < 2 * kSecond; now += 4000) {
    drive(host, host_game, now);
    drive(client, client_game, now);
    while (const std::optional<Outgoing> out = client.poll_send(now)) {
      std::vector<std::uint8_t> bytes(out->bytes.begin(), out->bytes.end());
      alter(out->channel, bytes);
      if (!out->bytes.empty() && !closed) host.receive(3, out->channel, bytes, now);
    }
    while (const std::optional<Outgoing> out = host.poll_send(now)) {
      if (!out->bytes.empty() && !closed) client.receive(0, out->channel, out->bytes, now);
      closed = closed || out->close;
    }
    collect(host, meeting.told_host);
    collect(client, meeting.told_client);
  }
  meeting.host = host.phase();
  meeting.client = client.phase();
  return meeting;
}
constexpr auto kAsItIs = [](Channel, std::vector<std::uint8_t>&) {};

SessionConfig config_with(const ReplayIdentity& identity) {
  SessionConfig config;
  const Result<ReplayHeader> header = make_replay_header(identity);
  EXPECT_TRUE(header.ok());
  config.identity = header.value();
  return config;
}
void expect_refused(const Meeting& meeting, std::string_view key) {
  EXPECT_EQ(meeting.told_client.key.view(), key);
  EXPECT_EQ(meeting.told_host.key.view(), key);
  EXPECT_EQ(meeting.client, SessionPhase::refused);
  EXPECT_EQ(meeting.host, SessionPhase::waiting) << "the host still waits for somebody who fits";
}

TEST(Handshake, LetsInWhoIsTheSame) {
  const SessionConfig config = config_with(identity_of_world(Settings<float>{}, "arena"));
  const Meeting meeting = meet(config, config, Toy(), Toy(), kAsItIs);
  EXPECT_EQ(meeting.client, SessionPhase::playing);
  EXPECT_EQ(meeting.host, SessionPhase::playing);
  EXPECT_TRUE(meeting.told_client.key.empty());
}

TEST(Handshake, LetsInAnotherReleaseOfTheSameBehaviour) {
  ReplayIdentity other = identity_of_world(Settings<float>{}, "arena");
  const SessionConfig host = config_with(other);
  other.engine = "99.0.0";
  const Meeting meeting = meet(host, config_with(other), Toy(), Toy(), kAsItIs);
  EXPECT_EQ(meeting.client, SessionPhase::playing);
}

TEST(Handshake, RefusesEveryFieldThatShapesResultsByItsName) {
  const ReplayIdentity ours = identity_of_world(Settings<float>{}, "arena");
  const struct {
    std::string_view key;
    void (*change)(ReplayIdentity&);
  } cases[] = {
      {"behaviour", [](ReplayIdentity& identity) { identity.behaviour ^= 1; }},
      {"scalar", [](ReplayIdentity& identity) { identity = identity_of_world(Settings<Q16_16>{}, "arena"); }},
      {"scalar_id", [](ReplayIdentity& identity) { ++identity.scalar_id; }},
      {"hz", [](ReplayIdentity& identity) { identity.hz = 50; }},
      {"substeps", [](ReplayIdentity& identity) { ++identity.substeps; }},
      {"solver", [](ReplayIdentity& identity) { identity.solver = "another"; }},
      {"settings",
       [](ReplayIdentity& identity) {
         Settings<float> settings;
         settings.gravity.y = -1;
         identity = identity_of_world(settings, "arena");
       }},
      {"hash", [](ReplayIdentity& identity) { identity.hash_algorithm = "another"; }},
      {"scene", [](ReplayIdentity& identity) { identity.scene = "desert"; }},
  };
  for (const auto& one : cases) {
    SCOPED_TRACE(one.key);
    ReplayIdentity theirs = ours;
    one.change(theirs);
    expect_refused(meet(config_with(ours), config_with(theirs), Toy(), Toy(), kAsItIs), one.key);
    expect_refused(meet(config_with(theirs), config_with(ours), Toy(), Toy(), kAsItIs), one.key);
  }
}

TEST(Handshake, TellsBothValues) {
  ReplayIdentity identity = identity_of_world(Settings<float>{}, "arena");
  const SessionConfig host = config_with(identity);
  identity.hz = 50;
  const Meeting meeting = meet(host, config_with(identity), Toy(), Toy(), kAsItIs);
  EXPECT_EQ(meeting.told_client.in_file.view(), "50");  // the client's
  EXPECT_EQ(meeting.told_client.here.view(), "60");
}

TEST(Handshake, RefusesWhatTheGameItselfAdded) {
  SessionConfig host = config_with(identity_of_world(Settings<float>{}, "arena")), client = host;
  host.identity.set("rules", "classic", true);
  client.identity.set("rules", "sudden death", true);
  expect_refused(meet(host, client, Toy(), Toy(), kAsItIs), "rules");
}

TEST(Handshake, RefusesAnotherNumberOfPlayers) {
  SessionConfig host = config_with(identity_of_world(Settings<float>{}, "arena")), client = host;
  client.players = 3;
  expect_refused(meet(host, client, Toy(), Toy(), kAsItIs), "players");
}

TEST(Handshake, RefusesAnotherRateOfFrames) {
  SessionConfig host = config_with(identity_of_world(Settings<float>{}, "arena")), client = host;
  client.hz = 30;
  expect_refused(meet(host, client, Toy(), Toy(), kAsItIs), "session_hz");
}

/// An input of the same bytes with another meaning.
struct RenamedInput {
  std::int8_t push = 0, pull = 0;
  std::uint16_t buttons = 0;
  friend bool operator==(const RenamedInput&, const RenamedInput&) = default;
  ISO_FIELDS(push, pull, buttons)
};
static_assert(RenamedInput{} == RenamedInput{});
struct RenamedToy : Toy {
  using Input = RenamedInput;
  void step(InputView<RenamedInput>) {}
};

TEST(Handshake, RefusesAnotherLayoutOfTheInput) {
  const SessionConfig config = config_with(identity_of_world(Settings<float>{}, "arena"));
  expect_refused(meet(config, config, Toy(), RenamedToy(), kAsItIs), "input_schema");
}

TEST(Handshake, RefusesAnotherFirstState) {
  const SessionConfig config = config_with(identity_of_world(Settings<float>{}, "arena"));
  Toy other;
  other.state.places[7] = 1;
  expect_refused(meet(config, config, Toy(), other, kAsItIs), "start");
}

TEST(Handshake, RefusesAnotherProtocol) {
  const SessionConfig config = config_with(identity_of_world(Settings<float>{}, "arena"));
  const Meeting meeting = meet(config, config, Toy(), Toy(), [](Channel channel, std::vector<std::uint8_t>& bytes) {
    if (channel == Channel::reliable && bytes.size() > 7) bytes[5] ^= 0x80;  // after kind and magic
  });
  expect_refused(meeting, "protocol");
}

TEST(Handshake, IsOverBeforeItBeginsWhenTheConfigurationCannotBe) {
  SessionConfig config;
  config.players = static_cast<int>(kMaxPlayers) + 1;
  Session<Toy> session(config);
  const std::optional<SessionEvent> event = session.poll_event();
  ASSERT_TRUE(event.has_value());
  EXPECT_EQ(event->kind, SessionEvent::Kind::refused);
  EXPECT_NE(event->field.here.view().find("players"), std::string_view::npos);
  EXPECT_EQ(session.phase(), SessionPhase::refused);
  Toy toy;
  EXPECT_EQ(drive(session, toy, 0), 0);
}

}  // namespace handshake_test
}  // namespace isostep::test
