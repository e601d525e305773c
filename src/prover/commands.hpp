// The prover's commands: each reads its operands and returns an exit status.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <span>

#include "request.hpp"

namespace isostep::prover {

struct Command {
  const char* name;
  const char* operands;
  std::size_t least, most;  // of operands
  int (*run)(const Request& request);
  bool takes_frames = false;
  bool takes_fault = false;
};

int command_about(const Request& request);
int command_verify(const Request& request);
int command_snapshot(const Request& request);
int command_continue(const Request& request);
int command_trace(const Request& request);
int command_fields(const Request& request);
int command_selfcheck(const Request& request);

inline constexpr std::size_t kAny = ~std::size_t{0};
inline constexpr Command kCommands[] = {
    {"about", "", 0, 0, command_about},
    {"verify", "FILE...", 1, kAny, command_verify, true},
    {"snapshot", "FILE FRAME", 2, 2, command_snapshot},
    {"continue", "FILE FRAME", 2, 2, command_continue, true},
    {"trace", "FILE", 1, 1, command_trace, true, true},
    {"fields", "FILE FRAME[.STEP] STAGE", 3, 3, command_fields, false, true},
    {"selfcheck", "", 0, 0, command_selfcheck},
};

}  // namespace isostep::prover
