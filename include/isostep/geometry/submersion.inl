// Bodies of submersion.hpp.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/geometry/baked/box_solid.hpp"
#include "isostep/geometry/submersion.hpp"

namespace isostep {
namespace detail {

/// A plane as seen from a middle c in half widths h along each axis: dot(up, x) < level where dot(normal, u) < offset,
/// x = c + h u. The normal is a unit vector again.
template <class S> struct ScaledPlane {
  enum Side { above, below, across };  // where the solid is
  Side side;
  Vec3<Unit<S>> normal;
  Unit<S> offset;  // of planes across it

  /// No point of the solid is further than `reach` half widths from the middle; reach up to 7/4.
  static ISO_INLINE ScaledPlane of(Vec3<Unit<S>> up, S level, Vec3<S> middle, Vec3<S> half, Unit<S> reach) {
    const Heading<S> across_it = heading_of(Vec3<S>{up.x * half.x, up.y * half.y, up.z * half.z});
    const S depth = level - dot(up, middle), most = across_it.length * reach;
    if (depth <= -most) return {above, across_it.direction, Unit<S>(0)};
    if (depth >= most) return {below, across_it.direction, Unit<S>(0)};
    return {across, across_it.direction, divide_to<Unit<S>>(depth, across_it.length)};
  }
};

/// A share of the volume and the middle of the part, relative to the solid.
template <class U> struct ScaledPart {
  U share;
  Vec3<U> middle;  // of flat faces in eighths of half widths, else in half widths
};

// ---- flat faces

/// The tetrahedra of the faces below a plane with a point of it. Coordinates are eighths of half widths, so that
/// products of differences fit Unit<S>.
template <class U> class CutFaces {
 public:
  ISO_INLINE CutFaces(Vec3<U> normal, U offset) : normal_(normal), apex_(normal * offset) {}

  void add(Vec3<U> a, Vec3<U> b, Vec3<U> c) {
    const Vec3<U> corner[3] = {a - apex_, b - apex_, c - apex_};
    const U height[3] = {dot(normal_, corner[0]), dot(normal_, corner[1]), dot(normal_, corner[2])};
    Vec3<U> kept[4];
    int count = 0;
    for (int i = 0; i < 3; ++i) {
      const int j = i == 2 ? 0 : i + 1;
      const bool in = height[i] <= U(0), next_in = height[j] <= U(0);
      if (in) kept[count++] = corner[i];
      if (in != next_in) kept[count++] = crossing(corner[i], height[i], corner[j], height[j]);
    }
    for (int i = 2; i < count; ++i) add_tetrahedron(kept[0], kept[i - 1], kept[i]);
  }
  /// The part of a solid of six times that volume, in eighths as well.
  ISO_INLINE ScaledPart<U> part(U six_volumes) const {
    if (!(U(0) < volume_)) return {U(0), Vec3<U>::zero()};
    const U share = min(divide_to<U>(volume_, six_volumes), U(1)), most = U(0.25);
    if (!(U(0) < share)) return {U(0), Vec3<U>::zero()};
    // A part thinner than its own rounding has its middle anywhere: it is held within the solid's reach.
    const auto mean = [&](U moment) ISO_INLINE_LAMBDA {
      return abs(moment) < volume_ ? divide_to<U>(moment, volume_) : moment < U(0) ? U(-1) : U(1);
    };
    const Vec3<U> from_apex = {mean(moment_.x), mean(moment_.y), mean(moment_.z)};
    return {share, held_within(held_within(from_apex, U(1)) + apex_, most)};
  }

 private:
  static ISO_INLINE Vec3<U> crossing(Vec3<U> a, U height_a, Vec3<U> b, U height_b) {
    const U t = divide_to<U>(abs(height_a), abs(height_a) + abs(height_b));
    return a + (b - a) * t;
  }
  ISO_INLINE void add_tetrahedron(Vec3<U> a, Vec3<U> b, Vec3<U> c) {
    const U six = dot(a, cross(b, c)), quarter = U(0.25);
    volume_ += six;
    moment_ += (a * quarter + b * quarter + c * quarter) * six;
  }

  Vec3<U> normal_, apex_;
  U volume_ = U(0);  // six times
  Vec3<U> moment_ = Vec3<U>::zero();
};

/// The part of a polyhedron below a plane. `half`: of the box that the middle is seen in; `filled`: the share of that
/// box that the solid takes.
template <class S>
ScaledPart<Unit<S>> part_below(const Polyhedron<S>& solid, Vec3<S> middle, Vec3<S> half, Unit<S> filled,
                               const ScaledPlane<S>& plane) {
  using U = Unit<S>;
  CutFaces<U> faces(plane.normal, plane.offset);
  const Vec3<S> unit = half * S(8);
  const auto scaled = [&](std::uint32_t i) ISO_INLINE_LAMBDA {
    const Vec3<S> arm = solid.vertices[i] - middle;
    return Vec3<U>{divide_to<U>(arm.x, unit.x), divide_to<U>(arm.y, unit.y), divide_to<U>(arm.z, unit.z)};
  };
  for (std::uint32_t face = 0; face < solid.faces.size(); ++face) {
    solid.visit_fan(
        face, [&](std::uint32_t i, std::uint32_t j, std::uint32_t k) { faces.add(scaled(i), scaled(j), scaled(k)); });
  }
  return faces.part(filled * U(6.0 / 64));
}

// ---- round solids

/// Half of ten nodes of Gauss-Legendre over the angle from 0 to pi whose cosine leads from one end of a piece to the
/// other; the other half mirrors them. Ends at which a slice just touches the plane are smooth in that angle.
template <class U> struct SliceNode { U place, weight; };  // [1] of half the piece's length; of its length
template <class U>
inline constexpr SliceNode<U> kSliceNodes[5] = {{U(0.00083987118299022612), U(0.0021456516964593734)},
                                                {U(0.022379117526759251), U(0.024693503938838946)},
                                                {U(0.12414049822996021), U(0.083035178187506997)},
                                                {U(0.37060385196736745), U(0.1643390861013877)},
                                                {U(0.76827432930154904), U(0.22578658007580693)}};

/// A round solid along z from -1 to 1, its widest radius 1, cut by sine x + cosine z < offset, offset up to 1.5.
template <class S> class CutSlices {
  using U = Unit<S>;

 public:
  /// It keeps halves: their sums fit Unit<S>.
  ISO_INLINE CutSlices(U sine, U cosine, U offset)
      : sine_(sine * U(0.5)), cosine_(cosine * U(0.5)), offset_(offset * U(0.5)) {}

  /// Adds a piece from z0 to z1 with the radius at_0 + slope z.
  void add_straight(U z0, U z1, U at_0, U slope) {
    const auto radius = [&](U z) ISO_INLINE_LAMBDA { return at_0 + slope * z; };
    Places places = {{z0, z1, z1, z1}, 1};
    for (const U side : {sine_, -sine_}) {
      const U above = offset_ - side * at_0, below = cosine_ + side * slope;
      if (abs(above) < abs(below)) places.insert(divide_to<U>(above, below));
    }
    add(places, radius);
  }
  /// Adds a piece from z0 to z1, half of an ellipsoid about z = middle, of radius 1 there and `height` along z.
  void add_cap(U z0, U z1, U middle, U height) {
    const auto radius = [&](U z) ISO_INLINE_LAMBDA {
      const U up = clamp(divide_to<U>(z - middle, height), U(-1), U(1));
      return root(U(1) - up * up);
    };
    Places places = {{z0, z1, z1, z1}, 1};
    // The cap is stretched to a ball: the circle in which the plane cuts it ends at these heights.
    const Direction<U> stretched = direction_of(sine_, cosine_ * height, U(0));
    const U distance = offset_ - cosine_ * middle;
    if (abs(distance) < stretched.length) {
      const U d = divide_to<U>(distance, stretched.length);
      const U centre = stretched.y * d, reach = stretched.x * root(U(1) - d * d);
      for (const U end : {centre - reach, centre + reach}) places.insert(middle + height * clamp(end, U(-1), U(1)));
    }
    add(places, radius);
  }
  /// The part of a solid that fills such a share of the cylinder around it: the middle is (x, z, 0).
  ISO_INLINE ScaledPart<U> part(U filled) const {
    if (!(U(0) < volume_)) return {U(0), Vec3<U>::zero()};
    const auto mean = [&](U moment) ISO_INLINE_LAMBDA {
      return abs(moment) < volume_ ? divide_to<U>(moment, volume_) : moment < U(0) ? U(-1) : U(1);
    };
    return {min(divide_to<U>(volume_, filled), U(1)), {mean(across_), mean(along_), U(0)}};
  }

 private:
  /// The ends of pieces, ascending.
  struct Places {
    U at[4];
    int pieces;

    ISO_INLINE void insert(U z) {
      if (!(at[0] < z) || !(z < at[pieces])) return;
      int i = ++pieces;
      for (; z < at[i - 1]; --i) at[i] = at[i - 1];
      at[i] = z;
    }
  };
  static ISO_INLINE U root(U square) { return sqrt(max(square, U(0))); }

  template <class Radius> void add(const Places& places, const Radius& radius) {
    for (int piece = 0; piece < places.pieces; ++piece) {
      const U from = places.at[piece], to = places.at[piece + 1];
      const U half = to * U(0.5) - from * U(0.5);  // two, the whole of it, may not fit
      for (const SliceNode<U>& node : kSliceNodes<U>) {
        add_slice(from + half * node.place, half * node.weight, radius);
        add_slice(to - half * node.place, half * node.weight, radius);
      }
    }
  }
  /// Adds the part of a disc of that radius where x < d, over pi: with u = d / radius and v^2 = 1 - u^2 the area pi/2 +
  /// asin(u) + u v, the moment along x -2/3 v^3.
  template <class Radius> void add_slice(U z, U weight, const Radius& radius_at) {
    const U radius = radius_at(z), d = offset_ - cosine_ * z, reach = sine_ * radius;
    if (d <= -reach) return;
    U area = U(1), moment = U(0);
    if (d < reach) {
      const U u = divide_to<U>(d, reach), v = root(U(1) - u * u);
      area = U(0.5) + (atan2(u, v) * U(1 / kPi) + u * v * U(1 / kPi));
      moment = U(-2 / (3 * kPi)) * (v * v * v);
    }
    const U part = weight * (radius * radius);
    volume_ += part * area;
    along_ += part * area * z;
    across_ += part * radius * moment;
  }

  U sine_, cosine_, offset_;
  U volume_ = U(0), along_ = U(0), across_ = U(0);  // over that of the cylinder around the solid
};

/// The part of a solid of revolution about y: `fill` adds its pieces and returns the share of the cylinder that it
/// takes.
template <class S, class Fill>
Submersion<S> revolved_below(S radius, S half_height, Vec3<S> whole_centre, Vec3<Unit<S>> up, S level,
                             const Fill& fill) {
  using U = Unit<S>;
  const Direction<U> level_way = direction_of(up.x, U(0), up.z);
  const Vec3<U> tilted = {min(level_way.length, U(1)), up.y, U(0)};
  const Vec3<S> half = {radius, half_height, radius};
  const ScaledPlane<S> plane = ScaledPlane<S>::of(tilted, level, Vec3<S>::zero(), half, U(1.5));
  if (plane.side != ScaledPlane<S>::across) return {U(plane.side == ScaledPlane<S>::below ? 1 : 0), whole_centre};
  CutSlices<S> slices(plane.normal.x, plane.normal.y, plane.offset);
  const ScaledPart<U> part = slices.part(fill(slices));
  if (!(U(0) < part.share)) return {U(0), whole_centre};
  const S across = radius * part.middle.x;
  return {part.share, {across * level_way.x, half_height * part.middle.y, across * level_way.z}};
}

// ---- each shape

template <class S> Submersion<S> submersion_of(const Sphere<S>& sphere, Vec3<Unit<S>> up, S level) {
  using U = Unit<S>;
  if (level <= -sphere.radius) return {U(0), Vec3<S>::zero()};
  if (level >= sphere.radius) return {U(1), Vec3<S>::zero()};
  // x is half of the depth of the lowest point in radii. A cap has the share x^2 (3 - 2 x) and its middle 3 (1 - x)^2 /
  // (3 - 2 x) radii below the sphere's.
  const U x = divide_to<U>(level, sphere.radius) * U(0.5) + U(0.5), wide = U(1.5) - x;
  const U below = divide_to<U>((U(1) - x) * (U(1) - x) * U(1.5), wide);
  const U half_share = x * x * wide;
  return {min(half_share + half_share, U(1)), up * -(sphere.radius * below)};
}
template <class S> Submersion<S> submersion_of(const Box<S>& box, Vec3<Unit<S>> up, S level) {
  using U = Unit<S>;
  const Vec3<S> half = box.half_extents, middle = Vec3<S>::zero();
  const ScaledPlane<S> plane = ScaledPlane<S>::of(up, level, middle, half, U(1.75));
  if (plane.side != ScaledPlane<S>::across) return {U(plane.side == ScaledPlane<S>::below ? 1 : 0), middle};
  const BoxSolid<S> solid(half);
  const ScaledPlane<S> eighths = {plane.side, plane.normal, plane.offset * U(0.125)};
  const ScaledPart<U> part = part_below(solid.polyhedron(), middle, half, U(1), eighths);
  return {part.share, scale(half * S(8), part.middle)};
}
template <class S> Submersion<S> submersion_of(const Hull<S>& hull, Vec3<Unit<S>> up, S level) {
  using U = Unit<S>;
  const HullContent<S>& content = *hull.content;
  const Vec3<S> core = content.widths * S(0.5), middle = content.centre_of_mass;
  const Vec3<S> half = core + Vec3<S>{hull.radius, hull.radius, hull.radius};
  // No vertex is further from the centre of mass than two half widths along each axis: the reach in units of two.
  const ScaledPlane<S> plane = ScaledPlane<S>::of(up, level, middle, half * S(2), U(1.75));
  if (plane.side != ScaledPlane<S>::across) return {U(plane.side == ScaledPlane<S>::below ? 1 : 0), middle};
  const ScaledPlane<S> eighths = {plane.side, plane.normal, plane.offset * U(0.25)};
  const ScaledPart<U> part = part_below(hull.polyhedron(), middle, core, content.filled, eighths);
  return {part.share, middle + scale(half * S(8), part.middle)};
}
template <class S> Submersion<S> submersion_of(const Cylinder<S>& c, Vec3<Unit<S>> up, S level) {
  return revolved_below(c.radius, c.half_height, Vec3<S>::zero(), up, level, [](CutSlices<S>& slices) {
    using U = Unit<S>;
    slices.add_straight(U(-1), U(1), U(1), U(0));
    return U(1);
  });
}
template <class S> Submersion<S> submersion_of(const Cone<S>& c, Vec3<Unit<S>> up, S level) {
  return revolved_below(c.radius, c.half_height, c.centre_of_mass(), up, level, [](CutSlices<S>& slices) {
    using U = Unit<S>;
    slices.add_straight(U(-1), U(1), U(0.5), U(-0.5));
    return U(1.0 / 3);
  });
}
template <class S> Submersion<S> submersion_of(const Capsule<S>& c, Vec3<Unit<S>> up, S level) {
  using U = Unit<S>;
  const S half = c.half_height + c.radius;
  return revolved_below(c.radius, half, Vec3<S>::zero(), up, level, [&](CutSlices<S>& slices) {
    const U cap = divide_to<U>(c.radius, half), straight = U(1) - cap;
    slices.add_cap(U(-1), -straight, -straight, cap);
    slices.add_straight(-straight, straight, U(1), U(0));
    slices.add_cap(straight, U(1), straight, cap);
    return straight + cap * U(2.0 / 3);
  });
}
/// A shape that does not move has no share.
template <class S, class Shape>
requires(!Shape::kBounded) Submersion<S> submersion_of(const Shape&, Vec3<Unit<S>>, S) {
  return {Unit<S>(0), Vec3<S>::zero()};
}

}  // namespace detail

template <class S>
Submersion<S> submersion(std::type_identity_t<ShapeView<S>> solid, Vec3<Unit<S>> up, std::type_identity_t<S> level) {
  return visit_shape(solid, [&](const auto& shape) { return detail::submersion_of(shape, up, level); });
}

}  // namespace isostep
