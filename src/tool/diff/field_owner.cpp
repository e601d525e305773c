// The owner of a field: from an array's name and an index to the slots that games know bodies, joints and particles by.
// SPDX-License-Identifier: MIT
#include <array>

#include "field_list.hpp"
#include "isostep/core/number_text.hpp"

namespace isostep::tool {
namespace {

using Slot = std::optional<std::uint64_t>;

/// "islands[2].blocks[7].rows[1].answer" is of array "islands[2].blocks" and index 7 to those who ask for that depth.
struct Item {
  std::string array;
  std::uint64_t index;

  std::string text() const { return array + "[" + std::to_string(index) + "]"; }
};
/// The item in the n-th pair of brackets; nothing where no number stands in them: another program's paths come here,
/// too.
std::optional<Item> item_of(std::string_view path, int depth) {
  std::size_t open = 0, close = 0;
  for (int i = 0; i <= depth; ++i) {
    open = path.find('[', close);
    if (open == std::string_view::npos) return std::nullopt;
    close = path.find(']', open);
  }
  Item item = {std::string(path.substr(0, open)), 0};
  if (close == std::string_view::npos || !read_number(path.substr(open + 1, close - open - 1), item.index))
    return std::nullopt;
  return item;
}

template <std::size_t N> bool is_any(std::string_view name, const std::array<const char*, N>& names) {
  for (const char* one : names) {
    if (name == one) return true;
  }
  return false;
}

class Owners {
 public:
  explicit Owners(const FieldList& fields) : fields_(fields), rigid_(fields.find("body_slots.first_free") != nullptr) {}

  std::string of(std::string_view path) const {
    const std::optional<Item> item = item_of(path, 0);
    if (!item) return {};
    return rigid_ ? of_world(path, *item) : of_particles(*item);
  }

 private:
  Slot value(const std::string& path) const { return fields_.value(path); }
  static std::string named(const char* kind, Slot slot) {
    return slot ? std::string(kind) + " slot " + std::to_string(*slot) : std::string();
  }
  static std::string named(const char* kind, Slot a, Slot b) {
    if (!a || !b) return named(kind, a ? a : b);
    return std::string(kind) + " slots " + std::to_string(*a) + " and " + std::to_string(*b);
  }
  std::string by_field(const char* kind, const Item& item, const char* field) const {
    return named(kind, value(item.text() + field));
  }
  std::string by_fields(const char* kind, const Item& item, const char* a, const char* b) const {
    return named(kind, value(item.text() + a), value(item.text() + b));
  }

  // ---- rigid bodies

  Slot body_at(std::uint64_t index) const { return value(Item{"bodies", index}.text() + ".slot"); }
  /// The body of a row of SolverBodies: row 0 is what does not move.
  Slot body_of_row(Slot row) const { return row && *row != 0 ? body_at(*row - 1) : std::nullopt; }
  std::string of_contact(const std::string& array, Slot index) const {
    return index ? by_fields("body", {array, *index}, ".key.body_a", ".key.body_b") : std::string();
  }
  std::string of_joint(Slot index) const {
    return index ? by_field("joint", {"joints", *index}, ".slot") : std::string();
  }
  Slot body_of_frame(Slot frame) const { return frame ? value(Item{"frames", *frame}.text() + ".slot") : std::nullopt; }

  std::string of_world(std::string_view path, const Item& item) const {
    const std::string& name = item.array;
    if (name == "islands") return of_island(path);
    if (name == "sleeping") return of_sleeping(path);
    if (is_any(name, std::array{"bodies", "static_bodies", "frames", "forces", "fell_asleep", "woke", "untold_woke",
                                "untold_sensors"}))
      return by_field("body", item, ".slot");
    if (is_any(name, std::array{"properties", "accelerations", "start_poses", "start_slots", "solver_start",
                                "solver_inertia"}))
      return named("body", body_at(item.index));
    if (name == "static_properties") return by_field("body", {"static_bodies", item.index}, ".slot");
    if (name == "materials") return named("body", body_of_frame(item.index));
    if (name == "locations") return named("body", item.index);
    if (is_any(name, std::array{"solver_velocity", "solver_displacement", "solver_mass"}))
      return named("body", body_of_row(item.index));
    if (is_any(name, std::array{"joints", "joint_properties", "joint_constraints"})) return of_joint(item.index);
    if (name == "joint_locations") return named("joint", item.index);
    return of_pair(item);
  }
  std::string of_pair(const Item& item) const {
    const std::string& name = item.array;
    if (name == "contacts" || name == "old_contacts") return of_contact(name, item.index);
    if (is_any(name, std::array{"geometry", "prepared", "step_impulses", "colours"}))
      return of_contact("contacts", item.index);
    if (name == "order") return of_contact("contacts", value(item.text()));
    if (name == "points") return of_contact("contacts", value(item.text() + ".contact"));
    if (name == "held_joints") return of_joint(value(item.text()));
    if (name == "ends")
      return named("body", body_of_row(value(item.text() + ".a")), body_of_row(value(item.text() + ".b")));
    if (name == "pairs") return of_key("body", item);
    if (name == "parts")
      return named("body", body_of_frame(value(item.text() + ".frame_a")),
                   body_of_frame(value(item.text() + ".frame_b")));
    if (name == "broke") return named("body", value(item.text() + ".body.slot"));
    if (name == "overlaps" || name == "new_overlaps") return by_fields("body", item, ".sensor", ".other");
    if (is_any(name, std::array{"contact_begin", "contact_end", "untold_contact_end", "hits", "ghosts"}))
      return by_fields("body", item, ".a.slot", ".b.slot");
    if (is_any(name, std::array{"sensor_begin", "sensor_end", "untold_sensor_end"}))
      return by_fields("body", item, ".sensor.slot", ".other.slot");
    return {};
  }
  std::string of_key(const char* kind, const Item& item) const {
    const Slot key = value(item.text());
    return key ? named(kind, *key >> 32, *key & 0xffffffffu) : std::string();
  }
  std::string of_island(std::string_view path) const {
    const std::optional<Item> item = item_of(path, 1);
    if (!item) return {};
    const std::string kind = item->array.substr(item->array.rfind('.') + 1);
    const Slot index = value(item->text());
    if (kind == "contacts") return of_contact("contacts", index);
    if (kind == "joints") return of_joint(index);
    if (kind == "bodies") return named("body", body_of_row(index));
    if (kind != "blocks") return {};
    return named("body", body_of_row(value(item->text() + ".a")), body_of_row(value(item->text() + ".b")));
  }
  std::string of_sleeping(std::string_view path) const {
    const std::optional<Item> item = item_of(path, 1);
    if (!item) return {};
    const std::size_t dot = item->array.rfind('.');
    const std::string island = item->array.substr(0, dot + 1), kind = item->array.substr(dot + 1);
    if (kind == "contacts") return of_contact(item->array, item->index);
    const bool joint = kind == "joints" || kind == "joint_properties";
    return by_field(joint ? "joint" : "body", {island + (joint ? "joints" : "bodies"), item->index}, ".slot");
  }

  // ---- particles

  std::string of_particles(const Item& item) const {
    const std::string& name = item.array;
    const std::size_t dot = name.find('.');
    if (name == "spring_rows.anchors") return {};
    if (name.rfind("spring_rows.", 0) == 0)
      return of_sides(Item{"spring_rows.a", item.index}.text(), Item{"spring_rows.b", item.index}.text());
    if (dot != std::string::npos || name == "inverse_mass" || name == "material") return named("particle", item.index);
    if (name == "colliding" || name == "reaches") return named("particle", value(Item{"colliding", item.index}.text()));
    if (name == "pairs") return of_key("particle", item);
    if (name == "contacts" || name == "old_contacts" || name == "rows") {
      return of_sides(item.text() + ".a", item.text() + ".b");
    }
    if (name == "contact_begin") return by_fields("particle", item, ".a.slot", ".b.slot");
    if (name == "pushes" || name == "lifetimes") return by_field("particle", item, ".slot");
    if (name == "touches" || name == "expired") return by_field("particle", item, ".particle.slot");
    if (name == "touch_impulses") return by_field("particle", {"touches", item.index}, ".particle.slot");
    return {};
  }
  /// The owners by the paths of both sides' slots; the second is a particle if there is one of that slot.
  std::string of_sides(const std::string& path_a, const std::string& path_b) const {
    const Slot b = value(path_b);
    const bool particle = b && fields_.find(Item{"inverse_mass", *b}.text()) != nullptr;
    return named("particle", value(path_a), particle ? b : std::nullopt);
  }

  const FieldList& fields_;
  bool rigid_;
};

}  // namespace

std::string owner_of(const FieldList& fields, std::string_view path) { return Owners(fields).of(path); }

}  // namespace isostep::tool
