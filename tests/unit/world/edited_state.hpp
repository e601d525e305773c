// A world that goes on from a state which no command makes, as from a file that somebody wrote.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/state/members.hpp"
#include "unit/world/worlds.hpp"

namespace isostep::test {

/// `edit` changes a copy of the parts of records, which the world then reads.
template <class S, class Edit> void edit_parts(World<S>& world, const Edit& edit) {
  WorldState<S> state = world.state();
  edit(state.parts);
  std::vector<std::uint8_t> bytes;
  Writer writer(bytes);
  writer.write(ScalarTraits<S>::kId);
  WorldState<S>::members(detail::StateWriter(writer), state);
  Reader reader(bytes);
  EXPECT_TRUE(world.read_portable(reader).ok());
}

}  // namespace isostep::test
