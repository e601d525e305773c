// Errors and Ctrl-C, which every command of the tool shares.
// SPDX-License-Identifier: MIT
#pragma once

#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "isostep/core/scalar_names.hpp"
#include "programs/exit_status.hpp"

namespace isostep::tool {

namespace exit_status = isostep::exit_status;

/// Ends the command: one line on stderr, and this exit status.
class ToolError : public std::runtime_error {
 public:
  ToolError(int status, const std::string& message) : std::runtime_error(message), status_(status) {}
  int status() const { return status_; }

 private:
  int status_;
};

/// Makes Ctrl-C only set the flag from now on; loops look at it between frames, so that files end well.
void catch_interrupt();
bool interrupted();
/// Throws the ToolError of an interrupted command when the flag is set.
void stop_if_interrupted();

/// CPU time of this thread [ms].
double thread_milliseconds();
/// [ms] The real time since some moment.
double real_milliseconds();

std::string hex(std::uint64_t hash);

}  // namespace isostep::tool
