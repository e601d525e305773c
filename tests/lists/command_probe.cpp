// A program of the tests: the probe command, called and played from a command log, in a copy of the headers that has
// it in its list. Its world is compiled here and takes no step.
// SPDX-License-Identifier: MIT
#define ISOSTEP_OWN_SCALARS
#include <cstdio>

#include "own_world.hpp"

using namespace isostep;

int main() {
  World<float> world, other;
  std::vector<std::uint8_t> log;
  world.record_to(&log);
  const bool taken = world.apply(Probe{3}), again = world.apply(Probe{2});
  const FaultReport& fault = world.fault();
  const Result<void> played = play_commands<EveryCommand<float>>(
      log, [&](const auto& command) { return static_cast<bool>(other.apply(command)); }, [] {});
  std::printf("taken %d again %d %s.%s bytes %d number %d played %d tick %d\n", taken, again, fault.command,
              fault.field, static_cast<int>(log.size()), log[0], played.ok(), static_cast<int>(other.tick()));
}
