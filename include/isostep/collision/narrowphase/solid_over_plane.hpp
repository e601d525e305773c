// SolidOverPlane<S>: what of a solid lies over a flat face, a triangle or a half-space, clipped to it.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/collision/narrowphase/face_clip.hpp"
#include "isostep/collision/narrowphase/solid_view.hpp"

namespace isostep::detail {

/// The face that a solid lies on, in the frame of that solid: a plane and the face's sides.
template <class S> struct RestPlane {
  struct Side {
    Vec3<Unit<S>> outward;  // [1] in the plane
    S offset;               // [m] of it along that
    bool goes_on;           // what is beyond is in the plane, too
  };

  Vec3<Unit<S>> normal;  // [1] outward
  S offset;              // [m] along it
  std::uint32_t own;     // ors the names of the solid's own points
  std::uint32_t cut;     // ors those that a side has cut: name << 8 of the edge before, the edge after
  int count = 0;
  Side sides[SolidFace<S>::kMost];

  ISO_INLINE S height(Vec3<S> p) const { return dot(normal, p) - offset; }
  ISO_INLINE S beyond(int k, Vec3<S> p) const { return dot(sides[k].outward, p) - sides[k].offset; }
};
/// The name of what cuts: side k is kSideName + k.
inline constexpr std::uint32_t kSideName = 128;

/// Makes the plane of a solid's flat face. t leads from its frame. A disc's sides lie around it, so that a body that
/// turns in place on a disc of its size is not cut.
template <class S>
ISO_INLINE void plane_of(const SolidFace<S>& face, const Transform<S>& t, std::uint32_t name, RestPlane<S>& plane) {
  Vec3<S> corners[SolidFace<S>::kMost];
  for (int k = 0; k < face.count; ++k) corners[k] = to_world(t, face.points[k]);
  plane.normal = t.rotation * face.normal;
  plane.offset = dot(plane.normal, corners[0]);
  for (int k = 1; k < face.count; ++k) plane.offset = max(plane.offset, dot(plane.normal, corners[k]));
  plane.own = name | face.name << 16;
  plane.cut = plane.own | 1u << 29;
  const Vec3<S> centre = (corners[0] + corners[face.count / 2]) * S(0.5);
  for (int k = 0; k < face.count; ++k) {
    const Vec3<S> corner = corners[k], next = corners[k + 1 < face.count ? k + 1 : 0];
    const Vec3<S> inside = corners[(k + 2) % face.count] - corner;
    Vec3<Unit<S>> outward = face.is_disc ? normalise(corner - centre) : cross(normalise(next - corner), plane.normal);
    if (!face.is_disc && dot(outward, inside) > S(0)) outward = -outward;
    plane.sides[k] = {outward, dot(outward, corner), false};
  }
  plane.count = face.count;
}

/// [1] The sine of the axis within which a disc lies on a face, with points that turn with it. The lowest of its
/// sixteen points is then higher than the lowest of all by at most 0.0006 radii.
inline constexpr double kFlatDisc = 0.03125;
inline constexpr double kLeaningDisc = 0.5;        // sine up to which the points beside the lowest are looked at
inline constexpr std::uint32_t kQuarterTurn = 34;  // names those

template <class S> class SolidOverPlane {
  using U = Unit<S>;
  static constexpr int kMostClipped = 160;  // corners of a face that another one cuts
  using Polygon = ClipPolygon<S, kMostClipped>;

 public:
  /// `frame` leads out of the solid's frame. `tie` [m]: points within it count as equally deep.
  ISO_INLINE SolidOverPlane(const SolidView<S>& solid, const Transform<S>& frame, S margin, S tie, Manifold<S>& out)
      : solid_(solid), frame_(frame), margin_(margin), tie_(tie), out_(out) {}

  /// Adds the points over the plane, with the plane's normal reversed. Returns false if nothing is over it. True
  /// without a point: the points belong to a neighbour's side of the plane.
  ISO_INLINE bool touch(const RestPlane<S>& plane) const {
    const Vec3<U> n = -plane.normal;
    SolidFace<S> part;
    solid_.find_face(n, U(kFlatDisc), part);
    const bool is_over = part.is_flat() ? face_over(plane, part) : line_over(plane, part, n);
    if (out_.count > 0) out_.normal = frame_.rotation * n;
    return is_over;
  }
  /// Adds only the lowest point, at `height` [m].
  ISO_INLINE void touch_lowest(const RestPlane<S>& plane, Vec3<S> p, S height) const {
    out_.normal = frame_.rotation * -plane.normal;
    add(plane, p, height, plane.own | kLowestAlone);
  }

 private:
  static constexpr std::uint32_t kLowestAlone = 127;

  ISO_INLINE void add(const RestPlane<S>& plane, Vec3<S> p, S height, std::uint32_t name) const {
    if (height <= margin_) out_.add(to_world(frame_, p - plane.normal * (height * S(0.5))), height, name);
  }
  template <class Keep> ISO_INLINE void keep_near(Polygon& polygon, const Keep& keep) const {
    int kept = 0;
    for (int i = 0; i < polygon.count; ++i) {
      if (polygon.points[i].height <= margin_ && keep(polygon.points[i])) polygon.points[kept++] = polygon.points[i];
    }
    polygon.count = kept;
    if (kept > kMaxContactPoints) reduce_to_four(polygon, tie_);
  }
  static ISO_INLINE bool is_own(const ClipPoint<S>& p) { return p.before < kSideName && p.after < kSideName; }
  static ISO_INLINE bool is_cut_flat(const RestPlane<S>& plane, const ClipPoint<S>& p) {
    const auto goes_on = [&](std::uint32_t name)
                             ISO_INLINE_LAMBDA { return name < kSideName || plane.sides[name - kSideName].goes_on; };
    return goes_on(p.before) && goes_on(p.after);
  }

  /// Adds the points of a flat face, clipped to the plane's sides. Where the plane goes on beyond its sides, neighbours
  /// choose the same corners.
  ISO_INLINE bool face_over(const RestPlane<S>& plane, const SolidFace<S>& part) const {
    const Tangents<U> across = tangents_of(plane.normal);
    Polygon polygons[2];
    polygons[0].count = part.count;
    for (int k = 0; k < part.count; ++k) {
      const Vec3<S> p = part.points[k];
      const int before = k == 0 ? part.count - 1 : k - 1;
      polygons[0].points[k] = {dot(across.t, p), dot(across.u, p), plane.height(p), static_cast<std::uint32_t>(before),
                               static_cast<std::uint32_t>(k)};
    }
    bool kept[SolidFace<S>::kMost], cut = false, ends = false;  // the face, under the solid
    unsigned now = 0;
    for (int k = 0; k < plane.count; ++k) {
      const bool cuts = clip_to_side(plane, k, across, polygons[now], polygons[now ^ 1u]);
      if (cuts && !cut) choose(part, across, plane, kept);
      now ^= cuts ? 1u : 0u;
      cut = cut || cuts;
      ends = ends || (cuts && !plane.sides[k].goes_on);
    }
    Polygon& polygon = polygons[now];
    bool is_over = false;
    for (int i = 0; i < polygon.count; ++i) is_over = is_over || polygon.points[i].height <= margin_;
    keep_near(polygon, [&](const ClipPoint<S>& p) ISO_INLINE_LAMBDA {
      return is_own(p) ? ends || !cut || kept[p.after] : !is_cut_flat(plane, p);
    });
    for (int i = 0; i < polygon.count; ++i) {
      const ClipPoint<S>& p = polygon.points[i];
      const Vec3<S> at = across.t * p.u + across.u * p.v + plane.normal * (plane.offset + p.height);
      const auto name = [&](std::uint32_t k) ISO_INLINE_LAMBDA { return k < kSideName ? part.names[k] : k; };
      add(plane, at, p.height,
          is_own(p) ? plane.own | part.names[p.after] : plane.cut | name(p.before) << 8 | name(p.after));
    }
    return is_over;
  }
  /// Chooses the corners that would be kept if the plane had no sides.
  ISO_INLINE void choose(const SolidFace<S>& part, const Tangents<U>& across, const RestPlane<S>& plane,
                         bool (&kept)[SolidFace<S>::kMost]) const {
    Polygon all;
    all.count = part.count;
    for (int k = 0; k < part.count; ++k) {
      const Vec3<S> p = part.points[k];
      all.points[k] = {dot(across.t, p), dot(across.u, p), plane.height(p), 0, static_cast<std::uint32_t>(k)};
      kept[k] = false;
    }
    keep_near(all, [](const ClipPoint<S>&) ISO_INLINE_LAMBDA { return true; });
    for (int i = 0; i < all.count; ++i) kept[all.points[i].after] = true;
  }
  static ISO_INLINE bool clip_to_side(const RestPlane<S>& plane, int k, const Tangents<U>& across, const Polygon& from,
                                      Polygon& to) {
    const typename RestPlane<S>::Side& side = plane.sides[k];
    const U du = dot(across.t, side.outward), dv = dot(across.u, side.outward);
    S beyond[kMostClipped];
    for (int i = 0; i < from.count; ++i)
      beyond[i] = round_to<S>(product(from.points[i].u, du) + product(from.points[i].v, dv)) - side.offset;
    constexpr auto kCut = [](const auto& p, const auto& q, auto t, auto& at) ISO_INLINE_LAMBDA {
      at.u = p.u + (q.u - p.u) * t;
      at.v = p.v + (q.v - p.v) * t;
    };
    return clip(from, beyond, kSideName + static_cast<std::uint32_t>(k), kCut, to);
  }

  /// Adds the ends of a line as far as it is over the plane's face, and for a leaning disc the points beside its lowest
  /// one. If the lowest point of the disc is not over the face, other points of it. A point is a line of no length.
  ISO_INLINE bool line_over(const RestPlane<S>& plane, const SolidFace<S>& line, Vec3<U> n) const {
    const int last = line.count - 1;
    Vec3<S> ends[2] = {line.points[0], line.points[last]};
    const Vec3<S> whole[2] = {ends[0], ends[1]};
    std::uint32_t sides[2] = {0, 0};
    const int lower = plane.height(ends[1]) < plane.height(ends[0]) ? 1 : 0;
    SolidFace<S> disc;
    solid_.find_face(n, U(kLeaningDisc), disc);
    const bool leans = disc.is_disc, is_over = clip_line(plane, ends, sides);
    if (leans && (!is_over || sides[lower] != 0)) return face_over(plane, disc);
    if (!is_over) return false;
    for (int k = 0; k <= last; ++k) {
      const std::uint32_t side = sides[k], end = line.names[k];
      if (side != 0 && plane.sides[side - kSideName].goes_on) continue;
      add(plane, ends[k], plane.height(ends[k]), side == 0 ? plane.own | end : plane.cut | side << 8 | end);
    }
    if (leans) quarter_turns_over(plane, disc, whole[lower]);
    return min(plane.height(ends[0]), plane.height(ends[last])) <= margin_;
  }
  ISO_INLINE void quarter_turns_over(const RestPlane<S>& plane, const SolidFace<S>& disc, Vec3<S> lowest) const {
    const Vec3<S> centre = (disc.points[0] + disc.points[disc.count / 2]) * S(0.5);
    const Vec3<S> aside = cross(disc.normal, lowest - centre);
    for (std::uint32_t k = 0; k < 2; ++k) {
      const Vec3<S> p = k == 0 ? centre + aside : centre - aside;
      bool is_over = true;
      for (int side = 0; side < plane.count; ++side) is_over = is_over && !(plane.beyond(side, p) > S(0));
      if (is_over) add(plane, p, plane.height(p), plane.own | (kQuarterTurn + k));
    }
  }
  static ISO_INLINE bool clip_line(const RestPlane<S>& plane, Vec3<S> (&ends)[2], std::uint32_t (&names)[2]) {
    for (int k = 0; k < plane.count; ++k) {
      const S beyond[2] = {plane.beyond(k, ends[0]), plane.beyond(k, ends[1])};
      if (beyond[0] > S(0) && beyond[1] > S(0)) return false;
      for (int e = 0; e < 2; ++e) {
        if (!(beyond[e] > S(0))) continue;
        ends[e] = ends[e] + (ends[1 - e] - ends[e]) * divide_to<U>(beyond[e], beyond[e] - beyond[1 - e]);
        names[e] = kSideName + static_cast<std::uint32_t>(k);
      }
    }
    return true;
  }

  const SolidView<S>& solid_;
  const Transform<S>& frame_;
  const S margin_, tie_;  // [m]
  Manifold<S>& out_;
};

}  // namespace isostep::detail
