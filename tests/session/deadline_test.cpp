// A deadline for inputs: who waits to see what the others do, answers no better than who guesses.
// SPDX-License-Identifier: MIT
#include <map>

#include "session/altered_packet.hpp"
#include "session/pace_watch.hpp"

namespace isostep::test {
namespace deadline_test {

constexpr const char* kGoodLine = "latency=30,jitter=5,loss=0.5";
constexpr Time kMs = 1000;  // [us]
constexpr std::size_t kMachines = 3, kCheat = 2;

/// Paper, rock or scissors, a new one in every frame.
int hand(int player, Frame frame) {
  Pcg32 random = Pcg32::seeded(static_cast<std::uint64_t>(frame) * 8 + static_cast<std::uint64_t>(player));
  return static_cast<int>(random.next() % 3);
}
constexpr std::size_t kHand = 0;  // byte of an input
int answer_to(int other) { return (other + 1) % 3; }

/// One past the last frame of which the datagram tells an input.
Frame end_of_inputs(const std::vector<std::uint8_t>& bytes) {
  const Result<Packet> read = read_packet(bytes);
  Frame end = 0;
  for (std::uint8_t i = 0; read && i < read.value().slice_count; ++i) {
    end = std::max(end, read.value().slices[i].first + read.value().slices[i].count);
  }
  return end;
}

/// One machine sends its input of a frame when it knows that of the host, and beats it.
struct Cheat {
  explicit Cheat(VirtualMatch<Toy>& match) : machine(match.machine(kCheat)) {
    machine.middle = [this](Channel channel, std::vector<std::uint8_t>& bytes) {
      if (channel == Channel::datagram) look(bytes);
    };
    machine.outgoing = [this](Channel channel, std::vector<std::uint8_t>& bytes) {
      if (channel == Channel::datagram) answer(bytes);
    };
  }
  void look(std::vector<std::uint8_t> bytes) {
    alter_packet(
        bytes, [](PacketHeader&) {},
        [&](int player, Frame frame, std::vector<std::uint8_t>& input) {
          if (player == 0) seen[frame] = static_cast<int>(input[kHand]);
        });
  }
  void answer(std::vector<std::uint8_t>& bytes) {
    const std::vector<std::uint8_t> original = bytes;
    const Result<Packet> read = read_packet(original);
    if (!read || read.value().slice_count != 1) return;
    const InputSlice& slice = read.value().slices[0];
    std::uint8_t buffer[kDatagramCap];
    PacketWriter writer(read.value().header, buffer);
    InputStream stream(kSliceFrames, kInputCap);
    stream.reset(slice.first);
    SliceReader reader(slice);
    InputEntry entry;
    for (Frame frame = slice.first; reader.next(entry); ++frame) {
      if (seen.find(frame) == seen.end()) break;
      std::vector<std::uint8_t> input(entry.bytes.begin(), entry.bytes.end());
      if (!input.empty()) input[kHand] = static_cast<std::uint8_t>(answer_to(seen[frame]));
      stream.append({entry.absent, input});
    }
    writer.add_slice(slice.player, stream, slice.first);
    bytes.assign(writer.bytes().begin(), writer.bytes().end());
  }
  Machine<Toy>& machine;
  std::map<Frame, int> seen;
};

class Deadline : public testing::TestWithParam<SessionMode> {
 protected:
  SessionConfig config_of(Frame deadline) const {
    SessionConfig config = test::config_of(kMachines, GetParam());
    config.deadline = deadline;
    return config;
  }
  static Bot<Toy> bot() {
    return [](int player, Frame frame) { return ToyInput{static_cast<std::int8_t>(hand(player, frame)), 0, 0}; };
  }
};
INSTANTIATE_TEST_SUITE_P(Modes, Deadline, testing::Values(SessionMode::lockstep, SessionMode::rollback));

struct HandMatch : VirtualMatch<Toy> {
  HandMatch(const SessionConfig& config, std::string_view line, Bot<Toy> bot)
      : VirtualMatch(
            config, [] { return std::make_unique<Toy>(); }, std::move(bot)) {
    for (std::size_t i = 1; i < kMachines; ++i) add(profile(line));
  }
  void pass(Time time) {
    run(time, [] { return false; });
  }
  /// [%] The frames in which the player beat the host's inputs, of those from `first` on in which it played.
  int beaten(int player, Frame first) {
    Frame played = 0, beat = 0;
    for (Frame frame = first; frame < host().end(); ++frame) {
      const auto& said = host().at(frame);
      const auto& own = said[static_cast<std::size_t>(player)];
      if (own.absent) continue;
      ++played;
      beat += own.input.push == answer_to(said[0].input.push) ? 1 : 0;
    }
    EXPECT_GT(played, 200);
    return static_cast<int>(beat * 100 / (played > 0 ? played : 1));
  }
};

TEST_P(Deadline, WhoWaitsToSeeTheHostsInputGainsNothing) {
  for (const Frame deadline : {0, 4, 8}) {
    SCOPED_TRACE(deadline);
    HandMatch match(config_of(deadline), kGoodLine, bot());
    match.pass(10 * kSecond);
    const int seat = match.machine(kCheat).seat;
    const Frame first = match.host().end();
    const Cheat cheat(match);
    match.pass(20 * kSecond);
    if (deadline == 0) EXPECT_GE(match.beaten(seat, first), 90) << "the cheat does not cheat";
    else EXPECT_LE(match.beaten(seat, first), 40) << "a third by guessing";
    EXPECT_EQ(match.host().session.stats().players[seat].replaced > 100, deadline > 0);
    const std::vector<std::uint64_t> straight = match.straight(match.host().end());
    EXPECT_EQ(differences(match.machine(1), match.host(), straight), 0u) << "the honest ones agree on what counted";
  }
}

TEST_P(Deadline, CostsHonestPlayersNoInputAndNoGap) {
  for (const Frame deadline : {0, 4, 8}) {
    SCOPED_TRACE(deadline);
    HandMatch match(config_of(deadline), kGoodLine, bot());
    match.pass(10 * kSecond);
    PaceWatch<Toy> watch(match);
    const auto replaced = [&] {
      std::uint64_t sum = 0;
      for (const PlayerStats& player : match.host().session.stats().players) sum += player.replaced;
      return sum;
    };
    const std::uint64_t before = replaced();
    watch.watch(60 * kSecond);
    for (std::size_t i = 0; i < kMachines; ++i) {
      EXPECT_EQ(watch[i].gaps(50 * kMs), 0u) << i << ": " << watch[i].worst();
      EXPECT_GE(watch.hundred_seconds(i), 5950) << i;
      EXPECT_LE(watch[i].most_delay, GetParam() == SessionMode::lockstep ? 8 : 3) << i << ", 6 and 2 without";
      for (std::size_t depth = 6; depth <= 64; ++depth)
        EXPECT_EQ(match.machine(i).session.stats().rollbacks[depth], 0u);
    }
    EXPECT_EQ(replaced(), before);
    expect_one_history(match);
  }
}

// A late input is not waited for, and its player plays on with what was put in its place.
TEST_P(Deadline, ReplacesInputsOfABadLineAndKeepsOneHistory) {
  for (const char* line : {"mobile", "wifi", "latency=60,jitter=50,loss=10"}) {
    SCOPED_TRACE(line);
    HandMatch match(config_of(2), kGoodLine, bot());
    match.pass(10 * kSecond);
    match.network().set_profile(match.machine(kCheat).endpoint, profile(line));
    match.pass(30 * kSecond);
    const int seat = match.machine(kCheat).seat;
    EXPECT_GT(match.host().session.stats().players[seat].replaced, 0u);
    EXPECT_EQ(match.host().count(SessionEvent::Kind::left), 0);
    expect_one_history(match);
  }
}

// Its delay is too short for its line: all of its inputs are late, and none by the deadline.
TEST(DeadlineOfShortDelays, WhoIsAlwaysALittleLateStillPlays) {
  SessionConfig config = config_of(kMachines, SessionMode::rollback);
  config.deadline = 8;
  config.delay = config.least_delay = config.most_delay = 1;
  HandMatch match(config, "latency=60,jitter=10", [](int player, Frame frame) {
    return ToyInput{static_cast<std::int8_t>(hand(player, frame)), 0, 0};
  });
  match.pass(10 * kSecond);
  const int seat = match.machine(kCheat).seat;
  const auto replaced = [&] { return match.host().session.stats().players[seat].replaced; };
  match.network().set_silent(match.machine(kCheat).endpoint, true);
  const std::uint64_t at_first = replaced();
  match.pass(kSecond);
  match.network().set_silent(match.machine(kCheat).endpoint, false);
  match.pass(3 * kSecond);
  EXPECT_GT(replaced(), at_first + 30) << "it was late";
  const std::uint64_t before = replaced();
  match.pass(10 * kSecond);
  EXPECT_LE(replaced(), before + 6) << "of 600";
  expect_one_history(match, true);
}

TEST_P(Deadline, WhoFallsSilentHoldsNobodyUp) {
  HandMatch match(config_of(4), kGoodLine, bot());
  match.pass(10 * kSecond);
  match.network().set_silent(match.machine(kCheat).endpoint, true);
  PaceWatch<Toy> watch(match);
  watch.watch(3 * kSecond);
  for (std::size_t i = 0; i < kCheat; ++i) EXPECT_LE(watch[i].worst(), 120 * kMs) << i;
  match.network().set_silent(match.machine(kCheat).endpoint, false);
  match.pass(10 * kSecond);
  EXPECT_EQ(match.host().count(SessionEvent::Kind::left), 0);
  EXPECT_EQ(match.machine(kCheat).session.phase(), SessionPhase::playing);
  expect_one_history(match, true);
}

// All hear of whom an input is replaced, and of many in a second once.
TEST_P(Deadline, AllHearOfWhomInputsAreReplaced) {
  HandMatch match(config_of(8), kGoodLine, bot());
  match.pass(10 * kSecond);
  const int seat = match.machine(kCheat).seat;
  for (const Time outage : {0u, 1u, 2u}) {
    int told[kMachines];
    for (std::size_t i = 0; i < kMachines; ++i) told[i] = match.machine(i).count(SessionEvent::Kind::replaced, seat);
    const std::uint32_t before = match.host().session.stats().players[seat].replaced;
    match.network().set_silent(match.machine(kCheat).endpoint, true);
    match.pass(kSecond + outage * kSecond / 2);
    match.network().set_silent(match.machine(kCheat).endpoint, false);
    match.pass(4 * kSecond);
    ASSERT_GT(match.host().session.stats().players[seat].replaced, before);
    for (std::size_t i = 0; i < kMachines; ++i) {
      const int count = match.machine(i).count(SessionEvent::Kind::replaced, seat) - told[i];
      EXPECT_GE(count, 1) << i;
      EXPECT_LE(count, 3) << i;
      EXPECT_EQ(match.machine(i).count(SessionEvent::Kind::replaced),
                match.machine(i).count(SessionEvent::Kind::replaced, seat));
    }
  }
  expect_one_history(match, true);
}

TEST_P(Deadline, WhoCannotBeInTimeWatchesAndComesBackOnABetterLine) {
  SessionConfig config = config_of(8);
  config.exclusion = 5 * kSecond;
  config.delay = config.least_delay = config.most_delay = 4;  // does not adapt
  HandMatch match(config, "latency=5", bot());
  match.pass(10 * kSecond);
  const int seat = match.machine(kCheat).seat;
  match.network().set_profile(match.machine(kCheat).endpoint, profile("latency=120"));
  match.pass(10 * kSecond);
  for (const std::size_t i : {std::size_t{0}, kCheat})
    EXPECT_TRUE(match.machine(i).heard(SessionEvent::Kind::too_far, seat) ||
                match.machine(i).heard(SessionEvent::Kind::replaced, seat))
        << i;
  EXPECT_EQ(match.host().count(SessionEvent::Kind::left, seat), 1);
  EXPECT_EQ(match.machine(kCheat).session.phase(), SessionPhase::watching);
  const std::uint32_t lost = match.host().session.stats().players[seat].replaced;
  match.pass(4 * kSecond);
  EXPECT_EQ(match.host().session.stats().players[seat].replaced, lost);
  match.network().set_profile(match.machine(kCheat).endpoint, profile("latency=5"));
  match.pass(15 * kSecond);
  EXPECT_EQ(match.machine(kCheat).session.phase(), SessionPhase::playing);
  expect_one_history(match, true);
}

// A friend who watches is shown a frame when all inputs of it are there, or the cheat would ask the friend.
TEST(DeadlineOfSpectators, NoInputIsShownBeforeAllAreThere) {
  for (const Frame deadline : {0, 8}) {
    SCOPED_TRACE(deadline);
    SessionConfig config = config_of(kMachines, SessionMode::rollback);
    config.deadline = deadline;
    config.delay = config.least_delay = config.most_delay = 6;  // of the host: what it does is known early
    VirtualMatch<Toy> match(
        config, [] { return std::make_unique<Toy>(); }, [](int, Frame) { return ToyInput{}; });
    SessionConfig client = config;
    client.local_players = 0;
    client.delay = client.least_delay = client.most_delay = 0;
    Frame sent = 0, shown = 0;
    for (std::size_t i = 1; i < kMachines; ++i) match.add(profile(kGoodLine), client);
    match.machine(1).outgoing = [&](Channel channel, std::vector<std::uint8_t>& bytes) {
      if (channel == Channel::datagram) sent = std::max(sent, end_of_inputs(bytes));
    };
    client.mode = SessionMode::spectator;
    match.add(profile("lan"), client).middle = [&](Channel channel, std::vector<std::uint8_t>& bytes) {
      if (channel == Channel::datagram) shown = std::max(shown, end_of_inputs(bytes));
    };
    bool is_early = false;
    match.run(10 * kSecond, [&] { return is_early = is_early || shown > sent, false; });
    EXPECT_GT(shown, 500);
    EXPECT_EQ(is_early, deadline == 0);
    EXPECT_EQ(match.host().session.stats().players[1].replaced, 0u);
    expect_one_history(match);
  }
}

}  // namespace deadline_test
}  // namespace isostep::test
