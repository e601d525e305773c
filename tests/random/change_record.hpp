// A random change among a world's records of one kind: one more, one less, or one that is another now.
// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "random/dice.hpp"
#include "unit/world/worlds.hpp"

namespace isostep::test {

/// `draw` makes a record of the kind. Four are about as many as stay.
template <class S, class Record, class IdType, class Draw>
void change_record(World<S>& world, Dice& dice, const Registry<Record, IdType>& registry, const Draw& draw) {
  const std::vector<IdType> ids = registry.slot_map().template ids<IdType>();
  const std::uint32_t what = dice.below(8);
  if (ids.empty() || (what < 4 && ids.size() < 4)) {
    world.add(draw(Record{}));
    return;
  }
  const IdType id = dice.one_of(ids);
  if (what < 6) world.remove(id);
  else world.set(id, draw(Record{}));
}

}  // namespace isostep::test
