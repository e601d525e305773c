// Surfaces, collected and packed.
// SPDX-License-Identifier: MIT
#include "surfaces.hpp"

#include <algorithm>

#include "byte_writer.hpp"

namespace isostep::tool::page {
namespace {

constexpr double kFractions = 65535;

void pack_vertices(const Surface& surface, ByteWriter& out) {
  std::array<float, 3> low = {}, high = {};
  if (!surface.vertices.empty()) low = high = surface.vertices.front();
  for (const auto& vertex : surface.vertices) {
    for (std::size_t i = 0; i < 3; ++i) {
      low[i] = std::min(low[i], vertex[i]);
      high[i] = std::max(high[i], vertex[i]);
    }
  }
  std::array<double, 3> step = {};
  for (std::size_t i = 0; i < 3; ++i) step[i] = (double{high[i]} - low[i]) / kFractions;
  for (const float x : low) out.f32(x);
  for (const double x : step) out.f32(x);
  for (const auto& vertex : surface.vertices) {
    for (std::size_t i = 0; i < 3; ++i)
      out.u16(step[i] > 0 ? static_cast<std::uint32_t>((double{vertex[i]} - low[i]) / step[i] + 0.5) : 0);
  }
}

void pack_triangles(const Surface& surface, ByteWriter& out) {
  const std::size_t vertices = surface.vertices.size();
  for (const auto& triangle : surface.triangles) {
    for (const std::uint32_t vertex : triangle) {
      if (vertices <= 0x100) out.u8(vertex);
      else if (vertices <= 0x10000) out.u16(vertex);
      else out.u32(vertex);
    }
  }
}

}  // namespace

std::uint32_t Surfaces::find(const ContentId& content) const {
  const auto found = by_content_.find({content.high, content.low});
  return found == by_content_.end() ? kNone : found->second;
}

std::uint32_t Surfaces::begin(const ContentId& content) {
  const std::uint32_t place = static_cast<std::uint32_t>(all_.size());
  all_.push_back({content, {}, {}});
  by_content_[{content.high, content.low}] = place;
  vertices_.clear();
  return place;
}

void Surfaces::add(const DrawnTriangle& triangle) {
  Surface& surface = all_.back();
  std::array<std::uint32_t, 3> corners = {};
  for (std::size_t i = 0; i < 3; ++i) {
    const float(&at)[3] = triangle.corners[i];
    const auto [known, fresh] =
        vertices_.try_emplace({at[0], at[1], at[2]}, static_cast<std::uint32_t>(surface.vertices.size()));
    if (fresh) surface.vertices.push_back(known->first);
    corners[i] = known->second;
  }
  surface.triangles.push_back(corners);
}

std::uint32_t Surfaces::merge(const Surface& surface) {
  const std::uint32_t known = find(surface.content);
  if (known != kNone) return known;
  const std::uint32_t place = begin(surface.content);
  all_.back() = surface;
  return place;
}

std::vector<std::uint8_t> pack(const Surfaces& surfaces) {
  std::vector<std::uint8_t> bytes;
  ByteWriter out(bytes);
  out.count(surfaces.all().size());
  for (const Surface& surface : surfaces.all()) {
    out.count(surface.vertices.size());
    out.count(surface.triangles.size());
    pack_vertices(surface, out);
    pack_triangles(surface, out);
  }
  return bytes;
}

}  // namespace isostep::tool::page
