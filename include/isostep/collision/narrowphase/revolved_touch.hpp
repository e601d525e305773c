// The contact points of a solid of revolution: its rim or the lowest line of its side over a face, a face on its disc.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/collision/narrowphase/face_clip.hpp"
#include "isostep/collision/narrowphase/revolved_axes.hpp"
#include "isostep/geometry/baked/convex_hull.hpp"

namespace isostep::detail {

/// A polygon cut by a face, or by a rim of sixteen corners.
inline constexpr int kRimPolygon = 160;
template <class S> using RimPolygon = ClipPolygon<S, kRimPolygon>;

/// The sides of a face, in the frame of the solid over it.
template <class S> struct FaceSides {
  static constexpr int kMost = ConvexHull::kMaxEdges;
  struct Side {
    Vec3<Unit<S>> outward;  // [1] in the face
    S offset;               // [m] of it along that
    std::uint32_t name;     // kSideName or more, below 256
    bool is_flat;           // what is beyond goes on in the plane
  };
  Side sides[kMost];
  int count = 0;

  ISO_INLINE S beyond(int k, Vec3<S> p) const { return dot(sides[k].outward, p) - sides[k].offset; }
  ISO_INLINE bool has_flat(std::uint32_t name) const {
    for (int k = 0; k < count; ++k) {
      if (sides[k].name == name) return sides[k].is_flat;
    }
    return false;
  }
};
inline constexpr std::uint32_t kSideName = 128;

/// A face of the other, or a half-space's plane.
template <class S> struct FaceOfOther {
  Vec3<Unit<S>> normal;  // [1] outward
  S offset;              // [m] along it
  FaceSides<S> sides;
  std::uint32_t own;  // ors the names of the solid's own points
  std::uint32_t cut;  // ors those that a side has cut: name << 8 of the edge before, the edge after

  ISO_INLINE S height(Vec3<S> p) const { return dot(normal, p) - offset; }
};

/// Names of the solid's own points: 0 .. 31 those of the rims; the ends of the side's lowest line, which are no points
/// of it but of where it looks; those a quarter turn from there.
inline constexpr std::uint32_t kLowestEnd = 32, kQuarterTurn = 34;

/// Within this sine of the axis [1] a disc lies on a face with points that turn with it; the lowest of sixteen is then
/// higher than the lowest of all by 0.0006 radii at most.
inline constexpr double kFlatDisc = 0.03125;
inline constexpr double kLeaningDisc = 0.5;  // sine up to which the points beside the lowest are looked at

template <class S> class RevolvedTouch {
  using U = Unit<S>;

 public:
  ISO_INLINE RevolvedTouch(const Revolved<S>& solid, const Transform<S>& frame, S margin, S tie, Manifold<S>& out)
      : solid_(solid), frame_(frame), margin_(margin), tie_(tie), out_(out) {}

  /// The normal is the face's, reversed. False: nothing is over it.
  ISO_INLINE bool over_face(const FaceOfOther<S>& face) const {
    const Vec3<U> n = -face.normal;
    const Reach<S> reach = solid_.reach(n);
    const int lower = n.y > U(0) ? 1 : 0;
    if (reach.across <= U(kFlatDisc) && solid_.radii[lower] > S(0)) disc_over_face(face, lower);
    else line_over_face(face, reach);
    if (out_.count > 0) out_.normal = frame_.rotation * n;
    return out_.count > 0;
  }
  /// The corners [m] of the other's face over a disc; corner(i), and edge(i) names what leads from it to the next.
  template <class Corner, class Edge>
  ISO_INLINE void under_disc(int end, int count, const Corner& corner, const Edge& edge, std::uint32_t name) const {
    RimPolygon<S> polygons[2];
    polygons[0].count = count;
    for (int i = 0; i < count; ++i) {
      const Vec3<S> p = corner(i);
      const S height = (end == 0 ? -p.y : p.y) - solid_.half;
      polygons[0].points[i] = {p.x, p.z, height, edge(i == 0 ? count - 1 : i - 1), edge(i)};
    }
    unsigned now = 0;
    for (int k = 0; k < 16; ++k) now ^= clip_to_rim(end, k, polygons[now], polygons[now ^ 1u]) ? 1u : 0u;
    RimPolygon<S>& polygon = polygons[now];
    keep_near(polygon, [](const ClipPoint<S>&) ISO_INLINE_LAMBDA { return true; });
    const Vec3<U> n = unit_axis<U>(1, end == 0);
    if (polygon.count > 0) out_.normal = frame_.rotation * n;
    for (int i = 0; i < polygon.count; ++i) {
      const ClipPoint<S>& p = polygon.points[i];
      const S level = solid_.half + p.height * S(0.5);
      add(Vec3<S>{p.u, end == 0 ? -level : level, p.v}, p.height, name | p.before << 8 | p.after);
    }
  }
  /// One point, [m] midway.
  ISO_INLINE void at(Vec3<S> p, S separation, Vec3<U> n, std::uint32_t name) const {
    out_.normal = frame_.rotation * n;
    add(p, separation, name);
  }
  /// Both ends of what the lowest line of the side and an edge have beside each other, if they are nearly parallel.
  /// `from` + `along` * 0 .. length is the edge.
  ISO_INLINE bool beside(Vec3<S> from, Vec3<U> along, S length, Vec3<U> n, std::uint32_t name) const {
    const Segment<S> side = side_line(solid_, solid_.reach(n).radial);
    const Vec3<U> across = cross(along, side.direction);
    if (dot(across, across) > U(kAlongSide * kAlongSide)) return false;
    const Vec3<S> foot = side.at(-side.half);
    const U lean = dot(along, side.direction);
    const S start = dot(from - foot, side.direction), end = start + length * lean;
    const S low = max(min(start, end), S(0)), high = min(max(start, end), solid_.slant + solid_.slant);
    if (!(low < high)) return false;
    const S level = dot(n, foot);
    for (std::uint32_t k = 0; k < 2; ++k) {
      const S t = k == 0 ? low : high;
      const Vec3<S> on_edge = from + along * divide_to<S>(t - start, lean);
      const S separation = dot(n, on_edge) - level;
      if (separation <= margin_) at(on_edge - n * (separation * S(0.5)), separation, n, name | k);
    }
    return out_.count > 0;
  }

 private:
  static constexpr double kAlongSide = 0.0625;  // sine within which an edge lies along the side

  ISO_INLINE void add(Vec3<S> p, S separation, std::uint32_t name) const {
    out_.add(to_world(frame_, p), separation, name);
  }
  ISO_INLINE void add_over(const FaceOfOther<S>& face, Vec3<S> p, S height, std::uint32_t name) const {
    if (height <= margin_) add(p - face.normal * (height * S(0.5)), height, name);
  }
  template <class Keep> ISO_INLINE void keep_near(RimPolygon<S>& polygon, const Keep& keep) const {
    int kept = 0;
    for (int i = 0; i < polygon.count; ++i) {
      if (polygon.points[i].height <= margin_ && keep(polygon.points[i])) polygon.points[kept++] = polygon.points[i];
    }
    polygon.count = kept;
    if (kept > kMaxContactPoints) reduce_to_four(polygon, tie_);
  }

  static constexpr auto kCut = [](const auto& p, const auto& q, auto t, auto& at) ISO_INLINE_LAMBDA {
    at.u = p.u + (q.u - p.u) * t;
    at.v = p.v + (q.v - p.v) * t;
  };

  ISO_INLINE void disc_over_face(const FaceOfOther<S>& face, int end) const {
    RimPolygon<S> polygons[2];
    polygons[0].count = 16;
    for (std::uint32_t k = 0; k < 16; ++k) {
      const Vec3<S> p = solid_.rim_point(end, static_cast<int>(k));
      polygons[0].points[k] = {p.x, p.z, face.height(p), (k + 15) & 15u, k};
    }
    const RimPolygon<S> rim_points = polygons[0];
    unsigned now = 0;
    bool cut = false, ends = false;  // the face, under the disc
    for (int k = 0; k < face.sides.count; ++k) {
      const bool cuts = clip_to_side(face.sides, k, end, polygons[now], polygons[now ^ 1u]);
      now ^= cuts ? 1u : 0u;
      cut = cut || cuts;
      ends = ends || (cuts && !face.sides.sides[k].is_flat);
    }
    RimPolygon<S>& polygon = polygons[now];
    const std::uint32_t rim_mask = ends || !cut ? 0xffffu : four_of(rim_points);
    keep_near(polygon, [&](const ClipPoint<S>& p) ISO_INLINE_LAMBDA {
      const bool own = p.before < kSideName && p.after < kSideName;
      return own ? (rim_mask >> p.after & 1u) != 0 : !is_cut_flat(face.sides, p);
    });
    const std::uint32_t rim = end == 0 ? 0 : 16;
    for (int i = 0; i < polygon.count; ++i) {
      const ClipPoint<S>& p = polygon.points[i];
      const bool own = p.before < kSideName && p.after < kSideName;
      add_over(face, {p.u, end == 0 ? -solid_.half : solid_.half, p.v}, p.height,
               own ? face.own | rim | p.after : face.cut | p.before << 8 | p.after);
    }
  }
  /// Bits of the points that would be kept if the face went on in its plane: neighbours choose the same ones.
  ISO_INLINE std::uint32_t four_of(RimPolygon<S> polygon) const {
    keep_near(polygon, [](const ClipPoint<S>&) ISO_INLINE_LAMBDA { return true; });
    std::uint32_t mask = 0;
    for (int i = 0; i < polygon.count; ++i) mask |= 1u << polygon.points[i].after;
    return mask;
  }
  ISO_INLINE bool clip_to_side(const FaceSides<S>& sides, int k, int end, const RimPolygon<S>& from,
                               RimPolygon<S>& to) const {
    S beyond[kRimPolygon];
    for (int i = 0; i < from.count; ++i)
      beyond[i] = sides.beyond(k, {from.points[i].u, end == 0 ? -solid_.half : solid_.half, from.points[i].v});
    return clip(from, beyond, sides.sides[k].name, kCut, to);
  }
  static ISO_INLINE bool is_cut_flat(const FaceSides<S>& sides, const ClipPoint<S>& p) {
    const bool before = p.before >= kSideName, after = p.after >= kSideName;
    return (before || after) && (!before || sides.has_flat(p.before)) && (!after || sides.has_flat(p.after));
  }
  /// Side k of the polygon of sixteen around a rim: nothing that is under the disc is beyond it.
  ISO_INLINE bool clip_to_rim(int end, int k, const RimPolygon<S>& from, RimPolygon<S>& to) const {
    constexpr U kQuarter[4] = {U(0.9807852804032304), U(0.8314696123025452), U(0.5555702330196022),
                               U(0.1950903220161283)};
    const auto cosine = [&](int i) ISO_INLINE_LAMBDA {  // of (2 i + 1) pi / 16
      i &= 15;
      if (i > 7) i = 15 - i;
      return i < 4 ? kQuarter[i] : -kQuarter[7 - i];
    };
    const U x = cosine(k), z = cosine(k - 4);
    const S offset = solid_.radii[end];
    S beyond[kRimPolygon];
    for (int i = 0; i < from.count; ++i)
      beyond[i] = round_to<S>(product(from.points[i].u, x) + product(from.points[i].v, z)) - offset;
    return clip(from, beyond, kSideName + static_cast<std::uint32_t>(k), kCut, to);
  }

  /// The side's lowest line as far as it is over the face, and of a disc that leans the points beside its lowest one;
  /// of one whose lowest point is not over the face, what else of it is.
  ISO_INLINE void line_over_face(const FaceOfOther<S>& face, const Reach<S>& reach) const {
    Vec3<S> ends[2] = {solid_.rim(0, reach.radial), solid_.rim(1, reach.radial)};
    std::uint32_t names[2] = {0, 0};
    const int lower = reach.end();
    const bool leans = reach.across <= U(kLeaningDisc) && solid_.radii[lower] > S(0);
    const bool is_over_face = clip_line(face.sides, ends, names);
    if (leans && (!is_over_face || names[lower] != 0)) return disc_over_face(face, lower);
    if (!is_over_face) return;
    for (std::uint32_t k = 0; k < 2; ++k) {
      if (names[k] != 0 && face.sides.has_flat(names[k])) continue;
      add_over(face, ends[k], face.height(ends[k]),
               names[k] == 0 ? face.own | kLowestEnd | k : face.cut | names[k] << 8 | k);
    }
    if (!leans) return;
    const Vec3<U> aside = {-reach.radial.z, U(0), reach.radial.x};
    for (std::uint32_t k = 0; k < 2; ++k) {
      const Vec3<S> p = solid_.rim(lower, k == 0 ? aside : -aside);
      if (is_over(face.sides, p)) add_over(face, p, face.height(p), face.own | kQuarterTurn | k);
    }
  }
  static ISO_INLINE bool is_over(const FaceSides<S>& sides, Vec3<S> p) {
    for (int k = 0; k < sides.count; ++k) {
      if (sides.beyond(k, p) > S(0)) return false;
    }
    return true;
  }
  static ISO_INLINE bool clip_line(const FaceSides<S>& sides, Vec3<S> (&ends)[2], std::uint32_t (&names)[2]) {
    for (int k = 0; k < sides.count; ++k) {
      const S beyond[2] = {sides.beyond(k, ends[0]), sides.beyond(k, ends[1])};
      if (beyond[0] > S(0) && beyond[1] > S(0)) return false;
      for (int e = 0; e < 2; ++e) {
        if (!(beyond[e] > S(0))) continue;
        ends[e] = ends[e] + (ends[1 - e] - ends[e]) * divide_to<U>(beyond[e], beyond[e] - beyond[1 - e]);
        names[e] = sides.sides[k].name;
      }
    }
    return true;
  }

  const Revolved<S>& solid_;
  const Transform<S>& frame_;
  const S margin_, tie_;
  Manifold<S>& out_;
};

}  // namespace isostep::detail
