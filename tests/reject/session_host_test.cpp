// Hostile hosts, against an honest client.
// SPDX-License-Identifier: MIT
#include <algorithm>

#include "hostile_scene.hpp"
#include "isostep/core/random.hpp"

namespace isostep::hostile {
namespace session_host_test {

/// A client whose host is the test.
struct Victim {
  explicit Victim(SessionMode mode = SessionMode::rollback) : session(make(mode)) {
    session.connected(0, now);
    drive(session, game, now);
    while (session.poll_send(now)) {}
  }
  static SessionConfig make(SessionMode mode) {
    SessionConfig config = three_players();
    config.local_players = 0;
    config.mode = mode;
    return config;
  }
  void hear(const Buffer& bytes, Channel channel = Channel::reliable) { session.receive(0, channel, bytes, now); }
  void hear_welcome(const Welcome& welcome) {
    Buffer bytes;
    write_welcome(welcome, bytes);
    hear(bytes);
  }
  void hear_piece(std::uint32_t offset, Bytes content) {
    Buffer bytes;
    write_piece({offset, content}, bytes);
    hear(bytes);
  }
  void turn() {
    now += kMs;
    for (int p = 0; p < 3; ++p) session.add_local_input(p, {1, 1});
    drive(session, game, now);
    while (session.poll_send(now)) {}
  }
  static Welcome first_welcome() {
    return {.match = 9,
            .players = 3,
            .hosted = 1,
            .player = 1,
            .token = 1,
            .start = {0, Game{}.hash()},
            .hash = Game{}.hash(),
            .snapshot_size = 0,
            .opens = 0};
  }
  Buffer datagram(const std::function<void(PacketHeader&)>& change = nullptr) {
    PacketHeader header;
    header.match = 9;
    header.started = true;
    if (change) change(header);
    std::uint8_t buffer[kDatagramCap];
    const Bytes bytes = PacketWriter(header, buffer).bytes();
    return Buffer(bytes.begin(), bytes.end());
  }
  Time now = 1000;
  Session<Game> session;
  Game game;
};

TEST(HostileHost, AWelcomeToAStateThatWeDoNotHaveIsRefused) {
  for (const HashReport start :
       {HashReport{1, Game{}.hash()}, HashReport{0, 5}, HashReport{100000, 5}, HashReport{kLastFrame, 1}}) {
    Victim victim;
    Welcome welcome = Victim::first_welcome();
    welcome.start = start;
    victim.hear_welcome(welcome);
    victim.turn();
    EXPECT_EQ(victim.session.phase(), SessionPhase::refused);
    EXPECT_EQ(victim.session.current(), 0);
  }
}

/// A client that is sent the state before frame `frame`, all of it.
struct Joiner : Victim {
  explicit Joiner(Frame frame) {
    Game theirs;
    for (Frame f = 0; f < frame; ++f) {
      const Pad pads[3] = {bot(0, f), bot(1, f), bot(2, f)};
      const InputStatus statuses[3] = {InputStatus::confirmed, InputStatus::confirmed, InputStatus::confirmed};
      theirs.step({pads, statuses});
    }
    Writer writer(state);
    theirs.write_portable(writer);
    hash = theirs.hash();
    Welcome welcome = first_welcome();
    welcome.start = {frame, 3};
    welcome.hash = hash;
    welcome.snapshot_size = size();
    welcome.opens = kNoFrame;
    hear_welcome(welcome);
    for (std::size_t at = 0; at < state.size(); at += 16000) {
      const std::size_t left = state.size() - at;
      hear_piece(static_cast<std::uint32_t>(at), Bytes(state).subspan(at, left < 16000 ? left : 16000));
    }
  }
  std::uint32_t size() const { return static_cast<std::uint32_t>(state.size()); }
  /// How many states the game is to become in this turn.
  int restores(bool carries_out) {
    now += kMs;
    int count = 0;
    NoObserver observer;
    for (const Request<Pad>& request : session.advance(now)) {
      count += request.kind == RequestKind::restore ? 1 : 0;
      if (carries_out) carry_out(session, game, request, observer);
    }
    return count;
  }
  Buffer state;
  std::uint64_t hash = 0;
};

TEST(HostileHost, AnEmptyPieceIsRefusedWhereverTheSnapshotStands) {
  for (const Frame frame : {1, 50, 300}) {
    Joiner joiner(frame);
    joiner.hear_piece(joiner.size(), {});
    EXPECT_EQ(joiner.session.stats().refused, 1u) << "all of it is here";
    EXPECT_EQ(joiner.restores(false), 1);
    joiner.hear_piece(joiner.size(), {});
    EXPECT_EQ(joiner.session.stats().refused, 2u) << "the game is to become it";
    EXPECT_EQ(joiner.restores(true), 1) << "the caller forgot the first";
    joiner.hear_piece(joiner.size(), {});
    EXPECT_EQ(joiner.session.stats().refused, 3u) << "the game has become it";
    EXPECT_EQ(joiner.restores(true), 0);
    EXPECT_EQ(joiner.game.hash(), joiner.hash);
    EXPECT_EQ(joiner.session.current(), frame);
  }
}

TEST(HostileHost, WhoIsRefusedDoesNotBecomeTheStateThatHasArrived) {
  for (const Frame frame : {1, 50, 300}) {
    Joiner joiner(frame);
    Buffer refusal;
    write_refusal({"kicked", {}, "away"}, refusal);
    joiner.hear(refusal);
    for (int n = 0; n < 3; ++n) EXPECT_EQ(joiner.restores(true), 0);
    EXPECT_EQ(joiner.session.phase(), SessionPhase::refused);
    EXPECT_EQ(joiner.session.current(), 0);
    EXPECT_EQ(joiner.game.hash(), Game{}.hash());
  }
}

TEST(HostileHost, PromisesOfSizeCostNoMemory) {
  Victim victim;
  Welcome welcome = Victim::first_welcome();
  welcome.opens = kNoFrame;
  for (const std::uint32_t size : {1u, 16u << 20, 64u << 20}) {
    welcome.snapshot_size = size;
    for (int n = 0; n < 10; ++n) {
      victim.now += 10 * kMs;
      victim.hear_welcome(welcome);
    }
    EXPECT_LT(victim.session.portable().capacity(), 100000u);
    EXPECT_EQ(victim.session.phase(), SessionPhase::joining);
  }
  welcome.snapshot_size = (64u << 20) + 1;
  victim.hear_welcome(welcome);
  EXPECT_EQ(victim.session.phase(), SessionPhase::refused);
}

TEST(HostileHost, PiecesOutOfOrderOverlappingOrTooManyAreRefused) {
  Victim victim;
  Welcome welcome = Victim::first_welcome();
  welcome.start = {50, 3};
  welcome.snapshot_size = 100;
  const Buffer content(60, 7);
  victim.hear_piece(0, content);
  EXPECT_EQ(victim.session.stats().refused, 1u) << "none was promised";
  victim.hear_welcome(welcome);
  victim.hear_piece(60, content);
  victim.hear_piece(1, content);
  EXPECT_TRUE(victim.session.portable().empty());
  victim.hear_piece(0, content);
  victim.hear_piece(0, content);
  victim.hear_piece(30, content);
  victim.hear_piece(60, content);
  victim.hear_piece(0xffffffffu, content);
  EXPECT_EQ(victim.session.portable().size(), 60u);
  EXPECT_EQ(victim.session.stats().refused, 7u);
  for (int n = 0; n < 100; ++n) victim.hear_piece(60, {});
  EXPECT_EQ(victim.session.phase(), SessionPhase::joining);
  victim.hear_piece(60, Bytes(content).first(40));
  victim.hear_piece(100, {});
  victim.turn();  // a state that the game refuses
  EXPECT_EQ(victim.session.phase(), SessionPhase::refused);
  EXPECT_EQ(victim.session.current(), 50);
}

TEST(HostileHost, AStateThatIsNotTheOneWhoseHashWasNamedIsRefused) {
  Victim victim;
  Game other;
  Buffer state;
  Writer writer(state);
  other.write_portable(writer);
  Welcome welcome = Victim::first_welcome();
  welcome.start = {50, 3};
  welcome.hash = other.hash() ^ 1;
  welcome.opens = kNoFrame;
  welcome.snapshot_size = static_cast<std::uint32_t>(state.size());
  victim.hear_welcome(welcome);
  for (std::size_t at = 0; at < state.size(); at += 10000) {
    victim.hear_piece(static_cast<std::uint32_t>(at),
                      Bytes(state).subspan(at, std::min<std::size_t>(10000, state.size() - at)));
  }
  victim.turn();
  EXPECT_EQ(victim.session.phase(), SessionPhase::refused);
  bool told = false;
  while (const auto event = victim.session.poll_event()) told = told || event->kind == Kind::bad_snapshot;
  EXPECT_TRUE(told);

  // The same session may try again: it asks for a state, for it has none of the match any more.
  victim.session.connected(0, victim.now);
  std::optional<Hello> hello;
  while (const auto out = victim.session.poll_send(victim.now)) {
    if (out->channel == Channel::reliable && !out->bytes.empty()) hello = read_hello(out->bytes).value();
  }
  ASSERT_TRUE(hello.has_value());
  EXPECT_EQ(hello->have.frame, 0);
  EXPECT_EQ(hello->have.chain, 0u);
  welcome.hash = other.hash();
  victim.hear_welcome(welcome);
  for (std::size_t at = 0; at < state.size(); at += 10000) {
    victim.hear_piece(static_cast<std::uint32_t>(at),
                      Bytes(state).subspan(at, std::min<std::size_t>(10000, state.size() - at)));
  }
  victim.turn();
  EXPECT_EQ(victim.session.phase(), SessionPhase::joining);
  EXPECT_EQ(victim.session.confirmed(), 50);
}

TEST(HostileHost, ASpectatorIsNeverSeated) {
  for (const Frame opens : {kNoFrame, 0, 5, kLastFrame}) {
    for (const std::uint8_t player :
         {std::uint8_t{0}, std::uint8_t{2}, std::uint8_t{3}, std::uint8_t{0xfe}, std::uint8_t{0xff}}) {
      Victim victim(SessionMode::spectator);
      Welcome welcome = Victim::first_welcome();
      welcome.player = player;
      welcome.opens = opens;
      victim.hear_welcome(welcome);
      Buffer open;
      write_open(3, open);
      victim.hear(open);
      victim.turn();
      victim.hear(open);
      victim.turn();
      EXPECT_FALSE(victim.session.wants_input(0) || victim.session.wants_input(1) || victim.session.wants_input(2));
    }
  }
}

TEST(HostileHost, OpeningsThatMakeNoSenseAreRefused) {
  const Frame last = SessionConfig{}.history / 2;
  for (const Frame first : {Frame{-1}, last + 1, Frame{100000}, kLastFrame, kLastFrame + 1, Frame{0x7fffffff}}) {
    Victim victim;
    Welcome welcome = Victim::first_welcome();
    welcome.opens = kNoFrame;
    victim.hear_welcome(welcome);
    victim.turn();
    const std::uint64_t before = victim.session.stats().refused;
    Buffer open;
    write_open(first, open);
    victim.hear(open);
    EXPECT_EQ(victim.session.stats().refused, before + 1) << first;
    EXPECT_FALSE(victim.session.wants_input(1));
    write_open(last, open);
    victim.hear(open);
    EXPECT_TRUE(victim.session.wants_input(1));
    victim.hear(open);
    EXPECT_EQ(victim.session.stats().refused, before + 2) << "opened twice";
  }
}

TEST(HostileHost, AnythingAtAllInAnyOrderBreaksNothing) {
  Pcg32 random = Pcg32::seeded(11);
  for (int run = 0; run < 60; ++run) {
    Victim victim(run % 3 == 0 ? SessionMode::spectator : SessionMode::rollback);
    InputStream stream(400, 2);
    const auto frame = [&]() -> Frame {
      const Frame near = victim.session.current() + static_cast<Frame>(random.next() % 80) - 40;
      const Frame odd[] = {0, 1, 600, 1200, kLastFrame - 1, kLastFrame};
      return random.next() % 4 == 0 ? odd[random.next() % 6] : near < 0 ? 0 : near;
    };
    for (int step = 0; step < 400; ++step) {
      Buffer bytes;
      switch (random.next() % 8) {
        case 0: {
          Welcome welcome = Victim::first_welcome();
          if (random.next() % 2 == 0) welcome.start = {frame(), random.next()};
          welcome.player = random.next() % 3 == 0 ? 0xff : static_cast<std::uint8_t>(random.next() % 4);
          welcome.opens = random.next() % 2 == 0 ? kNoFrame : frame();
          welcome.snapshot_size = random.next() % 3 == 0 ? 10 : 0;
          if (step % 50 == 0) victim.hear_welcome(welcome);
          break;
        }
        case 1: {
          write_open(frame(), bytes);
          victim.hear(bytes);
          break;
        }
        case 2: {
          const Buffer piece(random.next() % 12);
          victim.hear_piece(random.next() % 12, piece);
          break;
        }
        case 3:
          if (step % 60 == 0) victim.session.disconnected(0, victim.now);
          if (step % 40 == 0) victim.session.connected(0, victim.now);
          break;
        case 4: {
          Welcome fine = Victim::first_welcome();
          if (victim.session.phase() != SessionPhase::playing) victim.hear_welcome(fine);
          break;
        }
        default: {
          const Frame first = frame();
          stream.reset(first);
          for (std::uint32_t n = random.next() % 100; n > 0; --n) {
            const std::uint8_t input[2] = {static_cast<std::uint8_t>(random.next() % 3), 0};
            if (random.next() % 10 == 0) {
              stream.append({true, {}});
            } else {
              stream.append({false, input});
            }
          }
          PacketHeader header;
          header.match = 9;
          header.started = random.next() % 2 == 0;
          header.frame = frame();
          header.report = {random.next() % 2 == 0 ? kNoFrame : frame(), random.next() % 5};
          header.ack_mask = static_cast<std::uint8_t>(random.next());
          for (Frame& ack : header.ack) ack = frame();
          for (std::int8_t& slack : header.slack) slack = static_cast<std::int8_t>(random.next());
          header.reporter = static_cast<std::uint8_t>(random.next() % 9);
          header.passed_on = {frame(), random.next() % 5};
          std::uint8_t buffer[kDatagramCap];
          PacketWriter writer(header, buffer);
          for (std::uint8_t p = 0; p < 4; ++p) writer.add_slice(p, stream, first);
          victim.hear(Buffer(writer.bytes().begin(), writer.bytes().end()), Channel::datagram);
          break;
        }
      }
      const Frame confirmed = victim.session.confirmed();
      victim.turn();
      while (victim.session.poll_event()) {}
      ASSERT_GE(victim.session.confirmed(), std::min(confirmed, victim.session.current()));
      ASSERT_LE(victim.session.current(), kLastFrame);
      if (random.next() % 30 == 0) victim.now += 20 * kMs * (random.next() % 10);
    }
  }
}

}  // namespace session_host_test
}  // namespace isostep::hostile
