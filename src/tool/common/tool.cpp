// Ctrl-C and the clock: the two things that the tool asks of the system.
// SPDX-License-Identifier: MIT
#include "tool.hpp"

#include <chrono>
#include <csignal>
#include <ctime>

#include "isostep/core/short_text.hpp"

namespace isostep::tool {
namespace {

volatile std::sig_atomic_t interrupt_seen = 0;
void on_interrupt(int) { interrupt_seen = 1; }

}  // namespace

void catch_interrupt() { std::signal(SIGINT, on_interrupt); }
bool interrupted() { return interrupt_seen != 0; }
void stop_if_interrupted() {
  if (interrupted()) throw ToolError(exit_status::kInterrupted, "interrupted");
}

double thread_milliseconds() {
#if defined(CLOCK_THREAD_CPUTIME_ID)
  timespec now = {};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return 1e3 * static_cast<double>(now.tv_sec) + 1e-6 * static_cast<double>(now.tv_nsec);
#else
  return 1e3 * static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
#endif
}

double real_milliseconds() {
  const auto now = std::chrono::steady_clock::now().time_since_epoch();
  return std::chrono::duration<double, std::milli>(now).count();
}

std::string hex(std::uint64_t hash) { return std::string(ShortText<16>().append_hex(hash).view()); }

}  // namespace isostep::tool
