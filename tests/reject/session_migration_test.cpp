// A member of the match that lies when the host is gone: about rosters, support, and inputs that nobody else knows.
// SPDX-License-Identifier: MIT
#include "hostile_scene.hpp"
#include "isostep/session/agreement/roster.hpp"

namespace isostep::hostile {
namespace session_migration_test {

SessionConfig migrating() {
  SessionConfig config = three_players();
  config.players = 5;
  config.migration = kSecond;
  return config;
}

Support support_in(std::uint32_t term) {
  Support support;
  support.term = term;
  return support;
}

/// The host's process has died, and the rogue is connected to the client that would follow it.
struct Orphans : SeatedRogue {
  explicit Orphans(std::size_t alive) : SeatedRogue(migrating()) {
    play(3 * kSecond, [] {});
    EXPECT_FALSE(rogue.roster.empty());
    roster = read_roster(rogue.roster).value();
    kill(0);
    for (std::size_t i = 4; i > alive; --i) kill(i - 1);
    rogue.port.disconnect(rogue.peer);
    died_at = match.now();
    // Until the first of those that are left has missed the host, so that it is a candidate.
    candidate->after_turn = [this] { seeks = seeks || candidate->session.phase() == SessionPhase::seeking; };
    EXPECT_TRUE(match.run(2 * kSecond, [&] { return seeks; }));
    join(rogue, rogue.welcome.token);
  }
  void kill(std::size_t machine) {
    match.machine(machine).plays = false;
    match.network().set_silent(match.machine(machine).endpoint, true);
  }
  void join(Rogue& one, std::uint64_t token) {
    match.network().connect(one.id, candidate->endpoint);
    one.is_connected = false;
    EXPECT_TRUE(match.run(kSecond, [&] {
      one.listen();
      return one.is_connected;
    }));
    Hello hello = hello_of(config);
    hello.token = token;
    if (token == rogue.welcome.token) hello.life = rogue.welcome.life;
    one.greet(hello);
  }
  std::uint64_t refused() const { return candidate->session.stats().refused; }
  void pass(Time time) {
    match.run(time, [&] {
      rogue.listen();
      return false;
    });
  }
  Peer* candidate = &match.machine(1);
  Roster roster;
  Time died_at = 0;
  bool seeks = false;
};

TEST(HostileMember, SupportsACandidateOnceAndNobodyElseMayAtAll) {
  Orphans scene(2);  // the candidate and the rogue, of five machines
  Buffer support, old;
  write_support(support_in(scene.roster.term + 1), support);
  write_support(support_in(scene.roster.term), old);
  std::vector<std::unique_ptr<Rogue>> others;
  for (int n = 0; n < 4; ++n) {
    others.push_back(std::make_unique<Rogue>(scene.match, lan()));
    scene.match.run(100 * kMs, [&] {
      others.back()->listen();
      return false;
    });
    const std::uint64_t tokens[] = {scene.rogue.welcome.token, 0, 12345, scene.rogue.welcome.token};
    scene.join(*others.back(), tokens[n]);
    others.back()->say(Channel::reliable, support);
    others.back()->say(Channel::reliable, old);
  }
  const std::uint64_t before = scene.refused();
  scene.rogue.say(Channel::reliable, support);
  scene.pass(100 * kMs);
  scene.rogue.say(Channel::reliable, old);
  scene.pass(4 * kSecond);
  EXPECT_FALSE(scene.candidate->session.config().host) << "two machines of five";
  EXPECT_GE(scene.refused(), before);
  EXPECT_EQ(scene.candidate->session.phase(), SessionPhase::seeking);
}

TEST(HostileMember, CannotChangeTheRoster) {
  Orphans scene(2);
  // The candidate and the rogue would be a majority of these; and the next to be asked is elsewhere.
  Roster forged;
  forged.version = scene.roster.version + 5;
  for (int m = 0; m < scene.roster.count; ++m) {
    const Roster::Machine& machine = scene.roster.machines[m];
    const bool stays = m == 0 || (machine.players & (2u | 1u << scene.rogue.welcome.player)) != 0;
    if (stays) forged.machines[forged.count++] = machine;
  }
  ASSERT_EQ(forged.count, 3);
  forged.machines[2].address = "99";
  Buffer bytes, support;
  for (int n = 0; n < 2; ++n) {
    // As if it came from the host, and sealed by who does not know the candidate's token.
    std::vector<std::uint8_t> scratch;
    if (n == 1) forged.machines[1].seal = seal_of(forged, scene.rogue.welcome.token, scratch);
    write_roster(forged, bytes);
    const std::uint64_t before = scene.refused();
    scene.rogue.say(Channel::reliable, bytes);
    scene.pass(50 * kMs);
    EXPECT_EQ(scene.refused(), before + 1);
  }
  write_support(support_in(forged.term + 1), support);
  scene.rogue.say(Channel::reliable, support);
  scene.pass(3 * kSecond);
  EXPECT_FALSE(scene.candidate->session.config().host);
  EXPECT_NE(scene.candidate->connects_to, "99");
}

TEST(HostileMember, GivesNoInputsForOthersWhoAreThere) {
  Orphans scene(4);
  const Frame from = scene.candidate->session.current();
  InputStream forged(4096, 2);
  const std::uint8_t word[2] = {77, 77};
  forged.reset(from > 40 ? from - 40 : 0);
  for (Frame f = forged.begin(); f < from + 2000; ++f) forged.append({false, word});
  ASSERT_TRUE(scene.match.run(4 * kSecond, [&] {
    scene.rogue.listen();
    return scene.rogue.asked.has_value();
  }));
  Buffer known, support;
  for (std::uint8_t p = 0; p < 5; ++p) {
    for (Frame first = forged.begin(); first < from + 1900; first += 100) {
      PacketHeader header;
      std::uint8_t buffer[kDatagramCap];
      PacketWriter writer(header, buffer);
      writer.add_slice(p, forged, first, 100);
      write_known(writer.bytes(), known);
      scene.rogue.say(Channel::reliable, known);
    }
  }
  write_support(support_in(scene.rogue.asked->term), support);
  scene.rogue.say(Channel::reliable, support);
  scene.pass(8 * kSecond);
  EXPECT_GT(scene.refused(), 0u);
  ASSERT_TRUE(scene.candidate->session.config().host);
  Frame forged_frames = 0, gone_frames = 0;
  for (Frame f = from - 40; f < scene.candidate->end(); ++f) {
    for (std::size_t p = 1; p < 4; ++p) forged_frames += scene.candidate->at(f)[p].input == Pad{77, 77} ? 1 : 0;
    gone_frames += f >= from && scene.candidate->at(f)[0].input == Pad{77, 77} ? 1 : 0;
  }
  EXPECT_EQ(forged_frames, 0);
  // Of who is gone nobody else knows what it did last.
  EXPECT_LE(gone_frames, 60 + 2 * scene.config.most_delay + scene.config.window);
  for (std::size_t i = 1; i < 4; ++i) {
    const Peer& peer = scene.match.machine(i);
    EXPECT_EQ(peer.session.phase(), SessionPhase::playing);
    EXPECT_FALSE(peer.heard(Kind::desync));
    EXPECT_GT(peer.end(), from + 240);
    for (Frame f = peer.first; f < std::min(peer.end(), scene.candidate->end()); ++f) {
      ASSERT_EQ(peer.hashes[static_cast<std::size_t>(f - peer.first)],
                scene.candidate->hashes[static_cast<std::size_t>(f - scene.candidate->first)]);
    }
  }
}

TEST(HostileMember, WordsOfACandidateAndOfAHostAreHeardFromNobodyElse) {
  SeatedRogue scene(migrating());
  scene.play(2 * kSecond, [] {});
  Buffer candidate, known, support, redirect;
  write_candidate({}, candidate);
  PacketHeader header;
  std::uint8_t buffer[kDatagramCap];
  write_known(PacketWriter(header, buffer).bytes(), known);
  write_support(support_in(1), support);
  write_redirect("99", redirect);
  // To the host that lives, and to a client that has one.
  const std::uint64_t before = scene.match.host().session.stats().refused;
  for (const Buffer* words : {&candidate, &known, &support, &redirect, &scene.rogue.roster}) {
    scene.rogue.say(Channel::reliable, *words);
  }
  scene.play(kSecond, [] {});
  EXPECT_EQ(scene.match.host().session.stats().refused - before, 5u);
  Rogue caller(scene.match, lan());
  scene.match.run(100 * kMs, [&] {
    caller.listen();
    return false;
  });
  scene.match.network().connect(caller.id, scene.honest->endpoint);
  scene.play(kSecond, [&] { caller.listen(); });
  const std::uint64_t there = scene.honest->session.stats().refused;
  for (const Buffer* words : {&candidate, &known, &support, &redirect, &scene.rogue.roster}) {
    caller.say(Channel::reliable, *words);
  }
  scene.play(kSecond, [&] { caller.listen(); });
  EXPECT_GE(scene.honest->session.stats().refused - there, 5u);
  scene.expect_progress(60);
}

/// A member whose host and whose candidates are the test.
struct Elector {
  Elector() : session(config_of()) {
    session.connected(0, now);
    turn();
    const Welcome welcome = {.match = 9,
                             .players = 3,
                             .hosted = 1,
                             .player = 1,
                             .token = 1,
                             .life = 5,
                             .term = 1,
                             .start = {0, Game{}.hash()},
                             .hash = Game{}.hash(),
                             .opens = 0};
    Buffer bytes;
    write_welcome(welcome, bytes);
    session.receive(0, Channel::reliable, bytes, now);
    Roster roster;
    roster.term = 1;
    roster.version = kVersion;
    roster.count = 3;
    for (std::uint8_t m = 0; m < 3; ++m) {
      Roster::Machine& machine = roster.machines[m];
      machine = {1u << m, proof_of(m), 4u + m, true, true, {}, 0};
      machine.address.append_number(m);
    }
    write_roster(roster, bytes);
    session.receive(0, Channel::reliable, bytes, now);
    turn();
    session.disconnected(0, now);
    turn();
  }
  static SessionConfig config_of() {
    SessionConfig config = migrating();
    config.players = 3;
    config.local_players = 0;
    config.address = "1";
    config.seed = 7;
    return config;
  }
  /// Of the messages to this peer.
  std::vector<MessageKind> told(PeerId peer) {
    std::vector<MessageKind> kinds;
    while (const auto out = session.poll_send(now)) {
      const bool is_message = out->channel == Channel::reliable && !out->bytes.empty();
      if (is_message && out->peer == peer) kinds.push_back(message_kind(out->bytes).value());
    }
    return kinds;
  }
  void turn() {
    now += kMs;
    drive(session, game, now);
    told(0);
  }
  static constexpr std::uint32_t kVersion = 3;
  Time now = 1000;
  Session<Game> session;
  Game game;
};

TEST(HostileMember, WhatACandidateWasToHearIsNotToldToTheNext) {
  for (const std::uint32_t version : {1u, Elector::kVersion}) {  // it lacks our roster, or has it
    Elector elector;
    ASSERT_EQ(elector.session.phase(), SessionPhase::seeking);
    Buffer asks, redirect;
    Candidate candidate{.term = 2, .log_term = 1, .roster_term = 1, .version = version};
    write_candidate(candidate, asks);
    write_redirect(Address("2"), redirect);
    elector.session.connected(1, elector.now);
    EXPECT_EQ(elector.told(1), std::vector{MessageKind::hello});
    elector.session.receive(1, Channel::reliable, asks, elector.now);
    EXPECT_EQ(elector.told(1).size(), 1u) << "an answer";
    // Another candidate, and before it has its answer it sends us on.
    candidate.term = 3;
    write_candidate(candidate, asks);
    elector.session.receive(1, Channel::reliable, asks, elector.now);
    elector.session.receive(1, Channel::reliable, redirect, elector.now);
    ASSERT_EQ(elector.session.poll_connect(), Address("2"));
    elector.session.connected(2, elector.now);
    EXPECT_EQ(elector.told(2), std::vector{MessageKind::hello});
  }
}

}  // namespace session_migration_test
}  // namespace isostep::hostile
