// The size of a frame's input of a character and of a car in a command log.
// SPDX-License-Identifier: MIT

#include "unit/world/worlds.hpp"

namespace isostep::test {
namespace input_bytes_test {

TEST(InputBytes, of_a_character_are_35_and_of_a_car_44_in_q32_32_with_their_number_and_id) {
  using S = Q32_32;
  World<S> w(settings<S>());
  BodyDefinition<S> d = moving<S>(w.add_shape(Capsule<S>{S(0.25), S(0.5)}), {0, 1, 0});
  VehicleSettings<S> vehicle;
  vehicle.body = w.create(d);
  d.type = BodyType::kinematic;
  CharacterSettings<S> character;
  character.body = w.create(d);
  const CharacterId walker = w.add(character);
  const VehicleId car = w.add(vehicle);
  std::vector<std::uint8_t> log;
  w.record_to(&log);
  ASSERT_TRUE(w.set_input(walker, {vec<S>(1, 0, 0), S(3)}));
  EXPECT_EQ(log.size(), 35u);  // 1 + 2 + 4 numbers
  log.clear();
  VehicleInput<S> input;
  input.throttle = S(1);
  ASSERT_TRUE(w.set_input(car, input));
  EXPECT_EQ(log.size(), 44u);  // 1 + 2 + 5 numbers and the gear
}

}  // namespace input_bytes_test
}  // namespace isostep::test
