// ContinuousCollision: a mover swept against one obstacle, at rest, moving or kinematic, part by part.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/systems/continuous/continuous_collision.inl"

namespace isostep {

template <class S> void ContinuousCollision<S>::sweep_against(const Mover& mover, std::uint32_t slot, Cut& cut) const {
  const Location at = map_.location(slot);
  if (!detail::is_at_rest(state_, start_, at)) {
    if (state_.awake.properties[at.index].type == BodyType::dynamic) sweep_against_moving(mover, slot, at.index, cut);
    else sweep_against_kinematic(mover, slot, at.index, cut);
    return;
  }
  const Pose<S> place = map_.centre_pose_at(slot);
  const Obstacle at_rest = {slot, {place, place, Vec3<S>::zero()}, S(0), mover.motion, nullptr};
  for (std::uint32_t i = 0; i < mover.pieces; ++i)
    sweep_piece(mover, {i, mover.pieces}, mover.motion_of(i), at_rest, cut);
}
/// Sweeps against a body that moves. Both paths get as many pieces as the one that had to be divided more.
template <class S>
void ContinuousCollision<S>::sweep_against_moving(const Mover& mover, std::uint32_t slot, std::size_t index,
                                                  Cut& cut) const {
  const Path path = path_of(index);
  const Pose<S> end = now(index);
  const Aabb<S> box = detail::solid_box(map_, state_.awake.states[index], state_.awake.properties[index]);
  const Vec3<S> sides = box.high - box.low;
  Obstacle obstacle = {slot, {}, S(0), S(0), &end};
  for (std::uint32_t i = 0; i < path.pieces; ++i)
    obstacle.moved += detail::most_motion<S>({path.poses[i], path.poses[i + 1], Vec3<S>::zero()}, length(sides));
  obstacle.relative_motion = mover.motion + obstacle.moved;
  const std::uint32_t pieces = max(mover.pieces, path.pieces);
  for (std::uint32_t i = 0; i < pieces; ++i) {
    obstacle.motion = motion_in(path, {i, pieces}, Vec3<S>::zero());
    sweep_piece(mover, {i, pieces}, motion_in(mover, {i, pieces}, mover.centre), obstacle, cut);
  }
}
/// Sweeps in the frame of a kinematic body, where what goes straight goes along a bow if that one turns: in pieces for
/// which a quarter of the inner radius is no less than the bow, (2 w v + w^2 d) t^2 / 8 for turning by w, a speed of v
/// and a distance of d.
template <class S>
void ContinuousCollision<S>::sweep_against_kinematic(const Mover& mover, std::uint32_t slot, std::size_t index,
                                                     Cut& cut) const {
  constexpr std::uint32_t kMost = 32;
  const Pose<S> here = Pose<S>::identity(), end = now(index);
  const Path other = path_of(index);
  const auto seen_from = [&](Unit<S> fraction) {
    return detail::pose_from(pose_on(other, Vec3<S>::zero(), fraction), way_of(mover, fraction));
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
  Obstacle obstacle = {slot, {here, here, Vec3<S>::zero()}, S(0), S(0), &end};
  CoreMotion<S> motions[kMost];
  for (std::uint32_t i = 0; i < pieces; ++i) {
    const Vec3<S> centre = i * mover.pieces < pieces ? mover.centre : Vec3<S>::zero();  // of its first piece
    const Unit<S> share = detail::share_of<S>(i + 1, pieces);
    motions[i] = {i == 0 ? seen_from(Unit<S>(0)) : motions[i - 1].end, seen_from(share), centre};
    obstacle.relative_motion += detail::most_motion(motions[i], mover.reach);
  }
  for (std::uint32_t i = 0; i < pieces; ++i) sweep_piece(mover, {i, pieces}, motions[i], obstacle, cut);
}
/// visit(part, part of the obstacle) where the boxes around their ways meet.
template <class S>
template <class Visit>
void ContinuousCollision<S>::visit_parts(const Mover& mover, const CoreMotion<S>& motion, const Obstacle& obstacle,
                                         const Visit& visit) const {
  const BodyProperties<S>& body = state_.awake.properties[mover.index];
  const BodyProperties<S>& other = map_.properties_at(map_.location(obstacle.slot));
  const std::span<const Child<S>> parts_of_other = map_.children_of(other.shape);
  const ChildTree<S>* const tree = map_.tree_of(other.shape);
  const Transform<S> frame = Transform<S>::of(obstacle.motion.start);
  const bool traits = (map_.traits_of(body.shape).flags | map_.traits_of(other.shape).flags) != 0;
  for (const Child<S>& child : map_.children_of(body.shape)) {
    const PlacedShape<S> part = detail::placed_part(map_, body, child);
    const Aabb<S> swept = detail::swept_bounds(part, motion);
    const auto visit_one = [&](const Child<S>& child_of_other) {
      if (traits && !parts_collide(child.traits, body.filter, child_of_other.traits, other.filter)) return;
      if (rules_.responses != nullptr &&
          !is_pushed_back(mover, child.traits.material_or(body.material).kind, obstacle.slot,
                          child_of_other.traits.material_or(other.material).kind))
        return;
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

/// A box that is smaller by the depth spares most of the tests.
template <class S>
bool ContinuousCollision<S>::ends_deep(const PlacedShape<S>& part, const CoreMotion<S>& motion,
                                       const PlacedShape<S>& obstacle, const Obstacle& body) const {
  const S deep = min(thickness<S>(part.shape) * S(0.5), detail::kTooDeep<S>);
  const Aabb<S> box = bounds(part.shape, compose(Transform<S>::of(motion.end), part.at));
  const Aabb<S> other = bounds(obstacle.shape, compose(Transform<S>::of(body.motion.end), obstacle.at));
  return overlap(grow(box, -deep), other) && is_deep(part, motion.end, obstacle, body.motion.end);
}

template <class S>
void ContinuousCollision<S>::sweep_piece(const Mover& mover, Piece piece, const CoreMotion<S>& motion,
                                         const Obstacle& obstacle, Cut& cut) const {
  using U = Unit<S>;
  const bool moving = map_.properties_at(map_.location(obstacle.slot)).type == BodyType::dynamic;
  const auto sweep_parts = [&](const PlacedShape<S>& part, const PlacedShape<S>& met) {
    const S inner = thickness<S>(part.shape), thick = moving ? S(0) : thickness<S>(met.shape);
    const bool closely = mover.closely && thick * S(0.5) < inner;
    // It would be pushed out the way that it came.
    if (!closely && obstacle.relative_motion < (inner + thick) * S(0.5)) {
      if (moving || !mover.deep || obstacle.relative_motion < detail::kDeepMotion<S> ||
          !ends_deep(part, motion, met, obstacle))
        return;
    }
    const FreeWay<S> way = free_way(part, motion, met, obstacle.motion);
    if (way.fraction == U(1)) return;
    const U all = detail::share_of<S>(piece.index, piece.count) + way.fraction * detail::share_of<S>(1, piece.count);
    const Pose<S> there = pose_at(motion, way.fraction);
    if (rules_.ways != nullptr && is_passed(mover, part, there, met, obstacle, way.fraction)) return;
    cut.add(way, all, obstacle.carried(there, way.fraction), obstacle.end == nullptr);
  };
  visit_parts(mover, motion, obstacle, sweep_parts);
}

}  // namespace isostep
