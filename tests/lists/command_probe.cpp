// A program of the tests: the probe command, called and played from a command log, in a copy of the headers that has
// it in its list. Its world is compiled here and takes no step.
// SPDX-License-Identifier: MIT
#define ISOSTEP_OWN_SCALARS
#include <cstdio>

#include "isostep/collision/broadphase/pairs.inl"
#include "isostep/collision/broadphase/tree.inl"
#include "isostep/dynamics/records/record_store.inl"
#include "isostep/geometry/mass_properties.inl"
#include "isostep/geometry/validate.inl"
#include "isostep/instantiate/contact_systems.inl"
#include "isostep/instantiate/event_systems.inl"
#include "isostep/instantiate/executing_commands.inl"
#include "isostep/instantiate/island_systems.inl"
#include "isostep/instantiate/motion_systems.inl"
#include "isostep/world/engine_step.inl"
#include "isostep/world/world.inl"

namespace isostep {
ISO_FOR_EACH_COMMAND(ISO_INSTANTIATE_EXECUTE, float)
template <> const BodyKernels<float>* body_kernels<float>(Simd) { return nullptr; }
template <> const ContactKernels<float>* contact_kernels<float>(Simd) { return nullptr; }
template <> const PairKernels<float>* pair_kernels<float>(Simd) { return nullptr; }
template <> const TreeKernels<float>* tree_kernels<float>(Simd) { return nullptr; }
}  // namespace isostep

using namespace isostep;

int main() {
  World<float> world, other;
  std::vector<std::uint8_t> log;
  world.record_to(&log);
  const bool taken = world.apply(Probe{3}), again = world.apply(Probe{2});
  const FaultReport& fault = world.fault();
  const Result<void> played = play_commands<Command<float>>(
      log, [&](const auto& command) { return static_cast<bool>(other.apply(command)); }, [] {});
  std::printf("taken %d again %d %s.%s bytes %d number %d played %d tick %d\n", taken, again, fault.command,
              fault.field, static_cast<int>(log.size()), log[0], played.ok(), static_cast<int>(other.tick()));
}
