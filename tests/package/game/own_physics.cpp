// A user's own float code, compiled with isostep::deterministic_flags: nothing is fused, whatever the machine.
// SPDX-License-Identifier: MIT
#include <isostep/scalar/environment.hpp>

int main() { return isostep::probe_environment_here() == 0 && isostep::probe_environment() == 0 ? 0 : 1; }
