// A child process behind a pair of sockets.
// SPDX-License-Identifier: MIT
#include "client_process.hpp"

#include <fcntl.h>
#include <spawn.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <bit>
#include <cerrno>
#include <csignal>
#include <stdexcept>
#include <utility>

extern char** environ;

namespace isostep::test {

static_assert(std::endian::native == std::endian::little);

ClientProcess::ClientProcess(std::string command) : command_(std::move(command)) {
  int ends[2];
  if (socketpair(AF_UNIX, SOCK_STREAM, 0, ends) != 0) throw std::runtime_error("no socket");
  for (const int end : ends) fcntl(end, F_SETFD, FD_CLOEXEC);  // no other client's
  std::string words[] = {"sh", "-c", "exec " + command_};
  char* arguments[] = {words[0].data(), words[1].data(), words[2].data(), nullptr};
  posix_spawn_file_actions_t files;
  posix_spawn_file_actions_init(&files);
  posix_spawn_file_actions_adddup2(&files, ends[1], 0);
  posix_spawn_file_actions_adddup2(&files, ends[1], 1);
  const int failed = posix_spawn(&pid_, "/bin/sh", &files, nullptr, arguments, environ);
  posix_spawn_file_actions_destroy(&files);
  close(ends[1]);
  socket_ = ends[0];
  if (failed == 0) return;
  close(socket_);
  throw std::runtime_error("no process for " + command_);
}

ClientProcess::~ClientProcess() {
  close(socket_);
  if (pid_ < 0) return;
  kill(pid_, SIGTERM);
  waitpid(pid_, nullptr, 0);
}

void ClientProcess::put_bytes(const void* bytes, std::size_t size) {
  const auto* const first = static_cast<const std::uint8_t*>(bytes);
  out_.insert(out_.end(), first, first + size);
}

void ClientProcess::flush() {
  for (std::size_t sent = 0; sent < out_.size();) {
    const ssize_t count = write(socket_, out_.data() + sent, out_.size() - sent);
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) throw std::runtime_error(command_ + " reads no more");
    sent += static_cast<std::size_t>(count);
  }
  out_.clear();
}

std::vector<std::uint8_t> ClientProcess::take_bytes(std::size_t size) {
  while (in_.size() - at_ < size) {
    in_.erase(in_.begin(), in_.begin() + static_cast<std::ptrdiff_t>(std::exchange(at_, 0)));
    const std::size_t had = in_.size();
    in_.resize(had + (64u << 10));
    const ssize_t count = read(socket_, in_.data() + had, in_.size() - had);
    in_.resize(had + static_cast<std::size_t>(count > 0 ? count : 0));
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) throw std::runtime_error(command_ + " has ended");
  }
  const auto first = in_.begin() + static_cast<std::ptrdiff_t>(at_);
  at_ += size;
  return {first, first + static_cast<std::ptrdiff_t>(size)};
}

void ClientProcess::expect_success() {
  int status = 0;
  while (waitpid(pid_, &status, 0) < 0 && errno == EINTR) {}
  pid_ = -1;
  if (!WIFEXITED(status) || WEXITSTATUS(status) != 0) throw std::runtime_error(command_ + " has failed");
}

}  // namespace isostep::test
