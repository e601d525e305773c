// The reader of one JSON object, member by member.
// SPDX-License-Identifier: MIT
#include "object_reader.hpp"

#include <algorithm>

namespace isostep::scenes {
namespace {

/// The key as it stands in a JSON pointer (RFC 6901).
std::string escaped(const std::string& key) {
  std::string text;
  for (const char c : key) {
    if (c == '~') text += "~0";
    else if (c == '/') text += "~1";
    else text += static_cast<unsigned char>(c) < 0x20 ? '?' : c;
  }
  return text;
}

[[noreturn]] void wrong_kind(const std::string& place, JsonKind expected, JsonKind found) {
  throw SceneError(place, std::string("expected ") + name_of(expected) + ", found " + name_of(found));
}

}  // namespace

ObjectReader::ObjectReader(const JsonNode& node, std::string place) : node_(node), place_(std::move(place)) {
  if (node.kind != JsonKind::object) wrong_kind(place_, JsonKind::object, node.kind);
}

const JsonNode* ObjectReader::find(const char* key, JsonKind kind) {
  known_.push_back(key);
  for (std::size_t i = 0; i < node_.keys.size(); ++i) {
    if (node_.keys[i] != key) continue;
    const JsonNode& value = node_.items[i];
    if (value.kind != kind) wrong_kind(place_of(key), kind, value.kind);
    return &value;
  }
  return nullptr;
}

bool ObjectReader::has(const char* key) const {
  return std::find(node_.keys.begin(), node_.keys.end(), key) != node_.keys.end();
}
void ObjectReader::require(const char* key) const {
  if (!has(key)) throw SceneError(place_, std::string("the key \"") + key + "\" is missing");
}

void ObjectReader::number(const char* key, Number& to) {
  if (const JsonNode* node = find(key, JsonKind::number)) to = Number(node->text);
}

/// The number is positive by its text: some digit before the exponent is not zero.
void ObjectReader::positive(const char* key, Number& to) {
  number(key, to);
  if (!has(key)) return;
  const std::string& text = to.text();
  const std::size_t digits = std::min(text.find_first_of("eE"), text.size());
  if (text[0] == '-' || text.find_first_of("123456789") >= digits) {
    throw SceneError(place_of(key), "expected a number above 0, found " + text);
  }
}

template <std::size_t N>
void ObjectReader::numbers(const JsonNode& node, const std::string& place, std::array<Number, N>& to) {
  if (node.kind != JsonKind::array) wrong_kind(place, JsonKind::array, node.kind);
  if (node.items.size() != N) {
    throw SceneError(
        place, "expected " + std::to_string(N) + " numbers, found " + std::to_string(node.items.size()) + " items");
  }
  for (std::size_t i = 0; i < N; ++i) {
    const JsonNode& item = node.items[i];
    if (item.kind != JsonKind::number) wrong_kind(place + "/" + std::to_string(i), JsonKind::number, item.kind);
    to[i] = Number(item.text);
  }
}
template <std::size_t N> void ObjectReader::numbers(const char* key, std::array<Number, N>& to) {
  if (const JsonNode* node = find(key, JsonKind::array)) numbers(*node, place_of(key), to);
}
void ObjectReader::vector(const char* key, Vector& to) { numbers(key, to); }
void ObjectReader::vectors(const char* key, std::vector<Vector>& to) {
  const std::span<const JsonNode> items = array(key);
  for (std::size_t i = 0; i < items.size(); ++i)
    numbers(items[i], place_of(key) + "/" + std::to_string(i), to.emplace_back(zero_vector()));
}
void ObjectReader::list(const char* key, std::vector<Number>& to) {
  const std::span<const JsonNode> items = array(key);
  for (std::size_t i = 0; i < items.size(); ++i) {
    if (items[i].kind != JsonKind::number)
      wrong_kind(place_of(key) + "/" + std::to_string(i), JsonKind::number, items[i].kind);
    to.push_back(Number(items[i].text));
  }
}
void ObjectReader::rotation(const char* key, Rotation& to) { numbers(key, to); }

void ObjectReader::flag(const char* key, bool& to) {
  if (const JsonNode* node = find(key, JsonKind::boolean)) to = node->flag;
}
void ObjectReader::text(const char* key, std::string& to) {
  if (const JsonNode* node = find(key, JsonKind::text)) to = node->text;
}

void ObjectReader::integer(const char* key, std::int64_t low, std::int64_t high, std::int64_t& to) {
  const JsonNode* node = find(key, JsonKind::number);
  if (node == nullptr) return;
  const bool digits =
      node->text.size() <= 12 && node->text.find_first_not_of("0123456789", node->text[0] == '-') == std::string::npos;
  if (digits) to = std::stoll(node->text);
  if (!digits || to < low || to > high) {
    throw SceneError(place_of(key), "expected a whole number from " + std::to_string(low) + " to " +
                                        std::to_string(high) + ", found " + node->text);
  }
}

std::size_t ObjectReader::choice(const char* key, std::span<const char* const> names) {
  require(key);
  const std::string& text = find(key, JsonKind::text)->text;
  std::string list;
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (text == names[i]) return i;
    list += (i == 0 ? "" : i + 1 == names.size() ? " or " : ", ") + std::string(names[i]);
  }
  throw SceneError(place_of(key), "expected " + list + ", found \"" + text + "\"");
}

std::span<const JsonNode> ObjectReader::array(const char* key) {
  const JsonNode* node = find(key, JsonKind::array);
  if (node == nullptr) return {};
  return node->items;
}

void ObjectReader::finish() const {
  for (const std::string& name : node_.keys) {
    const bool known = std::any_of(known_.begin(), known_.end(), [&](const char* key) { return name == key; });
    if (!known) throw SceneError(place_ + "/" + escaped(name), "unknown key");
  }
}

}  // namespace isostep::scenes
