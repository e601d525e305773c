// Bodies of fast_bodies.hpp.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/core/lower_bound.hpp"
#include "isostep/core/stable_sort.hpp"
#include "isostep/systems/continuous/fast_bodies.hpp"
#include "isostep/systems/continuous/pair_sweep.inl"

namespace isostep {

namespace detail {
/// Returns the exact box of a body with few parts, else its fat box, which needs no look at the parts.
template <class S> Aabb<S> box_of_few(const BodyMap<S>& map, const BodyState<S>& state, const BodyProperties<S>& body) {
  if (map.shapes.tree_of(body.shape) != nullptr) return state.fat;
  const Transform<S> origin = Transform<S>::of(origin_pose(state, body));
  return bounds(map.shapes.children_of(body.shape), origin, map.shapes.contents());
}

/// Finds bodies of which no point moves by `motion` [m]. A few comparisons accept most: the centre moves by less than
/// three quarters of it, and the ends turn by less than a quarter. Then the poses decide.
template <class S> class SlowBodies {
 public:
  ISO_INLINE SlowBodies(S motion, std::int32_t hz)
      : motion_(motion),
        hz_(hz),
        squared_(product(motion * S(0.75), motion * S(0.75))),
        turning_(product(motion * S(hz), S(0.25))) {}
  ISO_INLINE bool contain(const BodyMap<S>& map, const BodyState<S>& state, const BodyProperties<S>& body,
                          const Pose<S>& start) const {
    if (contain(state, start, state.fat)) return true;
    const Aabb<S> box = solid_box(map, state, body);
    return contain(state, start, box) || ends_near(state, start, box);
  }

 private:
  ISO_INLINE bool contain(const BodyState<S>& state, const Pose<S>& start, const Aabb<S>& box) const {
    const Vec3<S> moved = state.centre - start.position;
    const Vec3<S> sides = box.high - box.low;  // together longer than from the centre to any point
    const auto w = abs(state.angular_velocity);
    const auto turned = product(convert<S>(w.x + w.y + w.z), sides.x + sides.y + sides.z);
    return dot_sum(moved, moved) < squared_ && turned < turning_;
  }

  /// Bodies that turn by more than a radian are not slow.
  ISO_INLINE bool ends_near(const BodyState<S>& state, const Pose<S>& start, const Aabb<S>& box) const {
    const auto w = abs(state.angular_velocity);
    if (!(w.x + w.y + w.z < Velocity<S>(hz_))) return false;
    const Vec3<S> farthest = max(box.high - state.centre, state.centre - box.low);
    const Pose<S> end = {state.centre, state.orientation};
    return most_motion<S>({start, end, Vec3<S>::zero()}, length(farthest)) < motion_;
  }

  S motion_;  // [m]
  std::int32_t hz_;
  Sum<S> squared_, turning_;
};

/// Encodes a number, 0 or more, for Remembered.
template <class S> ISO_INLINE std::uint64_t number_to_keep(S a) { return std::uint64_t{to_bits(a)} + 1; }
template <class S> ISO_INLINE S number_kept(std::uint64_t kept) {
  return from_bits<S>(static_cast<RawBits<S>>(kept - 1));
}
}  // namespace detail

/// Returns the thinnest inner radius of static bodies, page by page: a new body renews its page only.
template <class S> S FastBodies<S>::thinnest_static() const {
  const StaticBodies<S>& bodies = state_.static_bodies;
  return detail::number_kept<S>(bodies.remembered_of_all(1).get([&] {
    S least = bodies.empty() ? highest<S>() : detail::kThick<S>;
    for (std::size_t p = 0; p < bodies.pages(); ++p)
      least = min(least, detail::number_kept<S>(bodies.remembered(p, 2).get([&] { return thinnest_of_page(p); })));
    return detail::number_to_keep(least);
  }));
}
template <class S> std::uint64_t FastBodies<S>::thinnest_of_page(std::size_t page) const {
  S least = highest<S>();
  for (const BodyProperties<S>& body : state_.static_bodies.page(page).properties)
    least = min(least, map_.shapes.thinnest_of(body.shape));
  return detail::number_to_keep(least);
}

/// Surveys the bodies. Kinematic bodies are few, but may sleep: then any shape may belong to one.
template <class S> typename FastBodies<S>::Survey FastBodies<S>::survey() const {
  Survey found = {thinnest_static(), false, false};
  if (!state_.sleeping.empty()) found.thinnest = min(found.thinnest, map_.shapes.least_thickness());
  for (const BodyProperties<S>& body : state_.awake.properties) {
    if (body.type == BodyType::kinematic) {
      found.thinnest = min(found.thinnest, map_.shapes.thinnest_of(body.shape));
      found.kinematic = true;
    }
    if ((body.flags & body_flag::kBullet) != 0) found.bullets = true;
  }
  return found;
}

template <class S> void FastBodies<S>::find() {
  movers_.clear();
  carriers_.clear();
  knows_fixed_ = false;
  survey_ = survey();
  const S thinnest = survey_.bullets ? S(0) : survey_.thinnest;
  if (detail::kThick<S> < thinnest) return;                       // nothing stops anybody
  const bool is_fixed = !(detail::kThick<S> < survey_.thinnest);  // something is
  // Whom the ground is asked about follows from the body alone: shapes elsewhere change nothing of it.
  const detail::SlowBodies<S> are_shallow(detail::kDeepMotion<S>, state_.settings.hz);
  const std::span<const BodyState<S>> states = state_.awake.states;
  const std::span<const BodyProperties<S>> bodies = state_.awake.properties;
  met_.clear();
  met_.reserve(states.size());  // however few were asked before
  for (std::size_t i = 0; is_fixed && i < states.size(); ++i) {
    if (!are_shallow.contain(map_, states[i], bodies[i], motion_.start(i)) && motion_.may_move(i))
      met_.push_back(static_cast<std::uint32_t>(i));
  }
  mark_deep(met_);
  for (std::size_t i = 0; i < states.size(); ++i) {
    if (mover_of_[i] == kDeepInside) {
      movers_.push_back(motion_.measure(i));
      movers_.back().deep = true;
    } else {
      add_if_fast(i);
    }
  }
  if (survey_.kinematic) find_met_by_kinematic((map_.shapes.least_thickness() + thinnest) * S(0.5));
  if (!movers_.empty()) list_fixed();
}

/// Returns true if there are more static and sleeping bodies than `most`. It counts no further.
template <class S> bool FastBodies<S>::are_still_more_than(std::size_t most) const {
  std::size_t count = state_.static_bodies.size();
  for (std::size_t i = 0; i < state_.sleeping.size() && count <= most; ++i)
    count += state_.sleeping[i]->bodies.states.size();
  return count > most;
}
template <class S> void FastBodies<S>::list_fixed() {
  if (are_still_more_than(kFewFixed)) return;
  const StaticBodies<S>& still = state_.static_bodies;
  fixed_.clear();
  for (std::size_t p = 0; p < still.pages(); ++p) {
    for (const BodyState<S>& body : still.page(p).states) fixed_.push_back({body.slot, body.fat});
  }
  const auto add_kinematic = [&](const BodySet<S>& bodies) {
    for (std::size_t i = 0; i < bodies.states.size(); ++i) {
      if (bodies.properties[i].type == BodyType::kinematic)
        fixed_.push_back({bodies.states[i].slot, bodies.states[i].fat});
    }
  };
  if (survey_.kinematic) add_kinematic(state_.awake);
  for (const auto& island : state_.sleeping) add_kinematic(island->bodies);
  knows_fixed_ = fixed_.size() <= kFewFixed;
}

/// Marks in mover_of_ those of the awake bodies `asked` without joints that end deep inside a fixed body. The smaller
/// group searches for the other: a floor for a thousand falling bodies, a falling body for the walls of a town.
template <class S> void FastBodies<S>::mark_deep(std::span<const std::uint32_t> asked) {
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
        if (at.set == Location::kAwake && mover_of_[at.index] == kAsked && pairs_.is_deep_in(at.index, slot, box))
          mover_of_[at.index] = kDeepInside;
        return true;
      });
    }
  };
  if (!are_still_more_than((asked.size() - 1) / 4)) {
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
      if (is_fixed(map_.properties_at(at)) && pairs_.is_deep_in(i, slot, map_.state_at(at).fat))
        mover_of_[i] = kDeepInside;
      return mover_of_[i] == kAsked;
    });
  }
}
/// Unmarks bodies with joints. Contacts push those out: to put one part back lifts its mechanism or tears it.
template <class S> void FastBodies<S>::leave_out_joined() {
  for (const JointProperties<S>& joint : state_.joints.properties) {
    if (!map_.is_enabled(joint)) continue;
    for (const std::uint32_t slot : {joint.body_a, joint.body_b}) {
      if (slot == kNoBody) continue;
      const Location at = map_.location(slot);
      if (at.set == Location::kAwake) mover_of_[at.index] = 0;
    }
  }
}

template <class S> void FastBodies<S>::add_if_fast(std::size_t index) {
  const BodyProperties<S>& body = state_.awake.properties[index];
  const S thinnest = motion_.is_bullet(index) ? S(0) : survey_.thinnest;
  const detail::SlowBodies<S> are_slow((map_.shapes.thinnest_of(body.shape) + thinnest) * S(0.5), state_.settings.hz);
  if (are_slow.contain(map_, state_.awake.states[index], body, motion_.start(index)) || !motion_.may_move(index))
    return;
  const Mover<S> mover = motion_.measure(index);
  if ((mover.inner + thinnest) * S(0.5) < mover.motion) movers_.push_back(mover);
}

template <class S> void FastBodies<S>::number() {
  mover_of_.assign(state_.awake.states.size(), 0);
  for (std::size_t i = 0; i < movers_.size(); ++i) mover_of_[movers_[i].index] = static_cast<std::uint32_t>(i + 1);
}

/// Adds slow bullets in the way of other bodies: they are swept too.
template <class S> bool FastBodies<S>::find_bullets() {
  if (!survey_.bullets) return false;
  number();
  find_comers();
  if (comers_.size() == 0) return true;
  for (std::size_t i = 0; i < state_.awake.states.size(); ++i) {
    if (!motion_.is_bullet(i) || mover_of_[i] != 0 || !motion_.may_move(i)) continue;
    const Mover<S> bullet = motion_.measure(i);
    bool met = false;
    comers_.query(bullet.swept(), [&](std::uint32_t) { return !(met = true); });
    if (met) movers_.push_back(bullet);
  }
  return true;
}
/// Finds dynamic bodies that were outside their fat box in this step. A body that moves further than the margin leaves
/// it, and the box of one that was put back belongs to another pose.
template <class S> void FastBodies<S>::find_comers() {
  comers_.clear();
  const detail::SlowBodies<S> are_slow(detail::kFatMargin<S>, state_.settings.hz);
  for (std::size_t i = 0; i < state_.awake.states.size(); ++i) {
    const BodyState<S>& body = state_.awake.states[i];
    const bool is_put_back = mover_of_[i] != 0 && mover_of(i)->fraction < Unit<S>(1);
    if (!is_put_back && are_slow.contain(map_, body, state_.awake.properties[i], motion_.start(i))) continue;
    if (motion_.may_move(i) && !motion_.is_bullet(i)) comers_.stage(body.slot, motion_.measure(i).swept());
  }
  comers_.rebuild();
}

/// Adds dynamic bodies in the way of fast kinematic bodies, relative to which they are fast.
template <class S> void FastBodies<S>::find_met_by_kinematic(S least) {
  met_.clear();
  for (std::size_t i = 0; i < state_.awake.states.size(); ++i) {
    const BodyProperties<S>& body = state_.awake.properties[i];
    const Location at = {Location::kAwake, static_cast<std::uint32_t>(i)};
    if (body.type != BodyType::kinematic || motion_.is_at_rest(at)) continue;
    const Mover<S> carrier = motion_.measure(i);
    if (carrier.motion < least) continue;
    carriers_.push_back({state_.awake.states[i].slot, carrier.swept()});
    proxies_.boxes().query(carriers_.back().swept, [&](std::uint32_t slot) {
      const Location met = map_.location(slot);
      if (met.set == Location::kAwake && motion_.may_move(met.index)) met_.push_back(met.index);
      return true;
    });
  }
  sort_scratch_.resize(met_.size());
  stable_sort(met_.data(), sort_scratch_.data(), static_cast<std::uint32_t>(met_.size()), OwnKey{});
  const std::size_t fast = movers_.size();
  for (std::size_t i = 0; i < met_.size(); ++i) {
    if (i > 0 && met_[i] == met_[i - 1]) continue;
    const std::size_t at = lower_bound(fast, [&](std::size_t k) { return movers_[k].index < met_[i]; });
    if (at == fast || movers_[at].index != met_[i]) movers_.push_back(motion_.measure(met_[i]));
  }
}

}  // namespace isostep
