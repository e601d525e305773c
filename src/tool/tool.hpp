// What every command of the tool shares: exit codes, errors, scalars by name, and Ctrl-C.
// SPDX-License-Identifier: MIT
#pragma once

#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "isostep/core/instantiate.hpp"
#include "isostep/scalar/scalar.hpp"

namespace isostep::tool {

/// sysexits.h. `verify` has its own: 0 verified, 1 diverged, 2 incompatible, 3 truncated, 4 corrupt.
namespace exit_status {
inline constexpr int kOk = 0;
inline constexpr int kDifferent = 1;
inline constexpr int kUsage = 64;
inline constexpr int kNoInput = 66;
inline constexpr int kUnavailable = 69;
inline constexpr int kSoftware = 70;
inline constexpr int kOutput = 74;
inline constexpr int kInterrupted = 130;
}  // namespace exit_status

/// Ends the command: one line on stderr, and this exit status.
class ToolError : public std::runtime_error {
 public:
  ToolError(int status, const std::string& message) : std::runtime_error(message), status_(status) {}
  int status() const { return status_; }

 private:
  int status_;
};

template <class S> struct ScalarTag { using Type = S; };

/// Calls visit(ScalarTag<S>{}) for each scalar of this build until one call returns true; whether one did.
template <class Visit> bool any_scalar(Visit&& visit) {
  bool found = false;
#define ISO_VISIT(S) found = found || visit(ScalarTag<S>{});
  ISO_FOR_EACH_SCALAR(ISO_VISIT)
#undef ISO_VISIT
  return found;
}
/// The names of this build's scalars, in their order.
std::vector<std::string> scalar_names();
/// visit(ScalarTag<S>{}) for the scalar of that name; false when this build has none.
template <class Visit> bool with_scalar(std::string_view name, Visit&& visit) {
  return any_scalar([&](auto tag) {
    if (name != ScalarTraits<typename decltype(tag)::Type>::kName) return false;
    visit(tag);
    return true;
  });
}

/// From now on Ctrl-C only sets the flag; loops look at it between frames, so that files end well.
void catch_interrupt();
bool interrupted();
/// Throws the ToolError of an interrupted command when the flag is set.
void stop_if_interrupted();

/// CPU time of this thread [ms].
double thread_milliseconds();
/// [ms] since some moment.
double real_milliseconds();

std::string hex(std::uint64_t hash);

}  // namespace isostep::tool
