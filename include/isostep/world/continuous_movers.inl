// ContinuousCollision: who is fast, and the ways that they go.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/world/continuous_collision.inl"

namespace isostep {

namespace detail {
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

/// Most bodies are slow, and a few comparisons tell: neither has the centre moved by three quarters of the least motion
/// that counts nor do its ends turn by a quarter of it.
template <class S> void ContinuousCollision<S>::find_movers(const Survey& survey) {
  movers_.clear();
  carriers_.clear();
  const S thinnest = survey.bullets ? S(0) : survey.thinnest;
  if (detail::kThick<S> < thinnest) return;  // nothing stops anybody
  const S least = (map_.least_thickness() + thinnest) * S(0.5);
  const S way = least * S(0.75);
  const auto squared = product(way, way), turning = product(least * S(state_.settings.hz), S(0.25));
  const std::span<const BodyState<S>> states = state_.awake.states;
  const std::span<const Pose<S>> start = start_;
  for (std::size_t i = 0; i < states.size(); ++i) {
    const BodyState<S>& state = states[i];
    const Vec3<S> moved = state.centre - start[i].position;
    const Vec3<S> sides = state.fat.high - state.fat.low;  // together longer than from the centre to any point
    const auto w = abs(state.angular_velocity);
    const auto turned = product(convert<S>(w.x + w.y + w.z), sides.x + sides.y + sides.z);
    if (dot_sum(moved, moved) < squared && turned < turning) continue;
    if (may_move(i)) add_if_fast(i, survey.thinnest);
  }
  if (survey.kinematic) find_met_by_kinematic(least);
}

template <class S> void ContinuousCollision<S>::add_if_fast(std::size_t index, S thinnest) {
  const Mover mover = measure(index);
  const bool bullet = (state_.awake.properties[index].flags & body_flag::kBullet) != 0;
  if ((mover.inner + (bullet ? S(0) : thinnest)) * S(0.5) < mover.motion) movers_.push_back(mover);
}

/// Those in the way of a kinematic body move as it sees them.
template <class S> void ContinuousCollision<S>::find_met_by_kinematic(S least) {
  met_.clear();
  for (std::size_t i = 0; i < state_.awake.states.size(); ++i) {
    const BodyProperties<S>& body = state_.awake.properties[i];
    const bool rests = start_[i].position == now(i).position && start_[i].orientation == now(i).orientation;
    if (body.type != BodyType::kinematic || rests) continue;
    const Mover carrier = measure(i);
    if (carrier.motion < least) continue;
    const CoreMotion<S> motion = {start_[i], now(i), Vec3<S>::zero()};
    carriers_.push_back({state_.awake.states[i].slot, detail::swept_box(motion, carrier.reach)});
    proxies_.boxes().query(carriers_.back().swept, [&](std::uint32_t slot) {
      const Location at = map_.location(slot);
      if (at.set == Location::kAwake && may_move(at.index)) met_.push_back(at.index);
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
  constexpr std::uint32_t kFlags = body_flag::kSensor | body_flag::kCollide;
  const BodyProperties<S>& body = state_.awake.properties[index];
  return body.type == BodyType::dynamic && (body.flags & kFlags) == body_flag::kCollide;
}
template <class S> typename ContinuousCollision<S>::Mover ContinuousCollision<S>::measure(std::size_t index) const {
  const BodyProperties<S>& body = state_.awake.properties[index];
  Mover mover = {};
  mover.index = static_cast<std::uint32_t>(index);
  mover.fraction = Unit<S>(1);
  mover.inner = detail::kThick<S>;
  for (const Child<S>& child : map_.children_of(body.shape)) {
    const PlacedShape<S> part = detail::placed_part(map_, body, child);
    const Aabb<S> box = bounds(part.shape, part.at);
    mover.inner = min(mover.inner, thickness<S>(part.shape));
    mover.reach = max(mover.reach, length(max(abs(box.low), abs(box.high))));
  }
  find_way(mover);
  for (std::uint32_t i = 0; i < mover.pieces; ++i)
    mover.motion += detail::most_motion<S>({mover.poses[i], mover.poses[i + 1], Vec3<S>::zero()}, mover.reach);
  return mover;
}

/// Two orientations do not tell a turn of more than half of one: the angular velocity does, where it leads from the
/// first to the second.
template <class S> void ContinuousCollision<S>::find_way(Mover& mover) const {
  using U = Unit<S>;
  constexpr std::uint32_t kPieces = Mover::kMostPieces;
  const Pose<S> from = start_[mover.index], to = now(mover.index);
  const auto spin = heading_of(convert<S>(state_.awake.states[mover.index].angular_velocity));
  const S turn = spin.length / S(state_.settings.hz);
  mover.pieces = 1;
  mover.poses[0] = from;
  mover.poses[1] = mover.stopped = to;
  if (turn < S(2)) return;
  Quat<U> turned[kPieces + 1];
  for (std::uint32_t i = 1; i <= kPieces; ++i) {
    const SinCos<U> half = sin_cos_to<U>(turn * detail::share_of<S>(i, kPieces) * U(0.5));
    const Vec3<U> axis = spin.direction * half.sin;
    turned[i] = normalise(Quat<U>{axis.x, axis.y, axis.z, half.cos} * from.orientation);
  }
  const Quat<U> error = turned[kPieces] * conjugate(to.orientation);
  if (abs(error.w) < U(0.875)) return;
  mover.pieces = kPieces;
  const Vec3<S> way = to.position - from.position;
  for (std::uint32_t i = 1; i < kPieces; ++i)
    mover.poses[i] = {from.position + way * detail::share_of<S>(i, kPieces), turned[i]};
  mover.poses[kPieces] = to;
}

}  // namespace isostep
