// Bodies of shatter.hpp.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/fracture/shatter.hpp"
#include "isostep/geometry/baked/hull_content.inl"
#include "isostep/geometry/content.hpp"
#include "isostep/geometry/mass_properties.inl"
#include "isostep/scalar/environment.hpp"

namespace isostep {
namespace detail {

/// A piece in a scalar, in the solid's frame.
template <class S> struct ShatterPiece {
  Primitive<S> primitive;
  const void* content;  // of a hull
  Vec3<S> origin;       // [m]
  Vec3<S> centre;       // [m] of mass
  S mass;               // [kg]
  Unit<S> weight;       // [1] over the mass of all
};

template <class S> ISO_INLINE Vec3<S> in_metres(GridPoint p, int exponent) {
  return {from_lattice<S>(p.x, exponent), from_lattice<S>(p.y, exponent), from_lattice<S>(p.z, exponent)};
}

/// The pieces of a body as they are before they move.
template <class S> class Shattering {
  using U = Unit<S>;

 public:
  ISO_INLINE explicit Shattering(const BodyView<S>& body)
      : body_(body), child_(body.children[0].pose), turn_(to_matrix(child_.orientation)) {}
  ISO_INLINE Shattering(const Shattering&) = default;
  ISO_INLINE ~Shattering() = default;

  /// Returns false for pieces that are refused: error() tells.
  ISO_INLINE bool take(const Fracture& fracture) {
    S before = S(0);
    std::int64_t volume = 0;
    for (const FracturePiece& piece : fracture.pieces) {
      volume += piece.volume6;
      const U share = ratio_of<U>(Int128(volume), static_cast<std::uint64_t>(fracture.volume6));
      const S upto = body_.properties->mass * share;
      if (!add(piece, fracture.exponent, upto - before)) return false;
      before = upto;
    }
    find_centre();
    find_inertia();
    return true;
  }
  ISO_INLINE const Error& error() const { return error_; }
  ISO_INLINE const std::vector<ShatterPiece<S>>& pieces() const { return pieces_; }
  ISO_INLINE Vec3<S> centre() const { return centre_; }
  ISO_INLINE Quat<U> orientation() const {
    return child_.orientation == Quat<U>::identity() ? body_.state->orientation
                                                     : normalise(body_.state->orientation * child_.orientation);
  }
  /// Computes T'^-1 (T - T') w [rad/s], in the solid's frame.
  ISO_INLINE Vec3<S> change_of_turning(Vec3<S> w) const {
    const BodyProperties<S>& p = *body_.properties;
    const bool turns = S(0) < p.kappa.x && S(0) < p.kappa.y && S(0) < p.kappa.z;
    if (!turns || (p.flags & body_flag::kAllLocks) != 0) return Vec3<S>::zero();
    Mat3<U> more = body_inertia();
    for (int i = 0; i < 3; ++i) more.rows[i] = more.rows[i] - inertia_.rows[i];
    const Quat<U> axes = principal_axes(inertia_);
    const Mat3<U> principal = seen_from(inertia_, axes), to_solid = to_matrix(axes);
    Vec3<S> change = transposed_times(to_solid, more * w);
    for (int i = 0; i < 3; ++i) change[i] = divide_to<S>(change[i], principal.rows[i][i]);
    return to_solid * change;
  }

 private:
  ISO_INLINE bool refuse(const char* place, const char* expected) {
    ShortText<112> text = "piece ";
    text.append_number(pieces_.size()).append(": expected ").append(expected);
    error_ = {ErrorCode::invalid, text, place};
    return false;
  }
  ISO_INLINE bool add(const FracturePiece& piece, int exponent, S mass) {
    ShatterPiece<S> made = {};
    made.origin = in_metres<S>(piece.origin, exponent + 1);
    made.centre = made.origin;
    made.mass = mass;
    made.weight = divide_to<U>(mass, body_.properties->mass);
    if (!(S(0) < mass)) return refuse("mass", "a share of the body's mass above the scalar's resolution");
    if (piece.blob == nullptr) {
      const Box<S> box = piece_box<S>(piece, exponent);
      if (box.fault() != ShapeFault::none) return refuse("pieces", describe(box.fault()));
      made.primitive = box.primitive();
    } else {
      const auto* content = static_cast<const HullContent<S>*>(content_of<S>(*piece.blob));
      if (content == nullptr || content->fault != ShapeFault::none)
        return refuse("pieces", content == nullptr ? "a hull" : describe(content->fault));
      made.primitive = Hull<S>{1}.primitive();
      made.content = content;
      made.centre = made.origin + content->centre_of_mass;
    }
    pieces_.push_back(made);
    return true;
  }
  /// Finds the centre of mass of all pieces by the masses that they have.
  ISO_INLINE void find_centre() {
    const Vec3<S> first = pieces_[0].centre;
    const SumOf<S, U> zero = product(S(0), U(0));
    SumOf<S, U> x = zero, y = zero, z = zero;
    for (const ShatterPiece<S>& piece : pieces_) {
      const Vec3<S> arm = piece.centre - first;
      x += product(arm.x, piece.weight);
      y += product(arm.y, piece.weight);
      z += product(arm.z, piece.weight);
    }
    centre_ = first + Vec3<S>{round_to<S>(x), round_to<S>(y), round_to<S>(z)};
  }
  /// Finds a length [m] against which all arms and gyration radii are below 1/2.
  ISO_INLINE void find_scale() {
    S reach = S(0);
    for (const ShatterPiece<S>& piece : pieces_) {
      const Aabb<S> box = bounds(ShapeView<S>(piece.primitive, piece.content), Transform<S>::of(Pose<S>::identity()));
      const Vec3<S> arm = piece.origin - centre_;
      reach = max(reach, max(max_abs(box.low + arm), max_abs(box.high + arm)));
    }
    scale_ = reach + reach;
  }
  /// Computes T' over scale^2, in the solid's frame: parallel-axis theorem, as in mass_properties.inl, by these masses.
  ISO_INLINE void find_inertia() {
    find_scale();
    const Sum<U> zero = product(U(0), U(0));
    Sum<U> xx = zero, yy = zero, zz = zero, xy = zero, xz = zero, yz = zero;
    for (const ShatterPiece<S>& piece : pieces_) {
      const Mat3<U> own = own_inertia(piece);
      const Vec3<S> arm = piece.centre - centre_;
      const U x = divide_to<U>(arm.x, scale_), y = divide_to<U>(arm.y, scale_), z = divide_to<U>(arm.z, scale_);
      xx += product(piece.weight, own.rows[0].x + (y * y + z * z));
      yy += product(piece.weight, own.rows[1].y + (z * z + x * x));
      zz += product(piece.weight, own.rows[2].z + (x * x + y * y));
      xy += product(piece.weight, own.rows[0].y - x * y);
      xz += product(piece.weight, own.rows[0].z - x * z);
      yz += product(piece.weight, own.rows[1].z - y * z);
    }
    const U m01 = round_to<U>(xy), m02 = round_to<U>(xz), m12 = round_to<U>(yz);
    inertia_ = {{{round_to<U>(xx), m01, m02}, {m01, round_to<U>(yy), m12}, {m02, m12, round_to<U>(zz)}}};
  }
  ISO_INLINE Mat3<U> own_inertia(const ShatterPiece<S>& piece) const {
    if (piece.content == nullptr) return Mat3<U>::diagonal(Box<S>::of(piece.primitive).relative_inertia(scale_));
    return Hull<S>::of(piece.primitive, static_cast<const HullContent<S>*>(piece.content)).relative_inertia(scale_);
  }
  /// Returns T over scale^2, in the solid's frame, as squares of the radii of gyration.
  ISO_INLINE Mat3<U> body_inertia() const {
    Vec3<U> principal = Vec3<U>::zero();
    for (int i = 0; i < 3; ++i) {
      const U radius = divide_to<U>(rsqrt(body_.properties->kappa[i]), scale_);
      principal[i] = radius * radius;
    }
    const Mat3<U> axes = transpose(turn_) * to_matrix(body_.properties->principal);
    return rotate_diagonal(axes, principal);
  }

  BodyView<S> body_;
  Pose<S> child_;  // the solid's frame in the body's
  Mat3<U> turn_;
  std::vector<ShatterPiece<S>> pieces_;
  Vec3<S> centre_ = Vec3<S>::zero();  // [m] of mass of all pieces, in the solid's frame
  S scale_ = S(1);                    // [m]
  Mat3<U> inertia_ = Mat3<U>::diagonal(Vec3<U>::zero());
  Error error_ = {};
};

/// Returns all of a body of one part that does not depend on its place.
template <class S> ISO_INLINE BodyDefinition<S> likeness_of(const BodyProperties<S>& p, const PartTraits<S>& part) {
  BodyDefinition<S> d;
  d.type = BodyType::dynamic;
  d.material = part.material_or(p.material);
  d.filter = part.filter_or(p.filter);
  d.user_data = p.user_data;
  d.gravity_scale = p.gravity_scale;
  d.linear_damping = p.linear_damping;
  d.angular_damping = p.angular_damping;
  d.locks = p.flags & body_flag::kAllLocks;
  d.sensor = (p.flags & body_flag::kSensor) != 0 || part.has(part_flag::kSensor);
  d.allow_sleep = (p.flags & body_flag::kAllowSleep) != 0;
  d.collide = (p.flags & body_flag::kCollide) != 0;
  d.bullet = (p.flags & body_flag::kBullet) != 0;
  d.report_contacts = (p.flags & body_flag::kReportContacts) != 0 || part.has(part_flag::kReportContacts);
  return d;
}

template <class S> ISO_INLINE bool may_shatter(const BodyView<S>& body) {
  if (body.state == nullptr || body.properties->type != BodyType::dynamic || body.children.size() != 1) return false;
  const Primitive<S>& primitive = body.children[0].primitive;
  return primitive.type == ShapeType::box || (primitive.type == ShapeType::hull && primitive.radius == S(0));
}
}  // namespace detail

template <class S>
Result<std::vector<BodyDefinition<S>>> shatter(const Fracture& pieces, const BodyView<S>& body,
                                               std::span<const ShapeId> shapes) {
  return pin_floats([&]() -> Result<std::vector<BodyDefinition<S>>> {
    if (!detail::may_shatter(body))
      return detail::bad_fracture_number("body", "a dynamic body whose one part is a box or a hull without a radius");
    if (pieces.pieces.empty()) return detail::bad_fracture_number("pieces", "one or more, as fracture gives them");
    if (shapes.size() != pieces.pieces.size()) return detail::bad_fracture_number("shapes", "one for each piece");
    detail::Shattering<S> parts(body);
    if (!parts.take(pieces)) return parts.error();
    const Quat<Unit<S>> orientation = parts.orientation();
    const Mat3<Unit<S>> turn = to_matrix(orientation);
    const Vec3<S> velocity = convert<S>(body.state->velocity), spin = convert<S>(body.state->angular_velocity);
    const Vec3<S> turning = spin + turn * parts.change_of_turning(transposed_times(turn, spin));
    std::vector<BodyDefinition<S>> definitions;
    for (std::size_t i = 0; i < shapes.size(); ++i) {
      const detail::ShatterPiece<S>& piece = parts.pieces()[i];
      BodyDefinition<S> d = detail::likeness_of(*body.properties, body.children[0].traits);
      d.shape = shapes[i];
      d.mass = piece.mass;
      d.orientation = orientation;
      d.position = body.state->centre + turn * (piece.origin - parts.centre());
      d.velocity = velocity + cross(turning, turn * (piece.centre - parts.centre()));
      d.angular_velocity = turning;
      definitions.push_back(d);
    }
    return definitions;
  });
}

template <class S> std::vector<ShapeId> add_piece_shapes(World<S>& world, const Fracture& pieces) {
  return pin_floats([&] {
    std::vector<ShapeId> shapes;
    for (const FracturePiece& piece : pieces.pieces) {
      shapes.push_back(piece.blob != nullptr ? world.add_shape(piece.blob)
                                             : world.add_shape(piece_box<S>(piece, pieces.exponent)));
    }
    return shapes;
  });
}

}  // namespace isostep
