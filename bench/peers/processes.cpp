// fork, a pipe each, and wait.
// SPDX-License-Identifier: MIT
#include "processes.hpp"

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <map>
#include <stdexcept>

namespace isostep::bench {
namespace {

struct Child {
  std::size_t index;
  int pipe;  // its reading end
};

void write_all(int pipe, const std::string& text) {
  for (std::size_t sent = 0; sent < text.size();) {
    const ssize_t count = write(pipe, text.data() + sent, text.size() - sent);
    if (count <= 0) return;
    sent += static_cast<std::size_t>(count);
  }
}
std::string read_all(int pipe) {
  std::string text;
  char chunk[4096];
  for (ssize_t count; (count = read(pipe, chunk, sizeof chunk)) > 0;)
    text.append(chunk, static_cast<std::size_t>(count));
  close(pipe);
  return text;
}

/// The child does not exec: what the parent has made is at hand.
pid_t start(const Work& work, std::size_t index, int& reading) {
  int ends[2];
  if (pipe2(ends, O_CLOEXEC) != 0) throw std::runtime_error("no pipe");
  const pid_t child = fork();
  if (child == 0) {
    alarm(static_cast<unsigned>(work.guard));
    const rlim_t seconds = 2 * static_cast<rlim_t>(work.guard);
    const rlimit most = {seconds, seconds};
    setrlimit(RLIMIT_CPU, &most);  // of an engine's own process that computes on and does not see this one end
    write_all(ends[1], work.run(index));
    _exit(0);
  }
  close(ends[1]);
  if (child < 0) throw std::runtime_error("no process");
  reading = ends[0];
  return child;
}

}  // namespace

void in_processes(const Work& work) {
  std::map<pid_t, Child> running;
  for (std::size_t next = 0; next < work.count || !running.empty();) {
    if (next < work.count && running.size() < static_cast<std::size_t>(work.jobs)) {
      int reading = -1;
      work.prepare(next);
      const pid_t child = start(work, next, reading);
      running[child] = {next++, reading};
      continue;
    }
    int status = 0;
    const pid_t ended = wait(&status);
    if (ended < 0 && errno != EINTR) throw std::runtime_error("lost the processes of running peers");
    const auto found = running.find(ended);
    if (found == running.end()) continue;
    ProcessEnd end;
    end.said = read_all(found->second.pipe);
    if (WIFSIGNALED(status)) end.signal = WTERMSIG(status);
    end.hung = end.signal == SIGALRM;
    work.done(found->second.index, end);
    running.erase(found);
  }
}

}  // namespace isostep::bench
