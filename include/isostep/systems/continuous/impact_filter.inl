// Bodies of impact_filter.hpp.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/collision/broadphase/pairs.hpp"
#include "isostep/collision/narrowphase/collide.hpp"
#include "isostep/core/lower_bound.hpp"
#include "isostep/geometry/surfaces.hpp"
#include "isostep/store/body_frames.hpp"
#include "isostep/store/contact_pairs.hpp"
#include "isostep/systems/continuous/impact_filter.hpp"

namespace isostep {

template <class S> void ImpactFilter<S>::begin(std::span<const std::uint64_t> joined, const ImpactRules<S>& rules) {
  const auto if_any = [](const auto* table) { return table == nullptr || table->empty() ? nullptr : table; };
  joined_ = joined;
  rules_ = {if_any(rules.ways), if_any(rules.responses), if_any(rules.ghosts)};
}

template <class S> bool ImpactFilter<S>::may_stop(std::uint32_t index, std::uint32_t slot, bool moving) const {
  const BodyProperties<S>& other = map_.properties_at(map_.location(slot));
  if ((other.type == BodyType::dynamic) != moving || !map_.shapes.has_contacts(other)) return false;
  if (moving && (other.flags & body_flag::kBullet) != 0) return false;
  if (!should_collide(map_.shapes.filter_of(state_.awake.properties[index]), map_.shapes.filter_of(other)))
    return false;
  if (rules_.ways != nullptr && is_let_out(index, slot)) return false;
  if (rules_.ghosts != nullptr && are_ghosts(index, slot)) return false;
  const std::uint64_t key = pair_key(state_.awake.states[index].slot, slot);
  const std::size_t at = lower_bound(joined_.size(), [&](std::size_t i) { return joined_[i] < key; });
  return at == joined_.size() || joined_[at] != key;
}

/// Returns true if a one-way body lets the other one leave it, by their velocities at the end of the step.
template <class S> bool ImpactFilter<S>::is_let_out(std::uint32_t index, std::uint32_t slot) const {
  const BodyState<S>& own = state_.awake.states[index];
  const Location at = map_.location(slot);
  Vec3<Velocity<S>> velocity = own.velocity;
  if (at.set == Location::kAwake) velocity -= state_.awake.states[at.index].velocity;
  const Way<S>*of_other = rules_.ways->find(slot), *of_own = rules_.ways->find(own.slot);
  return (of_other != nullptr && of_other->lets_out(velocity)) || (of_own != nullptr && of_own->lets_out(-velocity));
}

/// Returns true if a one-way body lets the mover pass there. Judges like PairRules: by the contact's normal, and a pair
/// with contacts never passes. Surfaces are solid here: a body that passes one leaves it.
template <class S>
bool ImpactFilter<S>::is_passed(std::uint32_t index, const PlacedShape<S>& part, const Pose<S>& there,
                                const PlacedShape<S>& met, const Obstacle<S>& obstacle, Unit<S> fraction) const {
  if (rules_.ways == nullptr) return false;
  const std::uint32_t own = state_.awake.states[index].slot, other = obstacle.slot;
  const Way<S>*of_other = rules_.ways->find(other), *of_own = rules_.ways->find(own);
  if ((of_other == nullptr && of_own == nullptr) || is_surface(met.shape.primitive.type)) return false;
  if (!detail::contacts_of<S>(state_.contacts, min(own, other), max(own, other)).empty()) return false;
  const Pose<S> pose = pose_at(obstacle.motion, fraction);
  Manifold<S> manifold;
  collide<S>(part.shape, compose(Transform<S>::of(there), part.at), met.shape, compose(Transform<S>::of(pose), met.at),
             detail::kSpeculativeDistance<S>, manifold);
  if (manifold.count == 0) return false;
  const Vec3<Unit<S>> normal =
      obstacle.end == nullptr
          ? manifold.normal
          : to_matrix(normalise(obstacle.end->orientation * conjugate(pose.orientation))) * manifold.normal;
  const auto passes = [](const Way<S>* way, Vec3<Unit<S>> outward) {
    return way != nullptr && dot(outward, way->axis) < way->least_cosine;
  };
  return passes(of_other, -normal) || passes(of_own, normal);
}

/// Returns true if their kinds pass each other. The step's ghost pairs cover only boxes that met as the step began.
template <class S> bool ImpactFilter<S>::are_ghosts(std::uint32_t index, std::uint32_t slot) const {
  const std::uint32_t own = state_.awake.properties[index].material.kind;
  return rules_.ghosts->find(own, map_.properties_at(map_.location(slot)).material.kind) != nullptr;
}

/// Returns true if contacts of the two parts push the body back with unlimited force. Mass scales count if both bodies
/// are dynamic.
template <class S>
bool ImpactFilter<S>::is_pushed_back(std::uint32_t index, const Child<S>& part, std::uint32_t slot,
                                     const Child<S>& met) const {
  if (rules_.responses == nullptr) return true;
  const BodyProperties<S>& body = map_.properties_at(map_.location(slot));
  const std::uint32_t own = part.traits.material_or(state_.awake.properties[index].material).kind;
  const std::uint32_t other = met.traits.material_or(body.material).kind;
  const KindResponse<S>* const found = rules_.responses->find(own, other);
  if (found == nullptr) return true;
  if (S(0) < found->max_force) return false;
  if (body.type != BodyType::dynamic) return true;
  const bool is_a = own == other ? state_.awake.states[index].slot < slot : own == found->kind_a;
  return S(0) < (is_a ? found->inverse_mass_scale_a : found->inverse_mass_scale_b);
}

}  // namespace isostep
