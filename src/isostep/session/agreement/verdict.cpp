// The verdict: by a majority of all machines that were asked.
// SPDX-License-Identifier: MIT
#include "isostep/session/agreement/verdict.hpp"

namespace isostep {

Verdict judge(const Statements& statements) {
  Verdict verdict;
  int asked = 0;
  for (const Statements::One& one : statements.of) asked += one.is_asked ? 1 : 0;
  for (const Statements::One& one : statements.of) {
    if (!one.is_asked || !one.has_spoken) continue;
    int same = 0;
    for (const Statements::One& other : statements.of) {
      same += other.is_asked && other.has_spoken && other.chain == one.chain ? 1 : 0;
    }
    if (2 * same <= asked) continue;
    verdict.is_decided = true;
    verdict.chain = one.chain;
  }
  for (std::size_t m = 0; m < kMachines && verdict.is_decided; ++m) {
    const Statements::One& one = statements.of[m];
    const bool differs = one.is_asked && one.has_spoken && one.chain != verdict.chain;
    if (differs) verdict.minority |= std::uint64_t{1} << m;
  }
  return verdict;
}

}  // namespace isostep
