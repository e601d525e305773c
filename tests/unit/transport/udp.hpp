// A plain UDP socket on 127.0.0.1, for tests that speak to endpoints without being one.
// SPDX-License-Identifier: MIT
#pragma once

#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <chrono>
#include <cstdint>
#include <optional>
#include <vector>

#include "isostep/session/timeline/frame.hpp"

namespace isostep::transport {

/// Ends what would wait for ever, long after any machine that only is busy; tests expect nothing else of time.
class Deadline {
 public:
  Deadline() : end_(std::chrono::steady_clock::now() + std::chrono::minutes(10)) {}
  bool over() const { return std::chrono::steady_clock::now() > end_; }

 private:
  std::chrono::steady_clock::time_point end_;
};

class UdpSocket {
 public:
  UdpSocket() : descriptor_(::socket(AF_INET, SOCK_DGRAM, 0)) {
    sockaddr_in address = at(0);
    socklen_t size = sizeof address;
    EXPECT_EQ(::bind(descriptor_, reinterpret_cast<sockaddr*>(&address), size), 0);
    EXPECT_EQ(::getsockname(descriptor_, reinterpret_cast<sockaddr*>(&address), &size), 0);
    port_ = ntohs(address.sin_port);
  }
  UdpSocket(const UdpSocket&) = delete;
  UdpSocket& operator=(const UdpSocket&) = delete;
  ~UdpSocket() { ::close(descriptor_); }

  std::uint16_t port() const { return port_; }
  void send(std::uint16_t to, const std::vector<std::uint8_t>& bytes) const {
    const sockaddr_in address = at(to);
    ::sendto(descriptor_, bytes.data(), bytes.size(), 0, reinterpret_cast<const sockaddr*>(&address), sizeof address);
  }

  struct Got {
    std::uint16_t from;
    std::vector<std::uint8_t> bytes;
  };
  std::optional<Got> receive(int milliseconds = 0) const {
    pollfd polled = {descriptor_, POLLIN, 0};
    if (::poll(&polled, 1, milliseconds) <= 0) return std::nullopt;
    std::vector<std::uint8_t> bytes(65536);
    sockaddr_in from = {};
    socklen_t size = sizeof from;
    const ssize_t got =
        ::recvfrom(descriptor_, bytes.data(), bytes.size(), 0, reinterpret_cast<sockaddr*>(&from), &size);
    if (got < 0) return std::nullopt;
    bytes.resize(static_cast<std::size_t>(got));
    return Got{ntohs(from.sin_port), bytes};
  }

 private:
  static sockaddr_in at(std::uint16_t port) {
    sockaddr_in address = {};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    address.sin_port = htons(port);
    return address;
  }
  int descriptor_;
  std::uint16_t port_ = 0;
};

}  // namespace isostep::transport
