// ContinuousCollision: who is fast, and the ways that they go.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/systems/continuous/continuous_collision.inl"

namespace isostep {

namespace detail {
/// Around a body, exactly if it has few parts; else its fat box, which needs no look at them.
template <class S> Aabb<S> box_of_few(const BodyMap<S>& map, const BodyState<S>& state, const BodyProperties<S>& body) {
  if (map.tree_of(body.shape) != nullptr) return state.fat;
  const Transform<S> origin = Transform<S>::of(BodyMap<S>::origin_pose(state, body));
  return bounds(map.children_of(body.shape), origin, map.contents());
}

/// Bodies no point of which moves by `motion` [m]. Most are, and a few comparisons tell: the centre has not moved by
/// three quarters of it, nor do its ends turn by a quarter.
template <class S> class SlowBodies {
 public:
  ISO_INLINE SlowBodies(S motion, std::int32_t hz)
      : squared_(product(motion * S(0.75), motion * S(0.75))), turning_(product(motion * S(hz), S(0.25))) {}
  ISO_INLINE bool contain(const BodyMap<S>& map, const BodyState<S>& state, const BodyProperties<S>& body,
                          const Pose<S>& start) const {
    return contain(state, start, state.fat) || contain(state, start, solid_box(map, state, body));
  }

 private:
  ISO_INLINE bool contain(const BodyState<S>& state, const Pose<S>& start, const Aabb<S>& box) const {
    const Vec3<S> moved = state.centre - start.position;
    const Vec3<S> sides = box.high - box.low;  // together longer than from the centre to any point
    const auto w = abs(state.angular_velocity);
    const auto turned = product(convert<S>(w.x + w.y + w.z), sides.x + sides.y + sides.z);
    return dot_sum(moved, moved) < squared_ && turned < turning_;
  }

  Sum<S> squared_, turning_;
};

/// A number that is not negative, as what Remembered keeps.
template <class S> ISO_INLINE std::uint64_t number_to_keep(S a) { return std::uint64_t{to_bits(a)} + 1; }
template <class S> ISO_INLINE S number_kept(std::uint64_t kept) {
  return from_bits<S>(static_cast<RawBits<S>>(kept - 1));
}
}  // namespace detail

/// Page by page, so that a body that is made costs its page.
template <class S> S ContinuousCollision<S>::thinnest_static() const {
  const StaticBodies<S>& bodies = state_.static_bodies;
  return detail::number_kept<S>(bodies.remembered_of_all(1).get([&] {
    S least = bodies.empty() ? highest<S>() : detail::kThick<S>;
    for (std::size_t p = 0; p < bodies.pages(); ++p)
      least = min(least, detail::number_kept<S>(bodies.remembered(p, 2).get([&] { return thinnest_of_page(p); })));
    return detail::number_to_keep(least);
  }));
}
template <class S> std::uint64_t ContinuousCollision<S>::thinnest_of_page(std::size_t page) const {
  S least = highest<S>();
  for (const BodyProperties<S>& body : state_.static_bodies.page(page).properties)
    least = min(least, map_.thinnest_of(body.shape));
  return detail::number_to_keep(least);
}

/// Kinematic bodies are few, and may sleep: then any shape may be one's.
template <class S> typename ContinuousCollision<S>::Survey ContinuousCollision<S>::survey() const {
  Survey found = {thinnest_static(), false, false};
  if (!state_.sleeping.empty()) found.thinnest = min(found.thinnest, map_.least_thickness());
  for (const BodyProperties<S>& body : state_.awake.properties) {
    if (body.type == BodyType::kinematic) {
      found.thinnest = min(found.thinnest, map_.thinnest_of(body.shape));
      found.kinematic = true;
    }
    if ((body.flags & body_flag::kBullet) != 0) found.bullets = true;
  }
  return found;
}

template <class S> void ContinuousCollision<S>::find_movers(const Survey& survey) {
  movers_.clear();
  carriers_.clear();
  const S thinnest = survey.bullets ? S(0) : survey.thinnest;
  if (detail::kThick<S> < thinnest) return;  // nothing stops anybody
  const S fast = (map_.least_thickness() + thinnest) * S(0.5);
  const bool is_fixed = !(detail::kThick<S> < survey.thinnest);  // something is
  const detail::SlowBodies<S> are_slow(fast, state_.settings.hz);
  // Whom the ground is asked about follows from the body alone: shapes elsewhere change nothing of it.
  const detail::SlowBodies<S> are_shallow(detail::kDeepMotion<S>, state_.settings.hz);
  const std::span<const BodyState<S>> states = state_.awake.states;
  const std::span<const BodyProperties<S>> bodies = state_.awake.properties;
  const std::span<const Pose<S>> start = start_;
  met_.clear();
  for (std::size_t i = 0; is_fixed && i < states.size(); ++i) {
    if (!are_shallow.contain(map_, states[i], bodies[i], start[i]) && may_move(i))
      met_.push_back(static_cast<std::uint32_t>(i));
  }
  mark_deep(met_);
  for (std::size_t i = 0; i < states.size(); ++i) {
    if (mover_of_[i] == kDeepInside) {
      movers_.push_back(measure(i));
      movers_.back().deep = true;
    } else if (!are_slow.contain(map_, states[i], bodies[i], start[i]) && may_move(i)) add_if_fast(i, survey.thinnest);
  }
  if (survey.kinematic) find_met_by_kinematic(fast);
}

/// Marks, in mover_of_, those of the awake bodies `asked` without joints that end deep inside of something fixed.
/// Whichever are fewer look for the others: a floor for a thousand that fall, one that falls for the walls of a town.
template <class S> void ContinuousCollision<S>::mark_deep(std::span<const std::uint32_t> asked) {
  mover_of_.assign(state_.awake.states.size(), 0);
  if (asked.empty()) return;
  for (const std::uint32_t i : asked) mover_of_[i] = kAsked;
  leave_out_joined();
  const auto is_fixed = [](const BodyProperties<S>& body) { return body.type != BodyType::dynamic; };
  const auto look_around = [&](const BodySet<S>& bodies) {
    for (std::size_t k = 0; k < bodies.states.size(); ++k) {
      if (!is_fixed(bodies.properties[k])) continue;
      const std::uint32_t slot = bodies.states[k].slot;
      const Aabb<S> box = detail::box_of_few(map_, bodies.states[k], bodies.properties[k]);
      proxies_.boxes().query(box, [&](std::uint32_t other) {
        const Location at = map_.location(other);
        if (at.set == Location::kAwake && mover_of_[at.index] == kAsked && is_deep_in(at.index, slot, box))
          mover_of_[at.index] = kDeepInside;
        return true;
      });
    }
  };
  std::size_t others = state_.static_bodies.size();
  for (const auto& island : state_.sleeping) others += island->bodies.states.size();
  if (others * 4 < asked.size()) {
    const StaticBodies<S>& still = state_.static_bodies;
    for (std::size_t p = 0; p < still.pages(); ++p) look_around(still.page(p));
    look_around(state_.awake);
    for (const auto& island : state_.sleeping) look_around(island->bodies);
    return;
  }
  for (const std::uint32_t i : asked) {
    if (mover_of_[i] != kAsked) continue;
    proxies_.boxes().query(state_.awake.states[i].fat, [&](std::uint32_t slot) {
      const Location at = map_.location(slot);
      if (is_fixed(map_.properties_at(at)) && is_deep_in(i, slot, map_.state_at(at).fat)) mover_of_[i] = kDeepInside;
      return mover_of_[i] == kAsked;
    });
  }
}
/// Contacts bring out what joints tie: a part that is put back lifts its mechanism or tears it.
template <class S> void ContinuousCollision<S>::leave_out_joined() {
  for (const JointProperties<S>& joint : state_.joints.properties) {
    if (!map_.is_enabled(joint)) continue;
    for (const std::uint32_t slot : {joint.body_a, joint.body_b}) {
      if (slot == kNoBody) continue;
      const Location at = map_.location(slot);
      if (at.set == Location::kAwake) mover_of_[at.index] = 0;
    }
  }
}
/// True if an awake body overlaps one that is fixed, all of it inside of `box`, by more than kTooDeep.
template <class S>
bool ContinuousCollision<S>::is_deep_in(std::uint32_t index, std::uint32_t slot, const Aabb<S>& box) const {
  const BodyProperties<S>& body = state_.awake.properties[index];
  const Transform<S> origin = Transform<S>::of(BodyMap<S>::origin_pose(state_.awake.states[index], body));
  const S deep = min(map_.thinnest_of(body.shape) * S(0.5), detail::kTooDeep<S>);
  if (!overlap(grow(bounds(map_.children_of(body.shape), origin, map_.contents()), -deep), box)) return false;
  Mover mover = {};
  mover.index = index;
  if (!may_stop(mover, slot, false)) return false;
  const Pose<S> end = now(index), place = map_.centre_pose_at(slot);
  const CoreMotion<S> still = {end, end, Vec3<S>::zero()};
  const Obstacle obstacle = {slot, {place, place, Vec3<S>::zero()}, S(0), S(0), nullptr};
  bool found = false;
  visit_parts(mover, still, obstacle, [&](const PlacedShape<S>& part, const PlacedShape<S>& met) {
    found = found || ends_deep(part, still, met, obstacle);
  });
  return found;
}

template <class S> void ContinuousCollision<S>::add_if_fast(std::size_t index, S thinnest) {
  const Mover mover = measure(index);
  if ((mover.inner + (is_bullet(index) ? S(0) : thinnest)) * S(0.5) < mover.motion) movers_.push_back(mover);
}

/// Slow bullets are swept too, against what comes towards them.
template <class S> void ContinuousCollision<S>::find_bullets() {
  mover_of_.assign(state_.awake.states.size(), 0);
  for (std::size_t i = 0; i < movers_.size(); ++i) mover_of_[movers_[i].index] = static_cast<std::uint32_t>(i + 1);
  find_comers();
  if (comers_.size() == 0) return;
  for (std::size_t i = 0; i < state_.awake.states.size(); ++i) {
    if (!is_bullet(i) || mover_of_[i] != 0 || !may_move(i)) continue;
    const Mover bullet = measure(i);
    bool met = false;
    comers_.query(bullet.swept(), [&](std::uint32_t) { return !(met = true); });
    if (met) movers_.push_back(bullet);
  }
}
/// Dynamic bodies that were, in this step, where their fat box is not: it is left behind by what moves further than its
/// margin, and is that of another pose where a body was put back.
template <class S> void ContinuousCollision<S>::find_comers() {
  comers_.clear();
  const detail::SlowBodies<S> are_slow(detail::kFatMargin<S>, state_.settings.hz);
  for (std::size_t i = 0; i < state_.awake.states.size(); ++i) {
    const bool is_put_back = mover_of_[i] != 0 && movers_[mover_of_[i] - 1].fraction < Unit<S>(1);
    if (!is_put_back && are_slow.contain(map_, state_.awake.states[i], state_.awake.properties[i], start_[i])) continue;
    if (may_move(i) && !is_bullet(i)) comers_.stage(state_.awake.states[i].slot, measure(i).swept());
  }
  comers_.rebuild();
}

/// Those in the way of a kinematic body move as it sees them.
template <class S> void ContinuousCollision<S>::find_met_by_kinematic(S least) {
  met_.clear();
  for (std::size_t i = 0; i < state_.awake.states.size(); ++i) {
    const BodyProperties<S>& body = state_.awake.properties[i];
    const Location at = {Location::kAwake, static_cast<std::uint32_t>(i)};
    if (body.type != BodyType::kinematic || detail::is_at_rest(state_, start_, at)) continue;
    const Mover carrier = measure(i);
    if (carrier.motion < least) continue;
    carriers_.push_back({state_.awake.states[i].slot, carrier.swept()});
    proxies_.boxes().query(carriers_.back().swept, [&](std::uint32_t slot) {
      const Location met = map_.location(slot);
      if (met.set == Location::kAwake && may_move(met.index)) met_.push_back(met.index);
      return true;
    });
  }
  sort_scratch_.resize(met_.size());
  stable_sort(met_.data(), sort_scratch_.data(), static_cast<std::uint32_t>(met_.size()), OwnKey{});
  const std::size_t fast = movers_.size();
  for (std::size_t i = 0; i < met_.size(); ++i) {
    if (i > 0 && met_[i] == met_[i - 1]) continue;
    const std::size_t at = lower_bound(fast, [&](std::size_t k) { return movers_[k].index < met_[i]; });
    if (at == fast || movers_[at].index != met_[i]) movers_.push_back(measure(met_[i]));
  }
}

template <class S> bool ContinuousCollision<S>::may_move(std::size_t index) const {
  const BodyProperties<S>& body = state_.awake.properties[index];
  return body.type == BodyType::dynamic && map_.has_contacts(body);
}
template <class S>
typename ContinuousCollision<S>::Mover ContinuousCollision<S>::measure(std::size_t index, const Path& path) const {
  const BodyProperties<S>& body = state_.awake.properties[index];
  Mover mover = {};
  static_cast<Path&>(mover) = path;
  mover.index = static_cast<std::uint32_t>(index);
  mover.fraction = Unit<S>(1);
  mover.stopped = mover.to();
  mover.inner = detail::kThick<S>;
  const Transform<S> turned[] = {{Vec3<S>::zero(), to_matrix(mover.from().orientation)},
                                 {Vec3<S>::zero(), to_matrix(mover.to().orientation)}};
  for (const Child<S>& child : map_.children_of(body.shape)) {
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

/// Two orientations do not tell a turn of more than half of one: the angular velocity does, where it leads from the
/// first to the second.
template <class S> typename ContinuousCollision<S>::Path ContinuousCollision<S>::path_of(std::size_t index) const {
  using U = Unit<S>;
  constexpr std::uint32_t kPieces = Path::kMostPieces;
  const Pose<S> from = start_[index], to = now(index);
  const auto spin = heading_of(convert<S>(state_.awake.states[index].angular_velocity));
  const S turn = spin.length / S(state_.settings.hz);
  Path path = {1, {from, to}};
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

}  // namespace isostep
