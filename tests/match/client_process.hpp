// ClientProcess: a client of a match in a process of its own, whatever its language, and the bytes to it and from it.
// SPDX-License-Identifier: MIT
#pragma once

#include <sys/types.h>

#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

namespace isostep::test {

/// Numbers are little-endian, as this machine's. What goes wrong is a std::runtime_error that names the command.
class ClientProcess {
 public:
  /// Runs it by the shell. Its standard input and output are ours; what it says of errors goes where ours does.
  explicit ClientProcess(std::string command);
  /// Ends it if it still runs.
  ~ClientProcess();
  ClientProcess(const ClientProcess&) = delete;
  ClientProcess& operator=(const ClientProcess&) = delete;

  template <class T> void put(T value) { put_bytes(&value, sizeof value); }
  void put_bytes(const void* bytes, std::size_t size);
  /// Sends what was put since the last call.
  void flush();

  template <class T> T take() {
    T value;
    std::memcpy(&value, take_bytes(sizeof value).data(), sizeof value);
    return value;
  }
  std::vector<std::uint8_t> take_bytes(std::size_t size);

  /// Waits until it has ended; its exit status has to be 0.
  void expect_success();
  const std::string& command() const { return command_; }

 private:
  std::string command_;
  pid_t pid_ = -1;
  int socket_ = -1;
  std::vector<std::uint8_t> out_, in_;
  std::size_t at_ = 0;  // of in_: what was taken
};

}  // namespace isostep::test
