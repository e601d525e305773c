// Node as a process of its own, which answers lines of JSON with doubles.
// SPDX-License-Identifier: MIT
#pragma once

#include <sys/types.h>

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace isostep::bench {

/// `node rapier.mjs PACKAGE`, which ends when its socket does. What fails is a SceneError.
class NodeProcess {
 public:
  explicit NodeProcess(std::string package);
  ~NodeProcess();
  NodeProcess(const NodeProcess&) = delete;
  NodeProcess& operator=(const NodeProcess&) = delete;

  std::vector<double> ask(const nlohmann::json& request, std::size_t count);

 private:
  int socket_ = -1;
  pid_t pid_ = 0;
};

}  // namespace isostep::bench
