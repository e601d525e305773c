// JSON as a tree in which every number is still its text, so that it can enter a scalar with one rounding.
// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace isostep::scenes {

enum class JsonKind { null, boolean, number, text, array, object };

struct JsonNode {
  JsonKind kind = JsonKind::null;
  bool flag = false;
  std::string text;               // of a number or a string
  std::vector<std::string> keys;  // of an object, one for each item
  std::vector<JsonNode> items;    // of an array or an object
};

/// Throws SceneError with line and column for what is no JSON, and with a pointer for a key that comes twice.
JsonNode parse_json(std::string_view text);

/// "a number", "an object", ... for messages.
const char* name_of(JsonKind kind);

}  // namespace isostep::scenes
