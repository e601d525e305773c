// Bodies of continuous_collision.hpp.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/collision/broadphase/pairs.hpp"
#include "isostep/collision/continuous/shape_impact.hpp"
#include "isostep/collision/narrowphase/collide.hpp"
#include "isostep/core/lower_bound.hpp"
#include "isostep/core/stable_sort.hpp"
#include "isostep/dynamics/body_inertia.hpp"
#include "isostep/geometry/bounds.hpp"
#include "isostep/geometry/surfaces.hpp"
#include "isostep/store/body_frames.hpp"
#include "isostep/store/contact_pairs.hpp"
#include "isostep/store/fat_box.hpp"
#include "isostep/systems/continuous/continuous_collision.hpp"

namespace isostep {

namespace detail {
/// [m] A body that moves less is not deep inside of one that was too far away for a contact as the step began.
template <class S> inline constexpr S kDeepMotion = kSpeculativeDistance<S> + kTooDeep<S>;

/// True if a body stays where it is in the step that began with all awake ones at `start`.
template <class S> bool is_at_rest(const WorldState<S>& state, std::span<const Pose<S>> start, Location at) {
  if (at.set != Location::kAwake) return true;
  const BodyState<S>& body = state.awake.states[at.index];
  return start[at.index].position == body.centre && start[at.index].orientation == body.orientation;
}
/// A part of a body in the frame of its centre of mass, axes as the body's.
template <class S>
PlacedShape<S> placed_part(const BodyMap<S>& map, const BodyProperties<S>& body, const Child<S>& child) {
  const Pose<S> at = {child.pose.position - body.local_centre, child.pose.orientation};
  return {map.contents().view(child.primitive), Transform<S>::of(at)};
}
/// b seen from a's frame.
template <class S> Pose<S> pose_from(const Pose<S>& a, const Pose<S>& b) {
  return {transposed_times(to_matrix(a.orientation), b.position - a.position),
          normalise(conjugate(a.orientation) * b.orientation)};
}
/// [1] The sine of half the angle of the turn from one pose to another.
template <class S> Unit<S> half_turn(const Pose<S>& from, const Pose<S>& to) {
  const Quat<Unit<S>> turn = to.orientation * conjugate(from.orientation);
  return length(Vec3<Unit<S>>{turn.x, turn.y, turn.z});
}
/// [m] No point within `reach` of the frame's origin moves further along a straight line.
template <class S> S most_motion(const CoreMotion<S>& motion, S reach) {
  const S chord = reach * half_turn(motion.start, motion.end);
  return length(motion.end.position - motion.start.position) + chord + chord;
}
/// The box around a part wherever it is on its way, with room for what nearly touches it.
template <class S> Aabb<S> swept_bounds(const PlacedShape<S>& part, const CoreMotion<S>& motion) {
  const auto at = [&](const Pose<S>& pose) { return bounds(part.shape, compose(Transform<S>::of(pose), part.at)); };
  const Aabb<S> own = bounds(part.shape, part.at);
  const S reach = length(max(abs(own.low - motion.centre), abs(own.high - motion.centre)));
  const S bow = min(bow_of(motion, reach), reach + reach);
  return grown_with_slack<S>(merge(at(motion.start), at(motion.end)), bow + kSpeculativeDistance<S>);
}
template <class S> Aabb<S> swept_box(const CoreMotion<S>& motion, S reach) {
  const Vec3<S> all = {reach, reach, reach};
  const Aabb<S> start = Aabb<S>::around(motion.start.position, all), end = Aabb<S>::around(motion.end.position, all);
  return grow(merge(start, end), kFatMargin<S>);
}
/// The angular velocity of a body whose orientation is put back: the same along its own axes. One that stayed in the
/// world's axes would meet another inertia, and a rod at 300 rad/s six times its energy.
template <class S> Vec3<Velocity<S>> turned_back(const BodyState<S>& state, Quat<Unit<S>> orientation) {
  const Mat3<Unit<S>> back = to_matrix(normalise(orientation * conjugate(state.orientation)));
  return back * state.angular_velocity;
}
/// Puts the centre within the world: rounding and joints lead beyond its edge.
template <class S> ISO_INLINE void put_centre(BodyState<S>& state, Vec3<S> place) {
  state.centre = held_within(place, Limits<S>::position());
}
/// The velocity of a body that falls by `left_out` less: without what gravity [m/s^2] did on that part of its way. What
/// keeps it would bounce higher than it fell. s' = sqrt(s^2 - 2 work), by its mean speed, so that no square has to fit.
template <class S> Vec3<Velocity<S>> without_fall(Vec3<Velocity<S>> velocity, Vec3<S> gravity, Vec3<S> left_out) {
  using V = Velocity<S>;
  const Heading<S> down = heading_of(gravity);
  const V falls = round_to<V>(dot_sum(down.direction, velocity)), speed = abs(falls);
  const S work = saturate_to<S>(product(down.length, dot(down.direction, left_out)));  // [m^2/s^2]
  if (!(V(0) < speed) || work == S(0) || (work < S(0)) != (falls < V(0))) return velocity;
  V left = speed;
  for (int i = 0; i < 4; ++i) {
    const V mean = round_to<V>(product(S(0.5), speed) + product(S(0.5), left));
    if (!(work < saturate_to<S>(product(speed, mean)))) return velocity - down.direction * falls;
    left = max(speed - divide_to<V>(work, mean), V(0));
  }
  return velocity + down.direction * (falls < V(0) ? speed - left : left - speed);
}
/// a / b for 0 <= a <= b, b a power of two.
template <class S> ISO_INLINE Unit<S> share_of(std::uint32_t a, std::uint32_t b) {
  return divide_to<Unit<S>>(S(static_cast<std::int32_t>(a)), S(static_cast<std::int32_t>(b)));
}
}  // namespace detail

template <class S>
void ContinuousCollision<S>::update(std::span<const Pose<S>> start, std::span<const std::uint64_t> joined,
                                    const ImpactRules<S>& rules) {
  const auto if_any = [](const auto* table) { return table == nullptr || table->empty() ? nullptr : table; };
  start_ = start;
  joined_ = joined;
  rules_ = {if_any(rules.ways), if_any(rules.responses), if_any(rules.ghosts)};
  const Survey found = survey();
  find_movers(found);
  for (Mover& mover : movers_) cut(mover, false);
  if (found.bullets) {
    find_bullets();
    for (Mover& mover : movers_) {
      if (is_bullet(mover.index)) cut_bullet(mover);
    }
  }
  stop_joined();
}

template <class S>
ISO_INLINE Pose<S> ContinuousCollision<S>::Obstacle::carried(const Pose<S>& there, Unit<S> fraction) const {
  return end == nullptr ? there : compose(*end, detail::pose_from(pose_at(motion, fraction), there));
}

/// Adds an end: `all` of the whole motion, `there` in the world; `at_rest`: no kinematic body stops it.
template <class S>
void ContinuousCollision<S>::Cut::add(const FreeWay<S>& way, Unit<S> all, const Pose<S>& there, bool at_rest) {
  if (!way.is_held && all < fraction) {
    fraction = all;
    pose = there;
  } else if (way.is_held && all < fraction_of_middle) {
    fraction_of_middle = all;
    middle = way.middle;
    place = there.position + rotate(there.orientation, way.middle);
    normal = at_rest ? way.normal : Vec3<Unit<S>>::zero();
  }
}

/// `moving`: dynamic bodies that are no bullets; else static and kinematic ones.
/// The tree shows no less; what it shows beyond depends on its past, so the box alone decides.
template <class S> void ContinuousCollision<S>::find_obstacles(const Mover& mover, bool moving) {
  const Vec3<S> from = mover.from().position, way = mover.to().position - from;
  const Vec3<S> middle = (mover.around.low + mover.around.high) * S(0.5), half = mover.around.high - middle;
  const Sweep<S> sweep = {from + middle, way, half, Unit<S>(1)};
  obstacles_.clear();
  proxies_.boxes().sweep(sweep, [&](std::uint32_t slot, Unit<S> max_fraction) {
    const Aabb<S>& fat = map_.state_at(map_.location(slot)).fat;
    if (may_stop(mover, slot, moving) && detail::SweepTest<S>(sweep, fat).touches(fat)) obstacles_.push_back(slot);
    return max_fraction;
  });
  const Aabb<S> swept = mover.swept();
  if (moving) {
    comers_.query(swept, [&](std::uint32_t slot) {
      if (may_stop(mover, slot, moving)) obstacles_.push_back(slot);
      return true;
    });
  }
  for (const Carrier& carrier : carriers_) {  // wherever they are by now
    if (overlap(carrier.swept, swept) && may_stop(mover, carrier.slot, moving)) obstacles_.push_back(carrier.slot);
  }
  sort_scratch_.resize(obstacles_.size());
  stable_sort(obstacles_.data(), sort_scratch_.data(), static_cast<std::uint32_t>(obstacles_.size()), OwnKey{});
}

template <class S> typename ContinuousCollision<S>::Cut ContinuousCollision<S>::sweep(const Mover& mover) const {
  Cut cut = {mover.fraction, now(mover.index), mover.fraction, {}, {}, {}};
  for (std::size_t i = 0; i < obstacles_.size(); ++i) {
    if (i == 0 || obstacles_[i] != obstacles_[i - 1]) sweep_against(mover, obstacles_[i], cut);
  }
  return cut;
}

/// The first obstacle at rest that the body touches at the start says where: by slots, children and triangles.
template <class S> bool ContinuousCollision<S>::find_touch(Mover& mover) const {
  const CoreMotion<S> motion = mover.motion_of(0);
  const CoreMotion<S> still = {motion.start, motion.start, Vec3<S>::zero()};
  bool found = false;
  for (std::size_t i = 0; i < obstacles_.size() && !found; ++i) {
    const Location at = map_.location(obstacles_[i]);
    if (!detail::is_at_rest(state_, start_, at)) continue;
    const Pose<S> place = map_.centre_pose_at(obstacles_[i]);
    const auto look = [&](const PlacedShape<S>& part, const PlacedShape<S>& obstacle) {
      Vec3<S> on_body;
      if (found || !touches_at_start(part, motion, obstacle, place, on_body)) return;
      mover.centre = transposed_times(to_matrix(motion.start.orientation), on_body - motion.start.position);
      found = true;
    };
    visit_parts(mover, still, {obstacles_[i], {place, place, Vec3<S>::zero()}, S(0), S(0), nullptr}, look);
  }
  return found;
}

/// A body that touches at the start goes as if it turned about that point, not about its centre of mass. With its
/// middle on a straight line a rod that tips over dips that end into the ground, and stays where it is for ever. All
/// obstacles see the same path.
template <class S>
typename ContinuousCollision<S>::Cut ContinuousCollision<S>::first_impact(Mover& mover, bool moving) {
  find_obstacles(mover, moving);
  const Cut cut = sweep(mover);
  if (!cut.is_before(mover.fraction) || moving || !find_touch(mover)) return cut;
  return sweep(mover);
}
/// The pose after a fraction of the step.
template <class S> Pose<S> ContinuousCollision<S>::way_of(const Mover& mover, Unit<S> fraction) const {
  return pose_on(mover, mover.centre, fraction);
}
/// The pose after a fraction of the path; `centre` is that of the Mover.
template <class S> Pose<S> ContinuousCollision<S>::pose_on(const Path& path, Vec3<S> centre, Unit<S> fraction) const {
  std::uint32_t piece = 0;
  while (piece + 1 < path.pieces && detail::share_of<S>(piece + 1, path.pieces) < fraction) ++piece;
  Unit<S> of_piece = fraction - detail::share_of<S>(piece, path.pieces);
  for (std::uint32_t parts = 1; parts < path.pieces; parts += parts) of_piece = of_piece + of_piece;
  return pose_at<S>({path.poses[piece], path.poses[piece + 1], piece == 0 ? centre : Vec3<S>::zero()}, of_piece);
}
/// A piece of a path, which has one piece or as many.
template <class S>
CoreMotion<S> ContinuousCollision<S>::motion_in(const Path& path, Piece piece, Vec3<S> centre) const {
  const Vec3<S> turning = piece.index == 0 || path.pieces == 1 ? centre : Vec3<S>::zero();
  if (path.pieces == piece.count) return {path.poses[piece.index], path.poses[piece.index + 1], turning};
  const CoreMotion<S> whole = {path.poses[0], path.poses[1], turning};
  return {pose_at(whole, detail::share_of<S>(piece.index, piece.count)),
          pose_at(whole, detail::share_of<S>(piece.index + 1, piece.count)), turning};
}

/// A bullet that what is fixed has stopped goes on from there to where it was stopped; what comes still meets it.
template <class S> void ContinuousCollision<S>::cut_bullet(Mover& mover) {
  Mover bullet = mover.fraction == Unit<S>(1) ? mover : measure(mover.index);
  cut(bullet, true);
  if (bullet.fraction == Unit<S>(1)) return;
  stop_at_what_is_fixed(mover.index, way_of(bullet, bullet.fraction));
  mover.fraction = mover.fraction * bullet.fraction;
  mover.stopped = now(mover.index);
}
/// Stops a body on the way on which the one that stopped it carries it to the end of the step.
template <class S> void ContinuousCollision<S>::stop_at_what_is_fixed(std::uint32_t index, const Pose<S>& from) {
  Mover carried = measure(index, {1, {from, now(index)}});
  carried.deep = true;
  if (detail::kDeepMotion<S> < carried.motion) cut(carried, false);
}

template <class S> void ContinuousCollision<S>::cut(Mover& mover, bool moving) {
  const Cut cut = first_impact(mover, moving);
  if (!cut.is_before(mover.fraction)) return;
  mover.fraction = min(cut.fraction, cut.fraction_of_middle);
  mover.stopped = cut.pose;
  if (cut.fraction_of_middle < cut.fraction) {
    const Quat<Unit<S>> turned = way_of(mover, cut.fraction_of_middle).orientation;
    mover.stopped = {cut.place - rotate(turned, cut.middle), turned};
  }
  const Vec3<S> end = now(mover.index).position;
  put_at(mover.index, cut.pose);
  BodyState<S>& state = state_.awake.states[mover.index];
  const S scale = state_.awake.properties[mover.index].gravity_scale;
  state.velocity = detail::without_fall(state.velocity, state_.settings.gravity * scale, end - state.centre);
  if (cut.fraction_of_middle < cut.fraction) stop_middle(state_.awake.states[mover.index], cut, moving);
  place(mover.index);
}
template <class S> void ContinuousCollision<S>::put_at(std::uint32_t index, const Pose<S>& pose) {
  BodyState<S>& state = state_.awake.states[index];
  if (detail::turns_freely(state_.awake.properties[index]))
    state.angular_velocity = detail::turned_back(state, pose.orientation);
  detail::put_centre(state, pose.position);
  state.orientation = pose.orientation;
}
template <class S> void ContinuousCollision<S>::place(std::uint32_t index) {
  BodyState<S>& state = state_.awake.states[index];
  const BodyProperties<S>& body = state_.awake.properties[index];
  detail::renew_fat_box(map_, state, body, false);
  proxies_.place(state, body, true);
}

/// Contacts push a body out of a surface it lies in, except where its middle is in none: it may turn, and does not
/// gather the speed of a fall. A body that `moving` ones stop keeps its speed: contacts share it with them.
template <class S> void ContinuousCollision<S>::stop_middle(BodyState<S>& state, const Cut& cut, bool moving) const {
  using V = Velocity<S>;
  detail::put_centre(state, cut.place - rotate(state.orientation, cut.middle));
  if (moving) return;
  const V inwards = max(V(0), saturate_to<V>(dot_sum(cut.normal, state.velocity)));
  state.velocity -= Vec3<V>{round_to<V>(product(cut.normal.x, inwards)), round_to<V>(product(cut.normal.y, inwards)),
                            round_to<V>(product(cut.normal.z, inwards))};
}

}  // namespace isostep
