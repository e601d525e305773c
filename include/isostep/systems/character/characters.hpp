// Characters<S>: moves what walks, at the end of a step.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "isostep/commands/command_executor.hpp"
#include "isostep/core/instantiate.hpp"
#include "isostep/query/asked_shape.hpp"
#include "isostep/systems/character/character_walk.hpp"

namespace isostep {

/// Input:   the world at the end of the step, and the characters.
/// Output:  their bodies' poses, the states of the records, forces for the next step on what they push and stand on.
/// Order:   slot by slot, all walk in the world as it was before any moved. Then all are moved, slot by slot.
/// Keeps:   nothing from step to step but memory.
template <class S> class Characters {
 public:
  ISO_INLINE Characters(WorldState<S>& state, const BodyMap<S>& map, Proxies<S>& proxies, IslandWake<S>& wake,
                        CommandExecutor<S>& commands)
      : state_(state), map_(map), proxies_(proxies), wake_(wake), commands_(commands), around_(state, map, proxies) {}

  void update();

 private:
  /// A force that acts during the next step.
  struct Push {
    BodyId body;
    Vec3<S> force, point;  // [N], [m] world
  };
  struct Move {
    std::uint32_t record;  // slot
    Walker<S> character;
    Vec3<S> way;  // [m]
  };
  using Place = typename CharacterWalk<S>::Place;
  void walk(std::uint32_t slot);
  /// The shape and pose whose surroundings are asked for.
  struct Asking {
    ShapeId shape;
    Pose<S> pose;  // of the body's origin
  };
  static QueryFilter seen_by(const Walker<S>& character);
  void find_passed(const Walker<S>& character, const Asking& asking);
  bool is_above(const Walker<S>& character, const Asking& asking, const OneWay<S>& way);
  S highest_of(const Walker<S>& character, BodyId body, Vec3<Unit<S>> axis) const;
  Vec3<S> local_to(BodyId body, Vec3<S> point) const;
  void push_touched(const CharacterWalk<S>& walk, const Walker<S>& character);
  void bear(const Walker<S>& character);
  void put(const Move& move);
  void push(const Push& push);

  WorldState<S>& state_;
  const BodyMap<S>& map_;
  Proxies<S>& proxies_;
  IslandWake<S>& wake_;
  CommandExecutor<S>& commands_;
  std::vector<std::uint8_t> walks_;  // by body slot: detail::obstacle
  std::vector<Move> moves_;
  std::vector<Push> pushes_;
  Surroundings<S> around_;  // of one character
  WalkMemory<S> memory_;
  bool knows_contacts_ = false;              // memory_ has what is near where one begins
  std::vector<BodyId> passed_;               // that one character goes through
  std::vector<std::uint32_t> passed_kinds_;  // likewise
};

#define ISO_CHARACTERS_OF(extern, S) extern template class Characters<S>;
ISO_EXTERN_FOR_EACH_SCALAR(ISO_CHARACTERS_OF)

}  // namespace isostep
