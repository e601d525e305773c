// The cost of a seal, beside what the system takes to send and receive the same bytes on this machine.
// SPDX-License-Identifier: MIT
#include <arpa/inet.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <span>
#include <stdexcept>
#include <vector>

#include "parts.hpp"
#include "scene_bench/clock.hpp"
#include "sealed/sealed_link.hpp"

namespace isostep::bench {
namespace {

using sealed::LobbyKey;
using sealed::Opened;
using sealed::SealedLink;

constexpr int kItems = 2000;

void require(bool condition, const char* what) {
  if (!condition) throw std::runtime_error(what);
}

/// A UDP socket that sends to itself.
class Loop {
 public:
  Loop() : descriptor_(::socket(AF_INET, SOCK_DGRAM, 0)) {
    sockaddr_in address = {};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    socklen_t size = sizeof address;
    auto* generic = reinterpret_cast<sockaddr*>(&address);
    require(::bind(descriptor_, generic, size) == 0 && ::getsockname(descriptor_, generic, &size) == 0 &&
                ::connect(descriptor_, generic, size) == 0,
            "no UDP socket on 127.0.0.1");
  }
  Loop(const Loop&) = delete;
  Loop& operator=(const Loop&) = delete;
  ~Loop() { ::close(descriptor_); }
  void pass(std::span<std::uint8_t> bytes) {
    const auto size = static_cast<ssize_t>(bytes.size());
    require(::send(descriptor_, bytes.data(), bytes.size(), 0) == size, "nothing is sent");
    require(::recv(descriptor_, bytes.data(), bytes.size(), 0) == size, "nothing is received");
  }

 private:
  int descriptor_;
};

struct Ends {
  SealedLink client, host;
  Ends() {
    const LobbyKey key{.id = 1};
    std::uint8_t hello[SealedLink::kHello], reply[SealedLink::kReply], confirm[SealedLink::kSeal];
    require(client.begin(key, hello) && host.answer(key, hello, reply) && client.take_reply(key, reply) &&
                client.seal(Channel::reliable, {}, confirm) && host.take_confirm(confirm),
            "no handshake");
  }
};

/// [ns] The cost of one item, the least of the repeats.
template <class Work> double least_ns(int repeats, int items, Work&& work) {
  double least = 1e300;
  for (int repeat = 0; repeat < repeats; ++repeat) {
    const double start = thread_milliseconds();
    for (int i = 0; i < items; ++i) work();
    least = std::min(least, 1e6 * (thread_milliseconds() - start) / items);
  }
  return least;
}

void report(int repeats, Channel channel, std::size_t size) {
  Ends ends;
  Loop loop;
  std::vector<std::uint8_t> said(size, 1), sealed(size + SealedLink::kSeal), heard(sealed.size());
  const double seal = least_ns(repeats, kItems, [&] { ends.client.seal(channel, said, sealed.data()); });
  // It is sealed anew, for what was opened once is refused.
  const double both = least_ns(repeats, kItems, [&] {
    ends.host.seal(channel, said, sealed.data());
    require(ends.client.open(channel, sealed, heard.data()) == Opened::good, "a seal does not open");
  });
  sealed.back() ^= 1;
  sealed[3] = 1;  // a count that has not come
  const double forged = least_ns(repeats, kItems, [&] {
    require(ends.client.open(channel, sealed, heard.data()) != Opened::good, "a forgery opens");
  });
  const double system = least_ns(repeats, kItems, [&] { loop.pass(said); });
  std::printf("| %s of %zu | %.0f | %.0f | %.0f | %.0f | %.2f |\n",
              channel == Channel::datagram ? "datagram" : "message", size, seal, both - seal, forged, system,
              both / system);
  std::fflush(stdout);
}

}  // namespace

void report_sealing(const SessionBenchOptions& options) {
  std::printf(
      "\nSealing, ns; both ends' work beside a send and a receive by the system on one machine:\n\n"
      "| bytes | seal | open | refuse a forgery | send and receive | ratio |\n|---|---|---|---|---|---|\n");
  for (const std::size_t size : {std::size_t{40}, std::size_t{200}, kDatagramCap}) {
    report(options.repeats, Channel::datagram, size);
  }
  report(options.repeats, Channel::reliable, kReliableCap);
  const double handshake = least_ns(options.repeats, 20, [] { const Ends ends; });
  std::printf("\nA handshake takes both ends together %.0f us, %zu bytes.\n", handshake / 1000,
              SealedLink::kHello + SealedLink::kReply + SealedLink::kSeal);
}

}  // namespace isostep::bench
