// Bodies of quickhull.hpp.
// SPDX-License-Identifier: MIT
#include "quickhull.hpp"

namespace isostep {

std::vector<HullTriangle> Quickhull::run() {
  if (!begin()) return {};
  // Facets are appended while this runs, and those that are gone have no points above them.
  for (std::uint32_t f = 0; f < facets_.size(); ++f) {
    if (facets_[f].first_above != kNone) take(f);
  }
  return result();
}

std::vector<HullTriangle> Quickhull::run(std::uint32_t vertices) {
  if (!begin()) return {};
  for (std::uint32_t taken = 4; taken < vertices; ++taken) {
    const std::uint32_t facet = facet_with_furthest();
    if (facet == kNone) break;
    take(facet);
  }
  return result();
}

/// The distances are squared in doubles: their few operations are rounded alike on every machine.
std::uint32_t Quickhull::facet_with_furthest() const {
  std::uint32_t best = kNone;
  double most = 0;
  for (std::uint32_t f = 0; f < facets_.size(); ++f) {
    const Facet& facet = facets_[f];
    if (facet.first_above == kNone) continue;
    const double x = static_cast<double>(facet.normal.x), y = static_cast<double>(facet.normal.y),
                 z = static_cast<double>(facet.normal.z),
                 above = static_cast<double>(height(facet, furthest_above(facet)));
    const double distance = above * above / (x * x + y * y + z * z);
    if (distance <= most) continue;
    most = distance;
    best = f;
  }
  return best;
}

void Quickhull::take(std::uint32_t facet) {
  const std::uint32_t apex = furthest_above(facets_[facet]);
  find_horizon(apex, facet);
  cover(apex);
}

std::vector<HullTriangle> Quickhull::result() const {
  std::vector<std::uint32_t> place(facets_.size(), kNone);
  std::vector<HullTriangle> hull;
  for (std::uint32_t f = 0; f < facets_.size(); ++f) {
    if (facets_[f].gone) continue;
    place[f] = static_cast<std::uint32_t>(hull.size());
    hull.push_back(facets_[f].triangle);
  }
  for (HullTriangle& triangle : hull) {
    for (std::uint32_t& neighbour : triangle.neighbours) neighbour = place[neighbour];
  }
  return hull;
}

/// Makes a tetrahedron of the first point, the last one, the furthest from their line and the furthest from that plane.
bool Quickhull::begin() {
  if (points_.size() < 4) return false;
  const std::uint32_t a = 0, b = static_cast<std::uint32_t>(points_.size() - 1), c = furthest_from_line(a, b);
  if (c == kNone) return false;
  std::uint32_t d = furthest_from_plane(a, b, c);
  if (d == kNone) return false;
  next_above_.assign(points_.size(), kNone);
  starting_at_.assign(points_.size(), kNone);
  const GridVector normal = cross(points_[b] - points_[a], points_[c] - points_[a]);
  const bool below = dot(normal, points_[d] - points_[a]) < 0;
  const std::uint32_t base[3] = {a, below ? b : c, below ? c : b};
  add_facet(base[0], base[1], base[2]);
  for (int i = 0; i < 3; ++i) add_facet(base[(i + 1) % 3], base[i], d);
  for (std::uint32_t i = 0; i < 3; ++i) {
    facets_[0].triangle.neighbours[i] = 1 + i;
    facets_[1 + i].triangle.neighbours[0] = 0;
    facets_[1 + i].triangle.neighbours[1] = 1 + (i + 2) % 3;  // across the edge from base[i] to d
    facets_[1 + i].triangle.neighbours[2] = 1 + (i + 1) % 3;
  }
  for (std::uint32_t p = 0; p < points_.size(); ++p) {
    if (p != a && p != b && p != c && p != d) give(p, 0);
  }
  return true;
}

std::uint32_t Quickhull::furthest_from_line(std::uint32_t a, std::uint32_t b) const {
  std::uint32_t furthest = kNone;
  Int128 most = 0;
  for (std::uint32_t p = 0; p < points_.size(); ++p) {
    const Int128 distance = squared_length(cross(points_[b] - points_[a], points_[p] - points_[a]));
    if (!(distance > most)) continue;
    most = distance;
    furthest = p;
  }
  return furthest;
}

std::uint32_t Quickhull::furthest_from_plane(std::uint32_t a, std::uint32_t b, std::uint32_t c) const {
  const GridVector normal = cross(points_[b] - points_[a], points_[c] - points_[a]);
  std::uint32_t furthest = kNone;
  std::int64_t most = 0;
  for (std::uint32_t p = 0; p < points_.size(); ++p) {
    const std::int64_t signed_distance = dot(normal, points_[p] - points_[a]);
    const std::int64_t distance = signed_distance < 0 ? -signed_distance : signed_distance;
    if (distance <= most) continue;
    most = distance;
    furthest = p;
  }
  return furthest;
}

std::uint32_t Quickhull::add_facet(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
  const GridVector normal = cross(points_[b] - points_[a], points_[c] - points_[a]);
  facets_.push_back({{{a, b, c}, {kNone, kNone, kNone}}, normal, kNone, false, false});
  return static_cast<std::uint32_t>(facets_.size() - 1);
}

/// The height of a point over a facet, not normalised; positive strictly outside.
std::int64_t Quickhull::height(const Facet& facet, std::uint32_t point) const {
  return dot(facet.normal, points_[point] - points_[facet.triangle.vertices[0]]);
}

/// Gives the point to the first facet from that one on that has it above; a point above none of them is inside the
/// hull.
void Quickhull::give(std::uint32_t point, std::uint32_t first_facet) {
  for (std::uint32_t f = first_facet; f < facets_.size(); ++f) {
    if (height(facets_[f], point) <= 0) continue;
    next_above_[point] = facets_[f].first_above;
    facets_[f].first_above = point;
    return;
  }
}

std::uint32_t Quickhull::furthest_above(const Facet& facet) const {
  std::uint32_t furthest = facet.first_above;
  std::int64_t most = 0;
  for (std::uint32_t p = facet.first_above; p != kNone; p = next_above_[p]) {
    const std::int64_t distance = height(facet, p);
    if (distance < most || (distance == most && p > furthest)) continue;
    most = distance;
    furthest = p;
  }
  return furthest;
}

/// Finds the rim of the facets that a point sees, which are a disc.
void Quickhull::find_horizon(std::uint32_t seen_from, std::uint32_t facet) {
  horizon_.clear();
  visible_.assign(1, facet);
  facets_[facet].visible = true;
  for (std::size_t i = 0; i < visible_.size(); ++i) {
    const HullTriangle triangle = facets_[visible_[i]].triangle;
    for (int edge = 0; edge < 3; ++edge) {
      Facet& neighbour = facets_[triangle.neighbours[edge]];
      if (neighbour.visible) continue;
      if (height(neighbour, seen_from) > 0) {
        neighbour.visible = true;
        visible_.push_back(triangle.neighbours[edge]);
      } else {
        horizon_.push_back({triangle.vertices[edge], triangle.vertices[(edge + 1) % 3], triangle.neighbours[edge]});
      }
    }
  }
}

/// Replaces the facets that the apex sees by triangles from each edge of the horizon to it.
void Quickhull::cover(std::uint32_t apex) {
  const auto first = static_cast<std::uint32_t>(facets_.size());
  for (const HorizonEdge& edge : horizon_) {
    const std::uint32_t fresh = add_facet(edge.from, edge.to, apex);
    facets_[fresh].triangle.neighbours[0] = edge.facet;
    HullTriangle& below = facets_[edge.facet].triangle;
    for (int i = 0; i < 3; ++i) {
      if (below.vertices[i] == edge.to && below.vertices[(i + 1) % 3] == edge.from) below.neighbours[i] = fresh;
    }
    starting_at_[edge.from] = fresh;
  }
  for (std::uint32_t f = first; f < facets_.size(); ++f) {
    const std::uint32_t after = starting_at_[facets_[f].triangle.vertices[1]];
    facets_[f].triangle.neighbours[1] = after;
    facets_[after].triangle.neighbours[2] = f;
  }
  for (const std::uint32_t f : visible_) {
    facets_[f].gone = true;
    std::uint32_t p = facets_[f].first_above;
    facets_[f].first_above = kNone;
    while (p != kNone) {
      const std::uint32_t next = next_above_[p];
      if (p != apex) give(p, first);
      p = next;
    }
  }
}

}  // namespace isostep
