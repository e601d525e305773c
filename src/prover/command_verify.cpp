// isostep_prover verify: a line for each recording, and a last one for all.
// SPDX-License-Identifier: MIT
#include <cstdio>

#include "checks.hpp"
#include "commands.hpp"
#include "streams.hpp"

namespace isostep::prover {

int command_verify(const Request& request) {
  int worst = exit_status::kOk;
  std::uint64_t frames = 0;
  std::size_t verified = 0;
  double milliseconds = 0;
  for (const std::string_view path : request.operands) {
    const Proof proof = prove(path, {.simd = request.simd, .span = {.count = request.frames}});
    print(line_of(path, proof));
    std::fflush(stdout);
    if (!proof.unreadable.empty()) refuse(proof.status(), proof.unreadable, path);
    if (proof.status() > worst) worst = proof.status();
    if (proof.status() == exit_status::kOk) ++verified;
    frames += proof.compared;
    milliseconds += proof.milliseconds;
  }
  print(total_line(frames, milliseconds, verified, request.operands.size()));
  return worst;
}

}  // namespace isostep::prover
