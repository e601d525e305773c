// Calls every function of isostep.h with random arguments: living, dead and wrong handles, ids of all worlds, structs
// with random members and sizes, damaged bytes. Each call has a known status; one that is refused changes nothing.
// SPDX-License-Identifier: MIT
//
// c_random_caller: ISOSTEP_RANDOM_CALLS calls (100000), seed ISOSTEP_RANDOM_SEED (1). Exits 1 on the first wrong one.

#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <map>
#include <memory>
#include <string>
#include <type_traits>
#include <vector>

#include "isostep.h"

namespace {

enum Kind {
  number_,
  unit_,
  bool_,
  enum_,
  id_,
  pointer_,
  struct_,
  char_,
  i16_,
  i32_,
  u8_,
  u16_,
  u32_,
  u64_,
  f32_,
  f64_
};
struct Member {
  std::size_t offset, size;
  Kind kind;
  std::string of;
};
struct Fact {
  std::string name;
  std::size_t size = 0;
  bool sized = false;
  std::vector<Member> members;
  std::vector<std::uint8_t> image;  // what _init makes of it
};

/// Structs by name, with their members and defaults.
class Facts {
 public:
  Facts() {
#define ISO_STRUCT(name, is_sized) begin(#name, sizeof(name), is_sized);
#define ISO_MEMBER(name, offset, size, kind, of) now_->members.push_back({offset, size, kind, of});
#include "calls.inl"
#undef ISO_STRUCT
#undef ISO_MEMBER
#define ISO_INIT(name)                                                 \
  {                                                                    \
    name made;                                                         \
    if (name##_init(&made) == ISO_OK) keep(#name, &made, sizeof made); \
  }
#include "calls.inl"
#undef ISO_INIT
  }
  const Fact* named(const std::string& name) const {
    const auto found = by_name_.find(name);
    return found == by_name_.end() ? nullptr : &found->second;
  }

 private:
  void begin(const char* name, std::size_t size, bool sized) {
    now_ = &by_name_[name];
    *now_ = {name, size, sized, {}, std::vector<std::uint8_t>(size, 0)};
  }
  void keep(const char* name, const void* image, std::size_t size) {
    std::memcpy(by_name_[name].image.data(), image, size);
  }

  std::map<std::string, Fact> by_name_;
  Fact* now_ = nullptr;
};

/// Splitmix64.
class Dice {
 public:
  explicit Dice(std::uint64_t seed) : state_(seed) {}
  std::uint64_t next() {
    std::uint64_t z = state_ += 0x9e3779b97f4a7c15u;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return z ^ (z >> 31);
  }
  std::size_t below(std::size_t n) { return static_cast<std::size_t>(next() % n); }
  bool one_in(std::size_t n) { return below(n) == 0; }

 private:
  std::uint64_t state_;
};

void run_here(void*, std::int32_t copies, iso_task task, void* data) {
  for (std::int32_t i = 0; i < copies; ++i) task(data);
}

constexpr std::size_t kRegion = 1 << 16;  // [bytes] that each pointer argument has
constexpr std::size_t kElements = 20;     // of an array, at most
constexpr std::size_t kAlive = 12;        // handles of a kind

/// What there is of a kind of handle.
struct Handles {
  std::vector<void*> alive, dead;
};

constexpr const char* kKinds[] = {"world", "snapshot", "tape", "replay", "blob", "session", "network"};

class Drawer {
 public:
  Drawer(const Facts& facts, std::uint64_t seed) : facts_(facts), dice_(seed) {
    bytes_.push_back({1, 2, 3});
    for (auto& region : regions_) region = std::make_unique<std::uint64_t[]>(kRegion / 8);
  }
  ~Drawer() {
    for (void* session : handles_["session"].alive) iso_session_destroy(static_cast<iso_session*>(session));
    for (void* network : handles_["network"].alive) iso_network_destroy(static_cast<iso_network*>(network));
    for (void* world : handles_["world"].alive) iso_world_destroy(static_cast<iso_world*>(world));
    for (void* snapshot : handles_["snapshot"].alive) iso_snapshot_destroy(static_cast<iso_snapshot*>(snapshot));
    for (void* tape : handles_["tape"].alive) iso_tape_destroy(static_cast<iso_tape*>(tape));
    for (void* replay : handles_["replay"].alive) iso_replay_destroy(static_cast<iso_replay*>(replay));
    for (void* blob : handles_["blob"].alive) iso_blob_destroy(static_cast<iso_blob*>(blob));
  }
  Drawer(const Drawer&) = delete;
  Drawer& operator=(const Drawer&) = delete;

  void begin(const char* function) {
    function_ = function;
    used_ = 0;
    out_id_ = nullptr;
    out_handles_.clear();
    taken_.clear();
    size_ = 0;
    const std::string prefix = function_.substr(4, 4);
    family_ = prefix == "f32_" ? 0 : prefix == "f64_" ? 1 : prefix == "q16_" ? 2 : prefix == "q32_" ? 3 : 4;
    world_ = choose_world();
    damage();
  }
  /// Takes note of what was made and destroyed.
  void end(iso_status status) {
    if (status == ISO_OK) {
      if (out_id_ != nullptr && *out_id_ != 0) keep_id(*out_id_);
      for (const auto& [kind, slot] : out_handles_) {
        if (*slot != nullptr) handles_[kind].alive.push_back(*slot);
      }
      if (function_.find("_destroy") != std::string::npos) {
        for (const auto& [kind, handle] : taken_) bury(kind, handle);
      }
    }
    for (auto& [kind, handles] : handles_) {
      while (handles.alive.size() > kAlive) destroy(kind, handles.alive.front());
      if (handles.dead.size() > 50) handles.dead.erase(handles.dead.begin());
    }
  }
  /// The world that the call was given, if it lives.
  const iso_world* world() const {
    for (void* alive : handles_.at("world").alive) {
      if (alive == world_) return static_cast<const iso_world*>(alive);
    }
    return nullptr;
  }
  void keep_bytes(std::vector<std::uint8_t> bytes) {
    if (bytes.empty() || bytes.size() > kRegion) return;
    if (bytes_.size() < 40) bytes_.push_back(std::move(bytes));
    else bytes_[kept_ + dice_.below(40 - kept_)] = std::move(bytes);
  }
  void keep_for_ever(std::vector<std::uint8_t> bytes) {
    if (bytes.size() > kRegion) return;
    bytes_.insert(bytes_.begin(), std::move(bytes));
    ++kept_;
  }
  Dice& dice() { return dice_; }

  /// To what an argument points: `to` as in "iso_world", "const iso_blob*" or "void".
  void* pointer(const std::string& to, bool is_const, const std::string& name) {
    if (dice_.one_in(60)) return nullptr;
    for (const char* kind : kKinds) {
      if (to == std::string("iso_") + kind) return handle(kind);
    }
    if (to == "char") return is_const ? static_cast<void*>(name == "profile" ? line_ : scene_) : region();
    if (name == "file" && !has_file_) return nullptr;
    if (to == "void") return is_const ? static_cast<void*>(damaged_) : name == "user" ? nullptr : region();
    if (to.find('*') != std::string::npos) return slots(to, is_const);
    return numbers(to, is_const);
  }
  template <class T> T value(const std::string& name) {
    if constexpr (std::is_same_v<T, iso_run>) return dice_.one_in(2) ? run_here : nullptr;
    else if constexpr (std::is_floating_point_v<T>) return static_cast<T>(real());
    else return static_cast<T>(integer(sizeof(T), name));
  }

 private:
  double real() {
    switch (dice_.below(12)) {
      case 0: return 0;
      case 1: return dice_.one_in(3) ? -1 : 0.5;
      case 2: return dice_.one_in(6) ? 1e30 : 0.25;
      case 3: return dice_.one_in(10) ? 0.0 / zero_ : 1;
      default: return static_cast<double>(dice_.below(4000)) / 1000;
    }
  }
  std::uint64_t integer(std::size_t bytes, const std::string& name) {
    if (bytes == 1) return dice_.one_in(20) ? dice_.next() : dice_.below(2);
    if (bytes == 4) return dice_.one_in(30) ? dice_.next() : dice_.below(13);
    if (name == "now") return now_ += dice_.one_in(100) ? dice_.below(20000000) : dice_.below(20000);
    if (name == "file_size") return has_file_ ? size_ : 0;
    if (name == "size") return dice_.one_in(10) && size_ > 0 ? dice_.below(size_) : size_;
    if (name == "count" || name == "room" || name == "blob_count") return dice_.below(kElements);
    if (name == "each") return dice_.below(4);
    if (name == "frame" || name == "most_frames") return dice_.below(60);
    if (name == "user_data") return dice_.next();
    if (family_ == 3 && (name == "value" || name == "radius" || name == "pitch" || name == "ratio" || name == "rope" ||
                         name == "gravity_scale" || name.find("damping") != std::string::npos)) {
      return static_cast<std::uint64_t>(iso_q32_from_double(real()));
    }
    const char* kind = name == "shape" ? "iso_shape" : name == "id" ? "iso_record" : name == "body" ? "iso_body" : "";
    const bool is_joint = name == "joint" || function_.find("coupling") != std::string::npos;
    return id(kind[0] != '\0' ? kind : is_joint ? "iso_joint" : "iso_body");
  }
  /// Ids are kept by the world that gave them, and those of records by their kind.
  std::string key(const std::string& kind) const {
    std::string of = kind;
    for (const char* verb : {"_add_", "_set_", "_get_", "_remove_"}) {
      const std::size_t at = function_.find(verb);
      if (kind == "iso_record" && at != std::string::npos) of += function_.substr(at + std::strlen(verb));
    }
    return of + std::to_string(reinterpret_cast<std::uintptr_t>(world_));
  }
  std::uint64_t id(const std::string& kind) {
    const std::vector<std::uint64_t>& known = ids_[key(kind)];
    if (known.empty() || dice_.one_in(30)) return dice_.one_in(2) ? 0 : dice_.next();
    return known[dice_.below(known.size())];
  }
  void keep_id(std::uint64_t made) {
    const auto has = [&](const char* part) { return function_.find(part) != std::string::npos; };
    const bool shape = has("_blob") || has("_sphere") || has("_box") || has("_capsule") || has("_half_space") ||
                       has("_cylinder") || has("_cone") || has("_hull") || has("_compound");
    const char* kind = has("body_create") ? "iso_body"
                       : has("create")    ? "iso_joint"
                       : shape            ? "iso_shape"
                                          : "iso_record";
    std::vector<std::uint64_t>& known = ids_[key(kind)];
    if (known.size() < 60) known.push_back(made);
    else known[dice_.below(60)] = made;
  }

  std::uint8_t* region() { return reinterpret_cast<std::uint8_t*>(regions_[used_++ % kRegions].get()); }

  /// Handles that are given, or room for those that are made.
  void* slots(const std::string& to, bool is_const) {
    auto** const all = reinterpret_cast<void**>(region());
    for (std::size_t i = 0; i < kElements; ++i) all[i] = is_const ? handle("blob") : nullptr;
    for (const char* kind : kKinds) {
      if (!is_const && to == std::string("iso_") + kind + "*") out_handles_.push_back({kind, all});
    }
    return all;
  }
  /// A world, a block or both, with a step or without.
  iso_game* game() {
    auto* const game = reinterpret_cast<iso_game*>(region());
    iso_game_init(game);
    if (!dice_.one_in(3)) game->world = static_cast<iso_world*>(handle("world"));
    if (!dice_.one_in(3)) game->block = block_, game->block_size = 1 + dice_.below(sizeof block_);
    if (!dice_.one_in(3)) game->step = [](void*, std::int32_t, const iso_input*, std::uint32_t) {};
    if (dice_.one_in(20)) game->size = static_cast<std::uint32_t>(dice_.below(300));
    return game;
  }
  /// Mostly of a session that can be: a host, or a client whom nobody ever answers.
  iso_session_config* config(iso_session_config* config) {
    if (!dice_.one_in(20)) std::strcpy(config->name, "random");
    config->host = dice_.one_in(3) ? 0 : 1;
    config->seed = config->host;
    config->asks_admission = config->votes = dice_.one_in(2) ? 1 : 0;
    if (!dice_.one_in(10)) config->snapshot_cap = 1u << 20, config->most_packets = 480;
    return config;
  }
  void* numbers(const std::string& to, bool is_const) {
    if (to == "iso_game") return game();
    std::uint8_t* const at = region();
    if (const Fact* fact = facts_.named(to)) {
      const bool same_size = !dice_.one_in(25);
      for (std::size_t i = 0; i < kElements; ++i) fill(at + i * fact->size, *fact, same_size);
      if (to == "iso_session_config" && is_const) return config(reinterpret_cast<iso_session_config*>(at));
      return at;
    }
    auto* const words = reinterpret_cast<std::uint64_t*>(at);
    for (std::size_t i = 0; i < kElements; ++i) words[i] = is_const ? id("iso_body") : dice_.below(60000);
    if (!is_const) out_id_ = words;
    return at;
  }
  /// Bytes for this call: whole, or with a bit flipped.
  void damage() {
    const std::vector<std::uint8_t>& whole = bytes_[dice_.below(bytes_.size())];
    damaged_ = region();
    std::memcpy(damaged_, whole.data(), whole.size());
    size_ = whole.size();
    has_file_ = dice_.one_in(4);
    if (dice_.one_in(3)) damaged_[dice_.below(size_)] ^= static_cast<std::uint8_t>(1u << dice_.below(8));
  }

  /// Defaults with some members changed.
  void fill(std::uint8_t* at, const Fact& fact, bool same_size) {
    std::memcpy(at, fact.image.data(), fact.size);
    bool is_solid = false;  // its defaults are no shape
    for (const char* solid : {"_sphere", "_box", "_capsule", "_cylinder", "_cone", "_half_space"}) {
      is_solid = is_solid || fact.name.substr(7) == solid;
    }
    for (const Member& member : fact.members) {
      if (fact.sized && member.offset < 8) continue;
      const bool names = member.kind == id_ || member.kind == pointer_ || (is_solid && member.kind != struct_);
      if (member.kind == struct_ || names || dice_.one_in(6)) change(at + member.offset, member, fact);
    }
    if (fact.sized && !same_size && dice_.one_in(4)) {
      const std::uint32_t size = static_cast<std::uint32_t>(dice_.below(fact.size + 64));
      std::memcpy(at, &size, sizeof size);
    }
  }
  void change(std::uint8_t* at, const Member& member, const Fact& fact) {
    switch (member.kind) {
      case struct_: {
        const Fact* inner = facts_.named(member.of);
        const bool is_size = fact.name.substr(7) == "_box";
        if (inner != nullptr && (is_size || dice_.one_in(3))) {
          for (const Member& deeper : inner->members) {
            if (deeper.kind == struct_ || is_size || dice_.one_in(8)) change(at + deeper.offset, deeper, *inner);
          }
        }
        return;
      }
      case id_: return put(at, dice_.one_in(5) ? 0 : id(member.of), 8);
      case pointer_: return put(at, dice_.one_in(3) ? 0 : reinterpret_cast<std::uintptr_t>(lists_), 8);
      case bool_: return put(at, dice_.one_in(30) ? dice_.next() : dice_.below(2), 1);
      case enum_: return put(at, dice_.one_in(30) ? dice_.next() : dice_.below(4), 4);
      case u32_: return put(at, dice_.below(kElements), 4);
      case number_:
      case unit_: {
        for (std::size_t i = 0, width = width_of(fact); i + width <= member.size; i += width)
          number(at + i, member, fact);
        return;
      }
      case f64_: {
        const double value = real();
        return void(std::memcpy(at, &value, sizeof value));
      }
      default: return;  // what is written to, and small numbers whose defaults do
    }
  }
  static std::size_t width_of(const Fact& fact) {
    const std::string family = fact.name.substr(4, 3);
    return family == "f32" || family == "q16" ? 4 : 8;
  }
  void number(std::uint8_t* at, const Member& member, const Fact& fact) {
    const std::string family = fact.name.substr(4, 3);
    const double value = real();
    const bool unit = member.kind == unit_;
    if (family == "f32") {
      const auto narrow = static_cast<float>(value);
      std::memcpy(at, &narrow, 4);
    } else if (family == "f64") {
      std::memcpy(at, &value, 8);
    } else if (family == "q16") {
      const std::int32_t raw = unit ? iso_q16_unit_from_double(value) : iso_q16_from_double(value);
      std::memcpy(at, &raw, 4);
    } else {
      const std::int64_t raw = unit ? iso_q32_unit_from_double(value) : iso_q32_from_double(value);
      std::memcpy(at, &raw, 8);
    }
  }
  static void put(std::uint8_t* at, std::uint64_t bits, std::size_t size) { std::memcpy(at, &bits, size); }

  /// Mostly one of the call's family.
  void* choose_world() {
    void* chosen = choose("world");
    if (family_ == 4 || dice_.one_in(10)) return chosen;
    for (void* alive : handles_["world"].alive) {
      iso_scalar scalar = 9;
      if (iso_world_get_scalar(static_cast<iso_world*>(alive), &scalar) == ISO_OK && scalar == family_) chosen = alive;
    }
    return chosen;
  }
  void* handle(const char* kind) {
    void* const chosen = std::strcmp(kind, "world") == 0 ? world_ : choose(kind);
    if (chosen != nullptr) taken_.push_back({kind, chosen});
    return chosen;
  }
  void* choose(const char* kind) {
    Handles& handles = handles_[kind];
    void* chosen = nullptr;
    if (dice_.one_in(40) && !handles.dead.empty()) chosen = handles.dead[dice_.below(handles.dead.size())];
    else if (dice_.one_in(60)) chosen = handle_of_other_kind();
    else if (!handles.alive.empty()) chosen = handles.alive[dice_.below(handles.alive.size())];
    return chosen;
  }
  void* handle_of_other_kind() {
    const std::vector<void*>& tapes = handles_["tape"].alive;
    return tapes.empty() ? static_cast<void*>(lists_) : tapes[dice_.below(tapes.size())];
  }
  void bury(const std::string& kind, void* handle) {
    std::vector<void*>& alive = handles_[kind].alive;
    for (std::size_t i = 0; i < alive.size(); ++i) {
      if (alive[i] != handle) continue;
      alive.erase(alive.begin() + static_cast<std::ptrdiff_t>(i));
      handles_[kind].dead.push_back(handle);
      return;
    }
  }
  void destroy(const std::string& kind, void* handle) {
    iso_status status = ISO_OK;
    if (kind == "world") status = iso_world_destroy(static_cast<iso_world*>(handle));
    if (kind == "snapshot") status = iso_snapshot_destroy(static_cast<iso_snapshot*>(handle));
    if (kind == "tape") status = iso_tape_destroy(static_cast<iso_tape*>(handle));
    if (kind == "replay") status = iso_replay_destroy(static_cast<iso_replay*>(handle));
    if (kind == "blob") status = iso_blob_destroy(static_cast<iso_blob*>(handle));
    if (kind == "session") status = iso_session_destroy(static_cast<iso_session*>(handle));
    if (kind == "network") status = iso_network_destroy(static_cast<iso_network*>(handle));
    if (status != ISO_OK)
      std::printf("a living %s is not destroyed: %s\n", kind.c_str(), iso_last_error()), std::exit(1);
    bury(kind, handle);
  }

  static constexpr std::size_t kRegions = 12;
  const Facts& facts_;
  Dice dice_;
  std::string function_;
  std::unique_ptr<std::uint64_t[]> regions_[kRegions];
  std::size_t used_ = 0, size_ = 0, kept_ = 0;
  std::uint8_t* damaged_ = nullptr;
  std::uint64_t* out_id_ = nullptr;
  std::vector<std::pair<const char*, void**>> out_handles_;
  std::vector<std::pair<const char*, void*>> taken_;
  void* world_ = nullptr;
  std::uint32_t family_ = 4;
  double zero_ = 0;
  char scene_[8] = "random", line_[8] = "wifi";
  std::uint8_t block_[200] = {};  // of all sessions' games
  std::uint64_t now_ = 0;         // [us] of sessions and networks
  bool has_file_ = false;
  alignas(16) std::uint64_t lists_[512] = {};  // what pointers within structs point to: 400 places and more
  std::map<std::string, Handles> handles_ = {{"world", {}}, {"snapshot", {}}, {"tape", {}},   {"replay", {}},
                                             {"blob", {}},  {"session", {}},  {"network", {}}};
  std::map<std::string, std::vector<std::uint64_t>> ids_;
  std::vector<std::vector<std::uint8_t>> bytes_;
};

struct Call {
  const char* name;
  bool has_status;
  iso_status (*call)(Drawer&);
};
/// The order in which a compiler draws the arguments is of no account: the draws of one do not depend on another's.
const std::vector<Call>& all_calls() {
  static const std::vector<Call> calls = {
#define ISO_P(type, to, is_const, name) static_cast<type>(drawer.pointer(to, is_const, name))
#define ISO_V(type, name) drawer.value<type>(name)
#define ISO_CALL(f, ...) {#f, true, []([[maybe_unused]] Drawer& drawer) { return f(__VA_ARGS__); }},
#define ISO_ASK(f, ...) \
  {#f, false, []([[maybe_unused]] Drawer& drawer) { return (void)f(__VA_ARGS__), iso_status{0}; }},
#include "calls.inl"
  };
  return calls;
}

/// Calls that are drawn more often than others: what makes bodies and what names them.
struct Often {
  std::vector<const Call*> bodies, all;

  Often() {
    for (const Call& call : all_calls()) {
      const std::string name = call.name;
      const auto has = [&](const char* part) { return name.find(part) != std::string::npos; };
      if (has("_body_create") || has("_add_box") || has("_add_sphere") || has("_create_six_axis"))
        bodies.push_back(&call);
      const bool makes = has("_body_create") || has("_add_") || (has("_create_") && !has("blob_") && !has("replay_"));
      if (makes) all.push_back(&call);
    }
  }
  const Call& draw(Dice& dice) const {
    if (dice.one_in(6)) return *bodies[dice.below(bodies.size())];
    return dice.one_in(3) ? *all[dice.below(all.size())] : all_calls()[dice.below(all_calls().size())];
  }
};

/// A recording of forty frames of a world with a body, and the file of a hull.
void keep_files(Drawer& drawer) {
  iso_q32_settings settings;
  iso_q32_settings_init(&settings);
  iso_world* world = nullptr;
  iso_tape* tape = nullptr;
  if (iso_q32_world_create(&settings, &world) != ISO_OK || iso_tape_create(&tape) != ISO_OK) return;
  iso_world_record(world, tape, "drawn");
  iso_q32_box box;
  iso_q32_box_init(&box);
  const std::int64_t one = iso_q32_from_double(1);
  box.half_extents = {one, one, one};
  iso_q32_body_definition definition;
  iso_q32_body_definition_init(&definition);
  definition.type = ISO_BODY_TYPE_DYNAMIC;
  iso_q32_add_box(world, &box, &definition.shape);
  iso_body body = 0;
  iso_q32_body_create(world, &definition, &body);
  for (int i = 0; i < 40; ++i) {
    iso_world_step(world, nullptr);
    iso_tape_end_frame(tape);
  }
  iso_tape_finish(tape);
  const void* bytes = nullptr;
  std::size_t size = 0;
  iso_tape_bytes(tape, &bytes, &size);
  const auto* const first = static_cast<const std::uint8_t*>(bytes);
  for (int i = 0; i < 4; ++i) drawer.keep_for_ever({first, first + size});
  iso_tape_destroy(tape);
  iso_world_destroy(world);
  const iso_q32_vec3 points[] = {{0, 0, 0}, {one, 0, 0}, {0, one, 0}, {0, 0, one}};
  iso_blob* hull = nullptr;
  std::vector<std::uint8_t> file(kRegion);
  size = file.size();
  if (iso_q32_blob_create_hull(points, 4, ISO_BLOB_HOME_CARRIED, &hull) != ISO_OK) return;
  iso_blob_write(hull, file.data(), &size);
  file.resize(size);
  for (int i = 0; i < 4; ++i) drawer.keep_for_ever(file);
  iso_blob_destroy(hull);
}

/// States and logs of a world, and recordings, for calls that read bytes.
void keep_bytes_of(const iso_world* world, Drawer& drawer) {
  std::vector<std::uint8_t> state(kRegion);
  std::size_t size = state.size();
  if (iso_world_write(world, state.data(), &size) == ISO_OK) {
    state.resize(size);
    drawer.keep_bytes(state);
  }
  const void* log = nullptr;
  if (iso_world_log(world, &log, &size) == ISO_OK && size != 0) {
    drawer.keep_bytes({static_cast<const std::uint8_t*>(log), static_cast<const std::uint8_t*>(log) + size});
  }
}

std::uint64_t setting(const char* name, std::uint64_t otherwise) {
  const char* const text = std::getenv(name);
  return text == nullptr ? otherwise : std::strtoull(text, nullptr, 10);
}

}  // namespace

int main() {
  const std::uint64_t count = setting("ISOSTEP_RANDOM_CALLS", 100000), seed = setting("ISOSTEP_RANDOM_SEED", 1);
  const Facts facts;
  Drawer drawer(facts, seed);
  const std::vector<Call>& calls = all_calls();
  std::map<std::string, std::uint64_t> succeeded;
  std::map<iso_status, std::uint64_t> statuses;
  int selfchecks = 0;
  const Often often;
  keep_files(drawer);
  for (std::uint64_t i = 0; i < count; ++i) {
    const Call& call = often.draw(drawer.dice());
    const std::string name = call.name;
    if (name == "iso_selfcheck" && ++selfchecks > 1) continue;  // half a second
    drawer.begin(call.name);
    const bool looks = drawer.dice().one_in(4) && drawer.world() != nullptr;
    const std::uint64_t before = looks ? iso_world_hash(drawer.world()) : 0;
    const iso_status status = call.call(drawer);
    if (call.has_status) ++statuses[status];
    if (std::strcmp(iso_status_text(status), "unknown status") == 0) {
      return std::printf("call %llu, %s: status %d\n", static_cast<unsigned long long>(i), call.name, status), 1;
    }
    // Of commands as bytes, what comes before the damage was done; a ragdoll that is taken back has used up ids.
    const bool leaves_traces = name == "iso_world_apply" || name.find("add_ragdoll") != std::string::npos;
    if (status != ISO_OK && looks && !leaves_traces && iso_world_hash(drawer.world()) != before) {
      return std::printf("call %llu, %s: refused, and the world is another: %s\n", static_cast<unsigned long long>(i),
                         call.name, iso_last_error()),
             1;
    }
    if (status == ISO_OK) ++succeeded[name];
    drawer.end(status);
    if (i % 50 == 0 && drawer.world() != nullptr) keep_bytes_of(drawer.world(), drawer);
  }
  std::printf("%llu calls; of %zu functions %zu succeeded at least once\n", static_cast<unsigned long long>(count),
              calls.size(), succeeded.size());
  for (const auto& [status, times] : statuses) {
    std::printf("%9llu %s\n", static_cast<unsigned long long>(times), iso_status_text(status));
  }
  for (const Call& call : calls) {
    if (succeeded.find(call.name) == succeeded.end()) std::printf("never: %s\n", call.name);
  }
  return succeeded.size() * 10 < calls.size() * 8 ? 1 : 0;
}
