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
#include "isostep/world/body_frames.hpp"
#include "isostep/world/contact_pairs.hpp"
#include "isostep/world/continuous_collision.hpp"
#include "isostep/world/fat_box.hpp"

namespace isostep {

namespace detail {
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
/// [m] No point within `reach` of the frame's origin moves further along a straight line.
template <class S> S most_motion(const CoreMotion<S>& motion, S reach) {
  const Quat<Unit<S>> turn = motion.end.orientation * conjugate(motion.start.orientation);
  const S chord = reach * length(Vec3<Unit<S>>{turn.x, turn.y, turn.z});
  return length(motion.end.position - motion.start.position) + chord + chord;
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
/// Between two places at the edge of the world rounding leads beyond it, and joints reach there too.
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
/// a / b for 0 <= a <= b, b of 1 or 4.
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
  rules_ = {if_any(rules.ways), rules.giving_way, if_any(rules.responses), if_any(rules.ghosts)};
  find_movers(survey());
  for (Mover& mover : movers_) cut(mover, false);
  for (Mover& mover : movers_) {
    if ((state_.awake.properties[mover.index].flags & body_flag::kBullet) != 0) cut(mover, true);
  }
  stop_joined();
}

/// `all`: of the whole motion, `there` in the world; `at_rest`: no kinematic body stops it.
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
template <class S> bool ContinuousCollision<S>::may_stop(const Mover& mover, std::uint32_t slot, bool moving) const {
  constexpr std::uint32_t kNone = body_flag::kSensor | body_flag::kCollide;
  const BodyProperties<S>& other = map_.properties_at(map_.location(slot));
  if ((other.type == BodyType::dynamic) != moving || (other.flags & kNone) != body_flag::kCollide) return false;
  if (moving && (other.flags & body_flag::kBullet) != 0) return false;
  if (!should_collide(state_.awake.properties[mover.index].filter, other.filter)) return false;
  if (rules_.ways != nullptr && is_let_out(mover, slot)) return false;
  if (rules_.ghosts != nullptr && are_ghosts(mover, slot)) return false;
  if (moving && rules_.responses != nullptr && !is_pushed_back(mover, slot)) return false;
  const std::uint64_t key = pair_key(state_.awake.states[mover.index].slot, slot);
  const auto is_in = [key](std::span<const std::uint64_t> pairs) {
    const std::size_t at = lower_bound(pairs.size(), [&](std::size_t i) { return pairs[i] < key; });
    return at < pairs.size() && pairs[at] == key;
  };
  return !is_in(joined_) && !is_in(rules_.giving_way);
}

/// By their velocities as the step leaves them.
template <class S> bool ContinuousCollision<S>::is_let_out(const Mover& mover, std::uint32_t slot) const {
  const BodyState<S>& own = state_.awake.states[mover.index];
  const Location at = map_.location(slot);
  Vec3<Velocity<S>> velocity = own.velocity;
  if (at.set == Location::kAwake) velocity -= state_.awake.states[at.index].velocity;
  const Way<S>*of_other = rules_.ways->find(slot), *of_own = rules_.ways->find(own.slot);
  return (of_other != nullptr && of_other->lets_out(velocity)) || (of_own != nullptr && of_own->lets_out(-velocity));
}

/// Whether a one-way body lets pass what meets it there, as PairRules judges a pair: by the contact's normal, and none
/// that has contacts. Surfaces are solid here: what passes one leaves it.
template <class S>
bool ContinuousCollision<S>::is_passed(const Mover& mover, const PlacedShape<S>& part, const Pose<S>& there,
                                       const PlacedShape<S>& obstacle, const Rest& rest) const {
  const std::uint32_t own = state_.awake.states[mover.index].slot;
  const Way<S>*of_other = rules_.ways->find(rest.slot), *of_own = rules_.ways->find(own);
  if ((of_other == nullptr && of_own == nullptr) || is_surface(obstacle.shape.primitive.type)) return false;
  if (!detail::contacts_of<S>(state_.contacts, min(own, rest.slot), max(own, rest.slot)).empty()) return false;
  Manifold<S> manifold;
  collide<S>(part.shape, compose(Transform<S>::of(there), part.at), obstacle.shape,
             compose(Transform<S>::of(rest.pose), obstacle.at), detail::kSpeculativeDistance<S>, manifold);
  if (manifold.count == 0) return false;
  const Vec3<Unit<S>> normal =
      rest.carrier == nullptr ? manifold.normal : to_matrix(rest.carrier->orientation) * manifold.normal;
  const auto passes = [](const Way<S>* way, Vec3<Unit<S>> outward) {
    return way != nullptr && dot(outward, way->axis) < way->least_cosine;
  };
  return passes(of_other, -normal) || passes(of_own, normal);
}

/// Where their boxes met as the step began, they are among the pairs that do not touch.
template <class S> bool ContinuousCollision<S>::are_ghosts(const Mover& mover, std::uint32_t slot) const {
  const std::uint32_t own = state_.awake.properties[mover.index].material.kind;
  return rules_.ghosts->find(own, map_.properties_at(map_.location(slot)).material.kind) != nullptr;
}

/// Of contacts with what is at rest the scales of masses are of no account.
template <class S> bool ContinuousCollision<S>::is_pushed_back(const Mover& mover, std::uint32_t slot) const {
  const std::uint32_t own = state_.awake.properties[mover.index].material.kind;
  const std::uint32_t other = map_.properties_at(map_.location(slot)).material.kind;
  const KindResponse<S>* const found = rules_.responses->find(own, other);
  if (found == nullptr) return true;
  const bool is_a = own == other ? state_.awake.states[mover.index].slot < slot : own == found->kind_a;
  return S(0) < (is_a ? found->inverse_mass_scale_a : found->inverse_mass_scale_b);
}

/// The tree shows no less; what it shows beyond depends on its past, so the box alone decides.
template <class S> void ContinuousCollision<S>::find_obstacles(const Mover& mover, bool moving) {
  const Pose<S> from = start_[mover.index];
  const Vec3<S> reach = {mover.reach, mover.reach, mover.reach};
  const Sweep<S> sweep = {from.position, now(mover.index).position - from.position, reach, Unit<S>(1)};
  obstacles_.clear();
  proxies_.boxes().sweep(sweep, [&](std::uint32_t slot, Unit<S> max_fraction) {
    const Aabb<S>& fat = map_.state_at(map_.location(slot)).fat;
    if (may_stop(mover, slot, moving) && detail::SweepTest<S>(sweep, fat).touches(fat)) obstacles_.push_back(slot);
    return max_fraction;
  });
  const Aabb<S> swept = detail::swept_box<S>({from, now(mover.index), Vec3<S>::zero()}, mover.reach);
  for (const Carrier& carrier : carriers_) {  // wherever they are by now
    if (overlap(carrier.swept, swept) && may_stop(mover, carrier.slot, moving)) obstacles_.push_back(carrier.slot);
  }
  sort_scratch_.resize(obstacles_.size());
  stable_sort(obstacles_.data(), sort_scratch_.data(), static_cast<std::uint32_t>(obstacles_.size()), OwnKey{});
}

/// What hits a kinematic body is seen from it, in its frame; `place` is that frame at the end.
template <class S>
void ContinuousCollision<S>::sweep_against(const Mover& mover, std::uint32_t slot, bool moving, Cut& cut) const {
  const Location at = map_.location(slot);
  const BodyProperties<S>& other = map_.properties_at(at);
  const Pose<S> place = map_.centre_pose_at(slot);
  if (moving || at.set != Location::kAwake) {
    for (std::uint32_t i = 0; i < mover.pieces; ++i)
      sweep_piece(mover, i, mover.motion_of(i), other, {place, nullptr, slot}, cut);
    return;
  }
  const CoreMotion<S> of_other = {start_[at.index], place, Vec3<S>::zero()};
  Pose<S> from = detail::pose_from(of_other.start, mover.poses[0]);
  for (std::uint32_t i = 0; i < mover.pieces; ++i) {
    const Unit<S> fraction = detail::share_of<S>(i + 1, mover.pieces);
    const Pose<S> to = detail::pose_from(pose_at(of_other, fraction), mover.poses[i + 1]);
    sweep_piece(mover, i, {from, to, mover.motion_of(i).centre}, other, {Pose<S>::identity(), &place, slot}, cut);
    from = to;
  }
}
/// visit(part, obstacle) for the parts of both bodies whose boxes meet: of the one all that is within `swept`.
template <class S>
template <class Visit>
void ContinuousCollision<S>::visit_parts(const BodyProperties<S>& body, const Aabb<S>& swept,
                                         const BodyProperties<S>& other, const Pose<S>& place,
                                         const Visit& visit) const {
  const std::span<const Child<S>> children = map_.children_of(body.shape), obstacles = map_.children_of(other.shape);
  const Transform<S> frame = Transform<S>::of(place);
  const auto visit_one = [&](const Child<S>& child_of_other) {
    const PlacedShape<S> obstacle = detail::placed_part(map_, other, child_of_other);
    if (!overlap(swept, bounds(obstacle.shape, compose(frame, obstacle.at)))) return true;
    for (const Child<S>& child : children) visit(detail::placed_part(map_, body, child), obstacle);
    return true;
  };
  const ChildTree<S>* const tree = map_.tree_of(other.shape);
  if (tree == nullptr) {
    for (const Child<S>& obstacle : obstacles) visit_one(obstacle);
    return;
  }
  const Transform<S> origin = {frame.position - frame.rotation * other.local_centre, frame.rotation};
  tree->query(origin, swept, [&](std::uint32_t i) { return visit_one(obstacles[i]); });
}

template <class S>
void ContinuousCollision<S>::sweep_piece(const Mover& mover, std::uint32_t piece, const CoreMotion<S>& motion,
                                         const BodyProperties<S>& other, const Rest& rest, Cut& cut) const {
  using U = Unit<S>;
  const BodyProperties<S>& body = state_.awake.properties[mover.index];
  const bool moving = other.type == BodyType::dynamic;
  const S far = rest.carrier == nullptr ? mover.motion : detail::most_motion(motion, mover.reach);
  const auto sweep_parts = [&](const PlacedShape<S>& part, const PlacedShape<S>& obstacle) {
    const S inner = thickness<S>(part.shape), thick = moving ? S(0) : thickness<S>(obstacle.shape);
    const bool closely = mover.closely && thick * S(0.5) < inner;
    if (!closely && far < (inner + thick) * S(0.5)) return;
    const FreeWay<S> way = free_way(part, motion, obstacle, rest.pose);
    if (way.fraction == U(1)) return;
    const U all = detail::share_of<S>(piece, mover.pieces) + way.fraction * detail::share_of<S>(1, mover.pieces);
    const Pose<S> there = pose_at(motion, way.fraction);
    if (rules_.ways != nullptr && is_passed(mover, part, there, obstacle, rest)) return;
    cut.add(way, all, rest.carrier == nullptr ? there : compose(*rest.carrier, there), rest.carrier == nullptr);
  };
  visit_parts(body, detail::swept_box(motion, mover.reach), other, rest.pose, sweep_parts);
}

template <class S>
typename ContinuousCollision<S>::Cut ContinuousCollision<S>::sweep(const Mover& mover, bool moving) const {
  Cut cut = {mover.fraction, now(mover.index), mover.fraction, {}, {}, {}};
  for (std::size_t i = 0; i < obstacles_.size(); ++i) {
    if (i == 0 || obstacles_[i] != obstacles_[i - 1]) sweep_against(mover, obstacles_[i], moving, cut);
  }
  return cut;
}

/// The first obstacle at rest that the body touches at the start says where: by slots, children and triangles.
template <class S> bool ContinuousCollision<S>::find_touch(Mover& mover) const {
  const CoreMotion<S> motion = mover.motion_of(0);
  const Vec3<S> reach = {mover.reach, mover.reach, mover.reach};
  bool found = false;
  for (std::size_t i = 0; i < obstacles_.size() && !found; ++i) {
    const Location at = map_.location(obstacles_[i]);
    if (at.set == Location::kAwake) continue;
    const Pose<S> place = map_.centre_pose_at(obstacles_[i]);
    const auto look = [&](const PlacedShape<S>& part, const PlacedShape<S>& obstacle) {
      Vec3<S> on_body;
      if (found || !touches_at_start(part, motion, obstacle, place, on_body)) return;
      mover.centre = transposed_times(to_matrix(motion.start.orientation), on_body - motion.start.position);
      found = true;
    };
    visit_parts(state_.awake.properties[mover.index], Aabb<S>::around(motion.start.position, reach),
                map_.properties_at(at), place, look);
  }
  return found;
}

/// What touches at the start goes as if it turned about that point, not about its centre of mass: with its middle on a
/// straight line a rod that tips over dips that end into the ground, and stays where it is for ever. All obstacles see
/// the same path.
template <class S>
typename ContinuousCollision<S>::Cut ContinuousCollision<S>::first_impact(Mover& mover, bool moving) {
  find_obstacles(mover, moving);
  const Cut cut = sweep(mover, moving);
  if (!cut.is_before(mover.fraction) || moving || !find_touch(mover)) return cut;
  return sweep(mover, moving);
}
/// The pose after a fraction of the step.
template <class S> Pose<S> ContinuousCollision<S>::way_of(const Mover& mover, Unit<S> fraction) const {
  std::uint32_t piece = 0;
  while (piece + 1 < mover.pieces && detail::share_of<S>(piece + 1, mover.pieces) < fraction) ++piece;
  Unit<S> of_piece = fraction - detail::share_of<S>(piece, mover.pieces);
  for (std::uint32_t parts = 1; parts < mover.pieces; parts += parts) of_piece = of_piece + of_piece;
  return pose_at(mover.motion_of(piece), of_piece);
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

/// What lies in a surface already has contacts that push it out, but where its middle is none: it may turn, and does
/// not gather the speed of a fall. What `moving` bodies stop keeps its speed: contacts share it with them.
template <class S> void ContinuousCollision<S>::stop_middle(BodyState<S>& state, const Cut& cut, bool moving) const {
  using V = Velocity<S>;
  detail::put_centre(state, cut.place - rotate(state.orientation, cut.middle));
  if (moving) return;
  const V inwards = max(V(0), saturate_to<V>(dot_sum(cut.normal, state.velocity)));
  state.velocity -= Vec3<V>{round_to<V>(product(cut.normal.x, inwards)), round_to<V>(product(cut.normal.y, inwards)),
                            round_to<V>(product(cut.normal.z, inwards))};
}

}  // namespace isostep
