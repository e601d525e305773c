// isostep_prover selfcheck: the library's self-check as one line.
// SPDX-License-Identifier: MIT
#include "commands.hpp"
#include "isostep/replay/selfcheck.hpp"
#include "streams.hpp"

namespace isostep::prover {

int command_selfcheck(const Request&) {
  const SelfcheckResult result = selfcheck();
  print(describe(result) + "\n");
  return result.sound() ? exit_status::kOk : exit_status::kDifferent;
}

}  // namespace isostep::prover
