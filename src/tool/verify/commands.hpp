// The commands verify, regenerate and selfcheck: the options of each; each returns an exit status.
// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

namespace isostep::tool {

struct VerifyOptions {
  std::vector<std::string> paths;
  std::string goldens;  // a scene whose hashes are printed instead
  int jobs = 1;
  bool json = false;
  double max_seconds = 0;  // [s] of all files together; 0: any number
  int max_memory = 0;      // [MiB] beyond what the program takes itself; 0: any number
};
int command_verify(const VerifyOptions& options);

struct RegenerateOptions {
  std::string directory;  // empty: the repository's
  bool record = false;    // the self-check's recordings instead of the goldens
};
int command_regenerate(const RegenerateOptions& options);

struct SelfcheckOptions {
  bool verbose = false, json = false;
};
int command_selfcheck(const SelfcheckOptions& options);

}  // namespace isostep::tool
