// ContinuousCollision: what joints tie together stops together.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/dynamics/joints/joint_kinds.hpp"
#include "isostep/world/continuous_collision.inl"

namespace isostep {

namespace detail {
/// Times that a mechanism is put back a little more because a body of it would pass something: the way that a body goes
/// with its joints and the one that it was swept along differ by the square of what they turn. In the first two joints
/// are closed, which moves bodies even in no time. From the fourth on it goes as it was, without a turn.
inline constexpr int kClosingTimes = 2, kTurningTimes = 3, kMostTimes = 6;
/// [m] What fast mechanisms' joints may be apart: a solver takes turns of a sub-step as straight, and 100 rad/s are 0.2
/// rad in one.
template <class S> inline constexpr S kJointSlack = S(0.0009765625);
}  // namespace detail

/// One body that stops alone is torn from the rest by what that still moves in this step: a limb of a ragdoll at 60 m/s
/// by 0.4 m. If each went as far along its own straight way, whirling limbs would be apart by what arcs differ from
/// chords, 0.17 m. So it is the joints that go part of their ways, and what they hold is held. As at an impact of one
/// body, the rest of the step's time is lost. Mechanisms that are fast and stopped by nothing are closed alike.
template <class S> void ContinuousCollision<S>::stop_joined() {
  if (movers_.empty() || state_.joints.properties.empty()) return;
  const std::size_t count = state_.awake.states.size();
  joined_bodies_.begin();
  ends_.resize(count);
  mover_of_.assign(count, 0);
  for (std::size_t i = 0; i < movers_.size(); ++i) mover_of_[movers_[i].index] = static_cast<std::uint32_t>(i + 1);
  for (const Mover& mover : movers_) {
    if (!joined_bodies_.is_known(mover.index)) stop_mechanism(joined_bodies_.find(mover.index));
  }
}

template <class S> void ContinuousCollision<S>::stop_mechanism(std::span<const std::uint32_t> mechanism) {
  keep_ends(mechanism);
  Course course = course_of(mechanism);
  const std::span<const Link> tree = joined_bodies_.tree_from(course.root);
  if (tree.size() == 1 && tree[0].joint == JoinedBodies<S>::kNone) return;
  if (course.fraction == Unit<S>(1) && !is_apart(tree)) return;
  for (int times = 0; times <= detail::kMostTimes; ++times) {
    course.closes = times < detail::kClosingTimes;
    course.turns = times < detail::kTurningTimes;
    if (times == detail::kTurningTimes) course.part = Unit<S>(1);
    if (times == detail::kMostTimes) course.part = Unit<S>(0);
    place_tree(tree, course);
    const Unit<S> free = times == detail::kMostTimes ? Unit<S>(1) : free_part(tree);
    if (free == Unit<S>(1)) break;
    course.part = course.part * free;
  }
  for (const Link& link : tree) place(link.body);
}

/// Those that were stopped are elsewhere by now.
template <class S> void ContinuousCollision<S>::keep_ends(std::span<const std::uint32_t> mechanism) {
  for (const std::uint32_t body : mechanism) {
    const std::uint32_t mover = mover_of_[body];
    ends_[body] = mover == 0 ? now(body) : movers_[mover - 1].poses[movers_[mover - 1].pieces];
  }
}

/// As far as the first that was stopped, and it from there on; if none was, the heaviest keeps its place. Ties: the
/// lowest slot.
template <class S>
typename ContinuousCollision<S>::Course ContinuousCollision<S>::course_of(
    std::span<const std::uint32_t> mechanism) const {
  const auto fraction_of = [&](std::uint32_t body) {
    return mover_of_[body] == 0 ? Unit<S>(1) : movers_[mover_of_[body] - 1].fraction;
  };
  std::uint32_t first = mechanism[0], heaviest = first;
  for (const std::uint32_t body : mechanism) {
    const S mass = state_.awake.properties[body].mass, most = state_.awake.properties[heaviest].mass;
    if (most < mass || (most == mass && body < heaviest)) heaviest = body;
    const Unit<S> fraction = fraction_of(body), least = fraction_of(first);
    if (fraction < least || (fraction == least && body < first)) first = body;
  }
  const Vec3<S> way = ends_[heaviest].position - start_[heaviest].position;
  if (fraction_of(first) == Unit<S>(1)) return {heaviest, ends_[heaviest], Unit<S>(1), Unit<S>(1), way, true, true};
  const Mover& mover = movers_[mover_of_[first] - 1];
  return {first, mover.stopped, mover.fraction, Unit<S>(1), way, true, true};
}

template <class S> bool ContinuousCollision<S>::is_apart(std::span<const Link> tree) const {
  for (const Link& link : tree) {
    if (link.joint == JoinedBodies<S>::kNone || !holds_point(state_.joints.properties[link.joint])) continue;
    const JointProperties<S>& p = state_.joints.properties[link.joint];
    const Pose<S> a = map_.centre_pose_at(p.body_a), b = map_.centre_pose_at(p.body_b);
    const Vec3<S> arm_a = rotate(a.orientation, p.frame_a.position), arm_b = rotate(b.orientation, p.frame_b.position);
    if (detail::kJointSlack<S> < max_abs((b.position - a.position) + (arm_b - arm_a))) return true;
  }
  return false;
}

template <class S> void ContinuousCollision<S>::place_tree(std::span<const Link> tree, const Course& course) {
  const bool hangs = tree[0].joint != JoinedBodies<S>::kNone;
  const Vec3<S> way = hangs ? Vec3<S>::zero() : course.way * course.part;
  for (const Link& link : tree) {
    const Pose<S>& start = start_[link.body];
    if (!course.turns) put_at(link.body, {start.position + way, start.orientation});
    else if (link.joint != JoinedBodies<S>::kNone) put_at(link.body, joined_pose(link, course));
    else put_at(link.body, pose_at<S>({start, course.end, Vec3<S>::zero()}, course.part));
  }
}

/// Where its joint has a body, while the joint's other body is where it is now.
template <class S> Pose<S> ContinuousCollision<S>::joined_pose(const Link& link, const Course& course) const {
  const JointProperties<S>& p = state_.joints.properties[link.joint];
  const Pose<S>& frame = link.is_b ? p.frame_b : p.frame_a;
  const Carriage other = carriage_of(link.is_b ? p.body_a : p.body_b, link.is_b ? p.frame_a : p.frame_b);
  const Pose<S> start = detail::pose_from(other.start, compose(start_[link.body], frame));
  const Pose<S> end = detail::pose_from(other.end, compose(ends_[link.body], frame));
  const Unit<S> fraction = course.fraction * course.part;
  Pose<S> joint = pose_at<S>({start, end, Vec3<S>::zero()}, fraction);
  if (course.closes && holds_point(p)) joint.position = Vec3<S>::zero();
  if (joins_two_points(p.type)) {
    const S from = length(start.position), to = length(end.position);
    joint.position = heading_of(joint.position).direction * (from + (to - from) * fraction);
  }
  return held_by_locks(link.body, compose(other.now, joint), frame);
}

template <class S>
typename ContinuousCollision<S>::Carriage ContinuousCollision<S>::carriage_of(std::uint32_t slot,
                                                                              const Pose<S>& frame) const {
  const Pose<S> here = map_.centre_pose_at(slot);
  Carriage of = {here, here, compose(here, frame)};
  if (slot != kNoBody && map_.location(slot).set == Location::kAwake) {
    const std::uint32_t index = map_.location(slot).index;
    of.start = start_[index];
    if (state_.awake.properties[index].type == BodyType::dynamic) of.end = ends_[index];
  }
  of.start = compose(of.start, frame);
  of.end = compose(of.end, frame);
  return of;
}

/// A body one of whose frames is there, as far as its locked axes let it.
template <class S>
Pose<S> ContinuousCollision<S>::held_by_locks(std::uint32_t index, const Pose<S>& there, const Pose<S>& frame) const {
  const std::uint32_t flags = state_.awake.properties[index].flags;
  const Pose<S>& start = start_[index];
  Quat<Unit<S>> orientation = normalise(there.orientation * conjugate(frame.orientation));
  if ((flags & body_flag::kAngularLocks) != 0) {
    Quat<Unit<S>> turn = orientation * conjugate(start.orientation);
    Unit<S>* const axes[] = {&turn.x, &turn.y, &turn.z};
    for (std::uint32_t i = 0; i < 3; ++i) {
      if ((flags & body_flag::kLockAngularX << i) != 0) *axes[i] = Unit<S>(0);
    }
    orientation = normalise(normalise(turn) * start.orientation);
  }
  Vec3<S> position = there.position - rotate(orientation, frame.position);
  for (int i = 0; i < 3; ++i) {
    if ((flags & body_flag::kLockX << i) != 0) position[i] = start.position[i];
  }
  return {position, orientation};
}

/// The least part of its way from the start up to which a body passes nothing, but for as much as two sweeps of one
/// motion may differ.
template <class S> Unit<S> ContinuousCollision<S>::free_part(std::span<const Link> tree) {
  Unit<S> least = Unit<S>(1);
  for (const Link& link : tree) {
    if (!may_move(link.body)) continue;
    Mover mover = measure(link.body);
    mover.closely = true;
    const S slack = min(mover.inner * S(0.125), detail::kGraze<S> * S(0.5));
    if (!(slack < mover.motion)) continue;
    const Cut cut = first_impact(mover, false);
    const Unit<S> fraction = min(cut.fraction, cut.fraction_of_middle);
    if (slack < mover.motion * (Unit<S>(1) - fraction)) least = min(least, fraction);
  }
  return least;
}

}  // namespace isostep
