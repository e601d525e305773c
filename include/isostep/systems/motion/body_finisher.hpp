// BodyFinisher<S>: keeps what a step moved within the scalar's range.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "isostep/core/instantiate.hpp"
#include "isostep/core/task_runner.hpp"
#include "isostep/store/body_map.hpp"
#include "isostep/store/events.hpp"
#include "isostep/store/proxies.hpp"

namespace isostep {

/// Input:   the state after the solver; the poses of the awake bodies' centres as the step began; whom the solver cut.
/// Output:  the state with only finite numbers, all within Limits<S>; counts of changes in the report; fat boxes, and
///          their proxies.
/// Keeps:   memory.
template <class S> class BodyFinisher {
 public:
  ISO_INLINE BodyFinisher(WorldState<S>& state, const BodyMap<S>& map, Proxies<S>& proxies)
      : state_(state), map_(map), proxies_(proxies) {}

  /// `cut`: for each awake body, 1 if the solver cut its speed in a sub-step already. Empty for none.
  void finish(std::span<const Pose<S>> start, std::span<const std::uint8_t> cut, const TaskRunner& runner,
              StepReport& report);

 private:
  /// Holds what the pieces of the work share, and what each of them has found.
  struct Job {
    BodyFinisher* finisher;
    std::span<const Pose<S>> start;
    std::span<const std::uint8_t> cut;
    Velocity<S> angular_limit;
    std::uint32_t pieces;
    StepReport reports[kMaxPieces];
    std::size_t moved[kMaxPieces];  // bodies
  };
  static void run_piece(void* job, std::uint32_t stage, std::uint32_t piece);
  void finish_piece(Job& job, std::uint32_t piece);
  static void stop_if_not_finite(BodyState<S>& state, const Pose<S>& start, StepReport& report);
  bool clamp_speed(BodyState<S>& state, const BodyProperties<S>& body, Velocity<S> angular_limit) const;
  static void clamp_position(BodyState<S>& state, StepReport& report);
  void discard_bad_impulses();

  WorldState<S>& state_;
  const BodyMap<S>& map_;
  Proxies<S>& proxies_;
  std::vector<std::uint32_t> moved_;  // bodies whose proxies are to be renewed, of each piece from its first body on
};

#define ISO_BODY_FINISHER_OF(extern, S) extern template class BodyFinisher<S>;
ISO_EXTERN_FOR_EACH_SCALAR(ISO_BODY_FINISHER_OF)

}  // namespace isostep
