// The program that runs other engines, as the laboratory calls it.
// SPDX-License-Identifier: MIT
#pragma once

#include <string>

namespace isostep::tool::lab {

struct PeerProgram {
  std::string path;
  std::string words;  // further options, as the shell takes them
  std::string out;    // file to which it adds lines
  int jobs = 0;       // runs at a time; 0: as many as there are cores
  double limit = 8;   // [s] CPU time of a run
};
/// It resumes by itself. A failure is a line on stderr: what it left in its file counts.
void run_peer_program(const PeerProgram& program);

}  // namespace isostep::tool::lab
