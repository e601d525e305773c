// Drawer: arguments for calls of isostep.h, by their types and names, and what calls have made so far.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdio>
#include <cstdlib>
#include <memory>
#include <type_traits>
#include <utility>

#include "random_facts.hpp"

namespace isostep::test {

inline void run_here(void*, std::int32_t copies, iso_task task, void* data) {
  for (std::int32_t i = 0; i < copies; ++i) task(data);
}

constexpr std::size_t kRegion = 1 << 16;  // [bytes] that each pointer argument has
constexpr std::size_t kElements = 20;     // of an array, at most
constexpr std::size_t kAlive = 12;        // handles of a kind

/// The handles of one kind.
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
        for (const auto& [kind, handle] : taken_) mark_destroyed(kind, handle);
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

  /// The object to which an argument points: `to` as in "iso_world", "const iso_blob*" or "void".
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
    if (name == "size" && ends_in("_init_sized")) {
      const Fact* fact = facts_.named(function_.substr(0, function_.size() - std::strlen("_init_sized")));
      if (fact != nullptr) return dice_.one_in(3) ? dice_.below(fact->size + 64) : fact->size;
    }
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
  bool ends_in(const char* end) const {
    const std::size_t length = std::strlen(end);
    return function_.size() > length && function_.compare(function_.size() - length, length, end) == 0;
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
  void mark_destroyed(const std::string& kind, void* handle) {
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
    mark_destroyed(kind, handle);
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

}  // namespace isostep::test
