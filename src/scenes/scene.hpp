// A scene as data, before any scalar is chosen: what the named scenes, scene files and their writer share.
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "isostep/collision/broadphase/broad_phase_name.hpp"
#include "isostep/dynamics/joints/joint_kinds.hpp"
#include "isostep/dynamics/projection.hpp"
#include "isostep/dynamics/solver_name.hpp"
#include "isostep/geometry/blob.hpp"
#include "isostep/geometry/shape.hpp"
#include "isostep/scalar/text.hpp"

namespace isostep::scenes {

/// A number is its decimal text and enters a scalar by one rounding, wherever it comes from: so a named scene, and the
/// file written of it, are the same scene in every scalar. Computed numbers are doubles whose shortest decimal counts.
class Number {
 public:
  Number(double value) : text_(to_text(value)) {}
  explicit Number(std::string text) : text_(std::move(text)) {}

  const std::string& text() const { return text_; }
  template <class S> bool read(S& out, TextError& error) const { return from_text(text_, out, error); }
  friend bool operator==(const Number& a, const Number& b) { return a.text_ == b.text_; }

 private:
  std::string text_;
};

using Vector = std::array<Number, 3>;
using Rotation = std::array<Number, 4>;  // x y z w

inline Vector zero_vector() { return {0, 0, 0}; }
inline Rotation no_rotation() { return {0, 0, 0, 1}; }

/// The surface behind a number among a part's materials.
struct SceneSurface {
  Number friction = 0.5;   // [1]
  Number restitution = 0;  // [1]
};

/// One primitive of a body; of the sizes only those of its type count.
/// What a part has of its own, as PartTraits says: a file that names a number of the material, or of the filter, names
/// the part's, and leaves the others as they are here.
struct ScenePartTraits {
  std::uint32_t flags = 0;             // part_flag
  Number friction = 0.6;               // [1]
  Number static_friction = 0;          // [1] below friction: the same
  Number restitution = 0;              // [1]
  Number rolling_resistance = 0;       // [m] lever arm of the normal force that resists rolling
  Number spin_resistance = 1.0 / 128;  // [m] radius at which friction resists spinning about the normal
  std::uint32_t kind = 0;              // of material, for pairs; 0: none
  Filter filter;
};

struct ScenePart {
  ShapeType type = ShapeType::box;
  Vector half_extents = zero_vector();  // [m] box
  Number radius = 0;                    // [m] sphere, capsule, cylinder, cone; around a hull
  Number half_height = 0;               // [m] capsule, cylinder, cone
  Vector normal = {0, 1, 0};            // [1] half-space
  Number offset = 0;                    // [m] half-space
  std::vector<Vector> points;           // [m] hull
  std::vector<Vector> vertices;         // [m] mesh
  std::vector<Vector> triangles;        // [1] mesh: numbers of three vertices, counter-clockwise seen from outside
  Number columns = 0, rows = 0;         // [1] height field
  Number pitch = 0;                     // [m] height field: between columns, and between rows
  std::vector<Number> heights;          // [m] height field, by rows
  std::vector<Number> materials;        // [1] mesh: of each triangle; height field: of each cell, 255 a hole; or none
  std::vector<SceneSurface> surfaces;   // what materials 0, 1 ... are; those beyond: as the body's
  std::string file;                     // hull, mesh, height field: a baked file in place of the numbers, or empty
  BlobRef blob;                         // its content
  Vector position = zero_vector();      // [m] in the body's frame
  Rotation orientation = no_rotation();
  ScenePartTraits own;
};

struct SceneBody {
  BodyType type = BodyType::dynamic;
  std::vector<ScenePart> parts;
  Vector position = zero_vector();  // [m]
  Rotation orientation = no_rotation();
  Vector velocity = zero_vector();          // [m/s]
  Vector angular_velocity = zero_vector();  // [rad/s]
  Number density = 1;                       // [kg/m^3]
  Number mass = 0;                          // [kg] 0: from density
  Vector inertia = zero_vector();           // [kg m^2] all 0: from the shape
  Number friction = 0.5;                    // [1]
  Number restitution = 0;                   // [1]
  Number rolling_resistance = 0;            // [m] lever arm of the normal force that resists rolling
  Number spin_resistance = 1.0 / 128;       // [m] radius at which friction resists spinning about the normal
  Vector surface_velocity = zero_vector();  // [m/s] world, a conveyor belt's
  Number static_friction = 0;               // [1] below friction: the same
  Vector anisotropy = {1, 1, 1};            // [1] what is left of friction along the body's axes
  std::uint32_t kind = 0;                   // of material, for pairs; 0: none
  Number gravity_scale = 1;                 // [1]
  Number linear_damping = 0;                // [1/s]
  Number angular_damping = 0;               // [1/s]
  std::uint32_t locks = 0;                  // body_flag::kLockX ...
  std::uint32_t group = 0;
  bool allow_sleep = true;
  bool collide = true;
  bool sensor = false;
  bool bullet = false;
  bool report_contacts = false;
};

/// Frames as they lie at the start, world.
struct SceneJoint {
  JointType type = JointType::ball;
  int a = -1, b = -1;                    // indices of bodies; -1: the world
  Vector anchor = zero_vector();         // [m]
  Vector anchor_b = zero_vector();       // [m] the end on b, of joints that do not hold a point; others: as anchor
  Rotation orientation = no_rotation();  // of the joint's frame, whose axis is z
  std::uint32_t flags = 0;               // joint_flag
  Number lower = 0, upper = 0;           // [rad] or [m]
  Number cone = 0;                       // [rad]
  Number motor_speed = 0;                // [rad/s]
  Number max_force = 0;               // [N m]
  Number spring_target = 0;              // [rad] or [m]
  Number spring_frequency = 0;           // [Hz]
  Number spring_damping = 0;             // [1]
};

/// A record of the world, such as a force: scene_records.hpp.
struct SceneField {
  std::string name;
  std::vector<Number> numbers;  // of a matrix by rows; of a flag or a choice its number; of a body its place, or -1
};
struct SceneRecord {
  std::string kind;                // as record_list.hpp names it
  std::vector<SceneField> fields;  // of record and input, those that differ from the engine's
};

/// The script that acts between frames: closed, so that a scene file can name it. Peers know none of it.
enum class Script : std::uint32_t {
  none,
  mixer,
  mixed,
  hit,
  medley,
  flight,
  flight_left,
  sail,
  guns,
  cars,
  walkers,
  street,
  pusher,
  crossers
};
inline constexpr const char* kScriptNames[] = {"none",        "mixer", "mixed", "hit",  "medley",  "flight",
                                               "flight_left", "sail",  "guns",  "cars", "walkers", "street",
                                               "pusher",      "crossers"};

struct Scene {
  std::string name = "scene";
  Vector gravity = {0, -10, 0};  // [m/s^2]
  bool allow_sleep = true;
  Number restitution_threshold = 0.25;  // [m/s] as in Settings
  int hz = 60, substeps = 8;            // as in Settings
  SolverName solver = SolverName::soft_step;
  BroadPhaseName broad_phase = {};  // the world's own; it changes no bit
  Projection projection = Projection::nonlinear;
  int frames = 600;  // of a run that asks for no other count
  Script script = Script::none;
  std::vector<SceneBody> bodies;
  std::vector<SceneJoint> joints;
  std::vector<SceneRecord> records;
};

/// Returns null, or why this build cannot play the scene: core/book.hpp.
inline const char* left_out(const Scene& scene) {
  const char* const solver = isostep::left_out(scene.solver);
  return solver != nullptr ? solver : isostep::left_out(scene.broad_phase);
}

/// A scene that cannot be; `place` is a JSON pointer into its file, "" for the whole.
class SceneError : public std::runtime_error {
 public:
  SceneError(std::string place, const std::string& message)
      : std::runtime_error(place.empty() ? message : place + ": " + message), place_(std::move(place)) {}
  const std::string& place() const { return place_; }

 private:
  std::string place_;
};

}  // namespace isostep::scenes
