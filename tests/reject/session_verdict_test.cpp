// Hostile words about states: statements that nobody asked for, repairs without end, and a host that misquotes.
// SPDX-License-Identifier: MIT
#include <algorithm>

#include "hostile_scene.hpp"
#include "isostep/session/agreement/repair.hpp"
#include "isostep/session/agreement/verdict.hpp"

namespace isostep::hostile {
namespace session_verdict_test {

TEST(HostileVerdict, MessagesAreReadWholeOrNotAtAll) {
  Statements statements;
  statements.frame = 77;
  statements.of[0] = {true, true, 5};
  statements.of[2] = {true, false, 0};
  statements.of[kHostMachine] = {true, true, 6};
  Buffer bytes;
  write_statements(statements, bytes);
  const Result<Statements> read = read_statements(bytes);
  ASSERT_TRUE(read.ok());
  EXPECT_EQ(read.value().frame, 77);
  EXPECT_TRUE(read.value().of[2].is_asked);
  EXPECT_FALSE(read.value().of[1].is_asked);
  EXPECT_EQ(read.value().of[kHostMachine].chain, 6u);
  for (std::size_t size = 0; size < bytes.size(); ++size) EXPECT_FALSE(read_statements(Bytes(bytes).first(size)).ok());
  // Behind the kind and the frame: how many, then for each the machine, a flag and the chain.
  const auto refuses = [&](std::size_t at, std::uint8_t value) {
    Buffer changed = bytes;
    changed[at] = value;
    return !read_statements(changed).ok();
  };
  EXPECT_TRUE(refuses(5, 200)) << "more machines than there can be";
  EXPECT_TRUE(refuses(5, 2)) << "more bytes than machines";
  EXPECT_TRUE(refuses(6, 2)) << "one machine twice";
  EXPECT_TRUE(refuses(6, static_cast<std::uint8_t>(kHostMachine)));
  EXPECT_TRUE(refuses(6, 0xfe));
  EXPECT_TRUE(refuses(7, 2)) << "neither true nor false";
  EXPECT_TRUE(refuses(4, 0xff)) << "a negative frame";
  Buffer repaired;
  write_repaired({kMaxPlayers, 5}, repaired);
  EXPECT_FALSE(read_repaired(repaired).ok());
  write_repaired({0xff, -1}, repaired);
  EXPECT_FALSE(read_repaired(repaired).ok());
}

TEST(HostileVerdict, WordsThatNobodyAskedForAreRefused) {
  SeatedRogue scene;
  scene.play(kSecond, [] {});
  Buffer statement, repaired, far, inquiry, statements, offer;
  write_statement({30, true, 1}, statement);
  write_repaired({0xff, 10}, repaired);
  write_repaired({0xff, kLastFrame}, far);
  write_inquiry(10, inquiry);
  write_statements({}, statements);
  write_offer({{10, 1}, 1, 100}, offer);
  const std::uint64_t before = scene.match.host().session.stats().refused;
  for (const Buffer* words : {&statement, &repaired, &far, &inquiry, &statements, &offer}) {
    scene.rogue.say(Channel::reliable, *words);
  }
  scene.play(kSecond, [] {});
  EXPECT_EQ(scene.match.host().session.stats().refused - before, 6u);
  EXPECT_FALSE(scene.honest->heard(Kind::repaired));
  scene.expect_progress(60);
}

TEST(HostileVerdict, ItsStatesAreComparedWhateverItSaysOfRepairs) {
  SeatedRogue scene;
  scene.play(kSecond, [] {});
  Buffer resync, far;
  write_resync(resync);
  write_repaired({0xff, kLastFrame}, far);
  scene.rogue.say(Channel::reliable, resync);
  std::uint32_t arrived = 0;
  const auto takes = [&] {
    Buffer progress;
    arrived += 256;
    write_progress(arrived < 50000 ? arrived : 0, progress);
    if (scene.rogue.pieces > 0) scene.rogue.say(Channel::reliable, progress);
    scene.rogue.say(Channel::reliable, far);
  };
  scene.play(2 * kSecond, takes);
  EXPECT_GT(scene.rogue.pieces, 0u);
  EXPECT_FALSE(scene.honest->heard(Kind::repaired));
  scene.play(kSecond, [&] {
    scene.rogue.say(Channel::datagram, scene.packet([&](PacketHeader& header) {
      header.report = {header.frame - 20, 0x1234};
    }));
  });
  for (const Peer* peer : {&scene.match.host(), scene.honest}) {
    EXPECT_EQ(peer->count(Kind::desync), 1);
    EXPECT_EQ(peer->last(Kind::desync).player, scene.rogue.welcome.player);
  }
}

TEST(HostileVerdict, RepairsCostTheHostOneSnapshotInTenSeconds) {
  SeatedRogue scene;
  scene.play(kSecond, [] {});
  Buffer resync;
  write_resync(resync);
  int offered = 0;
  std::uint32_t sent = 0;  // [bytes] of the snapshot
  scene.match.host().outgoing = [&](Channel channel, std::vector<std::uint8_t>& bytes) {
    if (channel != Channel::reliable || bytes.empty()) return;
    offered += bytes[0] == static_cast<std::uint8_t>(MessageKind::offer) ? 1 : 0;
    const Result<Piece> piece = read_piece(bytes);
    const bool is_piece = bytes[0] == static_cast<std::uint8_t>(MessageKind::piece) && piece.ok();
    if (is_piece) sent = piece.value().offset + static_cast<std::uint32_t>(piece.value().bytes.size());
  };
  // It asks all the time, takes each whole, and says that it is done.
  scene.play(25 * kSecond, [&] {
    scene.rogue.say(Channel::reliable, resync);
    Buffer words;
    write_progress(sent, words);
    scene.rogue.say(Channel::reliable, words);
    write_repaired({0xff, std::max(0, scene.rogue.host_frame - 40)}, words);
    scene.rogue.say(Channel::reliable, words);
  });
  EXPECT_EQ(offered, 3);
  EXPECT_EQ(scene.honest->count(Kind::repaired, scene.rogue.welcome.player), 3);
  scene.expect_progress(60);
}

TEST(HostileVerdict, WhoIsKickedWhileItsRepairArrivesIsNoSpectator) {
  SeatedRogue scene;
  scene.play(kSecond, [] {});
  std::uint32_t size = 0, sent = 0;  // [bytes] of the snapshot
  Peer& host = scene.match.host();
  host.outgoing = [&](Channel channel, std::vector<std::uint8_t>& bytes) {
    if (channel != Channel::reliable || bytes.empty()) return;
    if (const Result<RepairOffer> offer = read_offer(bytes); bytes[0] == static_cast<std::uint8_t>(MessageKind::offer))
      size = offer.value().snapshot_size;
    const Result<Piece> piece = read_piece(bytes);
    const bool is_piece = bytes[0] == static_cast<std::uint8_t>(MessageKind::piece) && piece.ok();
    if (is_piece) sent = piece.value().offset + static_cast<std::uint32_t>(piece.value().bytes.size());
  };
  // Before the word that all has arrived: the kick and the word are of one turn.
  bool is_kicked = false;
  host.middle = [&](Channel, std::vector<std::uint8_t>& bytes) {
    Buffer whole;
    write_progress(size, whole);
    if (size == 0 || is_kicked || bytes != whole) return;
    is_kicked = host.session.kick(scene.rogue.welcome.player, "away");
  };
  Buffer words;
  write_resync(words);
  scene.rogue.say(Channel::reliable, words);
  scene.play(3 * kSecond, [&] {
    write_progress(sent, words);
    if (sent > 0 && !is_kicked) scene.rogue.say(Channel::reliable, words);
  });
  EXPECT_TRUE(is_kicked);
  EXPECT_TRUE(scene.rogue.is_refused);
  EXPECT_FALSE(scene.rogue.is_connected);
  EXPECT_EQ(host.session.stats().peers, 1) << "the honest client alone";
  scene.expect_progress(60);
}

/// A client whose host is the test, in the match.
struct Victim {
  explicit Victim(bool repair) : session(config_of(repair)) {
    session.connected(0, now);
    turn(0);
    const Welcome welcome = {.match = 9,
                             .players = 3,
                             .hosted = 1,
                             .player = 1,
                             .token = 1,
                             .start = {0, Game{}.hash()},
                             .hash = Game{}.hash(),
                             .opens = 0};
    Buffer bytes;
    write_welcome(welcome, bytes);
    session.receive(0, Channel::reliable, bytes, now);
    for (int n = 0; n < 400; ++n) turn(3);
  }
  static SessionConfig config_of(bool repair) {
    SessionConfig config = three_players();
    config.local_players = 0;
    config.repair = repair;
    return config;
  }
  /// A millisecond, with `ahead` more frames of the others' inputs and all of its own acknowledged.
  void turn(Frame ahead) {
    now += 4 * kMs;
    if (ahead > 0) {
      const std::uint8_t neutral[2] = {0, 0};
      InputStream others(4096, 2);
      others.reset(0);
      for (Frame f = 0; f <= session.current() + ahead; ++f) others.append({false, neutral});
      PacketHeader header;
      header.match = 9;
      header.started = true;
      header.frame = session.current();
      header.ack_mask = 2;
      header.ack[1] = session.current() + 1;
      const Frame first = others.end() > 60 ? others.end() - 60 : 0;
      std::uint8_t buffer[kDatagramCap];
      PacketWriter writer(header, buffer);
      writer.add_slice(0, others, first);
      writer.add_slice(2, others, first);
      session.receive(0, Channel::datagram, writer.bytes(), now);
    }
    session.add_local_input(1, {1, 1});
    drive(session, game, now);
    while (const auto out = session.poll_send(now)) {
      if (out->channel == Channel::datagram) {
        const Result<Packet> packet = read_packet(out->bytes);
        if (packet && packet.value().header.report.frame > report.frame) report = packet.value().header.report;
      } else if (!out->bytes.empty()) {
        said.emplace_back(out->bytes.begin(), out->bytes.end());
      }
    }
    while (const auto event = session.poll_event()) events.push_back(*event);
  }
  std::uint64_t hear(const Buffer& bytes) {
    const std::uint64_t before = session.stats().refused;
    session.receive(0, Channel::reliable, bytes, now);
    return session.stats().refused - before;
  }
  int count(Kind kind) const {
    int count = 0;
    for (const SessionEvent& event : events) count += event.kind == kind ? 1 : 0;
    return count;
  }
  bool has_said(MessageKind kind) const {
    for (const Buffer& bytes : said) {
      if (bytes[0] == static_cast<std::uint8_t>(kind)) return true;
    }
    return false;
  }
  Time now = 1000;
  Session<Game> session;
  Game game;
  HashReport report;
  std::vector<Buffer> said;
  std::vector<SessionEvent> events;
};

TEST(HostileVerdict, AHostThatMisquotesUsIsNotBelieved) {
  Victim victim(true);
  ASSERT_EQ(victim.session.phase(), SessionPhase::playing);
  ASSERT_GT(victim.report.frame, 30);
  Statements statements;
  statements.frame = victim.report.frame;
  statements.of[1] = {true, true, victim.report.chain ^ 1};
  statements.of[2] = statements.of[kHostMachine] = {true, true, victim.report.chain};
  Buffer bytes;
  write_statements(statements, bytes);
  EXPECT_EQ(victim.hear(bytes), 1u);
  victim.turn(3);
  EXPECT_EQ(victim.count(Kind::outvoted), 0);
  EXPECT_FALSE(victim.has_said(MessageKind::resync));
  // What can be is believed: others may have other states.
  statements.of[1].chain = victim.report.chain;
  statements.of[2].chain = statements.of[kHostMachine].chain = 6;
  write_statements(statements, bytes);
  EXPECT_EQ(victim.hear(bytes), 0u);
  victim.turn(3);
  EXPECT_EQ(victim.count(Kind::outvoted), 1);
  EXPECT_TRUE(victim.has_said(MessageKind::resync));
}

TEST(HostileVerdict, AHostsOffersAreTakenWhenTheyWereAskedForAndFit) {
  Victim victim(false);
  Buffer offer, piece;
  write_offer({{20, 1}, 1, 100}, offer);
  write_piece({0, Buffer(50)}, piece);
  EXPECT_EQ(victim.hear(offer), 1u) << "not asked for";
  EXPECT_EQ(victim.hear(piece), 1u);
  ASSERT_TRUE(victim.session.resync());
  victim.turn(3);
  EXPECT_TRUE(victim.has_said(MessageKind::resync));
  EXPECT_EQ(victim.hear(piece), 1u) << "before the offer";
  write_offer({{20, 1}, 1, (64u << 20) + 1}, offer);
  EXPECT_EQ(victim.hear(offer), 1u) << "more than a client accepts";
  victim.turn(3);
  EXPECT_EQ(victim.count(Kind::bad_snapshot), 1);
  EXPECT_EQ(victim.session.phase(), SessionPhase::playing);
  ASSERT_TRUE(victim.session.resync());
  victim.turn(3);
  // A state of the far future: nothing is done until we are there.
  write_offer({{kLastFrame, 1}, 1, 50}, offer);
  EXPECT_EQ(victim.hear(offer), 0u);
  EXPECT_EQ(victim.hear(piece), 0u);
  const Frame before = victim.session.current();
  for (int n = 0; n < 100; ++n) victim.turn(3);
  EXPECT_GT(victim.session.current(), before + 10);
  // One that the game does not take.
  write_offer({{victim.session.confirmed(), 1}, 1, 50}, offer);
  EXPECT_EQ(victim.hear(offer), 0u);
  EXPECT_EQ(victim.hear(piece), 0u);
  victim.turn(3);
  EXPECT_EQ(victim.count(Kind::bad_snapshot), 2);
  EXPECT_EQ(victim.session.phase(), SessionPhase::refused);
}

TEST(HostileVerdict, AHostAsksOnlyForStatesThatMayCome) {
  Victim victim(false);
  Buffer inquiry, repaired;
  write_inquiry(kLastFrame, inquiry);
  EXPECT_EQ(victim.hear(inquiry), 1u);
  write_inquiry(victim.report.frame, inquiry);
  EXPECT_EQ(victim.hear(inquiry), 0u);
  victim.turn(3);
  ASSERT_TRUE(victim.has_said(MessageKind::statement));
  const Statement statement = read_statement(victim.said.back()).value();
  EXPECT_TRUE(statement.is_known);
  EXPECT_EQ(statement.chain, victim.report.chain);
  for (const Repaired& words : {Repaired{3, 5}, Repaired{0xff, 5}, Repaired{1, 5}, Repaired{2, kLastFrame}}) {
    write_repaired(words, repaired);
    EXPECT_EQ(victim.hear(repaired), 1u) << int{words.player};
  }
}

}  // namespace session_verdict_test
}  // namespace isostep::hostile
