// ChildProcess: this program once more, with other words, its output in files.
// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

namespace isostep::tool {

class ChildProcess {
 public:
  /// Runs `isostep WORDS...`; stdout and stderr go to these files. Throws ToolError 70 when it cannot.
  ChildProcess(const std::vector<std::string>& words, const std::string& out, const std::string& error);
  /// Ends it if it still runs.
  ~ChildProcess();
  ChildProcess(ChildProcess&& other) noexcept;
  ChildProcess& operator=(ChildProcess&&) = delete;

  /// Its exit status; 128 and the signal when one ended it.
  int wait();
  bool runs();

 private:
  int pid_;
  int status_ = -1;  // once it is over
};

}  // namespace isostep::tool
