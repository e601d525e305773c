// Bodies of body_finisher.hpp.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/dynamics/checks.hpp"
#include "isostep/dynamics/solvers/step_context.hpp"
#include "isostep/math/shortened.hpp"
#include "isostep/store/fat_box.inl"
#include "isostep/systems/motion/body_finisher.hpp"

namespace isostep {

namespace detail {
// Bodies that a thread finishes while another wakes, and so the fewest of a piece.
inline constexpr std::uint32_t kLeastFinished = 128;
}  // namespace detail

template <class S>
void BodyFinisher<S>::finish(std::span<const Pose<S>> start, std::span<const std::uint8_t> cut,
                             const TaskRunner& runner, StepReport& report) {
  const Settings<S>& settings = state_.settings;
  const auto bodies = static_cast<std::uint32_t>(state_.awake.states.size());
  const auto threads = static_cast<std::uint32_t>(max(runner.threads, std::int32_t{1}));
  const std::int32_t rate = integration_rate(settings.solver, settings.hz, settings.substeps);
  moved_.resize(bodies);
  Job job = {this, start, cut, angular_speed_limit<S>(rate), piece_count(bodies, detail::kLeastFinished, threads),
             {},   {}};
  run_stages(job.pieces > 1 ? runner : TaskRunner{}, {&job.pieces, 1}, &BodyFinisher::run_piece, &job);
  for (std::uint32_t piece = 0; piece < job.pieces; ++piece) {
    report.clamped_speed += job.reports[piece].clamped_speed;
    report.clamped_position += job.reports[piece].clamped_position;
    report.stopped += job.reports[piece].stopped;
    const std::size_t first = std::size_t{bodies} * piece / job.pieces;
    for (std::size_t i = first; i < first + job.moved[piece]; ++i)
      proxies_.place(state_.awake.states[moved_[i]], state_.awake.properties[moved_[i]], true);
  }
  if (report.stopped > 0) discard_bad_impulses();
}
template <class S> void BodyFinisher<S>::run_piece(void* job, std::uint32_t, std::uint32_t piece) {
  Job& all = *static_cast<Job*>(job);
  all.finisher->finish_piece(all, piece);
}

template <class S> void BodyFinisher<S>::finish_piece(Job& job, std::uint32_t piece) {
  const std::size_t bodies = state_.awake.states.size();
  const std::size_t first = bodies * piece / job.pieces, end = bodies * (piece + 1) / job.pieces;
  StepReport& report = job.reports[piece];
  std::size_t moved = first;
  for (std::size_t i = first; i < end; ++i) {
    BodyState<S>& state = state_.awake.states[i];
    const BodyProperties<S>& body = state_.awake.properties[i];
    stop_if_not_finite(state, job.start[i], report);
    const bool too_fast = clamp_speed(state, body, job.angular_limit);
    report.clamped_speed += too_fast || (!job.cut.empty() && job.cut[i] != 0);
    clamp_position(state, report);
    detail::renew_fat_box(map_, state, body, false);
    if (!proxies_.is_placed(state, body, true)) moved_[moved++] = static_cast<std::uint32_t>(i);
  }
  job.moved[piece] = moved - first;
}

/// Stops a body with a number that is not finite, and puts it back to its pose at the start of the step.
template <class S>
ISO_INLINE void BodyFinisher<S>::stop_if_not_finite(BodyState<S>& state, const Pose<S>& start, StepReport& report) {
  const auto& q = state.orientation;
  const bool finite = is_finite(state.centre) && is_finite(state.velocity) && is_finite(state.angular_velocity) &&
                      is_finite(q.x) && is_finite(q.y) && is_finite(q.z) && is_finite(q.w);
  if (finite) return;
  state.centre = start.position;
  state.orientation = start.orientation;
  state.velocity = Vec3<Velocity<S>>::zero();
  state.angular_velocity = Vec3<Velocity<S>>::zero();
  ++report.stopped;
}

template <class S>
ISO_INLINE bool BodyFinisher<S>::clamp_speed(BodyState<S>& state, const BodyProperties<S>& body,
                                             Velocity<S> angular_limit) const {
  using V = Velocity<S>;
  const V speed = convert<V>(Limits<S>::speed());
  Aabb<S> box = state.fat;
  bool rotates_too_fast = detail::rotates_too_fast(state.angular_velocity, box);
  if (rotates_too_fast) {
    box = detail::solid_box(map_, state, body);
    rotates_too_fast = detail::rotates_too_fast(state.angular_velocity, box);
  }
  if (!(detail::is_longer(state.velocity, speed) || detail::is_longer(state.angular_velocity, angular_limit) ||
        rotates_too_fast))
    return false;
  const S most =
      rotates_too_fast ? Limits<S>::surface_speed() / max_abs(box.high - box.low) : Limits<S>::angular_speed();
  state.velocity = detail::shortened(state.velocity, speed);
  state.angular_velocity = detail::shortened(state.angular_velocity, min(angular_limit, convert<V>(most)));
  return true;
}

/// Stops a body at the edge of the world.
template <class S> ISO_INLINE void BodyFinisher<S>::clamp_position(BodyState<S>& state, StepReport& report) {
  const S edge = Limits<S>::position();
  if (!(edge < max_abs(state.centre))) return;
  const Vec3<S> c = state.centre;
  state.centre = {clamp(c.x, -edge, edge), clamp(c.y, -edge, edge), clamp(c.z, -edge, edge)};
  for (int axis = 0; axis < 3; ++axis) {
    if (!(state.centre[axis] == c[axis])) state.velocity[axis] = Velocity<S>(0);
  }
  ++report.clamped_position;
}

/// Clears impulses that are not finite: a stopped body leaves contacts and joints with such impulses behind.
template <class S> void BodyFinisher<S>::discard_bad_impulses() {
  using V = Velocity<S>;
  for (Contact<S>& contact : state_.contacts) {
    bool finite = is_finite(contact.friction_impulse) && is_finite(contact.twist_impulse);
    for (const V impulse : contact.normal_impulse) finite = finite && is_finite(impulse);
    if (finite) continue;
    for (V& impulse : contact.normal_impulse) impulse = V(0);
    contact.friction_impulse = Vec3<V>::zero();
    contact.twist_impulse = V(0);
  }
  for (JointState<S>& joint : state_.joints.states) {
    if (is_finite(joint.point) && is_finite(joint.angular)) continue;
    JointState<S> fresh = {};
    fresh.slot = joint.slot;
    joint = fresh;
  }
}

}  // namespace isostep
