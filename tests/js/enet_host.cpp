// The native half of transports_test.mjs: the host of the game over UDP. Its arguments are the number of frames, and
// EnetSettings::key in 32 digits or none.
// SPDX-License-Identifier: MIT
//
// Prints the input's schema and its port, then frame and hash of each final frame up to FRAMES; ends with its input.
#include <poll.h>

#include <charconv>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <string_view>

#include "match/pucks.hpp"
#include "transport/enet_transport.hpp"
#include "transport/pump.hpp"

namespace iso = isostep;
using iso::Q16_16, iso::Q32_32;
using Game = iso::test::Pucks<ISOSTEP_TEST_SCALAR>;

namespace {

struct Printer {
  iso::Frame most;
  void confirmed(iso::Frame frame, std::uint64_t hash) const {
    if (frame < most) std::printf("%d %016llx\n", static_cast<int>(frame), static_cast<unsigned long long>(hash));
    std::fflush(stdout);
  }
};
bool input_has_ended() {
  pollfd input{0, POLLIN, 0};
  return ::poll(&input, 1, 0) > 0;
}
bool read_key(std::string_view digits, iso::transport::PacketKey& key) {
  if (digits.size() != 2 * key.size()) return false;
  for (std::size_t i = 0; i < key.size(); ++i) {
    const char* const at = digits.data() + 2 * i;
    if (std::from_chars(at, at + 2, key[i], 16).ptr != at + 2) return false;
  }
  return true;
}

}  // namespace

int main(int count, char** words) {
  if (count != 2 && count != 3) return 64;
  iso::transport::EnetSettings settings{.timeout = 60 * iso::kSecond};
  if (count == 3 && !read_key(words[2], settings.key)) return 64;
  auto opened = iso::transport::EnetTransport::listen(0, settings);
  if (!opened) return 1;
  iso::transport::EnetTransport& transport = opened.value();
  Game game;
  iso::SessionConfig config = iso::test::host_config_of(game);
  config.silence = config.patience = 60 * iso::kSecond;
  iso::Session<Game> session(config);
  std::printf("%llu %u\n", static_cast<unsigned long long>(iso::InputCodec<iso::test::Push>::schema()),
              transport.port());
  std::fflush(stdout);
  Printer printer{std::atoi(words[1])};
  const auto start = std::chrono::steady_clock::now();
  while (!input_has_ended()) {
    const auto passed = std::chrono::steady_clock::now() - start;
    const auto now = static_cast<iso::Time>(std::chrono::duration_cast<std::chrono::microseconds>(passed).count());
    transport.poll();
    iso::transport::deliver(transport, session, now);
    session.add_local_input(0, iso::test::push_of(session.current(), 0));
    iso::drive(session, game, now, printer);
    iso::transport::dispatch(transport, session, now);
    transport.flush();
    transport.wait(2000);
  }
}
