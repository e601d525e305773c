// Bodies of zones.hpp and record_ranks.hpp.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/core/stable_sort.hpp"
#include "isostep/systems/forces/zones.hpp"

namespace isostep {

/// Ranks by priority, as signed numbers, then by slot.
template <class Record>
template <class IdType>
void RecordRanks<Record>::rank(const Registry<Record, IdType>& registry) {
  ranks_.clear();
  for (std::uint32_t slot = 0; slot < registry.all().size(); ++slot) {
    if (!registry.is_taken(slot)) continue;
    const auto place = static_cast<std::uint32_t>(registry.all()[slot].priority) ^ 0x80000000u;
    ranks_.push_back(std::uint64_t{place} << 32 | slot);
  }
  if (ranks_.empty()) return;
  scratch_.resize(ranks_.size());
  stable_sort(ranks_.data(), scratch_.data(), static_cast<std::uint32_t>(ranks_.size()), OwnKey{});
}

template <class S> void Zones<S>::rank() {
  const auto rank = [&]<class Record, class IdType>(const Registry<Record, IdType>& registry) {
    std::get<RecordRanks<Record>>(ranks_).rank(registry);
  };
  const RecordStore<S>& records = *state_.records;
  rank(records.force_zones);
  rank(records.damping_zones);
  rank(records.waters);
}
template <class S>
template <class Record, class IdType, class Visit>
void Zones<S>::for_each(const Registry<Record, IdType>& registry, const Visit& visit) const {
  if constexpr (requires(const Record& record) { record.priority; }) {
    std::get<RecordRanks<Record>>(ranks_).for_each(registry.all(), visit);
  } else {
    for (std::uint32_t slot = 0; slot < registry.all().size(); ++slot) {
      if (registry.is_taken(slot)) visit(registry.all()[slot]);
    }
  }
}
template <class S>
template <class Record, class IdType, class Visit>
void Zones<S>::for_each_down(const Registry<Record, IdType>& registry, const Visit& visit) const {
  std::get<RecordRanks<Record>>(ranks_).for_each_down(registry.all(), visit);
}

template <class S>
bool Zones<S>::is_hidden(std::uint32_t effect, std::int32_t priority, std::uint32_t category, Vec3<S> point) const {
  return std::get<RecordRanks<ForceZone<S>>>(ranks_).is_hidden(
      state_.records->force_zones.all(), priority,
      [&](const ForceZone<S>& zone) { return detail::replaces(zone, effect, category, point); });
}
template <class S> bool Zones<S>::is_undamped(std::int32_t priority, std::uint32_t category, Vec3<S> point) const {
  return std::get<RecordRanks<DampingZone<S>>>(ranks_).is_hidden(
      state_.records->damping_zones.all(), priority,
      [&](const DampingZone<S>& zone) { return detail::replaces(zone, category, point); });
}
template <class S> bool Zones<S>::is_dry(std::int32_t priority, std::uint32_t category, Vec3<S> point) const {
  if (is_hidden(zone_effect::kWater, priority, category, point)) return true;
  return std::get<RecordRanks<Water<S>>>(ranks_).is_hidden(
      state_.records->waters.all(), priority,
      [&](const Water<S>& water) { return detail::replaces(water, category, point); });
}

template <class S> Vec3<S> Zones<S>::wind_at(Vec3<S> point) const {
  constexpr std::uint32_t kAllCategories = 0xffffffffu;
  Vec3<S> wind = Vec3<S>::zero();
  for_each(state_.records->force_zones, [&](const ForceZone<S>& zone) {
    if (zone.wind == Vec3<S>::zero() || !detail::is_inside(zone, point)) return;
    if (!is_hidden(zone_effect::kWind, zone.priority, kAllCategories, point)) wind = saturating_add(wind, zone.wind);
  });
  return held_within(wind, Limits<S>::speed());
}

template <class S> void Zones<S>::replace_gravity(const SubstepBodies<S>& bodies, ForceSums<S>& sums) const {
  bool any = false;
  for_each(state_.records->force_zones,
           [&](const ForceZone<S>& zone) { any = any || (zone.replaces & zone_effect::kGravity) != 0; });
  if (!any) return;
  for (std::uint32_t row = 1; row < bodies.rows(); ++row) {
    if (!bodies.moves(row)) continue;
    const bool hidden = replaces_gravity(bodies.category(row), bodies.state(row).centre);
    if (hidden) sums.accelerate(row, -(bodies.gravity() * bodies.properties(row).gravity_scale));
  }
}
template <class S> bool Zones<S>::replaces_gravity(std::uint32_t category, Vec3<S> point) const {
  for (const ForceZone<S>& zone : state_.records->force_zones.all()) {
    if (detail::replaces(zone, zone_effect::kGravity, category, point)) return true;
  }
  return false;
}

}  // namespace isostep
