// Every struct crosses to C and back with all its members; every kind of record does in C what it does in C++, and what
// sets shapes and joints does too.
// SPDX-License-Identifier: MIT
#include "c/convert.hpp"
#include "game.hpp"
#include "isostep/core/random.hpp"
#include "isostep/world/world.hpp"
#include "unit/world/named_by_records.hpp"

namespace isostep::test {

/// A struct whose first two members the last release had, in sixteen bytes.
struct Grown {
  std::uint32_t number = 1;
  bool is_old = true;
  bool is_new = true;

  ISO_FIELDS(number, is_old, is_new)
};

}  // namespace isostep::test
template <> inline constexpr int isostep::c::kMembersReleased<isostep::test::Grown> = 2;

namespace isostep::test {
namespace records_test {

using namespace isostep::c;

// ---- Structs

TEST(CStructs, GrowBehindThePaddingThatTheyHad) {
  EXPECT_EQ((offsets_of<Grown, true>()), (std::array<std::size_t, 3>{8, 12, 16}));
  EXPECT_EQ(sized_size<Grown>(), 24u);
  std::uint8_t bytes[24] = {};
  ASSERT_EQ(init_sized<Grown>("", bytes, sizeof bytes), kOk);
  EXPECT_EQ(bytes[16], 1);
  // A caller of the last release: rubbish behind its end is none of its members.
  bytes[0] = 16;
  bytes[12] = 0;
  bytes[16] = 77;
  Grown taken;
  ASSERT_EQ(take_sized("", bytes, taken), kOk) << last_error();
  EXPECT_FALSE(taken.is_old);
  EXPECT_TRUE(taken.is_new);
  bytes[0] = 24;
  EXPECT_EQ(take_sized("", bytes, taken), ISO_BAD_ENUM);
}

/// Any value of every member.
struct AnyValue {
  Pcg32& random;

  template <class T> void operator()(const char*, T& value) const {
    if constexpr (std::is_bounded_array_v<T>) {
      for (auto& element : value) (*this)("", element);
    } else if constexpr (kIsOptional<T>) {
      if (random_below(random, 2) == 0) return value.reset();
      value.emplace();
      (*this)("", *value);
    } else if constexpr (kIsId<T>) {
      value = {random.next(), random.next()};
    } else if constexpr (kIsPointer<T>) {
      value.at = nullptr;
    } else if constexpr (CStruct<T>) {
      CFields<T>::fields(*this, value);
    } else if constexpr (std::is_enum_v<T>) {
      value = static_cast<T>(random_below(random, Enumerators<T>::kCount));
    } else if constexpr (std::is_same_v<T, bool>) {
      value = random_below(random, 2) == 1;
    } else {
      std::uint8_t bits[sizeof(T)];
      for (std::uint8_t& byte : bits) byte = static_cast<std::uint8_t>(random_below(random, 127));  // no NaN
      std::memcpy(static_cast<void*>(&value), bits, sizeof value);
    }
  }
};
/// Expects that no random byte of members is left out.
template <class T, bool kSized> void expect_round_trip(const char* name) {
  constexpr std::size_t kSize = kSized ? sized_size<T>() : extent_of<T>().size;
  Pcg32 random(7, 11);
  for (int i = 0; i < 20; ++i) {
    T value{};
    CFields<T>::fields(AnyValue{random}, value);
    std::vector<std::uint8_t> bytes(kSize), again(kSize);
    T back{};
    if constexpr (kSized) {
      ASSERT_EQ(init_sized<T>("", bytes.data(), bytes.size()), kOk);
      ASSERT_EQ(init_sized<T>("", again.data(), again.size()), kOk);
      const std::vector<std::uint8_t> defaults = bytes;
      ASSERT_EQ(put_sized("", bytes.data(), value), kOk);
      ASSERT_NE(bytes, defaults) << name;
      ASSERT_EQ(take_sized("", bytes.data(), back), kOk) << name << ": " << last_error();
      ASSERT_EQ(put_sized("", again.data(), back), kOk);
    } else {
      put_plain(bytes.data(), value);
      ASSERT_EQ(take_plain("", bytes.data(), back), kOk) << name << ": " << last_error();
      put_plain(again.data(), back);
    }
    ASSERT_EQ(bytes, again) << name;
  }
}

template <class S> void expect_all_round_trips() {
#define ISO_PLAIN(name, Type, S) expect_round_trip<Type, false>(#name);
#define ISO_SIZED(name, Type, S) expect_round_trip<Type, true>(#name);
#define ISO_RECORD(name, Type, Id, S) expect_round_trip<Type, true>(#name);
  ISO_C_PLAIN(ISO_PLAIN, S)
  ISO_C_SIZED(ISO_SIZED, S)
  ISO_FOR_EACH_RECORD(ISO_RECORD, S)
  ISO_FOR_EACH_INPUT(ISO_RECORD, S)
  ISO_FOR_EACH_RECORD_STATE(ISO_RECORD, S)
#undef ISO_PLAIN
#undef ISO_SIZED
#undef ISO_RECORD
}
TEST(CStructs, CrossWithAllTheirMembers) {
  expect_all_round_trips<float>();
  expect_all_round_trips<double>();
  expect_all_round_trips<Q16_16>();
  expect_all_round_trips<Q32_32>();
}

// ---- Records

/// Twins: the same world in C and in C++: two crates, a carrier without weight, a sensor, two hinges and a six-axis
/// joint.
template <class S> struct Twins {
  World<S> cpp;
  iso_world* c = nullptr;
  NamedByRecords<S> named;

  Twins() {
    const ShapeId box = cpp.add_shape(Box{{0.5, 0.5, 0.5}});
    const auto make = [&](BodyType type, int x, bool is_sensor) {
      return cpp.create({.type = type, .shape = box, .position = {S(x), S(1), S(0)}, .sensor = is_sensor});
    };
    named.a = make(BodyType::dynamic, 0, false);
    named.b = make(BodyType::dynamic, 3, false);
    named.carried = make(BodyType::kinematic, 6, false);
    named.sensor = make(BodyType::kinematic, 9, true);
    named.create_joints(cpp);
  }
  ~Twins() { iso_world_destroy(c); }
  Twins(const Twins&) = delete;
  Twins& operator=(const Twins&) = delete;

  /// The C world, by the functions of the scalar, as the C++ world is now.
  template <class SettingsC>
  void create_c(iso_status (*init)(SettingsC*), iso_status (*create)(const SettingsC*, iso_world**)) {
    SettingsC settings;
    ASSERT_EQ(init(&settings), ISO_OK);
    ASSERT_EQ(create(&settings, &c), ISO_OK);
    std::vector<std::uint8_t> state;
    Writer writer(state);
    cpp.write_portable(writer);
    ASSERT_EQ(iso_world_read(c, state.data(), state.size()), ISO_OK) << iso_last_error();
    ASSERT_EQ(iso_world_hash(c), cpp.hash());
  }
};

template <class S, class Record, class Id, class InC, class Add, class Set, class Get, class Remove>
int expect_same_record(Twins<S>& twins, const char* name, Add add, Set set, Get get, Remove remove) {
  const Record record = twins.named.template naming<Record>();
  InC in_c, kept, expected;
  for (InC* each : {&in_c, &kept, &expected}) EXPECT_EQ(init_sized<Record>("", each, sizeof *each), kOk);
  EXPECT_EQ(put_sized("", &in_c, record), kOk);
  iso_record made = 0;
  const iso_status status = add(twins.c, &in_c, &made);
  const Id id = twins.cpp.add(record);
  EXPECT_EQ(status, id ? iso_status{ISO_OK} : static_cast<iso_status>(twins.cpp.fault().fault)) << name;
  if (!id) return 0;
  EXPECT_EQ(made, id_bits(id)) << name;
  EXPECT_EQ(get(twins.c, made, &kept), ISO_OK) << name;
  EXPECT_EQ(put_sized("", &expected, *twins.cpp.find(id)), kOk);
  EXPECT_EQ(std::memcmp(&kept, &expected, sizeof kept), 0) << name;
  EXPECT_EQ(set(twins.c, made, &kept), ISO_OK) << name << ": " << iso_last_error();
  EXPECT_TRUE(twins.cpp.set(id, *twins.cpp.find(id)));
  EXPECT_EQ(iso_world_hash(twins.c), twins.cpp.hash()) << name;
  EXPECT_EQ(iso_world_step(twins.c, nullptr), ISO_OK);
  twins.cpp.step();
  EXPECT_EQ(iso_world_hash(twins.c), twins.cpp.hash()) << name;
  // Some are over after a step, by themselves.
  const iso_status removed = remove(twins.c, made);
  EXPECT_EQ(twins.cpp.remove(id) ? iso_status{ISO_OK} : static_cast<iso_status>(twins.cpp.fault().fault), removed)
      << name;
  EXPECT_EQ(get(twins.c, made, &kept), ISO_FAULT_STALE_ID) << name;
  EXPECT_EQ(iso_world_hash(twins.c), twins.cpp.hash()) << name;
  return 1;
}

#define ISO_SAME(P, name, Record, Id, S)                           \
  accepted += expect_same_record<S, Record, Id, iso_##P##_##name>( \
      twins, #name, iso_##P##_add_##name, iso_##P##_set_##name, iso_##P##_get_##name, iso_remove_##name);
#define ISO_F32(name, Record, Id, S) ISO_SAME(f32, name, Record, Id, S)
#define ISO_F64(name, Record, Id, S) ISO_SAME(f64, name, Record, Id, S)
#define ISO_Q16(name, Record, Id, S) ISO_SAME(q16, name, Record, Id, S)
#define ISO_Q32(name, Record, Id, S) ISO_SAME(q32, name, Record, Id, S)
#define ISO_TEST(P, S, EACH)                                                                  \
  TEST(CRecords, DoWhatTheyDoInCppIn_##P) {                                                   \
    Twins<S> twins;                                                                           \
    ASSERT_NO_FATAL_FAILURE(twins.create_c(iso_##P##_settings_init, iso_##P##_world_create)); \
    int accepted = 0;                                                                         \
    ISO_FOR_EACH_RECORD(EACH, S)                                                              \
    EXPECT_GE(accepted, 20) << "kinds whose defaults a world takes";                          \
  }
ISO_TEST(f32, float, ISO_F32)
ISO_TEST(f64, double, ISO_F64)
ISO_TEST(q16, Q16_16, ISO_Q16)
ISO_TEST(q32, Q32_32, ISO_Q32)
#undef ISO_TEST

// ---- Settings, inputs, states

/// C sets its own copy of the settings in every frame beside the input, C++ the input alone.
template <class S, class SettingsC, class InputC, class Settings, class Input, class Add, class Set, class SetInput>
iso_record expect_stale_settings_take_nothing_back(Twins<S>& twins, const Settings& settings, const Input& input,
                                                   Add add, Set set, SetInput set_input) {
  SettingsC settings_c;
  InputC input_c;
  EXPECT_EQ(init_sized<Settings>("", &settings_c, sizeof settings_c), kOk);
  EXPECT_EQ(init_sized<Input>("", &input_c, sizeof input_c), kOk);
  EXPECT_EQ(put_sized("", &settings_c, settings), kOk);
  EXPECT_EQ(put_sized("", &input_c, input), kOk);
  iso_record made = 0;
  EXPECT_EQ(add(twins.c, &settings_c, &made), ISO_OK) << iso_last_error();
  const auto id = twins.cpp.add(settings);
  for (int frame = 0; frame < 60; ++frame) {
    EXPECT_EQ(set(twins.c, made, &settings_c), ISO_OK) << iso_last_error();
    EXPECT_EQ(set_input(twins.c, made, &input_c), ISO_OK) << iso_last_error();
    EXPECT_TRUE(twins.cpp.set_input(id, input));
    EXPECT_EQ(iso_world_step(twins.c, nullptr), ISO_OK);
    twins.cpp.step();
    EXPECT_EQ(iso_world_hash(twins.c), twins.cpp.hash()) << frame;
  }
  return made;
}

#define ISO_TEST(P, S)                                                                                                 \
  TEST(CRecords, StaleSettingsTakeNothingBackIn_##P) {                                                                 \
    Twins<S> twins;                                                                                                    \
    ASSERT_NO_FATAL_FAILURE(twins.create_c(iso_##P##_settings_init, iso_##P##_world_create));                          \
    CharacterInput<S> walk;                                                                                            \
    walk.move.x = S(1);                                                                                                \
    const iso_record character =                                                                                       \
        expect_stale_settings_take_nothing_back<S, iso_##P##_character, iso_##P##_character_input>(                    \
            twins, twins.named.naming<CharacterSettings<S>>(), walk, iso_##P##_add_character, iso_##P##_set_character, \
            iso_##P##_set_character_input);                                                                            \
    iso_##P##_character_state state;                                                                                   \
    iso_##P##_character_state_init(&state);                                                                            \
    ASSERT_EQ(iso_##P##_get_character_state(twins.c, character, &state), ISO_OK);                                      \
    CharacterState<S> told;                                                                                            \
    ASSERT_EQ(take_sized("", &state, told), kOk);                                                                      \
    EXPECT_LT(to_double(told.velocity.y), -5.0) << "it falls for a second";                                            \
    WheelSettings<S> wheel = twins.named.naming<WheelSettings<S>>();                                                   \
    wheel.drive_share = S(1);                                                                                          \
    iso_##P##_wheel wheel_c;                                                                                           \
    iso_##P##_wheel_init(&wheel_c);                                                                                    \
    ASSERT_EQ(put_sized("", &wheel_c, wheel), kOk);                                                                    \
    iso_record driven = 0;                                                                                             \
    ASSERT_EQ(iso_##P##_add_wheel(twins.c, &wheel_c, &driven), ISO_OK) << iso_last_error();                            \
    ASSERT_EQ(id_bits(twins.cpp.add(wheel)), driven);                                                                  \
    VehicleSettings<S> vehicle = twins.named.naming<VehicleSettings<S>>();                                             \
    vehicle.engine_torque = vehicle.clutch_torque = S(100);                                                            \
    vehicle.engine_inertia = S(1);                                                                                     \
    VehicleInput<S> drive;                                                                                             \
    drive.throttle = S(1);                                                                                             \
    expect_stale_settings_take_nothing_back<S, iso_##P##_vehicle, iso_##P##_vehicle_input>(                            \
        twins, vehicle, drive, iso_##P##_add_vehicle,                                                                  \
        [&](iso_world* world, iso_record id, const iso_##P##_vehicle* stale) {                                         \
          EXPECT_EQ(iso_##P##_set_wheel(world, driven, &wheel_c), ISO_OK) << iso_last_error();                         \
          return iso_##P##_set_vehicle(world, id, stale);                                                              \
        },                                                                                                             \
        iso_##P##_set_vehicle_input);                                                                                  \
    iso_##P##_wheel_state wheel_state;                                                                                 \
    iso_##P##_wheel_state_init(&wheel_state);                                                                          \
    ASSERT_EQ(iso_##P##_get_wheel_state(twins.c, driven, &wheel_state), ISO_OK);                                       \
    WheelState<S> turned;                                                                                              \
    ASSERT_EQ(take_sized("", &wheel_state, turned), kOk);                                                              \
    EXPECT_GT(to_double(turned.spin), 25.0) << "the engine turns it for a second";                                     \
  }
ISO_TEST(f32, float)
ISO_TEST(f64, double)
ISO_TEST(q16, Q16_16)
ISO_TEST(q32, Q32_32)
#undef ISO_TEST

#define ISO_TEST(P, S, N)                                                                                          \
  TEST(CRecords, WheelsAreSpunIn_##P) {                                                                            \
    Twins<S> twins;                                                                                                \
    ASSERT_NO_FATAL_FAILURE(twins.create_c(iso_##P##_settings_init, iso_##P##_world_create));                      \
    const WheelSettings<S> wheel = twins.named.naming<WheelSettings<S>>();                                         \
    iso_##P##_wheel wheel_c;                                                                                       \
    iso_##P##_wheel_init(&wheel_c);                                                                                \
    ASSERT_EQ(put_sized("", &wheel_c, wheel), kOk);                                                                \
    iso_record made = 0;                                                                                           \
    ASSERT_EQ(iso_##P##_add_wheel(twins.c, &wheel_c, &made), ISO_OK) << iso_last_error();                          \
    const WheelId id = twins.cpp.add(wheel);                                                                       \
    ASSERT_EQ(iso_##P##_wheel_set_spin(twins.c, made, static_cast<N>(to_bits(S(3)))), ISO_OK) << iso_last_error(); \
    EXPECT_TRUE(twins.cpp.set_spin(id, S(3)));                                                                     \
    EXPECT_EQ(iso_world_hash(twins.c), twins.cpp.hash());                                                          \
    EXPECT_NE(iso_##P##_wheel_set_spin(twins.c, 0, N{}), ISO_OK) << "no wheel";                                    \
  }
ISO_TEST(q16, Q16_16, std::int32_t)
ISO_TEST(q32, Q32_32, std::int64_t)
#undef ISO_TEST

// ---- Setters

#define ISO_TEST(P, S)                                                                                                \
  TEST(CSetters, ABodyThatGrowsStaysOnItsGroundIn_##P) {                                                              \
    Twins<S> twins;                                                                                                   \
    const ShapeId crate = twins.cpp.add_shape(Box{{0.25, 0.25, 0.25}});                                               \
    const ShapeId ground = twins.cpp.add_shape(Box{{5, 1, 5}}), large = twins.cpp.add_shape(Box{{0.5, 0.5, 0.5}});    \
    twins.cpp.create({.shape = ground, .position = {S(30), S(-1), S(0)}});                                            \
    const BodyId body =                                                                                               \
        twins.cpp.create({.type = BodyType::dynamic, .shape = crate, .position = {S(30), S(0.25), S(0)}});            \
    ASSERT_NO_FATAL_FAILURE(twins.create_c(iso_##P##_settings_init, iso_##P##_world_create));                         \
    EXPECT_EQ(iso_##P##_body_set_shape(twins.c, id_bits(body), id_bits(large), nullptr), ISO_OK) << iso_last_error(); \
    EXPECT_TRUE(twins.cpp.set_shape(body, large));                                                                    \
    for (int frame = 0; frame < 120; ++frame) {                                                                       \
      EXPECT_EQ(iso_world_step(twins.c, nullptr), ISO_OK);                                                            \
      twins.cpp.step();                                                                                               \
    }                                                                                                                 \
    EXPECT_EQ(iso_world_hash(twins.c), twins.cpp.hash());                                                             \
    EXPECT_NEAR(to_double(twins.cpp.pose(body).position.y), 0.5, 0.01);                                               \
    const iso_shape stale = id_bits(large) + (std::uint64_t{1} << 32);                                                \
    EXPECT_EQ(iso_##P##_body_set_shape(twins.c, id_bits(body), stale, nullptr), ISO_FAULT_STALE_ID);                  \
    EXPECT_NE(std::string(iso_last_error()).find("shape:"), std::string::npos) << iso_last_error();                   \
    EXPECT_EQ(iso_world_hash(twins.c), twins.cpp.hash());                                                             \
  }
ISO_TEST(f32, float)
ISO_TEST(f64, double)
ISO_TEST(q16, Q16_16)
ISO_TEST(q32, Q32_32)
#undef ISO_TEST

#define ISO_TEST(P, S, N)                                                                                      \
  TEST(CSetters, OfAHingeDriveItIn_##P) {                                                                      \
    Twins<S> twins;                                                                                            \
    ASSERT_NO_FATAL_FAILURE(twins.create_c(iso_##P##_settings_init, iso_##P##_world_create));                  \
    const JointId id = twins.named.hinge_b;                                                                    \
    const iso_joint hinge = id_bits(id);                                                                       \
    const auto n = [](S value) { return same_bits<N>(value); };                                                \
    const auto expect_to_reach = [&](double angle) {                                                           \
      for (int frame = 0; frame < 60; ++frame) {                                                               \
        EXPECT_EQ(iso_world_step(twins.c, nullptr), ISO_OK);                                                   \
        twins.cpp.step();                                                                                      \
      }                                                                                                        \
      EXPECT_EQ(iso_world_hash(twins.c), twins.cpp.hash());                                                    \
      N position{};                                                                                            \
      EXPECT_EQ(iso_##P##_joint_get_position(twins.c, hinge, &position), ISO_OK);                              \
      EXPECT_NEAR(to_double(same_bits<S>(position)), angle, 0.01);                                             \
    };                                                                                                         \
    EXPECT_EQ(iso_##P##_joint_set_motor(twins.c, hinge, n(S(1)), n(S(1000))), ISO_OK) << iso_last_error();     \
    EXPECT_TRUE(twins.cpp.set_motor(id, S(1), S(1000)));                                                       \
    expect_to_reach(1);                                                                                        \
    EXPECT_EQ(iso_##P##_joint_set_limits(twins.c, hinge, n(S(-1.5)), n(S(1.25))), ISO_OK) << iso_last_error(); \
    EXPECT_TRUE(twins.cpp.set_limits(id, S(-1.5), S(1.25)));                                                   \
    expect_to_reach(1.25);                                                                                     \
    EXPECT_EQ(iso_##P##_joint_set_motor(twins.c, hinge, n(S(0)), n(S(0))), ISO_OK) << iso_last_error();        \
    EXPECT_EQ(iso_##P##_joint_set_spring(twins.c, hinge, n(S(4)), n(S(1))), ISO_OK) << iso_last_error();       \
    EXPECT_EQ(iso_##P##_joint_set_target(twins.c, hinge, n(S(-0.5))), ISO_OK) << iso_last_error();             \
    EXPECT_TRUE(twins.cpp.set_motor(id, S(0), S(0)));                                                          \
    EXPECT_TRUE(twins.cpp.set_spring(id, S(4), S(1)));                                                         \
    EXPECT_TRUE(twins.cpp.set_target(id, S(-0.5)));                                                            \
    expect_to_reach(-0.5);                                                                                     \
    const auto expect_refused = [&](iso_status status, const std::string& field) {                             \
      EXPECT_NE(status, ISO_OK) << field;                                                                      \
      EXPECT_NE(std::string(iso_last_error()).find(field + ":"), std::string::npos) << iso_last_error();       \
      EXPECT_EQ(iso_world_hash(twins.c), twins.cpp.hash());                                                    \
    };                                                                                                         \
    const S too_fast = Limits<S>::angular_speed() + S(1);                                                      \
    expect_refused(iso_##P##_joint_set_limits(twins.c, hinge, n(S(1)), n(S(0))), "lower");                     \
    expect_refused(iso_##P##_joint_set_motor(twins.c, hinge, n(too_fast), n(S(1))), "motor_speed");            \
    expect_refused(iso_##P##_joint_set_spring(twins.c, hinge, n(S(4)), n(S(-1))), "spring_damping");           \
    expect_refused(iso_##P##_joint_set_target(twins.c, hinge, n(S(7))), "spring_target");                      \
  }
ISO_TEST(f32, float, float)
ISO_TEST(f64, double, double)
ISO_TEST(q16, Q16_16, std::int32_t)
ISO_TEST(q32, Q32_32, std::int64_t)
#undef ISO_TEST

}  // namespace records_test
}  // namespace isostep::test
