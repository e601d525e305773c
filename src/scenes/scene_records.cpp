// Records of scenes, read, written and built by the fields that they visit.
// SPDX-License-Identifier: MIT
#include "scene_records.hpp"

#include <type_traits>

#include "build.hpp"
#include "object_reader.hpp"

namespace isostep::scenes {
namespace {

#define ISO_NAME(name, Record, Id, S) #name,
constexpr const char* kRecordNames[] = {ISO_FOR_EACH_RECORD(ISO_NAME, double)};
#undef ISO_NAME

struct NoInput {
  template <class Visitor, class Self> static constexpr void fields(Visitor&&, Self&&) {}
};
/// The input of the kind that has these ids.
template <class Id, class S> struct InputOf { using Type = NoInput; };
#define ISO_INPUT(name, Input, Id, S) \
  template <class S> struct InputOf<Id, S> { using Type = Input; };
ISO_FOR_EACH_INPUT(ISO_INPUT, S)
#undef ISO_INPUT

/// visit(Record<S>{}, its input or NoInput{}) for the kind of that name. False: there is none.
template <class S, class Visit> bool visit_kind(const std::string& kind, const Visit& visit) {
#define ISO_CASE(name, Record, Id, S)                 \
  if (kind == #name) {                                \
    visit(Record{}, typename InputOf<Id, S>::Type{}); \
    return true;                                      \
  }
  ISO_FOR_EACH_RECORD(ISO_CASE, S)
#undef ISO_CASE
  return false;
}
/// visit(name, member) of a record's fields; of a pose its two.
template <class Record, class Visit> void visit_fields(Record& record, const Visit& visit) {
  std::remove_const_t<Record>::fields(
      [&](const char* name, auto& member) {
        if constexpr (requires { member.orientation; }) {
          visit("position", member.position);
          visit("orientation", member.orientation);
        } else {
          visit(name, member);
        }
      },
      record);
}
/// A choice: its words stand beside it, in the file of its kind.
template <class T> constexpr bool is_name = std::is_enum_v<T>;

Number whole(std::int64_t n) { return Number(std::to_string(n)); }
const SceneField* find(const SceneRecord& record, std::string_view name) {
  for (const SceneField& field : record.fields) {
    if (field.name == name) return &field;
  }
  return nullptr;
}

/// A record of a kind has to name these bodies and joints.
template <class Record> void require_named(const ObjectReader& reader, const Record& record) {
  const auto bodies = detail::bodies_of(record);
  for (int i = 0; i < bodies.count; ++i) {
    if (!bodies.all[i].may_be_null) reader.require(bodies.all[i].field);
  }
  const detail::NamedJoints joints = detail::joints_of(record);
  for (int i = 0; i < joints.count; ++i) {
    if (!joints.may_be_null(i)) reader.require(joints.field(i));
  }
}

// ---- from a file: what it gives, as numbers

class FieldReader {
 public:
  FieldReader(ObjectReader& reader, std::size_t bodies, std::size_t joints, SceneRecord& to)
      : reader_(reader), bodies_(bodies), joints_(joints), to_(to) {}

  template <class T> void operator()(const char* name, const T&) const {
    if (!reader_.has(name)) return;
    SceneField field = {name, {}};
    read(name, T{}, field.numbers);
    to_.fields.push_back(std::move(field));
  }

 private:
  void read(const char* name, double, std::vector<Number>& out) const { reader_.number(name, out.emplace_back(0)); }
  void read(const char* name, bool, std::vector<Number>& out) const {
    bool set = false;
    reader_.flag(name, set);
    out = {whole(set)};
  }
  void read(const char* name, std::uint32_t, std::vector<Number>& out) const { read_whole(name, 0, 0xffffffff, out); }
  void read(const char* name, std::int32_t, std::vector<Number>& out) const {
    constexpr std::int64_t kMost = 0x7fffffff;
    read_whole(name, -kMost - 1, kMost, out);
  }
  void read(const char* name, std::uint64_t, std::vector<Number>& out) const {
    read_whole(name, 0, 999'999'999'999, out);  // as many digits as files may have
  }
  void read(const char* name, BodyId, std::vector<Number>& out) const {
    read_whole(name, -1, static_cast<std::int64_t>(bodies_) - 1, out);
  }
  void read(const char* name, JointId, std::vector<Number>& out) const {
    read_whole(name, -1, static_cast<std::int64_t>(joints_) - 1, out);
  }
  void read(const char* name, const Vec3<double>&, std::vector<Number>& out) const {
    Vector v = zero_vector();
    reader_.vector(name, v);
    out.assign(v.begin(), v.end());
  }
  void read(const char* name, const Quat<double>&, std::vector<Number>& out) const {
    Rotation q = no_rotation();
    reader_.rotation(name, q);
    out.assign(q.begin(), q.end());
  }
  void read(const char* name, const Mat3<double>&, std::vector<Number>& out) const {
    std::vector<Vector> rows;
    reader_.vectors(name, rows);
    if (rows.size() != 3) throw SceneError(reader_.place_of(name), "expected three rows");
    for (const Vector& row : rows) out.insert(out.end(), row.begin(), row.end());
  }
  template <std::size_t N> void read(const char* name, const double (&)[N], std::vector<Number>& out) const {
    reader_.list(name, out);
    if (out.size() != N) throw SceneError(reader_.place_of(name), "expected " + std::to_string(N) + " numbers");
  }
  template <class T>
  requires is_name<T>
  void read(const char* name, T, std::vector<Number>& out) const {
    out = {whole(static_cast<std::int64_t>(reader_.choice(name, words_of(T{}))))};
  }
  void read_whole(const char* name, std::int64_t least, std::int64_t most, std::vector<Number>& out) const {
    std::int64_t n = 0;
    reader_.integer(name, least, most, n);
    out = {whole(n)};
  }

  ObjectReader& reader_;
  std::size_t bodies_, joints_;
  SceneRecord& to_;
};

// ---- to a file

std::string list(std::span<const Number> numbers) {
  std::string text;
  for (const Number& n : numbers) text += (text.empty() ? "" : ", ") + n.text();
  return "[" + text + "]";
}
template <class T> std::string text_of(const T&, const std::vector<Number>& numbers) {
  if constexpr (std::is_same_v<T, bool>) return numbers[0].text() == "0" ? "false" : "true";
  else if constexpr (is_name<T>) return '"' + std::string(words_of(T{})[std::stoul(numbers[0].text())]) + '"';
  else if constexpr (std::is_same_v<T, Mat3<double>>) {
    const std::span<const Number> all(numbers);
    return "[" + list(all.subspan(0, 3)) + ", " + list(all.subspan(3, 3)) + ", " + list(all.subspan(6, 3)) + "]";
  } else return numbers.size() == 1 ? numbers[0].text() : list(numbers);
}

// ---- into a world

template <class S> class FieldBuilder {
 public:
  FieldBuilder(const SceneRecord& record, const SceneIds& ids, std::string place)
      : record_(record), ids_(ids), place_(std::move(place)) {}

  template <class T> void operator()(const char* name, T& member) const {
    const SceneField* const field = find(record_, name);
    if (field != nullptr) set(member, field->numbers, place_ + "/" + name);
  }

 private:
  template <class T> void set(T& to, const std::vector<Number>& from, const std::string& place) const {
    if constexpr (std::is_same_v<T, bool>) to = from[0].text() != "0";
    else if constexpr (is_name<T>) to = static_cast<T>(std::stoul(from[0].text()));
    else if constexpr (std::is_same_v<T, std::int32_t>) to = static_cast<T>(std::stol(from[0].text()));
    else if constexpr (std::is_integral_v<T>) to = static_cast<T>(std::stoull(from[0].text()));
    else if constexpr (std::is_same_v<T, BodyId>) {
      to = at(ids_.bodies, from[0]);
    } else if constexpr (std::is_same_v<T, JointId>) {
      to = at(ids_.joints, from[0]);
    } else if constexpr (std::is_array_v<T>) {
      for (std::size_t i = 0; i < from.size(); ++i) to[i] = value_of<S>(from[i], place);
    } else if constexpr (requires { to.rows; }) {
      for (std::size_t i = 0; i < 9; ++i) to.rows[i / 3][static_cast<int>(i % 3)] = value_of<S>(from[i], place);
    } else if constexpr (requires { to.w; }) {
      to = {unit(from[0], place), unit(from[1], place), unit(from[2], place), unit(from[3], place)};
    } else if constexpr (std::is_same_v<T, Vec3<S>>) {
      to = {value_of<S>(from[0], place), value_of<S>(from[1], place), value_of<S>(from[2], place)};
    } else if constexpr (requires { to.z; }) {
      to = {unit(from[0], place), unit(from[1], place), unit(from[2], place)};
    } else to = value_of<S>(from[0], place);
  }
  template <class AnyId> static AnyId at(const std::vector<AnyId>& ids, const Number& place) {
    const long long index = std::stoll(place.text());
    return index < 0 ? AnyId{} : ids[static_cast<std::size_t>(index)];
  }
  static Unit<S> unit(const Number& from, const std::string& place) {
    Unit<S> value{};
    TextError error = TextError::none;
    if (!from.read(value, error)) throw SceneError(place, from.text() + " is no part of a direction");
    return value;
  }

  const SceneRecord& record_;
  const SceneIds& ids_;
  std::string place_;
};

template <class Input> bool gives_any_of(const SceneRecord& record, const Input& input) {
  bool any = false;
  visit_fields(input, [&](const char* name, const auto&) { any = any || find(record, name) != nullptr; });
  return any;
}
template <class S, class Id, class Input> bool set_input(World<S>& world, Id id, const Input& input) {
  if constexpr (std::is_same_v<Input, NoInput>) return true;
  else return world.set_input(id, input);
}

}  // namespace

SceneRecord read_record(const JsonNode& node, const std::string& place, std::size_t bodies, std::size_t joints) {
  ObjectReader reader(node, place);
  SceneRecord record = {kRecordNames[reader.choice("type", kRecordNames)], {}};
  const FieldReader read_field(reader, bodies, joints, record);
  visit_kind<double>(record.kind, [&](auto settings, auto input) {
    require_named(reader, settings);
    visit_fields(settings, read_field);
    visit_fields(input, read_field);
  });
  reader.finish();
  return record;
}

std::string text_of(const SceneRecord& record) {
  std::string text = "{\"type\": \"" + record.kind + '"';
  const auto write_field = [&](const char* name, const auto& member) {
    const SceneField* const field = find(record, name);
    if (field != nullptr) text += std::string(", \"") + name + "\": " + text_of(member, field->numbers);
  };
  visit_kind<double>(record.kind, [&](auto settings, auto input) {
    visit_fields(settings, write_field);
    visit_fields(input, write_field);
  });
  return text + "}";
}

namespace {
template <class S>
void add_record(World<S>& world, const SceneRecord& record, const SceneIds& ids, const std::string& place) {
  const FieldBuilder<S> set_field(record, ids, place);
  const bool known = visit_kind<S>(record.kind, [&](auto settings, auto input) {
    visit_fields(settings, set_field);
    visit_fields(input, set_field);
    const auto id = world.add(settings);
    if (id && (!gives_any_of(record, input) || set_input(world, id, input))) return;
    throw SceneError(place, std::string("the record is refused: ") + describe(world.fault()));
  });
  if (!known) throw SceneError(place, "no record is called " + record.kind);
}
}  // namespace

template <class S> void add_records(World<S>& world, const Scene& scene, const SceneIds& ids) {
  for (std::size_t i = 0; i < scene.records.size(); ++i)
    add_record(world, scene.records[i], ids, "/records/" + std::to_string(i));
}

#define ISO_INSTANTIATE(S) template void add_records<S>(World<S>&, const Scene&, const SceneIds&);
ISO_FOR_EACH_SCALAR(ISO_INSTANTIATE)
#undef ISO_INSTANTIATE

}  // namespace isostep::scenes
