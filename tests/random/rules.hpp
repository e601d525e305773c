// Random records of how bodies touch, added to worlds, changed and removed: functions of the state and the dice.
// SPDX-License-Identifier: MIT
#pragma once

#include "random/dice.hpp"
#include "unit/world/worlds.hpp"

namespace isostep::test {

/// Belts no faster than movers are, ghosts and one-way bodies among what moves, so that nothing leaves through the
/// ground, and reports of hits.
template <class S> class RandomRules {
 public:
  RandomRules(World<S>& world, Dice& dice, double most_speed) : world_(world), dice_(dice), most_speed_(most_speed) {}

  /// One more, one less, or one that is another now.
  void change() {
    const RecordStore<S>& records = *world_.state().records;
    switch (dice_.below(4)) {
      case 0: return change(records.surface_velocitys);
      case 1: return change(records.ghosts);
      case 2: return change(records.one_ways);
      default: return change(records.hit_reports);
    }
  }

 private:
  template <class Record, class IdType> void change(const Registry<Record, IdType>& registry) {
    const std::vector<IdType> ids = registry.slot_map().template ids<IdType>();
    const std::uint32_t what = dice_.below(8);
    if (ids.empty() || (what < 5 && ids.size() < 4)) {
      const Record record = drawn(Record{});
      if (detail::first_body_of(record) && is_new(registry, record)) world_.add(record);
      return;
    }
    const IdType id = dice_.one_of(ids);
    if (what == 5) {
      world_.remove(id);
      return;
    }
    if constexpr (requires(Record record) { record.body; }) {
      Record record = drawn(Record{});
      record.body = world_.find(id)->body;
      if constexpr (std::is_same_v<Record, SurfaceVelocity<S>>) {
        record.part = world_.find(id)->part;
        calm(record);
      }
      world_.set(id, record);
    }
  }
  /// The record's body or bodies have none yet, or none for its part.
  template <class Record, class IdType>
  static bool is_new(const Registry<Record, IdType>& registry, const Record& record) {
    const BodyId a = detail::first_body_of(record), b = detail::second_body_of(record);
    for (const Record& other : registry.all()) {
      if constexpr (requires { record.part; }) {
        if (record.part != other.part) continue;
      }
      const BodyId c = detail::first_body_of(other), d = detail::second_body_of(other);
      if ((a == c && b == d) || (b && a == d && b == c)) return false;
    }
    return true;
  }
  BodyId any_body() {
    const std::vector<BodyId> all = world_.bodies();
    return dice_.one_of(all);
  }
  BodyId moving_body() {
    for (int tries = 0; tries < 8; ++tries) {
      const BodyId id = any_body();
      if (world_.type(id) != BodyType::static_) return id;
    }
    return {};
  }
  /// The ground is wide: what turns with it would be fast.
  void calm(SurfaceVelocity<S>& belt) const {
    if (world_.type(belt.body) == BodyType::static_) belt.angular = Vec3<S>::zero();
  }

  SurfaceVelocity<S> drawn(SurfaceVelocity<S> belt) {
    belt.body = any_body();
    belt.linear = vec<S>(dice_.arrow(0, most_speed_));
    belt.angular = vec<S>(dice_.arrow(0, most_speed_ / 4));
    calm(belt);
    Dice own = dice_.apart();
    if (own.one_in(2)) belt.part = own.below(parts_of(belt.body));
    return belt;
  }
  std::uint32_t parts_of(BodyId body) const {
    const WorldState<S>& state = world_.state();
    return static_cast<std::uint32_t>(state.shapes[world_.view(body).properties->shape]->children.size());
  }
  Ghost<S> drawn(Ghost<S> ghost) {
    ghost.a = moving_body();
    ghost.b = moving_body();
    if (!ghost.b || ghost.a == ghost.b) ghost.a = {};
    return ghost;
  }
  OneWay<S> drawn(OneWay<S> way) {
    way.body = moving_body();
    if (dice_.one_in(2)) way.axis = {Unit<S>(1), Unit<S>(0), Unit<S>(0)};
    way.least_cosine = num<S>(dice_.in(0.25, 0.75));
    return way;
  }
  HitReport<S> drawn(HitReport<S> report) {
    report.body = any_body();
    report.speed = num<S>(dice_.in(0, 4));
    return report;
  }

  World<S>& world_;
  Dice& dice_;
  double most_speed_;  // [m/s]
};

}  // namespace isostep::test
