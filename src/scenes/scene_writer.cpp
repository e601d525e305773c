// The writer of scene files: one body a line, members only where they differ from what their absence means.
// SPDX-License-Identifier: MIT
#include "scene_file.hpp"
#include "scene_keys.hpp"
#include "scene_records.hpp"
#include "shape_keys.hpp"

namespace isostep::scenes {
namespace {

template <std::size_t N> std::string list(const std::array<Number, N>& numbers) {
  std::string text = "[";
  for (std::size_t i = 0; i < N; ++i) text += (i == 0 ? "" : ", ") + numbers[i].text();
  return text + "]";
}
std::string list(const std::vector<Vector>& vectors) {
  std::string text = "[";
  for (const Vector& v : vectors) text += (text.size() == 1 ? "" : ", ") + list(v);
  return text + "]";
}
std::string list(const Number& number) { return number.text(); }
std::string list(const std::vector<Number>& numbers) {
  std::string text = "[";
  for (const Number& n : numbers) text += (text.size() == 1 ? "" : ", ") + n.text();
  return text + "]";
}
std::string list(const std::vector<SceneSurface>& surfaces) {
  std::string text = "[";
  for (const SceneSurface& s : surfaces) {
    text += (text.size() == 1 ? "" : ", ") + ("{\"friction\": " + s.friction.text());
    text += ", \"restitution\": " + s.restitution.text() + "}";
  }
  return text + "]";
}
std::string list(bool flag) { return flag ? "true" : "false"; }

std::string in_quotes(const std::string& text) {
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') out += '\\';
    out += c;
  }
  return out + '"';
}

class ObjectWriter {
 public:
  ObjectWriter() = default;
  explicit ObjectWriter(std::string type) { raw("type", in_quotes(type)); }
  void raw(const char* key, const std::string& value) {
    text_ += (text_.empty() ? "\"" : ", \"") + std::string(key) + "\": " + value;
  }
  template <class T> void member(const char* key, const T& value) { raw(key, list(value)); }
  template <class T> void member(const char* key, const T& value, const T& otherwise) {
    if (!(value == otherwise)) member(key, value);
  }
  void member(const char* key, const std::string& value) { raw(key, in_quotes(value)); }
  std::string text() const { return "{" + text_ + "}"; }

 private:
  std::string text_;
};

/// All of a material or filter of its own, so that the part has one again.
void write_traits(ObjectWriter& out, const ScenePartTraits& own) {
  const auto put = [&](const char* key, const auto& number) {
    if constexpr (std::is_same_v<decltype(number), const Number&>) out.member(key, number);
    else out.raw(key, std::to_string(number));
  };
  if ((own.flags & part_flag::kOwnMaterial) != 0) visit_part_material(own, put);
  if ((own.flags & part_flag::kOwnFilter) != 0) visit_part_filter(own, put);
  visit_part_flags([&](const char* key, std::uint32_t flag) { out.member(key, (own.flags & flag) != 0, false); });
}

std::string text_of(const ScenePart& part) {
  const ScenePart plain;
  ObjectWriter out(kShapeNames[static_cast<std::size_t>(part.type)]);
  visit_sizes(part, [&](const char* key, const auto& size, SizeRule rule) {
    if constexpr (std::is_same_v<decltype(size), const Number&>) {
      if (rule == SizeRule::thickness) return out.member(key, size, Number(0));
    }
    if constexpr (std::is_same_v<decltype(size), const std::vector<Number>&> ||
                  std::is_same_v<decltype(size), const std::vector<SceneSurface>&>) {
      if (size.empty()) return;
    }
    out.member(key, size);
  });
  out.member("position", part.position, plain.position);
  out.member("orientation", part.orientation, plain.orientation);
  write_traits(out, part.own);
  return out.text();
}

std::string text_of(const SceneBody& body) {
  const SceneBody plain;
  ObjectWriter out(kBodyNames[static_cast<std::size_t>(body.type)]);
  out.member("position", body.position);
  out.member("orientation", body.orientation, plain.orientation);
  out.member("velocity", body.velocity, plain.velocity);
  out.member("angular_velocity", body.angular_velocity, plain.angular_velocity);
  out.member("density", body.density, plain.density);
  out.member("mass", body.mass, plain.mass);
  out.member("inertia", body.inertia, plain.inertia);
  out.member("friction", body.friction);
  out.member("restitution", body.restitution, plain.restitution);
  out.member("rolling_resistance", body.rolling_resistance, plain.rolling_resistance);
  out.member("spin_resistance", body.spin_resistance, plain.spin_resistance);
  out.member("surface_velocity", body.surface_velocity, plain.surface_velocity);
  out.member("static_friction", body.static_friction, plain.static_friction);
  out.member("anisotropy", body.anisotropy, plain.anisotropy);
  if (body.kind != plain.kind) out.raw("kind", std::to_string(body.kind));
  out.member("gravity_scale", body.gravity_scale, plain.gravity_scale);
  out.member("linear_damping", body.linear_damping, plain.linear_damping);
  out.member("angular_damping", body.angular_damping, plain.angular_damping);
  for (const auto& [key, flag] : kBodyLocks) out.member(key, (body.locks & flag) != 0, false);
  if (body.group != plain.group) out.raw("group", std::to_string(body.group));
  out.member("allow_sleep", body.allow_sleep, plain.allow_sleep);
  out.member("collide", body.collide, plain.collide);
  out.member("sensor", body.sensor, plain.sensor);
  out.member("bullet", body.bullet, plain.bullet);
  out.member("report_contacts", body.report_contacts, plain.report_contacts);
  std::string parts;
  for (const ScenePart& part : body.parts) parts += (parts.empty() ? "" : ", ") + text_of(part);
  out.raw("shapes", "[" + parts + "]");
  return out.text();
}

std::string text_of(const SceneJoint& joint) {
  const SceneJoint plain;
  ObjectWriter out(kJointNames[static_cast<std::size_t>(joint.type)]);
  out.raw("a", std::to_string(joint.a));
  out.raw("b", std::to_string(joint.b));
  out.member("anchor", joint.anchor);
  if (joins_two_points(joint.type)) out.member("anchor_b", joint.anchor_b);
  out.member("orientation", joint.orientation, plain.orientation);
  for (const auto& [key, flag] : kJointFlags) out.member(key, (joint.flags & flag) != 0, false);
  for (const auto& [key, member] : kJointNumbers) out.member(key, joint.*member, plain.*member);
  return out.text();
}

template <class T> std::string lines_of(const std::vector<T>& items) {
  std::string text;
  for (const T& item : items) text += (text.empty() ? "\n  " : ",\n  ") + text_of(item);
  return text;
}

}  // namespace

std::string write_scene(const Scene& scene) {
  std::string text = "{\"name\": " + in_quotes(scene.name) + ", \"gravity\": " + list(scene.gravity) +
                     ", \"allow_sleep\": " + list(scene.allow_sleep) + ", \"frames\": " + std::to_string(scene.frames);
  const Scene standard;
  if (!(scene.restitution_threshold == standard.restitution_threshold))
    text += ", \"restitution_threshold\": " + scene.restitution_threshold.text();
  if (scene.hz != standard.hz) text += ", \"hz\": " + std::to_string(scene.hz);
  if (scene.substeps != standard.substeps) text += ", \"substeps\": " + std::to_string(scene.substeps);
  if (scene.solver != standard.solver) {
    text += ", \"solver\": " + in_quotes(kSolverNames[static_cast<std::size_t>(scene.solver)]);
  }
  if (scene.projection != standard.projection) {
    text += ", \"projection\": " + in_quotes(kProjectionNames[static_cast<std::size_t>(scene.projection)]);
  }
  if (scene.broad_phase != standard.broad_phase) {
    text += ", \"broad_phase\": " + in_quotes(kBroadPhaseNames[static_cast<std::size_t>(scene.broad_phase)]);
  }
  if (scene.script != Script::none) {
    text += ", \"script\": " + in_quotes(kScriptNames[static_cast<std::size_t>(scene.script)]);
  }
  text += ",\n \"bodies\": [" + lines_of(scene.bodies) + "]";
  if (!scene.joints.empty()) text += ",\n \"joints\": [" + lines_of(scene.joints) + "]";
  if (!scene.records.empty()) text += ",\n \"records\": [" + lines_of(scene.records) + "]";
  return text + "}\n";
}

}  // namespace isostep::scenes
