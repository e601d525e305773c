// join_events: the events of a whole step, of those of its part and of the known step.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "isostep/collision/broadphase/pairs.hpp"
#include "isostep/store/event_order.hpp"
#include "isostep/world/resimulation/affected_bodies.hpp"
#include "isostep/world/resimulation/joined_lists.hpp"

namespace isostep::detail {

/// `old_sleeps`: it is the known step that put bodies to sleep or woke them. Returns false if the order of the whole
/// cannot be told: both have events whose order is that of records.
template <class S>
bool join_events(const Events<S>& old, const Events<S>& fresh, const AffectedBodies<S>& affected, bool old_sleeps,
                 Events<S>& into) {
  const auto pair_of = [](const auto& event) ISO_INLINE_LAMBDA { return pair_key(event.a.slot, event.b.slot); };
  const auto owns_pair = [&](const auto& event) ISO_INLINE_LAMBDA {
    return affected.contain(event.a.slot) || affected.contain(event.b.slot);
  };
  const auto owns_sensor = [&](const SensorEvent& event) ISO_INLINE_LAMBDA {
    return affected.contain(event.sensor.slot) || affected.contain(event.other.slot);
  };
  const auto overlap_of = [](const SensorEvent& event) ISO_INLINE_LAMBDA {
    return SensorOverlap{event.sensor.slot, event.other.slot, event.sensor_child, event.other_child};
  };
  if (!(old.joint_broke.empty() && fresh.joint_broke.empty())) return false;
  if (!(old.broke.empty() || fresh.broke.empty())) return false;
  for (const Broke<S>& broke : old.broke) {
    if (affected.contain(broke.body.slot)) return false;
  }
  join_lists(old.contact_begin, fresh.contact_begin, pair_of, owns_pair, into.contact_begin);
  join_lists(old.contact_end, fresh.contact_end, pair_of, owns_pair, into.contact_end);
  join_lists(old.sensor_begin, fresh.sensor_begin, overlap_of, owns_sensor, into.sensor_begin);
  join_lists(old.sensor_end, fresh.sensor_end, overlap_of, owns_sensor, into.sensor_end);
  join_lists(old.hits, fresh.hits, pair_of, owns_pair, into.hits);
  join_lists(old.contacts, fresh.contacts, pair_of, owns_pair, into.contacts);
  into.broke = old.broke.empty() ? fresh.broke : old.broke;
  into.joint_broke.clear();
  into.fell_asleep = old_sleeps ? old.fell_asleep : fresh.fell_asleep;
  into.woke = old_sleeps ? old.woke : fresh.woke;
  return true;
}

}  // namespace isostep::detail
