// The commands: what each is told, and what it answers, an exit status.
// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

namespace isostep::tool {

struct ScenesOptions {
  bool json = false;
  std::string write;  // directory, or empty
};
int command_scenes(const ScenesOptions& options);

struct RunOptions {
  std::string scene;
  std::string scalar = "float";
  int frames = -1;  // -1: the scene's
  int hz = -1, substeps = -1;
  std::string solver = "soft_step";
  int threads = 1;
  std::string simd = "best";
  std::string load, save, record, hashes, dump;  // files, or empty
  bool json = false;
};
int command_run(const RunOptions& options);

struct VerifyOptions {
  std::vector<std::string> paths;
  int jobs = 1;
  bool json = false;
};
int command_verify(const VerifyOptions& options);

struct DiffOptions {
  std::string a, b;
};
int command_diff(const DiffOptions& options);

struct SelftestOptions {
  std::string scene;
  std::string scalar = "float";
  int frames = -1;
  int rollback = 10;
  int every = 1;
};
int command_selftest(const SelftestOptions& options);

struct RebakeOptions {
  std::string directory;
};
int command_rebake(const RebakeOptions& options);

struct DemoOptions {
  std::string out;  // directory for the recordings, or empty
};
int command_demo(const DemoOptions& options);

int command_selfcheck();

/// The whole program: an exit status for these words.
int run_command_line(int argc, const char* const* argv);

}  // namespace isostep::tool
