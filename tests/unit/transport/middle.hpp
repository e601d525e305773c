// A machine on the line between one client and its host: hears all, and says what it likes in the name of either.
// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <vector>

#include "unit/transport/udp.hpp"

namespace isostep::transport {

/// The client connects to `port()`. What is injected comes from the address that the other side knows as its peer's, so
/// it is worth as much as a packet with a forged sender, without rights of the system.
class Middle {
 public:
  using Bytevec = std::vector<std::uint8_t>;

  explicit Middle(std::uint16_t host) : host_(host) {}
  std::uint16_t port() const { return front_.port(); }

  void turn() {
    while (const auto got = front_.receive()) {
      client_ = got->from;
      up.push_back(got->bytes);
      if (is_whole) back_.send(host_, got->bytes);
    }
    while (const auto got = back_.receive()) {
      down.push_back(got->bytes);
      if (is_whole && client_ != 0) front_.send(client_, got->bytes);
    }
  }
  void say_to_host(const Bytevec& bytes) const { back_.send(host_, bytes); }
  void say_to_client(const Bytevec& bytes) const { front_.send(client_, bytes); }

  std::vector<Bytevec> up, down;  // what went over it
  bool is_whole = true;           // passes on what it hears

 private:
  UdpSocket front_, back_;
  std::uint16_t host_, client_ = 0;
};

}  // namespace isostep::transport
