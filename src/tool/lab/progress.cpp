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

ProgressText::ProgressText(bool terminal, std::size_t total, double work, double now)
    : terminal_(terminal), total_(total), work_(work), begin_(now), last_(now) {}

std::string ProgressText::begin() {
  return terminal_ && total_ > 0 ? line("0 of " + std::to_string(total_) + " runs") : "";
}

std::string ProgressText::done(double work, const std::string& name, double now) {
  ++done_;
  work_done_ += work;
  if (done_ < total_ && now - last_ < (terminal_ ? kOnTerminal : kInLog)) return "";
  last_ = now;
  const double left = (now - begin_) * 1e-3 * std::max(work_ - work_done_, 0.0) / std::max(work_done_, 1e-9);
  return line(std::to_string(done_) + " of " + std::to_string(total_) + " runs, about " + clock_text(left) +
              " left: " + name);
}

std::string ProgressText::line(const std::string& text) {
  open_ = terminal_;
  return terminal_ ? "\r" + text + "\x1b[K" : text + "\n";
}

Progress::Progress(bool shown, std::size_t total, double work)
    : shown_(shown), text_(is_terminal(), total, work, real_milliseconds()) {
  print(text_.begin());
}
Progress::~Progress() { print(text_.end()); }

void Progress::done(double work, const std::string& name) { print(text_.done(work, name, real_milliseconds())); }

void Progress::print(const std::string& text) const {
  if (!shown_) return;
  std::fputs(text.c_str(), stderr);
  std::fflush(stderr);
}

}  // namespace isostep::tool::lab
