// Records in scene files: each kind with each field reaches the world and returns to the file; what is wrong is named.
// SPDX-License-Identifier: MIT
#include "scenes/scene_records.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cstdio>

#include "isostep/store/state.hpp"
#include "random/record_draw.hpp"
#include "scenes/build.hpp"
#include "scenes/scene_file.hpp"

namespace isostep::scenes {
namespace scene_records_test {

constexpr char kBodies[] = R"({"bodies": [
  {"type": "dynamic", "position": [0, 2, 0], "shapes": [{"type": "sphere", "radius": 0.5}]},
  {"type": "dynamic", "position": [3, 2, 0], "shapes": [{"type": "sphere", "radius": 0.5}]},
  {"type": "kinematic", "position": [6, 2, 0], "shapes": [{"type": "sphere", "radius": 0.5}]},
  {"type": "kinematic", "position": [9, 2, 0], "sensor": true, "shapes": [{"type": "sphere", "radius": 0.5}]}],
  "joints": [
  {"type": "slider", "a": -1, "b": 0, "anchor": [0, 2, 0]}, {"type": "slider", "a": -1, "b": 1, "anchor": [3, 2, 0]},
  {"type": "slider", "a": 0, "b": 1, "anchor": [1, 2, 0]},
  {"type": "six_axis", "a": 0, "b": 1, "anchor": [1, 2, 0], "lock_x": true}], "records": [)";

std::string scene_of(const std::string& record) { return kBodies + record + "]}"; }

// With all their fields and those of their inputs, none as it is by itself.
constexpr const char* kRecords[] = {
    R"({"type": "force_zone", "shape": "sphere", "position": [1, 2, 3], "orientation": [0, 0, 0, 1], )"
    R"("half": [2, 0, 0], "acceleration": [0, 1, 0], "wind": [3, 0, 0], "mask": 5, )"
    R"("priority": -7, "replaces": 5})",
    R"({"type": "attractor", "body": 1, "point": [1, 0, 0], "strength": 4, "least_distance": 0.5, )"
    R"("range": 8, "mask": 1})",
    R"({"type": "body_spring", "a": 0, "b": 1, "anchor_a": [0, 0.25, 0], "anchor_b": [0, 0, 0.25], )"
    R"("rest_length": 2, "stiffness": 8, "damping": 0.5, "only_pulls": true})",
    R"({"type": "thruster", "body": 0, "point": [0, 0.25, 0], "force": [1, 2, 3]})",
    R"({"type": "buoyancy", "body": 0, "point": [0, 0.25, 0], "max_depth": 0.5, "volume": 0.5, )"
    R"("surface_height": 1, "density": 2})",
    R"({"type": "explosion", "centre": [1, 0, 0], "begin": 30, "implosion_force": 1, "implosion_least": 0.5, )"
    R"("implosion_most": 4, "implosion_duration": 0.25, "wave_force": 8, "wave_speed": 30, "wave_width": 2, )"
    R"("wave_ramp": 0.25, "wave_duration": 0.5, "chimney_force": 3, "chimney_radius": 2, "chimney_height": 4, )"
    R"("chimney_duration": 1, "is_shielded": true, "mask": 7})",
    R"({"type": "water", "surface_height": 1, "density": 2, "middle": [1, 0, 0], "half": [8, 8, 8], )"
    R"("current": [0.5, 0, 0], "linear_drag": 1, "quadratic_drag": 0.25, "angular_drag": 1, "wave_height": 0.25, )"
    R"("wave_length": 8, "wave_period": 2, "wave_direction": [0, 0, 1], "mask": 3, "priority": -7, "replaces": true})",
    R"({"type": "drag", "body": 0, "linear": 1, "quadratic": 0.5, "angular": 0.25})",
    R"({"type": "aero_surface", "body": 0, "point": [0, 0, 0.25], "orientation": [0, 1, 0, 0], )"
    R"("tensor": [[-1, 0, 0], [0, -2, 0], [0, 0, -3]], "low": [[0, 1, 0], [0, 0, 0], [0, 0, 0]], )"
    R"("high": [[0, 2, 0], [0, 0, 0], [0, 0, 0]], "control": 0.5, "is_quadratic": true, "is_under_water": true})",
    R"({"type": "material_pair", "kind_a": 1, "kind_b": 4294967295, "friction": 0.5, "static_friction": 1, )"
    R"("restitution": 0.25, "rolling_resistance": 0.125, "spin_resistance": 0.25})",
    R"({"type": "breakable", "body": 0, "break_impulse": 4, "pattern": "radial", "most_pieces": 12, "depth": 2, )"
    R"("grain": [1, 0, 0], "seed": 7, "small_mass": 0.25, "lifetime": 60, "expires": 600, "owns_shape": true, )"
    R"("impulse": 0.5, "point": [0, 0.25, 0], "direction": [0, -1, 0]})",
    R"({"type": "character", "body": 2, "step_height": 0.25, "least_up": 0.5, "skin": 0.03125, "mass": 60, )"
    R"("push_force": 100, "air_acceleration": 5, "gravity_scale": 0.5, "mask": 3, "move": [1, 0, 0], "jump": 2})",
    R"({"type": "vehicle", "body": 0, "engine_torque": 200, "engine_speed": 400, )"
    R"("gears": [0, -3, 3, 2, 1.5, 1, 0.75, 0.5], "final_drive": 3, "engine_inertia": 0.25, )"
    R"("clutch_torque": 100, "differential_lock": 0.5, )"
    R"("brake_torque": 8, "handbrake_torque": 4, "ackermann": 0.5, "track_steer": 1.5, "throttle": 0.5, )"
    R"("clutch": 0.75, "brake": 0.25, "handbrake": 0.125, "steer": -0.5, "gear": 2})",
    R"({"type": "wheel", "body": 0, "hard_point": [0, 0.25, 0], "suspension": [0, 0, -1], )"
    R"("axle_direction": [0, 1, 0], "free_length": 0.5, "travel": 0.25, "stiffness": 8, "damping": 2, )"
    R"("radius": 0.25, "inertia": 2, "grip_along": 0.5, "grip_across": 0.75, "peak_slip": 0.125, "peak_grip": 2, )"
    R"("slide_slip": 0.5, "slide_grip": 0.75, "steer_angle": 0.5, )"
    R"("drive_share": 0.5, "brake_share": 0.5, "handbrake_share": 1, "axle": 3, "anti_roll": 4, "track": 2})",
    R"({"type": "joint_load", "joint": 1, "break_force": 8, "break_torque": 4})",
    R"({"type": "coupling", "joint_a": 0, "joint_b": 1, "joint_c": 2, "ratio_a": 2, "ratio_b": -0.5, "ratio_c": 1, )"
    R"("lower": -1, "upper": 1})",
    R"({"type": "axis_drive", "joint": 3, "axis": "swing_y", "limited": true, "motor": true, "lower": -1, )"
    R"("upper": 1, "motor_speed": 2, "spring_target": 0.5, "spring_frequency": 4, "spring_damping": 1, )"
    R"("max_force": 3, "spring_mass": 2, "limit_frequency": 8, "limit_damping": 1})",
    R"({"type": "surface_velocity", "body": 0, "linear": [2, 0, 0.5], "angular": [0, 1, 0], "part": 0})",
    R"({"type": "sensor_mount", "sensor": 3, "on": 0, "position": [0, 0.5, 0], "orientation": [0, 1, 0, 0]})",
    R"({"type": "ghost", "a": 0, "b": 1})",
    R"({"type": "one_way", "body": 0, "axis": [1, 0, 0], "least_cosine": 0.75})",
    R"({"type": "hit_report", "body": 0, "speed": 2})",
    R"({"type": "contact_report", "body": 1})",
    R"({"type": "kind_ghost", "kind_a": 1, "kind_b": 4294967295})",
    R"({"type": "kind_response", "kind_a": 1, "kind_b": 4294967295, "inverse_mass_scale_a": 0.25, )"
    R"("inverse_mass_scale_b": 0.5, "inverse_inertia_scale_a": 0.5, "inverse_inertia_scale_b": 0, "max_force": 8})",
    R"({"type": "damping_zone", "shape": "box", "position": [1, 0, 0], "orientation": [0, 1, 0, 0], )"
    R"("half": [2, 1, 1], "linear": 2, "angular": 0.5, "mask": 3, "priority": -7, "replaces": true})",
};
template <class S> class SceneRecords : public testing::Test {};
using Scalars = testing::Types<float, double, Q16_16, Q32_32>;
TYPED_TEST_SUITE(SceneRecords, Scalars);

/// Every field of it is another than it is by itself.
template <class Record> void expect_all_fields_set(const Record& record, const char* text) {
  const Record plain;
  Record::fields(
      [&](const char* name, const auto& member) {
        std::vector<std::uint8_t> a, b;
        Writer(a).write(member);
        Record::fields(
            [&](const char* other, const auto& same) {
              if (std::string_view(name) == other) Writer(b).write(same);
            },
            plain);
        EXPECT_NE(a, b) << text << ": " << name;
      },
      record);
}
/// Expects all fields set of the one record that a world has, and of its input.
template <class S> void expect_all_fields_set(const World<S>& world, const char* text) {
  int records = 0;
  RecordStore<S>::members(
      [&]<class Record, class IdType>(const char*, const Registry<Record, IdType>& registry) {
        for (const Record& record : registry.all()) {
          ++records;
          expect_all_fields_set(record, text);
        }
        if constexpr (requires { detail::inputs_of(world.state().parts, IdType{}); }) {
          for (const auto& input : detail::inputs_of(world.state().parts, IdType{})) expect_all_fields_set(input, text);
        }
      },
      *world.state().records);
  EXPECT_EQ(records, 1) << text;
}

TYPED_TEST(SceneRecords, reach_the_world_with_all_their_fields_and_return_to_the_file) {
  using S = TypeParam;
  for (const char* record : kRecords) {
    const Scene scene = read_scene(scene_of(record));
    ASSERT_EQ(scene.records.size(), 1u);
    EXPECT_EQ(text_of(scene.records[0]), record);
    World<S> world(settings_of<S>(scene)), again(settings_of<S>(scene));
    build(scene, world);
    build(read_scene(write_scene(scene)), again);
    EXPECT_EQ(world.hash(), again.hash());
    expect_all_fields_set(world, record);
  }
}

/// The text of a record in a scene whose bodies and joints have their places for slots.
class RecordText {
 public:
  template <class Record> static std::string of(const char* kind, const Record& record) {
    RecordText writer{std::string("{\"type\": \"") + kind + '"'};
    Record::fields([&](const char* name, const auto& member) { writer.member(name, member); }, record);
    return writer.text_ + "}";
  }

 private:
  explicit RecordText(std::string text) : text_(std::move(text)) {}

  template <class T> void member(const char* name, const T& value) {
    if constexpr (requires { value.orientation; }) {
      member("position", value.position);
      member("orientation", value.orientation);
    } else {
      text_ += std::string(", \"") + name + "\": " + of(value);
    }
  }
  template <class T> static std::string of(const T& value) {
    if constexpr (std::is_same_v<T, bool>) return value ? "true" : "false";
    else if constexpr (std::is_enum_v<T>) return '"' + std::string(words_of(value)[std::size_t(value)]) + '"';
    else if constexpr (std::is_integral_v<T>) return std::to_string(value);
    else if constexpr (requires { value.generation; }) return value ? std::to_string(value.slot) : "-1";
    else if constexpr (requires { value.rows; }) return list(value.rows);
    else if constexpr (requires { value.w; }) return list(std::array{value.x, value.y, value.z, value.w});
    else if constexpr (requires { value.z; }) return list(std::array{value.x, value.y, value.z});
    else if constexpr (std::is_array_v<T>) return list(value);
    else return exact(value);
  }
  static std::string exact(double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%.17g", value);
    return text;
  }
  template <class List> static std::string list(const List& values) {
    std::string text;
    for (const auto& value : values) text += (text.empty() ? "" : ", ") + of(value);
    return "[" + text + "]";
  }

  std::string text_;
};

/// Adds a random record to a world, and to another by a file of its fields.
template <class Record> void expect_taken_from_a_file(const char* kind, test::Dice& dice) {
  for (int tries = 0, taken = 0; taken < 5; ++tries) {
    ASSERT_LT(tries, 20000) << kind;
    const Scene empty = read_scene(scene_of(""));
    World<double> world(settings_of<double>(empty)), again(settings_of<double>(empty));
    build(empty, world);
    Record record;
    test::RecordDraw<double>(world, dice).draw(record);
    if (!world.add(record)) continue;
    ++taken;
    const std::string text = RecordText::of(kind, record);
    build(read_scene(scene_of(text)), again);
    ASSERT_EQ(world.hash(), again.hash()) << text;
  }
}
TEST(SceneRecordKeys, are_the_fields_of_every_kind) {
  test::Dice dice(3);
#define ISO_TRY(name, Record, Id, S) expect_taken_from_a_file<Record>(#name, dice);
  ISO_FOR_EACH_RECORD(ISO_TRY, double)
#undef ISO_TRY
}

TEST(SceneRecordFaults, name_the_place) {
  const auto error = [](const std::string& record) -> std::string {
    try {
      const Scene scene = read_scene(scene_of(record));
      World<Q16_16> world(settings_of<Q16_16>(scene));
      build(scene, world);
    } catch (const SceneError& e) {
      return e.what();
    }
    return "";
  };
  EXPECT_EQ(error(R"({"type": "drag", "body": 0, "linear": 1})"), "");
  EXPECT_NE(error(R"({"type": "magic"})").find("/records/0/type: expected force_zone, "), std::string::npos);
  EXPECT_EQ(error(R"({"type": "drag", "body": 0, "speed": 1})"), "/records/0/speed: unknown key");
  EXPECT_EQ(error(R"({"type": "character", "body": 2, "footing": "steep"})"), "/records/0/footing: unknown key");
  EXPECT_EQ(error(R"({"type": "wheel", "body": 0, "spin": 2})"), "/records/0/spin: unknown key");
  EXPECT_EQ(error(R"({"type": "drag"})"), "/records/0: the key \"body\" is missing");
  EXPECT_EQ(error(R"({"type": "sensor_mount", "sensor": 3})"), "/records/0: the key \"on\" is missing");
  EXPECT_NE(error(R"({"type": "drag", "body": 4})").find("/records/0/body: expected a whole"), std::string::npos);
  EXPECT_NE(error(R"({"type": "drag", "body": 0, "linear": 1e9})").find("/records/0/linear"), std::string::npos);
  EXPECT_NE(error(R"({"type": "drag", "body": 0, "linear": -1})").find("linear"), std::string::npos);
  EXPECT_NE(error(R"({"type": "character", "body": 2, "jump": -1})").find("jump"), std::string::npos);
  EXPECT_EQ(error(R"({"type": "aero_surface", "body": 0, "tensor": [[1, 0, 0]]})"),
            "/records/0/tensor: expected three rows");
  EXPECT_NE(error(R"({"type": "force_zone", "shape": "round"})").find("expected everywhere, sphere or box"),
            std::string::npos);
}

}  // namespace scene_records_test
}  // namespace isostep::scenes
