// StepWheels<S>: the wheels of awake bodies in a step, and the sub-step that they are in.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "isostep/dynamics/solver_body.hpp"
#include "isostep/store/body_map.hpp"
#include "isostep/store/state.hpp"
#include "isostep/systems/vehicle/wheel_run.hpp"

namespace isostep {

/// Input:   the records of wheels and vehicles; the bodies in every sub-step.
/// Output:  runs, sorted by body, with the states of their records, steered and paired by anti-roll bars; groups of
///          runs; the order in which a sweep solves them. VehicleRows and its parts write the rest of runs and groups.
/// Keeps:   nothing from step to step but memory.
/// Order:   bodies ascending by slot, the wheels of each ascending by slot.
template <class S> class StepWheels {
 public:
  using U = Unit<S>;
  using V = Velocity<S>;
  using Run = WheelRun<S>;
  using Group = WheelGroup<S>;

  ISO_INLINE StepWheels(const WorldState<S>& state, const BodyMap<S>& map) : state_(state), map_(map) {}

  void list();
  /// Marks the groups whose sweeps may end early, by their engines and their ground.
  void find_who_ends_early();
  ISO_INLINE void begin_substep(SolverBodies<S>& bodies, std::int32_t rate) {
    bodies_ = &bodies;
    rate_ = S(rate);
    h_ = divide_to<Step<S>>(S(1), rate_);
  }

  ISO_INLINE std::span<Run> runs() { return runs_; }
  ISO_INLINE std::span<const Run> runs() const { return runs_; }
  ISO_INLINE std::span<Run> runs_of(const Group& group) { return runs().subspan(group.first, group.end - group.first); }
  ISO_INLINE std::span<Group> groups() { return groups_; }
  /// The order of runs: the first wheels of all bodies, then the second, and so on.
  ISO_INLINE std::span<const std::uint32_t> order() const { return order_; }

  ISO_INLINE const WheelSettings<S>& wheel(const Run& run) const { return state_.records->wheels.all()[run.slot]; }
  // Of a group that has one.
  ISO_INLINE const VehicleSettings<S>& vehicle(const Group& group) const {
    return state_.records->vehicles.all()[group.vehicle];
  }
  ISO_INLINE const VehicleInput<S>& input(const Group& group) const {
    return state_.parts.vehicle_inputs[group.vehicle];
  }

  // Of the sub-step.
  ISO_INLINE SolverBodies<S>& bodies() { return *bodies_; }
  ISO_INLINE S rate() const { return rate_; }
  ISO_INLINE Step<S> h() const { return h_; }

 private:
  void list_runs();
  void list_groups();
  Group* group_of(std::uint32_t row);
  void steer(const Group& group);
  void join_bars(const Group& group);

  const WorldState<S>& state_;
  const BodyMap<S>& map_;
  std::vector<Run> runs_;
  std::vector<Group> groups_;
  std::vector<std::uint32_t> first_;  // by row: where its wheels begin
  std::vector<std::uint32_t> order_;
  SolverBodies<S>* bodies_ = nullptr;
  S rate_ = S(1);
  Step<S> h_ = {};
};

}  // namespace isostep
