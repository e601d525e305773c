// ObjectReader: the members of one JSON object by name and type; what is left unread is an unknown key.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "json_tree.hpp"
#include "scene.hpp"

namespace isostep::scenes {

/// Absent members leave their target as it is. Everything throws SceneError.
class ObjectReader {
 public:
  ObjectReader(const JsonNode& node, std::string place);

  void number(const char* key, Number& to);
  void positive(const char* key, Number& to);
  void vector(const char* key, Vector& to);
  void vectors(const char* key, std::vector<Vector>& to);
  void list(const char* key, std::vector<Number>& to);
  void rotation(const char* key, Rotation& to);
  void flag(const char* key, bool& to);
  void text(const char* key, std::string& to);
  /// A whole number from `low` to `high`.
  void integer(const char* key, std::int64_t low, std::int64_t high, std::int64_t& to);
  /// The index of the member's text in `names`.
  std::size_t choice(const char* key, std::span<const char* const> names);
  /// An array's nodes; empty when absent.
  std::span<const JsonNode> array(const char* key);

  bool has(const char* key) const;
  void require(const char* key) const;
  /// Call last: any member that was not asked for is an error.
  void finish() const;

  const std::string& place() const { return place_; }
  std::string place_of(const char* key) const { return place_ + "/" + key; }

 private:
  const JsonNode* find(const char* key, JsonKind kind);
  template <std::size_t N> void numbers(const char* key, std::array<Number, N>& to);
  template <std::size_t N>
  static void numbers(const JsonNode& node, const std::string& place, std::array<Number, N>& to);

  const JsonNode& node_;
  std::string place_;
  std::vector<const char*> known_;
};

}  // namespace isostep::scenes
