// One line on stderr that says how far a long command is.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <string>

namespace isostep::tool::lab {

/// A line of progress: on a terminal it is written over; into a file it goes now and then. The time left is what the
/// work done so far took, for the work that is left.
class Progress {
 public:
  Progress(bool shown, std::size_t total, double work);
  /// Ends the line.
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// One more is done.
  void done(double work, const std::string& name);

 private:
  bool shown_, terminal_;
  std::size_t total_, done_ = 0;
  double work_, work_done_ = 0;
  double begin_, last_;  // [ms]
  bool open_ = false;
};

}  // namespace isostep::tool::lab
