// A check at start: does the engine compute on this machine as it does on every other?
// SPDX-License-Identifier: MIT
#include "isostep/replay/selfcheck.hpp"

#include <cstdio>

namespace iso = isostep;

int main() {
  // README: begin
  const iso::SelfcheckResult check = iso::selfcheck();  // a second or two, at the first start after an update
  std::printf("%s\n", iso::describe(check).c_str());    // one line for the log
  if (!check.sound()) return 1;                         // do not let this machine into a match
  // README: end
  return check.caller == 0 ? 0 : 2;  // float code of the game's own could not be trusted
}
