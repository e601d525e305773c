// Bodies of step_memory.hpp.
// SPDX-License-Identifier: MIT
#pragma once

#include <utility>

#include "isostep/systems/contacts/throng.hpp"
#include "isostep/world/engine.hpp"
#include "isostep/world/resimulation/joined_events.hpp"
#include "isostep/world/resimulation/partial_state.inl"
#include "isostep/world/resimulation/step_memory.hpp"

namespace isostep {

namespace detail {
template <class State> ISO_INLINE bool same_slots(const std::vector<State>& a, const std::vector<State>& b) {
  if (a.size() != b.size()) return false;
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (a[i].slot != b[i].slot) return false;
  }
  return true;
}
}  // namespace detail

/// The engine that steps parts, and the part as it was before that.
template <class S> struct StepMemory<S>::Part {
  explicit Part(const Settings<S>& settings) : engine(settings) {}
  WorldState<S> state;
  WorldEngine<S> engine;
};

template <class S>
StepMemory<S>::StepMemory(WorldEngine<S>& engine)
    : engine_(engine),
      affected_(engine.state_, engine.map_, engine.proxies_),
      partial_(engine.state_, engine.map_, affected_) {}
template <class S> StepMemory<S>::~StepMemory() = default;

template <class S> void StepMemory<S>::resize(std::uint32_t steps) {
  steps_.clear();
  steps_.resize(steps);
  totals_ = {};
  hopeless_ = kNoTick;
}

template <class S> StepReport StepMemory<S>::step() {
  Step& known = steps_[engine_.state_.tick % steps_.size()];
  if (known.known && known.before.tick == engine_.state_.tick) {
    if (engine_.state_.tick != hopeless_ && step_difference(known)) return engine_.report_;
    if (engine_.state_.tick == hopeless_ || !affected_.are_few()) hopeless_ = engine_.state_.tick + 1;
    ++totals_.whole;
  }
  take_whole(known);
  return engine_.report_;
}

/// Steps the whole world and remembers that.
template <class S> void StepMemory<S>::take_whole(Step& known) {
  known.before = engine_.state_;
  engine_.step_whole({});
  known.known = is_clean(engine_.report_) && !engine_.narrow_phase_.part_pairs().any_throng();
  if (!known.known) return;
  known.after = engine_.state_;
  known.events = engine_.events_;
  known.pairs = engine_.proxies_.pairs().size();
  known.looks = engine_.narrow_phase_.part_pairs().looks();
  known.parts = engine_.narrow_phase_.part_pairs().parts();
}

template <class S> bool StepMemory<S>::is_clean(const StepReport& report) const {
  return report.clean() && report.unsolved == 0;
}

/// Returns false, with no change, if the whole world must be stepped.
template <class S> bool StepMemory<S>::step_difference(Step& known) {
  constexpr std::size_t kShare = 3;  // beyond a third of the bodies, finding them costs what it spares
  const std::size_t all = engine_.state_.awake.states.size();
  if (!affected_.find(known.before, all / kShare)) return false;
  if (part_ == nullptr) part_ = std::make_unique<Part>(engine_.state_.settings);
  WorldEngine<S>& part = part_->engine;
  const std::size_t stepped = partial_.take(part_->state);
  part.tools_ = engine_.tools_;
  part.loader_.load(part_->state);
  part.step_whole({});
  if (!is_clean(part.report_) || !fits_budgets(known)) return false;
  if (!partial_.fit(part_->state, part.state_, known.before, known.after)) return false;
  const bool old_sleeps = !detail::all_same(known.before.sleeping, known.after.sleeping, detail::SameObject{});
  if (!detail::join_events(known.events, part.events_, affected_, old_sleeps, joined_events_)) return false;
  partial_.join(part.state_, known.before, known.after);
  std::swap(known.events, joined_events_);
  engine_.render_poses_.keep_start();
  put(known);
  engine_.events_ = known.events;
  engine_.report_ = {};
  known.pairs += part.proxies_.pairs().size();
  known.looks += part.narrow_phase_.part_pairs().looks();
  known.parts += part.narrow_phase_.part_pairs().parts();
  ++totals_.parts;
  totals_.bodies += all;
  totals_.stepped += stepped;
  return true;
}

/// Makes the state before the step that of memory, and that after it the engine's.
template <class S> void StepMemory<S>::put(Step& known) {
  WorldState<S>& state = engine_.state_;
  const bool moved = !detail::all_same(state.sleeping, known.after.sleeping, detail::SameObject{}) ||
                     !detail::same_slots(state.awake.states, known.after.awake.states) ||
                     !detail::same_slots(state.joints.states, known.after.joints.states);
  if (moved) {
    known.before = state;
    engine_.loader_.load(known.after);
    return;
  }
  std::swap(known.before, state);
  state = known.after;
  for (std::size_t i = 0; i < state.awake.states.size(); ++i) {
    if (!(state.awake.states[i].fat == known.before.awake.states[i].fat))
      engine_.proxies_.place(state.awake.states[i], state.awake.properties[i], true);
  }
}

/// Returns true if the step of all stays within what budgets allow for sure: the known step and the part together do.
template <class S> bool StepMemory<S>::fits_budgets(const Step& known) const {
  const WorldEngine<S>& part = part_->engine;
  const auto most = static_cast<std::uint64_t>(engine_.state_.settings.most_pairs);
  const std::uint64_t pairs = known.pairs + part.proxies_.pairs().size();
  return pairs <= most && !part.narrow_phase_.part_pairs().any_throng() &&
         !Throng<S>::is_searched(pairs, engine_.state_.awake.states.size()) &&
         known.looks + part.narrow_phase_.part_pairs().looks() <= PartPairs<S>::most_looks(most) &&
         known.parts + part.narrow_phase_.part_pairs().parts() <= PartPairs<S>::most_parts(most);
}

}  // namespace isostep

/// Instantiates the memory of steps, which whoever never rolls back does not use.
#define ISO_INSTANTIATE_STEP_MEMORY(S) \
  ISO_AFFECTED_BODIES_OF(, S)          \
  ISO_PARTIAL_STATE_OF(, S)            \
  ISO_STEP_MEMORY_OF(, S)
