// Node's process and the socket to it.
// SPDX-License-Identifier: MIT
#include "node_process.hpp"

#include <spawn.h>
#include <sys/socket.h>
#include <sys/time.h>
#include <sys/wait.h>
#include <unistd.h>

#include <bit>
#include <cerrno>
#include <csignal>
#include <iterator>

#include "engine.hpp"

extern char** environ;

namespace isostep::bench {

static_assert(std::endian::native == std::endian::little, "node_peer.mjs writes little-endian doubles");

constexpr timeval kPatience = {120, 0};  // [s] for one answer

void NodeProcess::give_up() const {
  kill(pid_, SIGKILL);
  throw NoAnswer("", script_ + " gave no answer within " + std::to_string(kPatience.tv_sec) + " s");
}

std::size_t NodeProcess::bytes_of(std::ptrdiff_t count) const {
  if (count < 0 && (errno == EAGAIN || errno == EWOULDBLOCK)) give_up();
  if (count <= 0) throw scenes::SceneError("", script_ + " has ended; what it said is above");
  return static_cast<std::size_t>(count);
}

NodeProcess::NodeProcess(const std::string& script, std::string package, std::string variant) : script_(script) {
  int ends[2];
  if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends) != 0) throw scenes::SceneError("", "no socket");
  socket_ = ends[0];
  setsockopt(socket_, SOL_SOCKET, SO_RCVTIMEO, &kPatience, sizeof kPatience);
  std::string words[] = {"node", "--no-liftoff",  // optimised before the first step
                         ISOSTEP_BENCH_SOURCE_DIR "/scene_bench/" + script, std::move(package), std::move(variant)};
  char* arguments[std::size(words) + 1] = {};
  for (std::size_t i = 0; i < std::size(words); ++i) arguments[i] = words[i].data();
  posix_spawn_file_actions_t files;
  posix_spawn_file_actions_init(&files);
  posix_spawn_file_actions_adddup2(&files, ends[1], 0);
  posix_spawn_file_actions_adddup2(&files, ends[1], 1);
  const int failed = posix_spawnp(&pid_, "node", &files, nullptr, arguments, environ);
  posix_spawn_file_actions_destroy(&files);
  close(ends[1]);
  if (failed == 0) return;
  close(socket_);
  throw scenes::SceneError("", "node does not start");
}

NodeProcess::~NodeProcess() {
  close(socket_);
  waitpid(pid_, nullptr, 0);
}

std::vector<double> NodeProcess::ask(const nlohmann::json& request, std::size_t count) {
  const std::string line = request.dump() + "\n";
  for (std::size_t sent = 0; sent < line.size();) {
    sent += bytes_of(send(socket_, line.data() + sent, line.size() - sent, MSG_NOSIGNAL));
  }
  std::vector<double> answer(count);
  const std::size_t size = count * sizeof(double);
  for (std::size_t got = 0; got < size;) {
    got += bytes_of(recv(socket_, reinterpret_cast<char*>(answer.data()) + got, size - got, 0));
  }
  return answer;
}

}  // namespace isostep::bench
