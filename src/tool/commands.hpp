// The commands: what each is told, and what it answers, an exit status.
// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "game_options.hpp"

namespace isostep::tool {

struct ScenesOptions {
  bool json = false;
  std::string write;  // directory, or empty
};
int command_scenes(const ScenesOptions& options);

struct RunOptions {
  std::string scene;  // named, or a scene's file, or a recording to watch
  std::string scalar = "float";
  int frames = -1;  // -1: the scene's
  GameOptions game;
  int threads = 1;
  std::string simd = "best";
  std::string load, save, record, hashes, dump;  // files, or empty
  std::string html;                              // a page that plays the run, or empty
  int html_every = 1;                            // steps from one frame of the page to the next
  std::string beside;                            // a scalar whose run the page plays as well, or empty
  double beside_tolerance = 0.01;                // [m] beyond which the two have parted
  bool json = false;
};
int command_run(const RunOptions& options);

struct VerifyOptions {
  std::vector<std::string> paths;
  int jobs = 1;
  bool json = false;
  double max_seconds = 0;  // [s] of all files together; 0: any number
  int max_memory = 0;      // [MiB] beyond what the program takes itself; 0: any number
};
int command_verify(const VerifyOptions& options);

struct DiffOptions {
  std::string a, b;                // with `stages` b may be empty: a again
  bool stages = false;             // what every stage left, scratch too
  std::string prover_a, prover_b;  // command lines that play a and b instead; of `stages`
  std::string html;                // a page that plays both recordings side by side, or empty
};
int command_diff(const DiffOptions& options);
int diff_stages(const DiffOptions& options);

struct SelftestOptions {
  std::string scene;
  std::string scalar = "float";
  int frames = -1;
  int rollback = 10;
  int every = 1;
};
int command_selftest(const SelftestOptions& options);

struct RebakeOptions {
  std::string directory;  // empty: the repository's
  bool record = false;    // the self-check's recordings instead of the lists
};
int command_rebake(const RebakeOptions& options);

struct DemoOptions {
  std::string out;  // directory for the recordings; empty: a temporary one
};
int command_demo(const DemoOptions& options);

struct PeerOptions {
  int listen = -1;        // port, 0: any; -1: connect instead
  std::string connect;    // HOST:PORT
  std::string port_file;  // where a host writes its port
  int players = 2;
  bool spectate = false;
  bool lockstep = false;
  std::string scalar = "q32.32";
  int frames = 600;  // confirmed, then the peer leaves
  int window = 8, delay = 2;
  int pile = 40;                       // bodies of the match
  std::uint64_t match_seed = 1;        // of the match; all peers the same
  std::uint64_t bot = 1;               // seed of this peer's player
  std::string inputs;                  // file of inputs instead: one a line, "x z buttons aim"
  std::string profile;                 // what befalls this peer's packets
  std::string hashes, record, bundle;  // files, or empty
  bool trace = false;                  // stage hashes in bundles
  int fault = -1;                      // frame of a drill: one bit of one body is flipped
  int patience = 0;                    // [s] that a silent peer is waited for; 0: the session's and the transport's own
  bool json = false;
};
int command_peer(const PeerOptions& options);

struct RelayOptions {
  int listen = 0;
  std::string target;  // HOST:PORT
  std::string profile = "mobile";
  std::uint64_t seed = 1;
  std::string port_file;
};
int command_relay(const RelayOptions& options);

struct LabOptions {
  std::string scene;
  std::string tolerance;
  std::vector<std::string> scalars, solvers, models;  // empty: all
  std::vector<int> substeps, hz;                      // empty: see lab/sweep.hpp
  int frames = -1;                                    // -1: the scene's
  double limit = 20;                                  // [s] CPU time of a run
  int jobs = 0;                                       // 0: as many as cores
  bool fresh = false;
  std::string out = "build/lab";  // directory, or empty
  std::string csv;                // file, or empty
  bool json = false;
  // Instead of one scene the report, see lab/report/report.hpp.
  bool all = false, is_short = false;
  std::string peers;  // program that runs the peers, or empty
};
int command_lab(const LabOptions& options);

struct LabSpringsOptions {
  bool quick = false;  // fewer stiffnesses, steps timed once
  bool json = false;
  bool quiet = false;  // no table
  std::string out;     // directory for the table and its chart, or empty
};
int command_lab_springs(const LabSpringsOptions& options);

struct SelfcheckOptions {
  bool verbose = false, json = false;
};
int command_selfcheck(const SelfcheckOptions& options);

/// The whole program: an exit status for these words.
int run_command_line(int argc, const char* const* argv);

}  // namespace isostep::tool
