// Bodies of stopped_mechanisms.hpp.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/dynamics/joints/joint_kinds.hpp"
#include "isostep/systems/continuous/first_impacts.inl"
#include "isostep/systems/continuous/joined_bodies.inl"
#include "isostep/systems/continuous/stopped_bodies.inl"
#include "isostep/systems/continuous/stopped_mechanisms.hpp"

namespace isostep {

namespace detail {
/// The most times that a mechanism is placed because a body of it would pass something: the way of a body with its
/// joints differs from the way along which it was swept by the square of what they turn. The first half of the placings
/// closes joints, which moves bodies even at fraction 0.
inline constexpr int kMostPlacings = 8;
/// [1] The least part of the way to where it is stopped that a mechanism keeps. With less it would make no progress.
template <class S> inline constexpr Unit<S> kLeastPart = Unit<S>(0.125);
/// Returns the heaviest body. Ties go to the first.
template <class S>
std::uint32_t heaviest_of(std::span<const std::uint32_t> bodies, std::span<const BodyProperties<S>> properties) {
  std::uint32_t heaviest = bodies[0];
  for (const std::uint32_t body : bodies) {
    if (properties[heaviest].mass < properties[body].mass) heaviest = body;
  }
  return heaviest;
}
/// [1] Returns the share by which a joint may move a body towards its other body: the lighter one follows the heavier.
template <class S>
Unit<S> share_of_pull(const WorldState<S>& state, const BodyMap<S>& map, const typename JoinedBodies<S>::Link& link) {
  const JointProperties<S>& joint = state.joints.properties[link.joint];
  const std::uint32_t holder = link.is_b ? joint.body_a : joint.body_b;
  const S own = state.awake.properties[link.body].mass;
  if (holder == kNoBody || map.location(holder).set != Location::kAwake) return Unit<S>(1);
  const BodyProperties<S>& other = state.awake.properties[map.location(holder).index];
  return other.type == BodyType::dynamic && other.mass < own ? divide_to<Unit<S>>(other.mass, own) : Unit<S>(1);
}
template <class S> Aabb<S> swept_box(const CoreMotion<S>& motion, S reach) {
  const Vec3<S> all = {reach, reach, reach};
  const Aabb<S> start = Aabb<S>::around(motion.start.position, all), end = Aabb<S>::around(motion.end.position, all);
  return grow(merge(start, end), kFatMargin<S>);
}
template <class S> Vec3<S> no_longer_than(Vec3<S> v, S most) {
  const S size = length(v);
  return most < size ? v * divide_to<Unit<S>>(most, size) : v;
}
/// [rad] Two bodies that turn by less in a step turn by less than half a turn relative to each other.
template <class S> inline constexpr S kFarTurn = S(1.5);
}  // namespace detail

/// Stops mechanisms. If one body of a ragdoll stopped alone, the rest would tear from it in this step: a limb at 60 m/s
/// by 0.4 m. If each body went the same fraction of its own straight way, whirling limbs would part by the difference
/// of arcs and chords, 0.17 m. So the joints go a fraction of their motions, and held points stay held. As for a single
/// body, the rest of the step's time is lost. A mechanism that nothing stopped stays as it is: fast bodies depend on
/// other islands, results must not.
template <class S> void StoppedMechanisms<S>::update() {
  if (fast_.movers().empty() || state_.joints.properties.empty()) return;
  joined_bodies_.begin();
  ends_.resize(state_.awake.states.size());
  fast_.number();
  for (const Mover<S>& mover : fast_.movers()) {
    if (!joined_bodies_.is_known(mover.index)) stop(joined_bodies_.find(mover.index));
  }
}

/// Stops one mechanism. A body that would pass something where its joint puts it becomes the new root. If that does not
/// help, each body goes its own free way, and joints come apart: a mechanism that stood still instead would never lose
/// the speed that presses it against a wall.
template <class S> void StoppedMechanisms<S>::stop(std::span<const std::uint32_t> mechanism) {
  const bool hangs = joined_bodies_.is_held();
  if (mechanism.size() == 1 && !hangs) return;
  keep_ends(mechanism);
  const Leader leader = leader_of(mechanism);
  if (leader.fraction == Unit<S>(1)) return;
  const bool carried = meets_carrier(mechanism);  // what may have stopped it goes on with it
  std::uint32_t root = detail::heaviest_of<S>(mechanism, state_.awake.properties);
  Unit<S> part = Unit<S>(1);
  bool is_free = false;
  for (int times = 0; times < detail::kMostPlacings && !is_free; ++times) {
    const std::span<const Link> tree = joined_bodies_.tree_from(root);
    place_tree(tree, leader.fraction * part, times < detail::kMostPlacings / 2);
    const Obstruction worst = worst_of(tree);
    is_free = worst.part == Unit<S>(1);
    part = part * worst.part;
    if (!carried && !(part < detail::kLeastPart<S>)) continue;
    if (hangs) break;
    root = worst.body;
    part = Unit<S>(1);
  }
  for (const std::uint32_t body : mechanism) {
    if (!is_free) bodies_.put_at(body, own_way(body, leader.fraction));
    bodies_.place(body);
  }
}

/// Keeps the poses that the solver found. Stopped bodies are elsewhere by now.
template <class S> void StoppedMechanisms<S>::keep_ends(std::span<const std::uint32_t> mechanism) {
  for (const std::uint32_t body : mechanism) {
    const Mover<S>* const mover = fast_.mover_of(body);
    ends_[body] = mover == nullptr ? motion_.now(body) : mover->to();
  }
}

/// Finds the body that was stopped first. Ties go to the lowest index.
template <class S>
typename StoppedMechanisms<S>::Leader StoppedMechanisms<S>::leader_of(std::span<const std::uint32_t> mechanism) const {
  Leader first = {mechanism[0], Unit<S>(1)};
  for (const std::uint32_t body : mechanism) {
    const Mover<S>* const mover = fast_.mover_of(body);
    const Unit<S> fraction = mover == nullptr ? Unit<S>(1) : mover->fraction;
    if (fraction < first.fraction || (fraction == first.fraction && body < first.body)) first = {body, fraction};
  }
  return first;
}

template <class S> bool StoppedMechanisms<S>::meets_carrier(std::span<const std::uint32_t> mechanism) const {
  if (fast_.carriers().empty()) return false;
  for (const std::uint32_t body : mechanism) {
    const CoreMotion<S> way = {motion_.start(body), ends_[body], Vec3<S>::zero()};
    const Aabb<S> swept = detail::swept_box(way, motion_.measure(body).reach);
    for (const auto& carrier : fast_.carriers()) {
      if (overlap(carrier.swept, swept)) return true;
    }
  }
  return false;
}

template <class S> void StoppedMechanisms<S>::place_tree(std::span<const Link> tree, Unit<S> fraction, bool closes) {
  for (const Link& link : tree) {
    const bool is_root = link.joint == JoinedBodies<S>::kNone;
    const Pose<S> own = own_way(link.body, fraction);
    if (is_root) {
      bodies_.put_at(link.body, own);
      continue;
    }
    Pose<S> there = joined_pose(link, fraction, closes);
    const S most = length(ends_[link.body].position - motion_.start(link.body).position) *
                   detail::share_of_pull(state_, map_, link);
    there.position = own.position + detail::no_longer_than(there.position - own.position, most);
    bodies_.put_at(link.body, there);
  }
}

/// Returns the pose of a body after a fraction of the step, which is at most the free part of the body's own way.
template <class S> Pose<S> StoppedMechanisms<S>::own_way(std::uint32_t body, Unit<S> fraction) {
  if (const Mover<S>* const mover = fast_.mover_of(body))
    return mover->fraction == fraction ? mover->stopped : mover->way(fraction);
  bodies_.put_at(body, ends_[body]);
  return motion_.measure(body).way(fraction);
}

/// Returns the pose that a joint gives a body after a fraction of the step, with its other body where that is now.
/// `closes`: the joint closes the gap that the solver left.
template <class S> Pose<S> StoppedMechanisms<S>::joined_pose(const Link& link, Unit<S> fraction, bool closes) {
  const JointProperties<S>& p = state_.joints.properties[link.joint];
  const Pose<S>& frame = link.is_b ? p.frame_b : p.frame_a;
  const Carriage other = carriage_of(link.is_b ? p.body_a : p.body_b, link.is_b ? p.frame_a : p.frame_b);
  const Pose<S> start = detail::pose_from(other.start, compose(motion_.start(link.body), frame));
  const Pose<S> end = detail::pose_from(other.end, compose(ends_[link.body], frame));
  Pose<S> joint = pose_at<S>({start, end, Vec3<S>::zero()}, fraction);
  if (closes && holds_point(p)) joint.position = Vec3<S>::zero();
  if (joins_two_points(p.type)) {
    const S from = length(start.position), to = length(end.position);
    joint.position = heading_of(joint.position).direction * (from + (to - from) * fraction);
  }
  Pose<S> there = compose(other.now, joint);
  if (turns_far(p.body_a) || turns_far(p.body_b))
    there.orientation = own_way(link.body, fraction).orientation * frame.orientation;
  return held_by_locks(link.body, there, frame);
}

/// Returns true if a body turns so far that two poses of a joint do not tell the turn.
template <class S> bool StoppedMechanisms<S>::turns_far(std::uint32_t slot) const {
  if (slot == kNoBody || map_.location(slot).set != Location::kAwake) return false;
  const Vec3<S> spin = convert<S>(map_.state_at(map_.location(slot)).angular_velocity);
  return !(heading_of(spin).length / S(state_.settings.hz) < detail::kFarTurn<S>);
}

template <class S>
typename StoppedMechanisms<S>::Carriage StoppedMechanisms<S>::carriage_of(std::uint32_t slot,
                                                                          const Pose<S>& frame) const {
  const Pose<S> here = map_.centre_pose_at(slot);
  Carriage of = {here, here, compose(here, frame)};
  if (slot != kNoBody && map_.location(slot).set == Location::kAwake) {
    const std::uint32_t index = map_.location(slot).index;
    of.start = motion_.start(index);
    if (state_.awake.properties[index].type == BodyType::dynamic) of.end = ends_[index];
  }
  of.start = compose(of.start, frame);
  of.end = compose(of.end, frame);
  return of;
}

/// Returns the pose of a body with one of its frames at `there`, as far as its locked axes allow.
template <class S>
Pose<S> StoppedMechanisms<S>::held_by_locks(std::uint32_t index, const Pose<S>& there, const Pose<S>& frame) const {
  const std::uint32_t flags = state_.awake.properties[index].flags;
  const Pose<S>& start = motion_.start(index);
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

/// [1] Returns the part of the way to its place in which a body passes nothing. A shallow overlap, which contacts push
/// out in a step, counts as free. For the middle of a part only a graze does.
template <class S> Unit<S> StoppedMechanisms<S>::free_part(std::uint32_t body) {
  if (!motion_.may_move(body)) return Unit<S>(1);
  Mover<S> mover = motion_.measure(body);
  mover.closely = true;
  const S shallow = mover.inner * S(0.25), least = min(shallow, detail::kGraze<S> * S(0.5));
  if (!(least < mover.motion)) return Unit<S>(1);
  const MotionCut<S> cut = impacts_.find(mover, false);
  const auto part_of = [&](Unit<S> fraction, S deep) {
    return deep < mover.motion * (Unit<S>(1) - fraction) ? fraction : Unit<S>(1);
  };
  return min(part_of(cut.fraction, shallow), part_of(cut.fraction_of_middle, least));
}
/// Returns the body with the least free part. Ties go to the first of the tree. The root's own way is free.
template <class S>
typename StoppedMechanisms<S>::Obstruction StoppedMechanisms<S>::worst_of(std::span<const Link> tree) {
  Obstruction worst = {tree[0].body, Unit<S>(1)};
  for (const Link& link : tree) {
    const Unit<S> part = link.joint == JoinedBodies<S>::kNone ? Unit<S>(1) : free_part(link.body);
    if (part < worst.part) worst = {link.body, part};
  }
  return worst;
}

}  // namespace isostep
