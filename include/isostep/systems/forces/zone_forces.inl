// Bodies of body_forces.hpp: zones, for every awake body, and what hides them.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/core/stable_sort.hpp"
#include "isostep/systems/forces/body_forces.hpp"

namespace isostep {

namespace detail {
template <class Zone, class S> ISO_INLINE bool is_inside(const Zone& zone, Vec3<S> point) {
  if (zone.shape == ZoneShape::everywhere) return true;
  const Vec3<S> from_middle = point - zone.pose.position;
  if (zone.shape == ZoneShape::sphere) return length(from_middle) <= zone.half.x;
  const Vec3<S> local = transposed_times(to_matrix(zone.pose.orientation), from_middle);
  return within(local.x, zone.half.x) && within(local.y, zone.half.y) && within(local.z, zone.half.z);
}
}  // namespace detail

/// Priorities in the order of whole numbers, then slots.
template <class S>
template <class Zones>
void BodyForces<S>::rank(const Zones& zones, std::vector<std::uint64_t>& ranks) {
  ranks.clear();
  for (std::uint32_t slot = 0; slot < zones.all().size(); ++slot) {
    if (!zones.is_taken(slot)) continue;
    const auto place = static_cast<std::uint32_t>(zones.all()[slot].priority) ^ 0x80000000u;
    ranks.push_back(std::uint64_t{place} << 32 | slot);
  }
  if (ranks.empty()) return;
  rank_scratch_.resize(ranks.size());
  stable_sort(ranks.data(), rank_scratch_.data(), static_cast<std::uint32_t>(ranks.size()), OwnKey{});
}
template <class S> void BodyForces<S>::rank_zones() {
  const RecordStore<S>& records = *state_.records;
  rank(records.force_zones, zone_ranks_);
  rank(records.damping_zones, damping_ranks_);
  rank(records.waters, water_ranks_);
}

/// Whether a zone of higher priority replaces the effect at a point, for bodies of that category.
template <class S>
bool BodyForces<S>::is_hidden(std::uint32_t effect, std::int32_t priority, std::uint32_t category,
                              Vec3<S> point) const {
  const auto& zones = state_.records->force_zones;
  for (std::size_t i = zone_ranks_.size(); i-- > 0;) {
    const ForceZone<S>& zone = zones.all()[zone_ranks_[i] & 0xffffffffu];
    if (zone.priority <= priority) return false;
    const bool hides = (zone.replaces & effect) != 0 && (category & zone.mask) != 0;
    if (hides && detail::is_inside(zone, point)) return true;
  }
  return false;
}

template <class S> void BodyForces<S>::act(const ForceZone<S>& zone) {
  if (zone.acceleration == Vec3<S>::zero()) return;
  for (std::uint32_t row = 1; row < bodies_->mass.size(); ++row) {
    const Vec3<S> centre = state_.awake.states[row - 1].centre;
    if (!is_pushed(row, zone.mask) || !detail::is_inside(zone, centre)) continue;
    const std::uint32_t category = state_.awake.properties[row - 1].filter.category;
    if (!is_hidden(zone_effect::kAcceleration, zone.priority, category, centre)) accelerate(row, zone.acceleration);
  }
}

/// The world's gravity, where a zone replaces it, is below all zones.
template <class S> void BodyForces<S>::act_in_place_of_gravity() {
  bool any = false;
  for_each_taken(state_.records->force_zones,
                 [&](const ForceZone<S>& zone) { any = any || (zone.replaces & zone_effect::kGravity) != 0; });
  if (!any) return;
  for (std::uint32_t row = 1; row < bodies_->mass.size(); ++row) {
    if (!bodies_->moves(row)) continue;
    const BodyProperties<S>& body = state_.awake.properties[row - 1];
    const bool hidden = replaces_gravity(body.filter.category, state_.awake.states[row - 1].centre);
    if (hidden) accelerate(row, -(state_.settings.gravity * body.gravity_scale));
  }
}
template <class S> bool BodyForces<S>::replaces_gravity(std::uint32_t category, Vec3<S> point) const {
  for (const ForceZone<S>& zone : state_.records->force_zones.all()) {
    const bool replaces = (zone.replaces & zone_effect::kGravity) != 0 && (category & zone.mask) != 0;
    if (replaces && detail::is_inside(zone, point)) return true;
  }
  return false;
}

template <class S> Vec3<S> BodyForces<S>::wind_at(Vec3<S> point) const {
  constexpr std::uint32_t kAllCategories = 0xffffffffu;
  Vec3<S> wind = Vec3<S>::zero();
  for_each_taken(state_.records->force_zones, [&](const ForceZone<S>& zone) {
    if (zone.wind == Vec3<S>::zero() || !detail::is_inside(zone, point)) return;
    if (!is_hidden(zone_effect::kWind, zone.priority, kAllCategories, point)) wind = saturating_add(wind, zone.wind);
  });
  return held_within(wind, Limits<S>::speed());
}

/// From the highest zone down, until one that replaces the rest.
template <class S> void BodyForces<S>::gather_damping() {
  damping_.clear();
  if (damping_ranks_.empty()) return;
  damping_.assign(accelerations_.size(), {S(0), S(0)});
  const auto& zones = state_.records->damping_zones;
  for (std::uint32_t row = 1; row < bodies_->mass.size(); ++row) {
    if (!bodies_->moves(row)) continue;
    const Vec3<S> centre = state_.awake.states[row - 1].centre;
    const DampingZone<S>* last = nullptr;  // of those that replace
    for (std::size_t i = damping_ranks_.size(); i-- > 0;) {
      const DampingZone<S>& zone = zones.all()[damping_ranks_[i] & 0xffffffffu];
      if (last != nullptr && zone.priority < last->priority) break;
      if (!is_pushed(row, zone.mask) || !detail::is_inside(zone, centre)) continue;
      damping_[row - 1].linear = saturating_add(damping_[row - 1].linear, zone.linear);
      damping_[row - 1].angular = saturating_add(damping_[row - 1].angular, zone.angular);
      if (zone.replaces) last = &zone;
    }
  }
}

}  // namespace isostep
