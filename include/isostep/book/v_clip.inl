// Body of v_clip.hpp.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/book/v_clip.hpp"
#include "isostep/collision/narrowphase/polyhedron_axes.hpp"

namespace isostep {
namespace detail {

/// A plane that bounds a feature's Voronoi region, and the neighbour beyond it.
template <class S> struct VoronoiPlane {
  Vec3<Unit<S>> inward;  // [1]
  Vec3<S> point;         // [m]
  PolyhedronFeature beyond;

  ISO_INLINE S inside(Vec3<S> p) const { return dot(inward, p - point); }
};

template <class S> ISO_INLINE Vec3<Unit<S>> way_along(const Polyhedron<S>& solid, std::uint32_t half_edge) {
  return negate_if((half_edge & 1u) != 0, solid.directions[half_edge / 2]);
}
ISO_INLINE PolyhedronFeature feature_of(PolyhedronFeature::Kind kind, std::uint32_t index) {
  return {kind, static_cast<std::uint8_t>(index)};
}

/// Visits the planes between a vertex and its edges.
template <class S, class Visit>
ISO_INLINE void planes_of_vertex(const Polyhedron<S>& solid, std::uint32_t v, const Visit& visit) {
  for (std::uint32_t e = 0; e < solid.half_edges.size(); ++e) {
    if (solid.origin(e) != v) continue;
    visit(VoronoiPlane<S>{-way_along(solid, e), solid.vertices[v], feature_of(PolyhedronFeature::edge, e / 2)});
  }
}
/// Visits the planes between an edge and its ends.
template <class S, class Visit>
ISO_INLINE void end_planes(const Polyhedron<S>& solid, std::uint32_t k, const Visit& visit) {
  for (std::uint32_t e = 2 * k; e < 2 * k + 2; ++e) {
    const std::uint32_t v = solid.origin(e);
    visit(VoronoiPlane<S>{way_along(solid, e), solid.vertices[v], feature_of(PolyhedronFeature::vertex, v)});
  }
}
/// Visits the planes between an edge and its faces.
template <class S, class Visit>
ISO_INLINE void side_planes(const Polyhedron<S>& solid, std::uint32_t k, const Visit& visit) {
  for (std::uint32_t e = 2 * k; e < 2 * k + 2; ++e) {
    const std::uint32_t f = solid.half_edges[e].face;
    visit(VoronoiPlane<S>{cross(way_along(solid, e), solid.normals[f]), solid.vertices[solid.origin(e)],
                          feature_of(PolyhedronFeature::face, f)});
  }
}
/// Visits the planes between a face and its edges.
template <class S, class Visit>
ISO_INLINE void planes_of_face(const Polyhedron<S>& solid, std::uint32_t f, const Visit& visit) {
  std::uint32_t e = solid.faces[f];
  do {
    visit(VoronoiPlane<S>{cross(solid.normals[f], way_along(solid, e)), solid.vertices[solid.origin(e)],
                          feature_of(PolyhedronFeature::edge, e / 2)});
    e = solid.half_edges[e].next;
  } while (e != solid.faces[f]);
}

/// The plane that a point is furthest beyond.
template <class S> struct FurthestBeyond {
  Vec3<S> p;
  S beyond;  // [m] what counts, and then what was found
  bool found = false;
  PolyhedronFeature feature = {};

  ISO_INLINE void operator()(const VoronoiPlane<S>& plane) {
    const S by = -plane.inside(p);
    if (!(by > beyond)) return;
    beyond = by;
    found = true;
    feature = plane.beyond;
  }
};

/// An edge of one solid, in the other's frame, clipped to the region of one of its features.
template <class S> struct EdgeClip {
  using U = Unit<S>;
  Vec3<S> tail, head;  // [m]
  S slack;             // [m] what is not beyond
  U in = U(0), out = U(1);
  bool has_in = false, has_out = false, outside = false, all_beyond = false;
  PolyhedronFeature at_in = {}, at_out = {};

  ISO_INLINE Vec3<S> at(U t) const { return tail + (head - tail) * t; }
  ISO_INLINE void operator()(const VoronoiPlane<S>& plane) {
    if (outside) return;
    const S of_tail = plane.inside(tail) + slack, of_head = plane.inside(head) + slack;
    if (of_tail < S(0) && of_head < S(0)) {
      outside = all_beyond = true;
      at_in = at_out = plane.beyond;
    } else if (of_tail < S(0)) {
      const U t = divide_to<U>(of_tail, of_tail - of_head);
      if (t > in || !has_in) in = max(in, t), at_in = plane.beyond, has_in = true;
    } else if (of_head < S(0)) {
      const U t = divide_to<U>(of_tail, of_tail - of_head);
      if (t < out || !has_out) out = min(out, t), at_out = plane.beyond, has_out = true;
    }
    outside = outside || in > out;
  }
};

template <class S> class VClip {
  using U = Unit<S>;
  using Feature = PolyhedronFeature;
  static constexpr std::int32_t kMostRounds = 64;
  enum class Walk : std::uint8_t { on, ended, overlap };

 public:
  ISO_INLINE VClip(const Polyhedron<S>& a, const Polyhedron<S>& b, const Transform<S>& b_in_a, FeaturePair from)
      : solids_{&a, &b}, features_{known(a, from.a), known(b, from.b)} {
    other_in_[0] = b_in_a;
    other_in_[1] = {transposed_times(b_in_a.rotation, -b_in_a.position), transpose(b_in_a.rotation)};
    S extent = max_abs(b_in_a.position);
    for (const Vec3<S> v : a.vertices) extent = max(extent, max_abs(v));
    for (const Vec3<S> v : b.vertices) extent = max(extent, max_abs(v));
    slack_ = extent * resolution<U>() * S(4) + resolution<S>() * S(4);
  }

  ISO_INLINE VClipDistance<S> run() {
    VClipDistance<S> result = {VClipStatus::unfinished, S(0), Vec3<U>::zero(), Vec3<S>::zero(), Vec3<S>::zero(), {}, 1};
    for (; result.rounds < kMostRounds; ++result.rounds) {
      const Walk walk = step();
      if (walk == Walk::on) continue;
      result.status = walk == Walk::overlap ? VClipStatus::overlap : VClipStatus::apart;
      break;
    }
    result.features = {features_[0], features_[1]};
    closest(result);
    return result;
  }

 private:
  static ISO_INLINE Feature known(const Polyhedron<S>& solid, Feature f) {
    const std::uint32_t count = f.kind == Feature::vertex ? solid.vertices.size()
                                : f.kind == Feature::edge ? solid.directions.size()
                                                          : solid.faces.size();
    return f.index < count ? f : Feature{Feature::vertex, 0};
  }
  ISO_INLINE bool is(int i, Feature::Kind kind) const { return features_[i].kind == kind; }
  ISO_INLINE std::uint32_t index(int i) const { return features_[i].index; }
  ISO_INLINE const Polyhedron<S>& solid(int i) const { return *solids_[i]; }
  ISO_INLINE Walk go(int i, Feature to) {
    features_[i] = to;
    return Walk::on;
  }
  /// Returns vertex v of solid i in the other's frame.
  ISO_INLINE Vec3<S> across(int i, std::uint32_t v) const { return to_world(other_in_[1 - i], solid(i).vertices[v]); }
  ISO_INLINE EdgeClip<S> edge_across(int i) const {
    return {across(i, solid(i).origin(2 * index(i))), across(i, solid(i).origin(2 * index(i) + 1)), slack_};
  }
  ISO_INLINE Vec3<U> direction_across(int i) const { return other_in_[1 - i].rotation * solid(i).directions[index(i)]; }

  ISO_INLINE Walk step() {
    const int low = features_[0].kind <= features_[1].kind ? 0 : 1, high = 1 - low;
    if (is(high, Feature::vertex)) return vertices();
    if (is(high, Feature::edge)) return is(low, Feature::vertex) ? vertex_edge(low, high) : edges();
    if (is(low, Feature::vertex)) return vertex_face(low, high);
    if (is(low, Feature::edge)) return edge_face(low, high);
    return go(low, feature_of(Feature::vertex, solid(low).origin(solid(low).faces[index(low)])));
  }

  ISO_INLINE Walk vertices() {
    for (int i = 0; i < 2; ++i) {
      FurthestBeyond<S> furthest = {across(1 - i, index(1 - i)), slack_};
      planes_of_vertex(solid(i), index(i), [&](const auto& plane) ISO_INLINE_LAMBDA { furthest(plane); });
      if (furthest.found) return go(i, furthest.feature);
    }
    return Walk::ended;
  }

  ISO_INLINE Walk vertex_edge(int i, int j) {
    FurthestBeyond<S> furthest = {across(i, index(i)), slack_};
    const auto beyond = [&](const auto& plane) ISO_INLINE_LAMBDA { furthest(plane); };
    end_planes(solid(j), index(j), beyond);
    side_planes(solid(j), index(j), beyond);
    if (furthest.found) return go(j, furthest.feature);
    EdgeClip<S> cut = edge_across(j);
    planes_of_vertex(solid(i), index(i), [&](const auto& plane) ISO_INLINE_LAMBDA { cut(plane); });
    const Vec3<S> v = solid(i).vertices[index(i)];
    return leave(i, cut, dot(direction_across(j), cut.at(cut.in) - v) > slack_,
                 dot(direction_across(j), cut.at(cut.out) - v) < -slack_);
  }

  /// Goes to the neighbour where the clipped edge comes in, if it is nearer there, or to the one where it goes out.
  ISO_INLINE Walk leave(int i, const EdgeClip<S>& cut, bool rises_at_in, bool falls_at_out) {
    if (cut.all_beyond) return go(i, cut.at_in);
    if (cut.has_in && rises_at_in) return go(i, cut.at_in);
    if (cut.has_out && falls_at_out) return go(i, cut.at_out);
    return Walk::ended;
  }

  ISO_INLINE Walk edges() {
    for (int i = 0; i < 2; ++i) {
      const Vec3<U> d = direction_across(1 - i);
      EdgeClip<S> cut = edge_across(1 - i);
      end_planes(solid(i), index(i), [&](const auto& plane) ISO_INLINE_LAMBDA { cut(plane); });
      const auto rise = [&](Feature vertex, U t)
                            ISO_INLINE_LAMBDA { return dot(d, cut.at(t) - solid(i).vertices[vertex.index]); };
      if (leave(i, cut, rise(cut.at_in, cut.in) > slack_, rise(cut.at_out, cut.out) < -slack_) == Walk::on)
        return Walk::on;
      cut = edge_across(1 - i);
      side_planes(solid(i), index(i), [&](const auto& plane) ISO_INLINE_LAMBDA { cut(plane); });
      const auto climb = [&](Feature face, U t) ISO_INLINE_LAMBDA { return climb_over(i, face.index, d, cut.at(t)); };
      if (leave(i, cut, climb(cut.at_in, cut.in) > flat(), climb(cut.at_out, cut.out) < -flat()) == Walk::on)
        return Walk::on;
    }
    return Walk::ended;
  }
  static ISO_INLINE constexpr U flat() { return resolution<U>() * U(1) + resolution<U>() + resolution<U>(); }
  ISO_INLINE S height(int i, std::uint32_t face, Vec3<S> p) const {
    return dot(solid(i).normals[face], p) - solid(i).offsets[face];
  }
  /// [1] Returns the rate at which a point that moves along d from p leaves the plane of a face of i.
  ISO_INLINE U climb_over(int i, std::uint32_t face, Vec3<U> d, Vec3<S> p) const {
    return negate_if(height(i, face, p) < S(0), dot(solid(i).normals[face], d));
  }

  ISO_INLINE Walk vertex_face(int i, int j) {
    const Vec3<S> p = across(i, index(i));
    FurthestBeyond<S> furthest = {p, slack_};
    planes_of_face(solid(j), index(j), [&](const auto& plane) ISO_INLINE_LAMBDA { furthest(plane); });
    if (furthest.found) return go(j, furthest.feature);
    const Vec3<U> up = transposed_times(other_in_[1 - i].rotation, solid(j).normals[index(j)]);
    const bool below = height(j, index(j), p) < S(0);
    for (std::uint32_t e = 0; e < solid(i).half_edges.size(); ++e) {
      if (solid(i).origin(e) != index(i)) continue;
      if (negate_if(below, dot(up, way_along(solid(i), e))) < -flat()) return go(i, feature_of(Feature::edge, e / 2));
    }
    return below ? climb_out(p, j) : Walk::ended;
  }
  /// Goes from a face of j, behind which p is, to the face that p is furthest above. If p is above none, the solids
  /// overlap.
  ISO_INLINE Walk climb_out(Vec3<S> p, int j) {
    std::uint32_t best = 0;
    for (std::uint32_t f = 1; f < solid(j).faces.size(); ++f) {
      if (height(j, f, p) > height(j, best, p)) best = f;
    }
    if (!(height(j, best, p) > S(0)) || best == index(j)) return Walk::overlap;
    return go(j, feature_of(Feature::face, best));
  }

  ISO_INLINE Walk edge_face(int i, int j) {
    EdgeClip<S> cut = edge_across(i);
    planes_of_face(solid(j), index(j), [&](const auto& plane) ISO_INLINE_LAMBDA { cut(plane); });
    if (cut.outside) return go(j, feature_of(Feature::edge, nearest_side(i, j)));
    const S at_in = height(j, index(j), cut.at(cut.in)), at_out = height(j, index(j), cut.at(cut.out));
    if ((at_in < S(0)) != (at_out < S(0))) return Walk::overlap;
    if (climb_over(j, index(j), direction_across(i), cut.at(cut.in)) >= U(0))
      return cut.has_in ? go(j, cut.at_in) : go(i, feature_of(Feature::vertex, solid(i).origin(2 * index(i))));
    return cut.has_out ? go(j, cut.at_out) : go(i, feature_of(Feature::vertex, solid(i).origin(2 * index(i) + 1)));
  }
  /// Returns the edge around j's face that is nearest to i's edge.
  ISO_INLINE std::uint32_t nearest_side(int i, int j) const {
    const Segment<S> edge = segment_across(i);
    std::uint32_t e = solid(j).faces[index(j)], nearest = e / 2;
    S least = highest<S>();
    do {
      const Segment<S> side = edge_of(solid(j), e / 2);
      const ClosestPair<S> pair = closest_points(edge, side);
      const S apart = distance(edge.at(pair.s), side.at(pair.t));
      if (apart < least) least = apart, nearest = e / 2;
      e = solid(j).half_edges[e].next;
    } while (e != solid(j).faces[index(j)]);
    return nearest;
  }
  ISO_INLINE Segment<S> segment_across(int i) const {
    const Segment<S> own = edge_of(solid(i), index(i));
    return {to_world(other_in_[1 - i], own.centre), direction_across(i), own.half};
  }

  /// Finds the closest points of the two features, in a's frame.
  ISO_INLINE void closest(VClipDistance<S>& result) const {
    const int low = features_[0].kind <= features_[1].kind ? 0 : 1, high = 1 - low;
    Vec3<S> of_low, of_high;  // in the frame of `high`
    if (is(low, Feature::vertex)) {
      of_low = across(low, index(low));
      of_high = nearest_of(high, of_low);
    } else {
      const Segment<S> edge = segment_across(low);
      const std::uint32_t k = is(high, Feature::edge) ? index(high) : nearest_side(low, high);
      const Segment<S> other = edge_of(solid(high), k);
      const ClosestPair<S> pair = closest_points(edge, other);
      of_low = edge.at(pair.s), of_high = other.at(pair.t);
    }
    if (high == 1) of_low = to_world(other_in_[0], of_low), of_high = to_world(other_in_[0], of_high);
    result.on_a = low == 0 ? of_low : of_high;
    result.on_b = low == 0 ? of_high : of_low;
    if (result.status == VClipStatus::overlap) return;
    const Heading<S> gap = heading_of(result.on_b - result.on_a);
    result.distance = gap.length;
    result.normal = gap.direction;
  }
  ISO_INLINE Vec3<S> nearest_of(int i, Vec3<S> p) const {
    if (is(i, Feature::vertex)) return solid(i).vertices[index(i)];
    if (is(i, Feature::face)) return p - solid(i).normals[index(i)] * height(i, index(i), p);
    const Segment<S> edge = edge_of(solid(i), index(i));
    return edge.at(edge.nearest(p));
  }

  const Polyhedron<S>* solids_[2];
  Transform<S> other_in_[2];  // the other solid in the frame of this
  Feature features_[2];
  S slack_;  // [m]
};

}  // namespace detail

template <class S>
VClipDistance<S> v_clip_distance(const Polyhedron<S>& a, const Transform<S>& ta, const Polyhedron<S>& b,
                                 const Transform<S>& tb, FeaturePair from) {
  VClipDistance<S> result = detail::VClip<S>(a, b, relative(ta, tb), from).run();
  result.normal = ta.rotation * result.normal;
  result.on_a = to_world(ta, result.on_a);
  result.on_b = to_world(ta, result.on_b);
  return result;
}

}  // namespace isostep
