// Memory: sealing, opening and refusing ask for none.
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cstdlib>
#include <new>
#include <vector>

#include "sealed/sealed_transport.hpp"

static bool counting = false;
static std::size_t allocations = 0;

// These are not inlined: gcc would take one half of a pair for a mismatch with the other.
#define NOT_INLINED __attribute__((noinline))
NOT_INLINED void* operator new(std::size_t size) {
  if (counting) ++allocations;
  void* memory = std::malloc(size == 0 ? 1 : size);
  if (memory == nullptr) std::abort();
  return memory;
}
NOT_INLINED void operator delete(void* memory) noexcept { std::free(memory); }
NOT_INLINED void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }

namespace isostep::sealed {
namespace sealed_memory_test {

using transport::Arrival;
using transport::ArrivalKind;

/// A line that keeps what was sent in memory that it has from the start.
struct Line {
  struct Said {
    ArrivalKind kind;
    Channel channel;
    std::size_t size;
    std::uint8_t bytes[transport::cap_of(Channel::reliable)];
  };
  Line* other = nullptr;
  bool incoming = false;
  std::vector<Said> ring = std::vector<Said>(8);
  std::size_t first = 0, last = 0;
  Said shown;

  void say(ArrivalKind kind, Channel channel, Bytes bytes) {
    Said& said = ring[last++ % ring.size()];
    said.kind = kind;
    said.channel = channel;
    said.size = bytes.size();
    std::copy(bytes.begin(), bytes.end(), said.bytes);
  }
  Result<void> send(PeerId, Channel channel, Bytes bytes) {
    other->say(ArrivalKind::message, channel, bytes);
    return {};
  }
  std::optional<Arrival> receive() {
    if (first == last) return std::nullopt;
    shown = ring[first++ % ring.size()];
    return Arrival{shown.kind, 0, shown.channel, {shown.bytes, shown.size}, incoming};
  }
  void disconnect(PeerId) {}
};

TEST(SealedMemory, IsNotNeededForWhatIsSealedOpenedAndRefused) {
  SealSettings settings{.keys = {{.id = 1, .secret = {}}}, .own_key = 1};
  Line lines[2];
  lines[0].other = &lines[1];
  lines[1].other = &lines[0];
  lines[1].incoming = true;
  SealedTransport<Line> client(lines[0], settings), host(lines[1], settings);
  for (Line& line : lines) line.say(ArrivalKind::connected, Channel::reliable, {});
  const std::vector<std::uint8_t> said(kReliableCap, 1);
  std::size_t heard = 0;
  const auto turn = [&](SealedTransport<Line>& side) {
    side.tend(1);
    while (const std::optional<Arrival> arrival = side.receive()) heard += arrival->bytes.size();
  };
  for (int i = 0; i < 3; ++i) {
    turn(client);
    turn(host);
  }
  ASSERT_TRUE(client.key_of(0) && host.key_of(0));
  counting = true;
  for (int i = 0; i < 100; ++i) {
    for (SealedTransport<Line>* side : {&client, &host}) {
      EXPECT_TRUE(side->send(0, Channel::datagram, Bytes(said).first(kDatagramCap)).ok());
      EXPECT_TRUE(side->send(0, Channel::reliable, said).ok());
    }
    for (Line& line : lines) line.say(ArrivalKind::message, Channel::datagram, Bytes(said).first(64));
    turn(client);
    turn(host);
  }
  counting = false;
  EXPECT_EQ(allocations, 0u);
  EXPECT_EQ(heard, 200 * (kDatagramCap + kReliableCap));
  EXPECT_EQ(host.statistics().forged + client.statistics().forged, 200u);
}

}  // namespace sealed_memory_test
}  // namespace isostep::sealed
