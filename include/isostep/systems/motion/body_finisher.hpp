// BodyFinisher<S>: keeps what a step moved within the scalar's range.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "isostep/core/instantiate.hpp"
#include "isostep/store/body_map.hpp"
#include "isostep/store/events.hpp"
#include "isostep/store/proxies.hpp"

namespace isostep {

/// Input:   the state after the solver; the poses of the awake bodies' centres as the step began; whom the solver cut.
/// Output:  the state with only finite numbers, all within Limits<S>; counts of changes in the report; fat boxes, and
///          their proxies.
/// Keeps:   nothing.
template <class S> class BodyFinisher {
 public:
  ISO_INLINE BodyFinisher(WorldState<S>& state, const BodyMap<S>& map, Proxies<S>& proxies)
      : state_(state), map_(map), proxies_(proxies) {}

  /// `cut`: for each awake body, 1 if the solver cut its speed in a sub-step already. Empty for none.
  void finish(std::span<const Pose<S>> start, std::span<const std::uint8_t> cut, StepReport& report);

 private:
  static void stop_if_not_finite(BodyState<S>& state, const Pose<S>& start, StepReport& report);
  bool clamp_speed(BodyState<S>& state, const BodyProperties<S>& body, Velocity<S> angular_limit) const;
  static void clamp_position(BodyState<S>& state, StepReport& report);
  void discard_bad_impulses();

  WorldState<S>& state_;
  const BodyMap<S>& map_;
  Proxies<S>& proxies_;
};

#define ISO_BODY_FINISHER_OF(extern, S) extern template class BodyFinisher<S>;
ISO_EXTERN_FOR_EACH_SCALAR(ISO_BODY_FINISHER_OF)

}  // namespace isostep
