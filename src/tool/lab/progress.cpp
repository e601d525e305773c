// Progress on a terminal, or in a log.
// SPDX-License-Identifier: MIT
#include "progress.hpp"

#include <algorithm>
#include <cstdio>
#if __has_include(<unistd.h>)
#include <unistd.h>
#endif

#include "tool/common/tool.hpp"

namespace isostep::tool::lab {
namespace {

constexpr double kOnTerminal = 100, kInLog = 10'000;  // [ms] from one line to the next

bool is_terminal() {
#if __has_include(<unistd.h>)
  return isatty(2) == 1;
#else
  return false;
#endif
}

std::string clock_text(double seconds) {
  const int whole = static_cast<int>(seconds + 0.5);
  char text[32];
  if (whole < 60) std::snprintf(text, sizeof text, "%d s", whole);
  else std::snprintf(text, sizeof text, "%d:%02d min", whole / 60, whole % 60);
  return text;
}

}  // namespace

Progress::Progress(bool shown, std::size_t total, double work)
    : shown_(shown && total > 0),
      terminal_(is_terminal()),
      total_(total),
      work_(work),
      begin_(real_milliseconds()),
      last_(begin_) {}

Progress::~Progress() {
  if (open_) std::fputs("\n", stderr);
}

void Progress::done(double work, const std::string& name) {
  ++done_;
  work_done_ += work;
  const double now = real_milliseconds();
  if (!shown_ || (done_ < total_ && now - last_ < (terminal_ ? kOnTerminal : kInLog))) return;
  last_ = now;
  const double left = (now - begin_) * 1e-3 * std::max(work_ - work_done_, 0.0) / std::max(work_done_, 1e-9);
  std::fprintf(stderr, "%s%zu of %zu runs, about %s left: %s%s", terminal_ ? "\r" : "", done_, total_,
               clock_text(left).c_str(), name.c_str(), terminal_ ? "\x1b[K" : "\n");
  std::fflush(stderr);
  open_ = terminal_;
}

}  // namespace isostep::tool::lab
