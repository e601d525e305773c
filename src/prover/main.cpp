// isostep_prover: the smallest program that proves a build of the library by recordings.
// SPDX-License-Identifier: MIT
#include <cstdio>
#include <string>

#include "commands.hpp"
#include "streams.hpp"

namespace isostep::prover {
namespace {

int refuse_command(const Request& request) {
  std::string known;
  for (const Command& command : kCommands) {
    known += known.empty() ? "" : " | ";
    known += command.name;
    if (*command.operands != '\0') known.append(" ").append(command.operands);
  }
  return refuse(exit_status::kUsage, request.command.empty() ? "a command is missing" : "no such command", known);
}

int run(const Request& request) {
  for (const Command& command : kCommands) {
    if (request.command != command.name) continue;
    if (request.operands.size() < command.least || request.operands.size() > command.most) {
      return refuse(exit_status::kUsage, std::string("usage: ").append(command.name).append(" ") + command.operands);
    }
    if (request.frames != kAllFrames && !command.takes_frames)
      return refuse(exit_status::kUsage, "--frames is for verify, continue and trace");
    if (request.fault && !command.takes_fault) return refuse(exit_status::kUsage, "--fault is for trace and fields");
    return command.run(request);
  }
  return refuse_command(request);
}

}  // namespace
}  // namespace isostep::prover

int main(int count, char** words) {
  using namespace isostep::prover;
  make_streams_binary();
  Request request;
  if (const int status = read_request(count, words, request); status != 0) return status;
  const int status = run(request);
  if (std::fflush(stdout) != 0 || std::ferror(stdout) != 0) {
    return refuse(isostep::exit_status::kOutput, "standard output cannot be written");
  }
  return status;
}
