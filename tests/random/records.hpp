// Random records of every kind, added to worlds, changed and removed: functions of the state and the dice.
// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "random/record_draw.hpp"

namespace isostep::test {

/// A kind whose records come with bodies and joints of their own, or into worlds of their own choice, elsewhere in
/// random worlds: mechanisms.hpp, mounts.hpp, vehicles.hpp, parts.hpp, changes.hpp. All others are drawn here.
template <class Record> inline constexpr bool kIsDrawnElsewhere = false;
template <class S> inline constexpr bool kIsDrawnElsewhere<AxisDrive<S>> = true;
template <class S> inline constexpr bool kIsDrawnElsewhere<Breakable<S>> = true;
template <class S> inline constexpr bool kIsDrawnElsewhere<CharacterSettings<S>> = true;
template <class S> inline constexpr bool kIsDrawnElsewhere<ContactReport<S>> = true;
template <class S> inline constexpr bool kIsDrawnElsewhere<Coupling<S>> = true;
template <class S> inline constexpr bool kIsDrawnElsewhere<JointLoad<S>> = true;
template <class S> inline constexpr bool kIsDrawnElsewhere<MaterialPair<S>> = true;
template <class S> inline constexpr bool kIsDrawnElsewhere<SensorMount<S>> = true;
template <class S> inline constexpr bool kIsDrawnElsewhere<VehicleSettings<S>> = true;
template <class S> inline constexpr bool kIsDrawnElsewhere<WheelSettings<S>> = true;

template <class S> class RandomRecords {
 public:
  RandomRecords(World<S>& world, Dice& dice) : world_(world), dice_(dice) {}

  /// Of any kind that is drawn here.
  void change() {
    std::uint32_t kinds = 0, i = 0;
    for_each_drawn([&](const auto&) { ++kinds; });
    const std::uint32_t kind = dice_.below(kinds);
    for_each_drawn([&](const auto& registry) {
      if (i++ == kind) change(registry);
    });
  }
  /// One more, one less, or one that is another now. Four are about as many as stay; the world refuses a second one
  /// about the same.
  template <class Record, class IdType> void change(const Registry<Record, IdType>& registry) {
    const std::vector<IdType> ids = registry.slot_map().template ids<IdType>();
    const std::uint32_t what = dice_.below(8);
    if (ids.empty() || (what < 4 && ids.size() < 4)) {
      world_.add(drawn<Record>());
      return;
    }
    const IdType id = dice_.one_of(ids);
    if (what < 6) world_.remove(id);
    else world_.set(id, drawn<Record>());
  }
  template <class Record> Record drawn() {
    Record record;
    RecordDraw<S>(world_, dice_).draw(record);
    return record;
  }

 private:
  template <class Visit> void for_each_drawn(const Visit& visit) const {
    RecordStore<S>::members(
        [&]<class Record, class IdType>(const char*, const Registry<Record, IdType>& registry) {
          if constexpr (!kIsDrawnElsewhere<Record>) visit(registry);
        },
        *world_.state().records);
  }

  World<S>& world_;
  Dice& dice_;
};

}  // namespace isostep::test
