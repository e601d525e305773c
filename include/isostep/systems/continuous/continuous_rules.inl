// ContinuousCollision: what may stop a mover, by filters, ghosts, one-way bodies and kinds.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/systems/continuous/continuous_collision.inl"

namespace isostep {

template <class S> bool ContinuousCollision<S>::may_stop(const Mover& mover, std::uint32_t slot, bool moving) const {
  const BodyProperties<S>& other = map_.properties_at(map_.location(slot));
  if ((other.type == BodyType::dynamic) != moving || !map_.has_contacts(other)) return false;
  if (moving && (other.flags & body_flag::kBullet) != 0) return false;
  if (!should_collide(map_.filter_of(state_.awake.properties[mover.index]), map_.filter_of(other))) return false;
  if (rules_.ways != nullptr && is_let_out(mover, slot)) return false;
  if (rules_.ghosts != nullptr && are_ghosts(mover, slot)) return false;
  const std::uint64_t key = pair_key(state_.awake.states[mover.index].slot, slot);
  const std::size_t at = lower_bound(joined_.size(), [&](std::size_t i) { return joined_[i] < key; });
  return at == joined_.size() || joined_[at] != key;
}

/// A one-way body lets out what leaves it by their velocities at the step's end.
template <class S> bool ContinuousCollision<S>::is_let_out(const Mover& mover, std::uint32_t slot) const {
  const BodyState<S>& own = state_.awake.states[mover.index];
  const Location at = map_.location(slot);
  Vec3<Velocity<S>> velocity = own.velocity;
  if (at.set == Location::kAwake) velocity -= state_.awake.states[at.index].velocity;
  const Way<S>*of_other = rules_.ways->find(slot), *of_own = rules_.ways->find(own.slot);
  return (of_other != nullptr && of_other->lets_out(velocity)) || (of_own != nullptr && of_own->lets_out(-velocity));
}

/// A one-way body lets the mover pass there if PairRules would: by the contact's normal, and never a pair that has
/// contacts. Surfaces are solid here: what passes one leaves it.
template <class S>
bool ContinuousCollision<S>::is_passed(const Mover& mover, const PlacedShape<S>& part, const Pose<S>& there,
                                       const PlacedShape<S>& obstacle, const Obstacle& body, Unit<S> fraction) const {
  const std::uint32_t own = state_.awake.states[mover.index].slot;
  const Way<S>*of_other = rules_.ways->find(body.slot), *of_own = rules_.ways->find(own);
  if ((of_other == nullptr && of_own == nullptr) || is_surface(obstacle.shape.primitive.type)) return false;
  if (!detail::contacts_of<S>(state_.contacts, min(own, body.slot), max(own, body.slot)).empty()) return false;
  const Pose<S> met = pose_at(body.motion, fraction);
  Manifold<S> manifold;
  collide<S>(part.shape, compose(Transform<S>::of(there), part.at), obstacle.shape,
             compose(Transform<S>::of(met), obstacle.at), detail::kSpeculativeDistance<S>, manifold);
  if (manifold.count == 0) return false;
  const Vec3<Unit<S>> normal =
      body.end == nullptr ? manifold.normal
                          : to_matrix(normalise(body.end->orientation * conjugate(met.orientation))) * manifold.normal;
  const auto passes = [](const Way<S>* way, Vec3<Unit<S>> outward) {
    return way != nullptr && dot(outward, way->axis) < way->least_cosine;
  };
  return passes(of_other, -normal) || passes(of_own, normal);
}

/// The step's pairs name ghosts only where their boxes met as it began; their kinds tell of them everywhere.
template <class S> bool ContinuousCollision<S>::are_ghosts(const Mover& mover, std::uint32_t slot) const {
  const std::uint32_t own = state_.awake.properties[mover.index].material.kind;
  return rules_.ghosts->find(own, map_.properties_at(map_.location(slot)).material.kind) != nullptr;
}

/// A contact of parts of those kinds pushes the mover back if it presses as hard as it has to. Scales of masses count
/// where both move.
template <class S>
bool ContinuousCollision<S>::is_pushed_back(const Mover& mover, std::uint32_t own, std::uint32_t slot,
                                            std::uint32_t other) const {
  const KindResponse<S>* const found = rules_.responses->find(own, other);
  if (found == nullptr) return true;
  if (S(0) < found->max_force) return false;
  if (map_.properties_at(map_.location(slot)).type != BodyType::dynamic) return true;
  const bool is_a = own == other ? state_.awake.states[mover.index].slot < slot : own == found->kind_a;
  return S(0) < (is_a ? found->inverse_mass_scale_a : found->inverse_mass_scale_b);
}

}  // namespace isostep
