// The reader of scene files.
// SPDX-License-Identifier: MIT
#include "scene_file.hpp"

#include "blob_files.hpp"
#include "object_reader.hpp"
#include "scene_keys.hpp"
#include "scene_records.hpp"
#include "shape_keys.hpp"

namespace isostep::scenes {
namespace {

std::string item(const std::string& place, const char* list, std::size_t i) {
  return place + "/" + list + "/" + std::to_string(i);
}

void read_surfaces(ObjectReader& reader, const char* key, std::vector<SceneSurface>& surfaces) {
  const auto nodes = reader.array(key);
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    ObjectReader of_one(nodes[i], item(reader.place(), key, i));
    SceneSurface& surface = surfaces.emplace_back();
    of_one.number("friction", surface.friction);
    of_one.number("restitution", surface.restitution);
    of_one.finish();
  }
}

void read_sizes(ObjectReader& reader, ScenePart& part) {
  visit_sizes(part, [&](const char* key, auto& size, SizeRule rule) {
    if (rule != SizeRule::optional && rule != SizeRule::thickness) reader.require(key);
    if constexpr (std::is_same_v<decltype(size), std::string&>) reader.text(key, size);
    else if constexpr (std::is_same_v<decltype(size), std::vector<Vector>&>) reader.vectors(key, size);
    else if constexpr (std::is_same_v<decltype(size), std::vector<Number>&>) reader.list(key, size);
    else if constexpr (std::is_same_v<decltype(size), Vector&>) reader.vector(key, size);
    else if constexpr (std::is_same_v<decltype(size), std::vector<SceneSurface>&>) read_surfaces(reader, key, size);
    else if (rule == SizeRule::positive) reader.positive(key, size);
    else reader.number(key, size);
  });
}
/// Reads a baked file in place of the sizes of a part.
void read_baked(ObjectReader& reader, ScenePart& part, BlobFiles& files) {
  visit_sizes(part, [&](const char* key, auto& size, SizeRule rule) {
    if constexpr (std::is_same_v<decltype(size), Number&>) {
      if (rule == SizeRule::thickness) return reader.number(key, size);
    }
    if (reader.has(key)) throw SceneError(reader.place_of(key), "what \"file\" holds has no other sizes");
  });
  reader.text("file", part.file);
  bool printable = !part.file.empty();
  for (const char c : part.file) printable = printable && static_cast<unsigned char>(c) >= 0x20;
  if (!printable) throw SceneError(reader.place_of("file"), "expected the name of a file");
  part.blob = files.read(part.file, part.type, reader.place_of("file"));
}

std::uint32_t read_number(ObjectReader& reader, const char* key, std::int64_t least) {
  std::int64_t number = least;
  reader.integer(key, least, 0xffffffff, number);
  return static_cast<std::uint32_t>(number);
}

void read_traits(ObjectReader& reader, ScenePartTraits& own) {
  const auto take = [&](std::uint32_t flag) {
    return [&reader, &own, flag](const char* key, auto& number) {
      if (!reader.has(key)) return;
      own.flags |= flag;
      if constexpr (std::is_same_v<decltype(number), Number&>) reader.number(key, number);
      else number = read_number(reader, key, 0);
    };
  };
  visit_part_material(own, take(part_flag::kOwnMaterial));
  visit_part_filter(own, take(part_flag::kOwnFilter));
  visit_part_flags([&](const char* key, std::uint32_t flag) {
    bool set = false;
    reader.flag(key, set);
    if (set) own.flags |= flag;
  });
}

ScenePart read_part(const JsonNode& node, const std::string& place, BlobFiles& files) {
  ObjectReader reader(node, place);
  ScenePart part;
  part.type = static_cast<ShapeType>(reader.choice("type", kShapeNames));
  if (has_blob(part.type) && reader.has("file")) read_baked(reader, part, files);
  else read_sizes(reader, part);
  reader.vector("position", part.position);
  reader.rotation("orientation", part.orientation);
  read_traits(reader, part.own);
  reader.finish();
  return part;
}

void read_flags(ObjectReader& reader, std::span<const FlagKey> keys, std::uint32_t& flags) {
  for (const auto& [key, flag] : keys) {
    bool set = false;
    reader.flag(key, set);
    if (set) flags |= flag;
  }
}

SceneBody read_body(const JsonNode& node, const std::string& place, BlobFiles& files) {
  ObjectReader reader(node, place);
  SceneBody body;
  body.type = static_cast<BodyType>(reader.choice("type", kBodyNames));
  reader.vector("position", body.position);
  reader.rotation("orientation", body.orientation);
  reader.vector("velocity", body.velocity);
  reader.vector("angular_velocity", body.angular_velocity);
  reader.positive("density", body.density);
  if (body.type == BodyType::dynamic) reader.positive("mass", body.mass);
  else reader.number("mass", body.mass);
  reader.vector("inertia", body.inertia);
  reader.number("friction", body.friction);
  reader.number("restitution", body.restitution);
  reader.number("rolling_resistance", body.rolling_resistance);
  reader.number("spin_resistance", body.spin_resistance);
  reader.vector("surface_velocity", body.surface_velocity);
  reader.number("static_friction", body.static_friction);
  reader.vector("anisotropy", body.anisotropy);
  body.kind = read_number(reader, "kind", 0);
  reader.number("gravity_scale", body.gravity_scale);
  reader.number("linear_damping", body.linear_damping);
  reader.number("angular_damping", body.angular_damping);
  read_flags(reader, kBodyLocks, body.locks);
  body.group = read_number(reader, "group", 0);
  reader.flag("allow_sleep", body.allow_sleep);
  reader.flag("collide", body.collide);
  reader.flag("sensor", body.sensor);
  reader.flag("bullet", body.bullet);
  reader.flag("report_contacts", body.report_contacts);
  const auto parts = reader.array("shapes");
  for (std::size_t i = 0; i < parts.size(); ++i)
    body.parts.push_back(read_part(parts[i], item(place, "shapes", i), files));
  if (parts.empty()) throw SceneError(place, "a body needs \"shapes\", one or more");
  reader.finish();
  return body;
}

int read_end(ObjectReader& reader, const char* key, std::size_t bodies) {
  reader.require(key);
  std::int64_t index = -1;
  reader.integer(key, -1, static_cast<std::int64_t>(bodies) - 1, index);
  return static_cast<int>(index);
}

SceneJoint read_joint(const JsonNode& node, const std::string& place, std::size_t bodies) {
  ObjectReader reader(node, place);
  SceneJoint joint;
  joint.type = static_cast<JointType>(reader.choice("type", kJointNames));
  joint.a = read_end(reader, "a", bodies);
  joint.b = read_end(reader, "b", bodies);
  if (joint.a == joint.b) throw SceneError(place, "a joint needs two different bodies");
  reader.require("anchor");
  reader.vector("anchor", joint.anchor);
  if (joins_two_points(joint.type)) {
    reader.require("anchor_b");
    reader.vector("anchor_b", joint.anchor_b);
  }
  reader.rotation("orientation", joint.orientation);
  read_flags(reader, kJointFlags, joint.flags);
  for (const auto& [key, member] : kJointNumbers) reader.number(key, joint.*member);
  reader.finish();
  return joint;
}

void read_name(ObjectReader& reader, Scene& scene) {
  constexpr std::size_t kMaxName = 128;  // what a replay's header holds
  reader.text("name", scene.name);
  bool printable = !scene.name.empty() && scene.name.size() <= kMaxName;
  for (const char c : scene.name) printable = printable && c >= 0x20 && c < 0x7f;
  if (!printable) throw SceneError("/name", "expected 1 to 128 printable ASCII characters");
}

int read_count(ObjectReader& reader, const char* key, int least, int most, int otherwise) {
  std::int64_t value = otherwise;
  reader.integer(key, least, most, value);
  return static_cast<int>(value);
}

}  // namespace

Scene read_scene(std::string_view json, const std::string& folder) {
  const JsonNode root = parse_json(json);
  ObjectReader reader(root, "");
  Scene scene;
  read_name(reader, scene);
  reader.vector("gravity", scene.gravity);
  reader.flag("allow_sleep", scene.allow_sleep);
  reader.number("restitution_threshold", scene.restitution_threshold);
  scene.hz = read_count(reader, "hz", kLeastHz, kMostHz, scene.hz);
  scene.substeps = read_count(reader, "substeps", 1, 64, scene.substeps);
  if (reader.has("solver")) scene.solver = static_cast<SolverName>(reader.choice("solver", kSolverNames));
  if (reader.has("projection"))
    scene.projection = static_cast<Projection>(reader.choice("projection", kProjectionNames));
  if (reader.has("broad_phase"))
    scene.broad_phase = static_cast<BroadPhaseName>(reader.choice("broad_phase", kBroadPhaseNames));
  if (const char* why = left_out(scene)) throw SceneError("", why);
  scene.frames = read_count(reader, "frames", 0, 1'000'000'000, scene.frames);
  if (reader.has("script")) scene.script = static_cast<Script>(reader.choice("script", kScriptNames));
  reader.require("bodies");
  const auto bodies = reader.array("bodies");
  BlobFiles files(folder);
  for (std::size_t i = 0; i < bodies.size(); ++i)
    scene.bodies.push_back(read_body(bodies[i], item("", "bodies", i), files));
  const auto joints = reader.array("joints");
  for (std::size_t i = 0; i < joints.size(); ++i) {
    scene.joints.push_back(read_joint(joints[i], item("", "joints", i), scene.bodies.size()));
  }
  const auto records = reader.array("records");
  for (std::size_t i = 0; i < records.size(); ++i)
    scene.records.push_back(read_record(records[i], item("", "records", i), scene.bodies.size(), scene.joints.size()));
  reader.finish();
  return scene;
}

}  // namespace isostep::scenes
