// A shape for the tests alone whose content is a blob: a box of so many millimetres, as a file in shapes/ would declare
// it.
// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "isostep/geometry/blob.hpp"
#include "isostep/geometry/shapes/box.hpp"

namespace isostep {

template <class S = Literal> struct Probe {
  static constexpr ShapeType kType = ShapeType::probe;
  static constexpr bool kBounded = true;
  static constexpr bool kHasBlob = true;
  static constexpr bool kPrincipal = true;

  struct Content {
    bool well_formed;
    Vec3<S> half;  // [m]

    static std::shared_ptr<const void> make(Bytes bytes) {
      if (bytes.size() != 12) return std::make_shared<Content>(Content{false, Vec3<S>::zero()});
      const auto side = [&](std::size_t at) { return S(load_le<std::uint32_t>(&bytes[at])) / S(1000); };
      return std::make_shared<Content>(Content{true, {side(0), side(4), side(8)}});
    }
    std::size_t memory() const { return sizeof *this; }
  };

  std::uint32_t blob;                // as Primitive has it
  const Content* content = nullptr;  // of a shape of a world

  static BlobRef bake(std::uint32_t x, std::uint32_t y, std::uint32_t z, BlobHome home = BlobHome::carried) {  // [mm]
    std::vector<std::uint8_t> bytes(12);
    store_le(&bytes[0], x);
    store_le(&bytes[4], y);
    store_le(&bytes[8], z);
    return Blob::make(kType, bytes, home);
  }
  static ISO_INLINE ShapeFault fault_of(const Content& content) {
    return content.well_formed ? Box<S>{content.half}.fault() : ShapeFault::blob_not_valid;
  }

  static ISO_INLINE constexpr Probe of(const Primitive<S>& p, const Content* content) { return {p.blob, content}; }
  static ISO_INLINE constexpr Probe of(const Probe<Literal>& p) { return {p.blob}; }
  ISO_INLINE constexpr Primitive<S> primitive() const {
    return {kType, blob, Vec3<S>::zero(), S(0), Vec3<Unit<S>>::zero(), S(0)};
  }
  ISO_INLINE constexpr ShapeFault fault() const { return ShapeFault::none; }
  ISO_INLINE constexpr Probe normalised() const { return *this; }
  ISO_INLINE Aabb<S> bounds(const Transform<S>& t) const { return box().bounds(t); }
  ISO_INLINE S inner_radius() const { return box().inner_radius(); }
  template <class Point> ISO_INLINE S visit_core(S inset, const Point& point) const {
    return box().visit_core(inset, point);
  }
  ISO_INLINE Vec3<S> middle() const { return box().middle(); }
  ISO_INLINE Vec3<S> support(Vec3<Unit<S>> n) const { return box().support(n); }
  ISO_INLINE void find_face(Vec3<Unit<S>> n, Unit<S> flat, SolidFace<S>& face) const { box().find_face(n, flat, face); }
  ISO_INLINE S mass(S density) const { return box().mass(density); }
  ISO_INLINE Vec3<S> kappa() const { return box().kappa(); }
  ISO_INLINE Unit<S> relative_volume(S scale) const { return box().relative_volume(scale); }
  ISO_INLINE Vec3<Unit<S>> relative_inertia(S scale) const { return box().relative_inertia(scale); }
  ISO_INLINE detail::LocalHit<S> cast(const Transform<S>& t, Vec3<S> origin, Vec3<S> translation) const {
    return box().cast(t, origin, translation);
  }
  ISO_INLINE ClosestPoint<S> closest(const Transform<S>& t, Vec3<S> query) const { return box().closest(t, query); }
  template <class Line> ISO_INLINE void visit_lines(const Line& line) const { box().visit_lines(line); }
  template <class Triangle> ISO_INLINE void visit_triangles(const Triangle&) const {}
  ISO_INLINE Pose<S> drawn_at(const Pose<S>&, const Pose<S>& pose) const { return pose; }
  ISO_INLINE Box<S> box() const { return {content->half}; }
};

}  // namespace isostep
