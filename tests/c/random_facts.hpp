// The random caller's facts about the structs of isostep.h, and its dice.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <cstring>
#include <map>
#include <string>
#include <vector>

#include "../random/splitmix64.hpp"
#include "isostep.h"

namespace isostep::test {

enum Kind {
  number_,
  unit_,
  bool_,
  enum_,
  id_,
  pointer_,
  word_,
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
  std::uint64_t next() { return splitmix64(state_); }
  std::size_t below(std::size_t n) { return static_cast<std::size_t>(next() % n); }
  bool one_in(std::size_t n) { return below(n) == 0; }

 private:
  std::uint64_t state_;
};

}  // namespace isostep::test
