// Wavefront OBJ, by tinyobjloader.
// SPDX-License-Identifier: MIT
#include "source_mesh.hpp"
#include "tool/common/files.hpp"
#include "tool/common/tool.hpp"

#ifdef ISOSTEP_HAS_TINYOBJLOADER

#define TINYOBJLOADER_IMPLEMENTATION
#define TINYOBJLOADER_USE_DOUBLE
#include <tiny_obj_loader.h>

#include <algorithm>
#include <sstream>
#include <string_view>

namespace isostep::tool::bake {
namespace {

[[noreturn]] void fail(const std::string& path, const std::string& message) {
  throw ToolError(exit_status::kUsage, path + ": " + message);
}

/// The next word of a line, which is taken off it.
std::string_view next_word(std::string_view& line) {
  line.remove_prefix(std::min(line.find_first_not_of(" \t"), line.size()));
  const std::string_view word = line.substr(0, line.find_first_of(" \t"));
  line.remove_prefix(word.size());
  return word;
}
std::size_t take(std::string_view& word, const char* any_of, std::size_t most = std::string_view::npos) {
  const std::size_t n = std::min({word.find_first_not_of(any_of), word.size(), most});
  word.remove_prefix(n);
  return n;
}
/// The word is a number, as tinyobjloader reads one to its end.
bool is_number(std::string_view word) {
  constexpr const char* kDigits = "0123456789";
  take(word, "+-", 1);
  std::size_t digits = take(word, kDigits);
  if (take(word, ".", 1) > 0) digits += take(word, kDigits);
  if (digits == 0) return false;
  if (take(word, "eE", 1) == 0) return word.empty();
  take(word, "+-", 1);
  return take(word, kDigits) > 0 && word.empty();
}

/// tinyobjloader reads what is no number as 0. How many lines of lines and points there are, which it passes over.
std::size_t check_lines(std::string_view text, const std::string& path) {
  std::size_t bare = 0;
  for (std::size_t line_number = 1; !text.empty(); ++line_number) {
    std::string_view line = text.substr(0, text.find_first_of("\r\n"));
    text.remove_prefix(line.size());
    if (take(text, "\r", 1) + take(text, "\n", 1) == 0) text = {};
    const std::string_view word = next_word(line);
    if (word == "l" || word == "p") ++bare;
    if (word != "v") continue;
    for (int i = 0; i < 3; ++i) {
      const std::string_view number = next_word(line);
      if (is_number(number)) continue;
      fail(path, "line " + std::to_string(line_number) + ": expected three numbers after v, found \"" +
                     std::string(number) + "\"");
    }
  }
  return bare;
}

/// The callbacks that tinyobjloader calls with the lines of a file.
class Lines {
 public:
  explicit Lines(const std::string& path) : path_(path) {}

  SourceMesh run(const std::string& text) {
    tinyobj::callback_t callback;
    callback.vertex_cb = [](void* self, double x, double y, double z, double) {
      of(self).mesh_.points.push_back({x, y, z});
    };
    callback.index_cb = [](void* self, tinyobj::index_t* corners, int count) { of(self).add_face(corners, count); };
    callback.usemtl_cb = [](void* self, const char* name, int) { of(self).material_ = {name, kNoPlace}; };
    callback.object_cb = [](void* self, const char* name) { of(self).begin_object(name); };
    callback.group_cb = [](void* self, const char** names, int count) {
      of(self).begin_group(count > 0 ? names[0] : "");
    };
    std::istringstream stream(text);
    std::string warnings, errors;
    if (!tinyobj::LoadObjWithCallback(stream, callback, this, nullptr, &warnings, &errors)) fail(path_, errors);
    return std::move(mesh_);
  }

 private:
  static constexpr std::uint32_t kNoPlace = 0xffffffffu;
  /// The material or object of the faces that follow; it is in its list once a face has it.
  struct Current {
    std::string name;
    std::uint32_t place = kNoPlace;
    std::uint32_t in(std::vector<std::string>& names) {
      if (place == kNoPlace) place = place_of(name, names);
      return place;
    }
  };

  static Lines& of(void* self) { return *static_cast<Lines*>(self); }

  void begin_object(const char* name) {
    object_ = {name, kNoPlace};
    has_objects_ = true;
  }
  void begin_group(const char* name) {
    if (!has_objects_) object_ = {name, kNoPlace};
  }
  /// Numbers of points count from 1, or backwards from the last one so far.
  void add_face(const tinyobj::index_t* corners, int count) {
    if (count < 3) {
      ++mesh_.bare;
      return;
    }
    const SourceFace face = {mesh_.corners.size(), static_cast<std::size_t>(count), material_.in(mesh_.materials),
                             object_.in(mesh_.objects)};
    const auto points = static_cast<std::int64_t>(mesh_.points.size());
    for (int i = 0; i < count; ++i) {
      const std::int64_t number = corners[i].vertex_index;
      if (number == 0 || number > points || -number > points)
        fail(path_, "face " + std::to_string(mesh_.faces.size()) + ": no vertex before it has the number " +
                        std::to_string(number));
      mesh_.corners.push_back(static_cast<std::uint32_t>(number > 0 ? number - 1 : points + number));
    }
    mesh_.faces.push_back(face);
  }

  const std::string& path_;
  SourceMesh mesh_;
  Current material_, object_;
  bool has_objects_ = false;
};

}  // namespace

SourceMesh read_obj(const std::string& path) {
  const std::vector<std::uint8_t> bytes = read_file(path);
  const std::string text(bytes.begin(), bytes.end());
  const std::size_t bare = check_lines(text, path);
  SourceMesh mesh = Lines(path).run(text);
  mesh.bare += bare;
  return mesh;
}

}  // namespace isostep::tool::bake

#else

namespace isostep::tool::bake {

SourceMesh read_obj(const std::string& path) {
  read_file(path);
  throw ToolError(exit_status::kUnavailable,
                  "OBJ files are read by tinyobjloader, which was not there when this was built: install "
                  "libtinyobjloader-dev and configure again");
}

}  // namespace isostep::tool::bake

#endif
