// Bodies of step_motion.hpp.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/collision/continuous/shape_impact.hpp"
#include "isostep/geometry/bounds.hpp"
#include "isostep/store/fat_box.hpp"
#include "isostep/systems/continuous/body_path.inl"
#include "isostep/systems/continuous/step_motion.hpp"

namespace isostep {

namespace detail {
/// Returns a part of a body, in a frame at its centre of mass with the body's axes.
template <class S>
PlacedShape<S> placed_part(const BodyMap<S>& map, const BodyProperties<S>& body, const Child<S>& child) {
  const Pose<S> at = {child.pose.position - body.local_centre, child.pose.orientation};
  return {map.shapes.contents().view(child.primitive), Transform<S>::of(at)};
}
}  // namespace detail

template <class S> bool StepMotion<S>::may_move(std::size_t index) const {
  const BodyProperties<S>& body = state_.awake.properties[index];
  return body.type == BodyType::dynamic && map_.shapes.has_contacts(body);
}
template <class S> bool StepMotion<S>::is_at_rest(Location at) const {
  if (at.set != Location::kAwake) return true;
  const BodyState<S>& body = state_.awake.states[at.index];
  return start_[at.index].position == body.centre && start_[at.index].orientation == body.orientation;
}

/// Finds the path of a body. Two orientations do not reveal a turn of more than half a turn. The angular velocity does,
/// if it leads from the first to the second.
template <class S> BodyPath<S> StepMotion<S>::path_of(std::size_t index) const {
  using U = Unit<S>;
  constexpr std::uint32_t kPieces = BodyPath<S>::kMostPieces;
  const Pose<S> from = start_[index], to = now(index);
  const auto spin = heading_of(convert<S>(state_.awake.states[index].angular_velocity));
  const S turn = spin.length / S(state_.settings.hz);
  BodyPath<S> path = {1, {from, to}};
  if (turn < S(2)) return path;
  Quat<U> turned[kPieces + 1];
  for (std::uint32_t i = 1; i <= kPieces; ++i) {
    const SinCos<U> half = sin_cos_to<U>(turn * detail::share_of<S>(i, kPieces) * U(0.5));
    const Vec3<U> axis = spin.direction * half.sin;
    turned[i] = normalise(Quat<U>{axis.x, axis.y, axis.z, half.cos} * from.orientation);
  }
  const Quat<U> error = turned[kPieces] * conjugate(to.orientation);
  if (abs(error.w) < U(0.875)) return path;
  path.pieces = kPieces;
  const Vec3<S> way = to.position - from.position;
  for (std::uint32_t i = 1; i < kPieces; ++i)
    path.poses[i] = {from.position + way * detail::share_of<S>(i, kPieces), turned[i]};
  path.poses[kPieces] = to;
  return path;
}
template <class S> Mover<S> StepMotion<S>::measure(std::size_t index, const BodyPath<S>& path) const {
  const BodyProperties<S>& body = state_.awake.properties[index];
  Mover<S> mover = {};
  static_cast<BodyPath<S>&>(mover) = path;
  mover.index = static_cast<std::uint32_t>(index);
  mover.fraction = Unit<S>(1);
  mover.stopped = mover.to();
  mover.inner = detail::kThick<S>;
  const Transform<S> turned[] = {{Vec3<S>::zero(), to_matrix(mover.from().orientation)},
                                 {Vec3<S>::zero(), to_matrix(mover.to().orientation)}};
  for (const Child<S>& child : map_.shapes.children_of(body.shape)) {
    if (child.traits.has(part_flag::kSensor)) continue;
    const PlacedShape<S> part = detail::placed_part(map_, body, child);
    const Aabb<S> box = bounds(part.shape, part.at);
    mover.inner = min(mover.inner, thickness<S>(part.shape));
    mover.reach = max(mover.reach, length(max(abs(box.low), abs(box.high))));
    for (const Transform<S>& t : turned) mover.around = merge(mover.around, bounds(part.shape, compose(t, part.at)));
  }
  const Vec3<S> all = {mover.reach, mover.reach, mover.reach};
  if (mover.pieces > 1) mover.around = Aabb<S>::around(Vec3<S>::zero(), all);
  const S bow = min(detail::bow_of(mover.motion_of(0), mover.reach), mover.reach);
  mover.around = grow(mover.around, bow + bow + detail::kFatMargin<S>);
  for (std::uint32_t i = 0; i < mover.pieces; ++i) mover.motion += detail::most_motion(mover.motion_of(i), mover.reach);
  return mover;
}

}  // namespace isostep
