// States read from outside: a character's body has a shape that can be cast, and the character what a step may leave,
// or the state is refused.
// SPDX-License-Identifier: MIT

#include "isostep/store/state_validator.hpp"
#include "unit/world/worlds.hpp"

namespace isostep::test {
namespace character_state_test {

template <class S> class CharacterStates : public ::testing::Test {};
TYPED_TEST_SUITE(CharacterStates, AllScalars);

TYPED_TEST(CharacterStates, are_of_shapes_that_can_be_cast) {
  using S = TypeParam;
  World<S> w(settings<S>());
  BodyDefinition<S> d = moving<S>(w.add_shape(Capsule<S>{num<S>(0.25), num<S>(0.5)}), {0, 1, 0});
  d.type = BodyType::kinematic;
  CharacterSettings<S> character;
  character.body = w.create(d);
  ASSERT_TRUE(w.add(character));
  const D3 half = {0.5, 0.5, 0.5};
  const ShapeId two = add_two_boxes(w, half, {-1, 0, 0}, half, {1, 0, 0});
  const ShapeId ball = add_ball(w, 0.5), plane = w.add_shape(HalfSpace<S>{vec<Unit<S>>(0, 1, 0), S(0)});
  const auto is_valid_with = [&](ShapeId shape) {
    WorldState<S> state = w.state();
    state.awake.properties[0].shape = shape.slot;
    return broken_rule(state) == nullptr;
  };
  ASSERT_TRUE(ball && two && plane) << describe(w.fault());
  ASSERT_EQ(w.state().awake.properties.size(), 1u);
  EXPECT_TRUE(is_valid_with(ball));
  EXPECT_FALSE(is_valid_with(two));
  EXPECT_FALSE(is_valid_with(plane));
}

TYPED_TEST(CharacterStates, have_inputs_and_states_in_range_and_none_where_there_is_no_record) {
  using S = TypeParam;
  World<S> w(settings<S>());
  BodyDefinition<S> d = moving<S>(w.add_shape(Capsule<S>{num<S>(0.25), num<S>(0.5)}), {0, 1, 0});
  d.type = BodyType::kinematic;
  CharacterSettings<S> character;
  character.body = w.create(d);
  const CharacterId id = w.add(character);
  d.position = vec<S>(4, 1, 0);
  character.body = w.create(d);
  const CharacterId gone = w.add(character);
  ASSERT_TRUE(id && gone && w.remove(gone));
  const auto is_valid_with = [&](const auto& change) {
    WorldState<S> state = w.state();
    change(state.parts);
    return broken_rule(state) == nullptr;
  };
  const auto of_state = [&](const auto& change) {
    return is_valid_with([&](RecordParts<S>& parts) { change(parts.character_states[id.slot]); });
  };
  EXPECT_TRUE(of_state([](auto&) {}));
  EXPECT_FALSE(of_state([](auto& c) { c.footing = static_cast<Footing>(3); }));
  EXPECT_FALSE(of_state([](auto& c) { c.normal.x = Unit<S>(0.5); }));
  EXPECT_FALSE(of_state([](auto& c) { c.velocity.y = Limits<S>::speed() + S(1); }));
  EXPECT_FALSE(of_state([](auto& c) { c.foot_at.x = highest<S>(); }));
  EXPECT_FALSE(is_valid_with([&](auto& parts) { parts.character_inputs[id.slot].jump = S(-1); }));
  EXPECT_FALSE(is_valid_with([&](auto& parts) { parts.character_inputs[gone.slot].jump = S(1); }));
  EXPECT_FALSE(is_valid_with([&](auto& parts) { parts.character_states[gone.slot].stuck = 1; }));
  EXPECT_FALSE(is_valid_with([&](auto& parts) { parts.character_states.pop_back(); }));
  EXPECT_FALSE(is_valid_with([&](auto& parts) { parts.character_inputs.emplace_back(); }));
}

}  // namespace character_state_test
}  // namespace isostep::test
