// Node as a process of its own, which answers lines of JSON with doubles.
// SPDX-License-Identifier: MIT
#pragma once

#include <sys/types.h>

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace isostep::bench {

/// `node SCRIPT PACKAGE VARIANT`, which ends when its socket does. What fails is a SceneError. A request that takes
/// more than two minutes, as a crowd's single step may, ends the process and is a NoAnswer.
class NodeProcess {
 public:
  /// `script`: beside this file; `package`: a directory.
  NodeProcess(const std::string& script, std::string package, std::string variant);
  ~NodeProcess();
  NodeProcess(const NodeProcess&) = delete;
  NodeProcess& operator=(const NodeProcess&) = delete;

  std::vector<double> ask(const nlohmann::json& request, std::size_t count);

 private:
  std::size_t bytes_of(std::ptrdiff_t count) const;
  [[noreturn]] void give_up() const;

  std::string script_;
  int socket_ = -1;
  pid_t pid_ = 0;
};

}  // namespace isostep::bench
