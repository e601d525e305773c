// Datagrams that are old, of another match, or claim what cannot be: pace and round trip stay what they were.
// SPDX-License-Identifier: MIT
#include <cstdlib>
#include <deque>

#include "session/altered_packet.hpp"
#include "session/pace_watch.hpp"

namespace isostep::test {
namespace forged_test {

constexpr const char* kGoodLine = "latency=30,jitter=5,loss=0.5";
constexpr auto kNoInput = [](int, Frame, std::vector<std::uint8_t>&) {};
using Datagram = std::vector<std::uint8_t>;

/// The step of one client: by how much it is before the host at most, and how far away it takes it to be.
struct Step {
  Frame most_ahead = -1000;
  Time round_trip = 0;  // [us] on average
};
template <class EachTick> Step watch_step(ToyMatch& match, Time time, EachTick&& each_tick) {
  Step step;
  Time sum = 0, ticks = 0;
  match.run(time, [&] {
    each_tick();
    const Session<Toy>& client = match.machine(1).session;
    step.most_ahead = std::max(step.most_ahead, client.current() - match.host().session.current());
    sum += client.stats().round_trip;
    ++ticks;
    return false;
  });
  step.round_trip = sum / ticks;
  return step;
}
constexpr auto kNothing = [] {};
void expect_same_round_trip(Time now, Time before) {
  EXPECT_LE(now * 10, before * 11);
  EXPECT_GE(now * 10, before * 9);
}

class Forged : public testing::TestWithParam<SessionMode> {};
INSTANTIATE_TEST_SUITE_P(Modes, Forged, testing::Values(SessionMode::lockstep, SessionMode::rollback));

TEST_P(Forged, OneFrameFarAheadOrFarBehindDoesNotMoveAClient) {
  for (const Frame forged : {kLastFrame - 1, Frame{0}, Frame{5000}}) {
    SCOPED_TRACE(forged);
    ToyMatch match(config_of(4, GetParam()), kGoodLine);
    match.pass(20 * kSecond);
    const Time before = watch_step(match, 10 * kSecond, kNothing).round_trip;
    int left = 1;
    match.machine(1).middle = [&](Channel channel, Datagram& bytes) {
      if (channel == Channel::datagram && left-- > 0) {
        alter_packet(
            bytes, [&](PacketHeader& header) { header.frame = forged; }, kNoInput);
      }
    };
    match.pass(kSecond);
    ASSERT_LT(left, 0);
    const Step after = watch_step(match, 30 * kSecond, kNothing);
    EXPECT_LE(after.most_ahead, 1) << "16 to 24 for the rest of the match";
    expect_same_round_trip(after.round_trip, before);
    expect_one_history(match);
  }
}

TEST_P(Forged, ThreeOfTenDatagramsAreForgivenToo) {
  ToyMatch match(config_of(4, GetParam()), kGoodLine);
  match.pass(20 * kSecond);
  int count = 0;
  match.machine(1).middle = [&](Channel channel, Datagram& bytes) {
    if (channel != Channel::datagram || ++count % 10 > 2) return;
    alter_packet(
        bytes, [&](PacketHeader& header) { header.frame = kLastFrame - 1; }, kNoInput);
  };
  match.pass(kSecond);
  EXPECT_LE(watch_step(match, 10 * kSecond, kNothing).most_ahead, 1);
  expect_one_history(match);
}

TEST_P(Forged, DatagramsOfAnotherMatchAreRefused) {
  std::vector<Datagram> recorded;
  {
    ToyMatch earlier(config_of(4, GetParam()), kGoodLine, 7);
    earlier.machine(1).middle = [&](Channel channel, Datagram& bytes) {
      if (channel == Channel::datagram) recorded.push_back(bytes);
    };
    earlier.pass(60 * kSecond);
  }
  ToyMatch match(config_of(4, GetParam()), kGoodLine, 8);
  match.pass(20 * kSecond);
  const Time before = watch_step(match, 10 * kSecond, kNothing).round_trip;
  const std::uint64_t refused = match.machine(1).session.stats().refused;
  std::uint64_t injected = 0;
  const Step step = watch_step(match, 20 * kSecond, [&] {
    if (match.now() % (kSecond / 10) != 0) return;
    const Datagram& old = recorded[recorded.size() - 1 - injected++];
    match.network().inject(match.machine(1).endpoint, 0, Channel::datagram, old);
  });
  match.pass(kSecond / 10);
  EXPECT_EQ(match.machine(1).session.stats().refused - refused, injected);
  EXPECT_LE(step.most_ahead, 1);
  expect_same_round_trip(step.round_trip, before);
  expect_one_history(match);
}

TEST_P(Forged, TenOldDatagramsASecondLeaveTheRoundTripAsItIsOnBothSides) {
  ToyMatch match(config_of(2, GetParam()), kGoodLine);
  std::deque<Datagram> heard[2];
  bool injects = false;
  for (const std::size_t i : {0, 1}) {
    match.machine(i).middle = [&heard, &injects, i](Channel channel, Datagram& bytes) {
      if (channel == Channel::datagram && !injects) heard[i].push_back(bytes);
    };
  }
  match.pass(20 * kSecond);
  const Time before = watch_step(match, 10 * kSecond, kNothing).round_trip;
  const Time hosts = match.host().session.stats().round_trip;
  injects = true;
  const Step step = watch_step(match, 20 * kSecond, [&] {
    if (match.now() % (kSecond / 10) != 0) return;
    for (const std::size_t i : {0, 1}) {
      match.network().inject(match.machine(i).endpoint, 0, Channel::datagram, heard[i].back());
      heard[i].pop_back();
    }
  });
  EXPECT_LE(step.most_ahead, 1);
  expect_same_round_trip(step.round_trip, before);
  expect_same_round_trip(match.host().session.stats().round_trip, hosts);
  expect_one_history(match);
}

TEST_P(Forged, AHashOfAFrameThatNeverComesKeepsNoDesyncFromBeingSeen) {
  ToyMatch match(config_of(2, GetParam()), kGoodLine);
  match.pass(10 * kSecond);
  int left = 1;
  match.machine(1).middle = [&](Channel channel, Datagram& bytes) {
    if (channel == Channel::datagram && left-- > 0) {
      alter_packet(
          bytes,
          [&](PacketHeader& header) {
            header.report = {kLastFrame, 1};
          },
          kNoInput);
    }
  };
  match.pass(kSecond);
  match.host().tamper = [](Toy& toy, Frame frame) {
    if (frame == 900) toy.state.places[0] ^= 1u;
  };
  match.pass(10 * kSecond);
  EXPECT_TRUE(match.machine(1).heard(SessionEvent::Kind::desync));
}

}  // namespace forged_test
}  // namespace isostep::test
