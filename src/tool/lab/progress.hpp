// One line on stderr that says how far a long command is.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <string>

namespace isostep::tool::lab {

/// The texts of a progress and when they are due, by a clock that is told. On a terminal a line is written over, and
/// begins at once; into a file one goes every ten seconds, and the last. The time left is what the work done so far
/// took, for the work that is left. Times in ms.
class ProgressText {
 public:
  ProgressText(bool terminal, std::size_t total, double work, double now);
  /// One more is done. Empty: nothing is due.
  std::string done(double work, const std::string& name, double now);
  /// The text with which it begins, and with which it ends.
  std::string begin();
  std::string end() const { return open_ ? "\n" : ""; }

 private:
  std::string line(const std::string& text);

  bool terminal_, open_ = false;
  std::size_t total_, done_ = 0;
  double work_, work_done_ = 0;
  double begin_, last_;
};

/// Prints a ProgressText on stderr by the real clock, so that stdout has nothing but results.
class Progress {
 public:
  Progress(bool shown, std::size_t total, double work);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// One more is done.
  void done(double work, const std::string& name);

 private:
  void print(const std::string& text) const;

  bool shown_;
  ProgressText text_;
};

}  // namespace isostep::tool::lab
