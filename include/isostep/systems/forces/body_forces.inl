// Bodies of body_forces.hpp.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/systems/forces/body_forces.hpp"

namespace isostep {

template <class S> void BodyForces<S>::begin_step() {
  bodies_.begin_step();
  sums_.begin_step(!no_records());
}
template <class S> void BodyForces<S>::end_step(StepReport& report) {
  report.clamped_force += sums_.cut_count();
  remove_ended();
}

template <class S> SubstepForces<S> BodyForces<S>::substeps() {
  if (no_records()) return {};
  const auto renew = [](void* forces, const SolverBodies<S>& bodies, std::int32_t rate) {
    static_cast<BodyForces*>(forces)->renew(bodies, rate);
  };
  return {renew, this};
}

template <class S> void BodyForces<S>::renew(const SolverBodies<S>& bodies, std::int32_t rate) {
  bodies_.begin_substep(bodies, rate);
  if (bodies_.when().substep == 0) zones_.rank();
  sums_.begin_substep();
  resistance_.begin_substep();
  wet_.begin_substep();
  act_all();
  zones_.replace_gravity(bodies_, sums_);
  resist_all();
  sums_.end_substep();
  bodies_.end_substep();
}

/// Calls visit(registry, its RecordRules) for the kinds that act.
template <class S> template <class Visit> void BodyForces<S>::for_each_kind(const Visit& visit) const {
  RecordStore<S>::members(
      [&]<class Record, class IdType>(const char*, const Registry<Record, IdType>& registry) {
        using Rules = detail::RecordRules<Record>;
        if constexpr (Rules::kActs != detail::Acts::not_here) visit(registry, Rules{});
      },
      *state_.records);
}
template <class S> bool BodyForces<S>::no_records() const {
  bool none = true;
  for_each_kind([&](const auto& registry, const auto&) { none = none && registry.all().empty(); });
  return none;
}

template <class S> void BodyForces<S>::act_all() {
  for_each_kind([&]<class Rules>(const auto& registry, const Rules&) {
    if constexpr (detail::pushes(Rules::kActs)) {
      const auto all = [&] { zones_.for_each(registry, [&](const auto& record) { Rules::act(record, forces_); }); };
      if (registry.all().empty()) return;
      if constexpr (Rules::kBears) sums_.bear(all);
      else all();
    }
  });
}
/// Applies resisting forces, after all that push: they resist the velocities to which the pushing forces lead.
template <class S> void BodyForces<S>::resist_all() {
  for_each_kind([&]<class Rules>(const auto& registry, const Rules&) {
    if constexpr (Rules::kActs == detail::Acts::slows) {
      zones_.for_each_down(registry, [&](const auto& record) { Rules::slow(record, forces_); });
    }
    if constexpr (detail::resists(Rules::kActs)) {
      zones_.for_each(registry, [&](const auto& record) {
        const auto named = detail::bodies_of(record);
        for (int i = 0; i < named.count; ++i) resistance_.count(bodies_.row_of(named.all[i].body));
      });
    }
  });
  resistance_.take_steady();
  for_each_kind([&]<class Rules>(const auto& registry, const Rules&) {
    if constexpr (detail::resists(Rules::kActs))
      zones_.for_each(registry, [&](const auto& record) { Rules::resist(record, forces_); });
  });
  resistance_.solve_fading();
}

/// Removes explosions that ended with this step.
template <class S> void BodyForces<S>::remove_ended() {
  const auto& explosions = state_.records->explosions;
  for (std::uint32_t slot = 0; slot < explosions.all().size(); ++slot) {
    if (!explosions.is_taken(slot)) continue;
    const bool ended = detail::has_ended(explosions.all()[slot], state_.tick + 1, state_.settings.hz);
    if (ended) state_.records.change().explosions.remove_at(slot);
  }
}

}  // namespace isostep
