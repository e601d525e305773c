// Child processes by posix_spawn.
// SPDX-License-Identifier: MIT
#include "child_process.hpp"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>

#include <csignal>
#include <cstring>
#include <filesystem>

#include "tool/common/tool.hpp"

extern char** environ;

namespace isostep::tool {
namespace {

std::string own_path() {
  std::error_code error;
  const std::filesystem::path path = std::filesystem::read_symlink("/proc/self/exe", error);
  if (error)
    throw ToolError(exit_status::kSoftware, "this system does not say where the program is: " + error.message());
  return path.string();
}
int status_of(int raw) { return WIFEXITED(raw) ? WEXITSTATUS(raw) : 128 + WTERMSIG(raw); }

}  // namespace

ChildProcess::ChildProcess(const std::vector<std::string>& words, const std::string& out, const std::string& error) {
  std::vector<std::string> texts = {own_path()};
  texts.insert(texts.end(), words.begin(), words.end());
  std::vector<char*> arguments;
  for (std::string& text : texts) arguments.push_back(text.data());
  arguments.push_back(nullptr);

  posix_spawn_file_actions_t files;
  posix_spawn_file_actions_init(&files);
  posix_spawn_file_actions_addopen(&files, 0, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_addopen(&files, 1, out.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0644);
  posix_spawn_file_actions_addopen(&files, 2, error.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0644);
  pid_t pid = 0;
  const int failed = posix_spawn(&pid, texts[0].c_str(), &files, nullptr, arguments.data(), environ);
  posix_spawn_file_actions_destroy(&files);
  if (failed != 0)
    throw ToolError(exit_status::kSoftware, std::string("cannot start a peer: ") + std::strerror(failed));
  pid_ = pid;
}

ChildProcess::ChildProcess(ChildProcess&& other) noexcept : pid_(other.pid_), status_(other.status_) {
  other.status_ = 0;
}

ChildProcess::~ChildProcess() {
  if (status_ >= 0) return;
  kill(pid_, SIGTERM);
  waitpid(pid_, nullptr, 0);
}

int ChildProcess::wait() {
  int raw = 0;
  if (status_ < 0) {
    while (waitpid(pid_, &raw, 0) < 0) stop_if_interrupted();
    status_ = status_of(raw);
  }
  return status_;
}

bool ChildProcess::runs() {
  int raw = 0;
  if (status_ < 0 && waitpid(pid_, &raw, WNOHANG) == pid_) status_ = status_of(raw);
  return status_ < 0;
}

}  // namespace isostep::tool
