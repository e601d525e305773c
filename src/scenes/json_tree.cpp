// The tree, built from nlohmann's events.
// SPDX-License-Identifier: MIT
#include "json_tree.hpp"

#include <cstdint>
#include <nlohmann/json.hpp>

#include "scene.hpp"

namespace isostep::scenes {
namespace {

constexpr std::size_t kMaxDepth = 32;  // a scene needs 6

/// "12:5: " for the byte at which the lexer stopped.
std::string place_of(std::string_view text, std::size_t position) {
  std::size_t line = 1, column = 1;
  for (std::size_t i = 0; i + 1 < position && i < text.size(); ++i) {
    ++column;
    if (text[i] == '\n') {
      ++line;
      column = 1;
    }
  }
  return std::to_string(line) + ":" + std::to_string(column);
}

/// nlohmann's sentence without its prefix and its own count of lines.
std::string reason_of(std::string message) {
  const std::size_t syntax = message.find("syntax error");
  if (syntax != std::string::npos) message.erase(0, syntax);
  const std::size_t bracket = message.find("] ");
  if (message.rfind("[json", 0) == 0 && bracket != std::string::npos) message.erase(0, bracket + 2);
  for (char& c : message) {
    if (static_cast<unsigned char>(c) < 0x20) c = ' ';
  }
  return message;
}

class TreeBuilder {
 public:
  explicit TreeBuilder(std::string_view text) : text_(text) {}

  bool null() { return add({}); }
  bool boolean(bool value) { return add({JsonKind::boolean, value, {}, {}, {}}); }
  /// Zero here was written "-0": only a negative integer comes.
  bool number_integer(std::int64_t value) { return number(value == 0 ? "-0" : std::to_string(value)); }
  bool number_unsigned(std::uint64_t value) { return number(std::to_string(value)); }
  bool number_float(double, const std::string& text) { return number(text); }
  bool string(std::string& text) { return add({JsonKind::text, false, text, {}, {}}); }
  bool binary(nlohmann::json::binary_t&) { return false; }
  bool start_object(std::size_t) { return open(JsonKind::object); }
  bool start_array(std::size_t) { return open(JsonKind::array); }
  bool end_object() { return close(); }
  bool end_array() { return close(); }
  bool key(std::string& name) {
    for (const std::string& other : path_.back()->keys) {
      if (other == name) throw SceneError(pointer(), "the key \"" + name + "\" comes twice");
    }
    path_.back()->keys.push_back(name);
    return true;
  }
  bool parse_error(std::size_t position, const std::string&, const nlohmann::json::exception& error) {
    throw SceneError(place_of(text_, position), reason_of(error.what()));
  }

  JsonNode take() { return std::move(root_); }

 private:
  bool number(std::string text) { return add({JsonKind::number, false, std::move(text), {}, {}}); }
  JsonNode* place(JsonNode node) {
    if (path_.empty()) {
      root_ = std::move(node);
      return &root_;
    }
    path_.back()->items.push_back(std::move(node));
    return &path_.back()->items.back();
  }
  bool add(JsonNode node) { return place(std::move(node)) != nullptr; }
  bool open(JsonKind kind) {
    if (path_.size() >= kMaxDepth) throw SceneError(pointer(), "nested too deeply");
    path_.push_back(place({kind, false, {}, {}, {}}));
    return true;
  }
  bool close() {
    path_.pop_back();
    return true;
  }
  std::string pointer() const {
    std::string text;
    for (std::size_t i = 0; i + 1 < path_.size(); ++i) {
      const JsonNode& node = *path_[i];
      text += '/' + (node.kind == JsonKind::array ? std::to_string(node.items.size() - 1) : node.keys.back());
    }
    return text;
  }

  std::string_view text_;
  JsonNode root_;
  std::vector<JsonNode*> path_;  // open nodes; an ancestor's items do not grow while a child is open
};

}  // namespace

JsonNode parse_json(std::string_view text) {
  TreeBuilder builder(text);
  nlohmann::json::sax_parse(text.begin(), text.end(), &builder);
  return builder.take();
}

const char* name_of(JsonKind kind) {
  switch (kind) {
    case JsonKind::null: return "null";
    case JsonKind::boolean: return "true or false";
    case JsonKind::number: return "a number";
    case JsonKind::text: return "a string";
    case JsonKind::array: return "an array";
    case JsonKind::object: return "an object";
  }
  return "nothing";
}

}  // namespace isostep::scenes
