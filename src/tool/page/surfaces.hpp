// Surfaces: the triangles of parts whose shape is a blob, each content once.
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <vector>

#include "isostep/draw/debug_draw.hpp"

namespace isostep::tool::page {

struct Surface {
  ContentId content;
  std::vector<std::array<float, 3>> vertices;           // [m] in the part's frame, distinct
  std::vector<std::array<std::uint32_t, 3>> triangles;  // vertices, counter-clockwise seen from outside
};

class Surfaces {
 public:
  /// The place of the content among all; kNone: it is not there.
  static constexpr std::uint32_t kNone = 0xffffffffu;
  std::uint32_t find(const ContentId& content) const;

  /// A content that is not there yet gets a surface, still without triangles, and its place.
  std::uint32_t begin(const ContentId& content);
  /// Adds a triangle to the surface begun last.
  void add(const DrawnTriangle& triangle);
  /// The place of an equal surface, which joins them if it is not there.
  std::uint32_t merge(const Surface& surface);

  const std::vector<Surface>& all() const { return all_; }

 private:
  std::vector<Surface> all_;
  std::map<std::array<std::uint64_t, 2>, std::uint32_t> by_content_;
  std::map<std::array<float, 3>, std::uint32_t> vertices_;  // of the surface begun last
};

/// The surfaces in a page [bytes], see surfaces.js: vertices are 16-bit fractions of their box.
std::vector<std::uint8_t> pack(const Surfaces& surfaces);

}  // namespace isostep::tool::page
