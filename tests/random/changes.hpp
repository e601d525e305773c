// What becomes of a random world beside its bodies' motion: its ground, records, vehicles, characters and couplings,
// each drawn by dice of its own.
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <vector>

#include "isostep/fracture/breaking.hpp"
#include "random/bodies.hpp"
#include "random/mechanisms.hpp"
#include "random/mounts.hpp"
#include "random/placing.hpp"
#include "random/records.hpp"
#include "random/vehicles.hpp"

namespace isostep::test {

inline Drive drive_of(std::uint64_t seed) { return static_cast<Drive>(seed % kDrives); }

/// Functions of the state, the seed and the frame alone.
template <class S> class RandomChanges {
 public:
  static constexpr double kMoverSpeed = 2;  // [m/s] most of a point of a mover or belt

  static void change(World<S>& w, std::uint64_t seed, std::uint64_t frame) {
    dig(w, seed, frame);
    change_records(w, seed, frame);
    break_some(w, seed, frame);
    walk_some(w, seed, frame);
    drive_some(w, seed, frame);
    couple_some(w, seed, frame);
    change_pairs(w, seed, frame);
    change_bodies(w, seed, frame);
    change_mounts(w, seed, frame);
    report_contacts(w, seed, frame);
  }

 private:
  /// Lowers the height field somewhere now and then, if there is one, or cuts a hole: it is never higher, which would
  /// lift what lies on it. It has dice of its own: what is drawn after it is as it was before there was this.
  static void dig(World<S>& w, std::uint64_t seed, std::uint64_t frame) {
    Dice dice(seed * 104729 + frame * 7907 + 3);
    if (!dice.one_in(12)) return;
    const BakedHeightField* field = nullptr;
    ShapeId shape;
    for (const BodyId id : w.bodies()) {
      const std::uint32_t slot = w.view(id).properties->shape;
      shape = w.state().shape_slots.template id_of<ShapeId>(slot);
      if ((field = w.height_field(shape)) != nullptr) break;
    }
    if (field == nullptr) return;
    const HeightGrid grid = field->grid();
    const std::uint32_t wide = 1 + dice.below(3), deep = 1 + dice.below(3);
    HeightPatch patch = {dice.below(grid.columns - wide + 1), dice.below(grid.rows - deep + 1), wide, deep, {}, {}};
    std::vector<std::int16_t> heights;
    const std::int32_t lower = static_cast<std::int32_t>(dice.below(1u << (grid.exponent - grid.height_shift)) / 8);
    const std::int32_t least = -(1 << (grid.exponent - grid.height_shift));  // [units] 1 m: where the plane below is
    for (std::uint32_t n = 0; n < wide * deep; ++n) {
      const std::size_t at = (patch.row + n / wide) * std::size_t{grid.columns} + patch.column + n % wide;
      heights.push_back(static_cast<std::int16_t>(std::max(field->heights()[at] - lower, least)));
    }
    const std::vector<std::uint8_t> holes((wide - 1) * (deep - 1), BakedHeightField::kHole);
    patch.heights = heights;
    if (dice.one_in(4)) patch.materials = holes;
    w.set_heights(shape, 0, patch);
  }
  /// Records of most kinds, in worlds whose energy no law bounds. Dice of its own.
  static void change_records(World<S>& w, std::uint64_t seed, std::uint64_t frame) {
    if (drive_of(seed) != Drive::movers) return;
    Dice dice(seed * 15485863 + frame * 32452843 + 29);
    if (dice.one_in(3)) RandomRecords<S>(w, dice).change();
  }
  /// Bodies that may break, in the same worlds, and pieces of those that did. Dice of its own.
  static void break_some(World<S>& w, std::uint64_t seed, std::uint64_t frame) {
    if (drive_of(seed) != Drive::movers) return;
    break_bodies(w);
    Dice dice(seed * 86028121 + frame * 122949823 + 17);
    if (!dice.one_in(12) || w.bodies().size() > kMostWhileBreaking) return;
    w.add(RandomRecords<S>(w, dice).template drawn<Breakable<S>>());
  }
  static constexpr std::size_t kMostWhileBreaking = 60;  // [1] bodies
  /// Up to three characters who wander and jump, in the same worlds. Dice of its own.
  static void walk_some(World<S>& w, std::uint64_t seed, std::uint64_t frame) {
    if (drive_of(seed) != Drive::movers) return;
    Dice dice(seed * 141650939 + frame * 160481183 + 23);
    if (!dice.one_in(12)) return;
    const std::vector<CharacterId> ids = w.state().records->characters.slot_map().template ids<CharacterId>();
    if (ids.size() < 3 && dice.one_in(2)) return add_character(w, dice);
    if (ids.empty()) return;
    const CharacterId id = dice.one_of(ids);
    if (dice.one_in(12)) {
      w.remove(id);
      return;
    }
    CharacterInput<S> input;
    RecordDraw<S> random(w, dice);
    detail::RecordRules<CharacterSettings<S>>::draw(input, random);
    w.set_input(id, input);
  }
  static void add_character(World<S>& w, Dice& dice) {
    BodyDefinition<S> d = still<S>(w.add_shape(Capsule<S>{num<S>(0.25), num<S>(0.5)}));
    d.type = BodyType::kinematic;
    d.allow_sleep = dice.one_in(2);
    const BodyId body = place_freely(w, dice, d, 0.75, {-4, 1, -4}, {4, 3, 4}, 0);
    CharacterSettings<S> character = RandomRecords<S>(w, dice).template drawn<CharacterSettings<S>>();
    character.body = body;
    if (body) w.add(character);
  }
  /// Vehicles, in the same worlds. Dice of its own.
  static void drive_some(World<S>& w, std::uint64_t seed, std::uint64_t frame) {
    if (drive_of(seed) != Drive::movers) return;
    Dice dice(seed * 198491317 + frame * 217645177 + 31);
    if (!dice.one_in(12)) return;
    RandomVehicles<S> vehicles(w, dice);
    BodyId chassis;
    if (vehicles.has_room() && dice.one_in(2)) {
      BodyDefinition<S> d = moving<S>(add_box(w, 0.5, 0.25, 1), {0, 0, 0});
      d.mass = num<S>(dice.in(2, 40));
      chassis = place_freely(w, dice, d, 1.25, {-4, 1, -4}, {4, 3, 4}, 0);
    }
    vehicles.change(chassis);
  }
  /// Couplings, and joints that may break. Dice of its own.
  static void couple_some(World<S>& w, std::uint64_t seed, std::uint64_t frame) {
    Dice dice(seed * 275604541 + frame * 295075147 + 37);
    if (seed % 2 == 0 && dice.one_in(12)) RandomMechanisms<S>(w, dice).change();
  }
  /// A record of two kinds more, or other, or none: whatever they say, contacts take energy. Dice of its own.
  static void change_pairs(World<S>& w, std::uint64_t seed, std::uint64_t frame) {
    Dice dice(seed * 49979687 + frame * 67867967 + 11);
    if (dice.one_in(8)) RandomRecords<S>(w, dice).change(w.state().records->material_pairs);
  }
  /// Changes what bodies are, where movers are. It has dice of its own.
  static void change_bodies(World<S>& w, std::uint64_t seed, std::uint64_t frame) {
    if (drive_of(seed) != Drive::movers) return;
    Dice dice(seed * 314606869 + frame * 334214467 + 41);
    if (dice.one_in(8)) RandomBodies<S>(w, dice, kMoverSpeed).change();
  }
  /// Sensors that go with bodies, in half of the same worlds: the others stay as they were. Dice of its own.
  static void change_mounts(World<S>& w, std::uint64_t seed, std::uint64_t frame) {
    if (drive_of(seed) != Drive::movers || seed / kDrives % 2 != 0) return;
    Dice dice(seed * 393342739 + frame * 413158511 + 47);
    if (dice.one_in(6)) RandomMounts<S>(w, dice).change();
  }
  /// Adds and removes reports of contacts in all worlds: they change no motion. Dice of its own.
  static void report_contacts(World<S>& w, std::uint64_t seed, std::uint64_t frame) {
    Dice dice(seed * 433494437 + frame * 452930477 + 53);
    if (dice.one_in(12)) RandomRecords<S>(w, dice).change(w.state().records->contact_reports);
  }
};

}  // namespace isostep::test
