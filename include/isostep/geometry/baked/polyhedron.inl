// Bodies of polyhedron.hpp.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/geometry/baked/polyhedron.hpp"
#include "isostep/geometry/baked/unit_of_steps.hpp"

namespace isostep {

template <class S>
HullSolid<S>::HullSolid(const ConvexHull& hull, int exponent) : half_edges_(hull.half_edges), starts_(hull.faces) {
  using U = Unit<S>;
  Vec3<S> middle = Vec3<S>::zero();
  const U share = divide_to<U>(S(1), from_lattice<S>(static_cast<std::int64_t>(hull.vertices.size()), 0));
  for (const GridPoint p : hull.vertices) {
    const Vec3<S> v = {from_lattice<S>(p.x, exponent), from_lattice<S>(p.y, exponent), from_lattice<S>(p.z, exponent)};
    vertices_.push_back(v);
    middle += v * share;
  }
  for (std::size_t e = 0; e < half_edges_.size(); e += 2) {
    directions_.push_back(detail::exact_unit_of_steps<U>(hull.vertices[half_edges_[e + 1].origin] -
                                                         hull.vertices[half_edges_[e].origin]));
  }
  inner_radius_ = highest<S>();
  const ColumnsView<S> vertices = vertices_.view();
  for (std::uint32_t f = 0; f < hull.faces.size(); ++f) {
    const Vec3<U> normal = detail::exact_unit_of_steps<U>(hull.normal(static_cast<std::uint8_t>(f)));
    S offset = dot(normal, vertices[half_edges_[hull.faces[f]].origin]);
    for (std::uint8_t e = half_edges_[hull.faces[f]].next; e != hull.faces[f]; e = half_edges_[e].next)
      offset = max(offset, dot(normal, vertices[half_edges_[e].origin]));
    normals_.push_back(normal);
    offsets_.push_back(offset);
    inner_radius_ = min(inner_radius_, offset - dot(normal, middle));
  }
  starts_.resize(hull.faces.size() + hull.vertices.size());
  for (std::size_t e = half_edges_.size(); e-- > 0;)
    starts_[hull.faces.size() + half_edges_[e].origin] = static_cast<std::uint8_t>(e);
}

template <class S> std::size_t HullSolid<S>::memory() const {
  return vertices_.memory() + normals_.memory() + directions_.memory() + half_edges_.size() * sizeof(HalfEdge) +
         starts_.size() * sizeof starts_[0] + offsets_.size() * sizeof(S);
}

}  // namespace isostep
