// Bodies of pair_sweep.hpp.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/store/body_frames.hpp"
#include "isostep/systems/continuous/impact_filter.inl"
#include "isostep/systems/continuous/pair_sweep.hpp"
#include "isostep/systems/continuous/step_motion.inl"

namespace isostep {

namespace detail {
/// [m] The least motion by which a body that was beyond contact distance can end deep inside another.
template <class S> inline constexpr S kDeepMotion = kSpeculativeDistance<S> + kTooDeep<S>;

/// Returns the box around a part on all of its way, with room for what it nearly touches.
template <class S> Aabb<S> swept_bounds(const PlacedShape<S>& part, const CoreMotion<S>& motion) {
  const auto at = [&](const Pose<S>& pose) { return bounds(part.shape, compose(Transform<S>::of(pose), part.at)); };
  if (is_still(motion)) return grown_with_slack<S>(at(motion.start), kSpeculativeDistance<S>);
  const Aabb<S> own = bounds(part.shape, part.at);
  const S reach = length(max(abs(own.low - motion.centre), abs(own.high - motion.centre)));
  const S bow = min(bow_of(motion, reach), reach + reach);
  return grown_with_slack<S>(merge(at(motion.start), at(motion.end)), bow + kSpeculativeDistance<S>);
}
/// Returns true if a part ends deep in an obstacle. A box smaller by that depth rejects most pairs first.
template <class S>
bool ends_deep(const PlacedShape<S>& part, const Pose<S>& end, const PlacedShape<S>& met, const Pose<S>& place) {
  const S deep = min(thickness<S>(part.shape) * S(0.5), kTooDeep<S>);
  const Aabb<S> box = bounds(part.shape, compose(Transform<S>::of(end), part.at));
  const Aabb<S> other = bounds(met.shape, compose(Transform<S>::of(place), met.at));
  return overlap(grow(box, -deep), other) && is_deep(part, end, met, place);
}
/// Shortens a motion to the fraction `all`, with the pose `there` in the world. `at_rest`: no kinematic body stops it.
template <class S>
void shorten(MotionCut<S>& cut, const FreeWay<S>& way, Unit<S> all, const Pose<S>& there, bool at_rest) {
  if (!way.is_held && all < cut.fraction) {
    cut.fraction = all;
    cut.pose = there;
  } else if (way.is_held && all < cut.fraction_of_middle) {
    cut.fraction_of_middle = all;
    cut.middle = way.middle;
    cut.place = there.position + rotate(there.orientation, way.middle);
    cut.normal = at_rest ? way.normal : Vec3<Unit<S>>::zero();
  }
}
}  // namespace detail

template <class S> Obstacle<S> PairSweep<S>::at_rest(std::uint32_t slot, S relative_motion) const {
  const Pose<S> place = map_.centre_pose_at(slot);
  return {slot, {place, place, Vec3<S>::zero()}, S(0), relative_motion, nullptr};
}

template <class S> void PairSweep<S>::sweep(const Mover<S>& mover, std::uint32_t slot, MotionCut<S>& cut) const {
  const Location at = map_.location(slot);
  if (!motion_.is_at_rest(at)) {
    if (state_.awake.properties[at.index].type == BodyType::dynamic) sweep_against_moving(mover, slot, at.index, cut);
    else sweep_against_kinematic(mover, slot, at.index, cut);
    return;
  }
  const Obstacle<S> obstacle = at_rest(slot, mover.motion);
  for (std::uint32_t i = 0; i < mover.pieces; ++i)
    sweep_piece(mover, {i, mover.pieces}, mover.motion_of(i), obstacle, cut);
}
/// Sweeps against a moving body. Both paths get as many pieces as the path that needs more.
template <class S>
void PairSweep<S>::sweep_against_moving(const Mover<S>& mover, std::uint32_t slot, std::size_t index,
                                        MotionCut<S>& cut) const {
  const BodyPath<S> path = motion_.path_of(index);
  const Pose<S> end = motion_.now(index);
  const Aabb<S> box = detail::solid_box(map_, state_.awake.states[index], state_.awake.properties[index]);
  const Vec3<S> sides = box.high - box.low;
  Obstacle<S> obstacle = {slot, {}, S(0), S(0), &end};
  for (std::uint32_t i = 0; i < path.pieces; ++i)
    obstacle.moved += detail::most_motion<S>({path.poses[i], path.poses[i + 1], Vec3<S>::zero()}, length(sides));
  obstacle.relative_motion = mover.motion + obstacle.moved;
  const std::uint32_t pieces = max(mover.pieces, path.pieces);
  for (std::uint32_t i = 0; i < pieces; ++i) {
    obstacle.motion = path.motion_in({i, pieces}, Vec3<S>::zero());
    sweep_piece(mover, {i, pieces}, mover.motion_in({i, pieces}, mover.centre), obstacle, cut);
  }
}
/// Sweeps in the frame of a kinematic body. If that turns, a straight way becomes an arc there. Pieces are so short
/// that the arc departs from its chord by at most a quarter of the inner radius: (2 w v + w^2 d) t^2 / 8 for turning by
/// w, a speed of v and a distance of d.
template <class S>
void PairSweep<S>::sweep_against_kinematic(const Mover<S>& mover, std::uint32_t slot, std::size_t index,
                                           MotionCut<S>& cut) const {
  constexpr std::uint32_t kMost = 32;
  const Pose<S> here = Pose<S>::identity(), end = motion_.now(index);
  const BodyPath<S> other = motion_.path_of(index);
  const auto seen_from = [&](Unit<S> fraction) {
    return detail::pose_from(other.pose_after(fraction, Vec3<S>::zero()), mover.way(fraction));
  };
  S turn = S(0);
  for (std::uint32_t i = 0; i < other.pieces; ++i)
    turn += convert<S>(detail::half_turn(other.poses[i], other.poses[i + 1])) * S(2);
  const Vec3<S> apart =
      max(abs(mover.from().position - other.poses[0].position), abs(mover.to().position - end.position));
  const S way = length(mover.to().position - mover.from().position) + length(end.position - other.poses[0].position);
  const S bow = turn * (way + way + turn * min(length(apart), S(256)));
  std::uint32_t pieces = max(mover.pieces, other.pieces);
  while (pieces < kMost && mover.inner * S(static_cast<std::int32_t>(2 * pieces * pieces)) < bow) pieces += pieces;
  Obstacle<S> obstacle = {slot, {here, here, Vec3<S>::zero()}, S(0), S(0), &end};
  CoreMotion<S> motions[kMost];
  for (std::uint32_t i = 0; i < pieces; ++i) {
    const Vec3<S> centre = i * mover.pieces < pieces ? mover.centre : Vec3<S>::zero();  // of its first piece
    const Unit<S> share = detail::share_of<S>(i + 1, pieces);
    motions[i] = {i == 0 ? seen_from(Unit<S>(0)) : motions[i - 1].end, seen_from(share), centre};
    obstacle.relative_motion += detail::most_motion(motions[i], mover.reach);
  }
  for (std::uint32_t i = 0; i < pieces; ++i) sweep_piece(mover, {i, pieces}, motions[i], obstacle, cut);
}

template <class S>
void PairSweep<S>::sweep_piece(const Mover<S>& mover, PathPiece piece, const CoreMotion<S>& motion,
                               const Obstacle<S>& obstacle, MotionCut<S>& cut) const {
  using U = Unit<S>;
  const bool moving = map_.properties_at(map_.location(obstacle.slot)).type == BodyType::dynamic;
  const auto sweep_parts = [&](const PlacedShape<S>& part, const PlacedShape<S>& met) {
    const S inner = thickness<S>(part.shape), thick = moving ? S(0) : thickness<S>(met.shape);
    const bool closely = mover.closely && thick * S(0.5) < inner;
    // It would be pushed out the way that it came.
    if (!closely && obstacle.relative_motion < (inner + thick) * S(0.5)) {
      if (moving || !mover.deep || obstacle.relative_motion < detail::kDeepMotion<S> ||
          !detail::ends_deep(part, motion.end, met, obstacle.motion.end))
        return;
    }
    const FreeWay<S> way = free_way(part, motion, met, obstacle.motion);
    if (way.fraction == U(1)) return;
    const U all = detail::share_of<S>(piece.index, piece.count) + way.fraction * detail::share_of<S>(1, piece.count);
    const Pose<S> there = pose_at(motion, way.fraction);
    if (filter_.is_passed(mover.index, part, there, met, obstacle, way.fraction)) return;
    const bool stays = obstacle.end == nullptr;
    const Pose<S> carried =
        stays ? there : compose(*obstacle.end, detail::pose_from(pose_at(obstacle.motion, way.fraction), there));
    detail::shorten(cut, way, all, carried, stays);
  };
  visit_parts(mover.index, motion, obstacle, sweep_parts);
}

/// Sets the mover's centre to the first child or triangle that it touches. Returns false if it touches none.
template <class S> bool PairSweep<S>::find_touch(Mover<S>& mover, std::uint32_t slot) const {
  const CoreMotion<S> motion = mover.motion_of(0);
  const CoreMotion<S> still = {motion.start, motion.start, Vec3<S>::zero()};
  const Obstacle<S> obstacle = at_rest(slot, S(0));
  bool found = false;
  visit_parts(mover.index, still, obstacle, [&](const PlacedShape<S>& part, const PlacedShape<S>& met) {
    Vec3<S> on_body;
    if (found || !touches_at_start(part, motion, met, obstacle.motion.start, on_body)) return;
    mover.centre = transposed_times(to_matrix(motion.start.orientation), on_body - motion.start.position);
    found = true;
  });
  return found;
}

template <class S> bool PairSweep<S>::is_deep_in(std::uint32_t index, std::uint32_t slot, const Aabb<S>& box) const {
  const BodyProperties<S>& body = state_.awake.properties[index];
  const Transform<S> origin = Transform<S>::of(origin_pose(state_.awake.states[index], body));
  const S deep = min(map_.shapes.thinnest_of(body.shape) * S(0.5), detail::kTooDeep<S>);
  if (!overlap(grow(bounds(map_.shapes.children_of(body.shape), origin, map_.shapes.contents()), -deep), box))
    return false;
  if (!filter_.may_stop(index, slot, false)) return false;
  const Pose<S> end = motion_.now(index);
  const Obstacle<S> obstacle = at_rest(slot, S(0));
  bool found = false;
  const auto look = [&](const PlacedShape<S>& part, const PlacedShape<S>& met) {
    found = found || detail::ends_deep(part, end, met, obstacle.motion.end);
  };
  visit_parts(index, {end, end, Vec3<S>::zero()}, obstacle, look);
  return found;
}

/// Calls visit(part, part of the obstacle) for parts whose boxes meet on their ways.
template <class S>
template <class Visit>
void PairSweep<S>::visit_parts(std::uint32_t index, const CoreMotion<S>& motion, const Obstacle<S>& obstacle,
                               const Visit& visit) const {
  const BodyProperties<S>& body = state_.awake.properties[index];
  const BodyProperties<S>& other = map_.properties_at(map_.location(obstacle.slot));
  const std::span<const Child<S>> parts_of_other = map_.shapes.children_of(other.shape);
  const ChildTree<S>* const tree = map_.shapes.tree_of(other.shape);
  const Transform<S> frame = Transform<S>::of(obstacle.motion.start);
  const bool traits = (map_.shapes.traits_of(body.shape).flags | map_.shapes.traits_of(other.shape).flags) != 0;
  for (const Child<S>& child : map_.shapes.children_of(body.shape)) {
    const PlacedShape<S> part = detail::placed_part(map_, body, child);
    const Aabb<S> swept = detail::swept_bounds(part, motion);
    const auto visit_one = [&](const Child<S>& child_of_other) {
      if (traits && !parts_collide(child.traits, body.filter, child_of_other.traits, other.filter)) return;
      if (!filter_.is_pushed_back(index, child, obstacle.slot, child_of_other)) return;
      const PlacedShape<S> met = detail::placed_part(map_, other, child_of_other);
      const bool moves = S(0) < obstacle.moved;
      if (overlap(swept,
                  moves ? detail::swept_bounds(met, obstacle.motion) : bounds(met.shape, compose(frame, met.at))))
        visit(part, met);
    };
    if (tree == nullptr) {
      for (const Child<S>& child_of_other : parts_of_other) visit_one(child_of_other);
      continue;
    }
    const Transform<S> origin = {frame.position - frame.rotation * other.local_centre, frame.rotation};
    tree->query(origin, grow(swept, obstacle.moved), [&](std::uint32_t i) {
      visit_one(parts_of_other[i]);
      return true;
    });
  }
}

}  // namespace isostep
