// StepMemory<S>: a world's last steps, so that a step that was taken before costs what differs.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "isostep/core/instantiate.hpp"
#include "isostep/store/events.hpp"
#include "isostep/store/resimulation.hpp"
#include "isostep/world/resimulation/affected_bodies.hpp"
#include "isostep/world/resimulation/partial_state.hpp"

namespace isostep {

template <class S> class WorldEngine;

/// Input:   the engine before a step; how many steps to remember.
/// Output:  the engine after it, as the whole step leaves it, bit for bit: state, events, report.
/// Keeps:   of each remembered step the states before and after it, its events and how many pairs it had; an engine
///          for parts of the state. All of it is cache: a step is a function of the state before it.
/// Method:  A step of a tick that is remembered looks for the bodies that differ from then, and those that they may
///          reach (AffectedBodies). It steps these alone (PartialState) and takes everything else from memory. It steps
///          the whole world where the difference is too large, or has no bounds.
template <class S> class StepMemory {
 public:
  explicit StepMemory(WorldEngine<S>& engine);
  ~StepMemory();

  /// The most steps that are remembered. Forgets all.
  void resize(std::uint32_t steps);
  StepReport step();
  const Resimulation& totals() const { return totals_; }

 private:
  struct Step {
    bool known = false;
    WorldState<S> before, after;
    Events<S> events;
    std::uint64_t pairs = 0, looks = 0, parts = 0;  // of bodies; of parts compared; of parts in reach
  };
  struct Part;
  static constexpr std::uint64_t kNoTick = ~std::uint64_t{0};

  bool step_difference(Step& known);
  bool is_clean(const StepReport& report) const;
  bool fits_budgets(const Step& known) const;
  void take_whole(Step& known);
  void put(Step& known);

  WorldEngine<S>& engine_;
  std::vector<Step> steps_;  // by tick modulo their number
  AffectedBodies<S> affected_;
  PartialState<S> partial_;
  std::unique_ptr<Part> part_;  // made when first used
  Events<S> joined_events_;
  Resimulation totals_;
  std::uint64_t hopeless_ = kNoTick;  // the tick after one in which too much differed: it grows within a rollback
};

#define ISO_STEP_MEMORY_OF(extern, S) extern template class StepMemory<S>;
ISO_EXTERN_FOR_EACH_SCALAR(ISO_STEP_MEMORY_OF)

}  // namespace isostep
