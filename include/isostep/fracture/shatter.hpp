// shatter: the bodies of a fracture's pieces, moving on as the broken body did.
// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <vector>

#include "isostep/core/instantiate.hpp"
#include "isostep/core/result.hpp"
#include "isostep/fracture/fracture.hpp"
#include "isostep/world/world.hpp"

namespace isostep {

/// Definitions of the pieces of a body, for World::create; the caller then destroys the body. Each is a command, so
/// recordings and rollback need nothing more:
///     const auto shards = shatter(broken, world.view(body), shapes);   // shapes = add_piece_shapes(world, broken)
///     world.destroy(body);
///     for (const auto& shard : shards.value()) world.create(shard);
/// Pieces take the body's user data, gravity, damping, locks and flags, and the material, filter and flags of its part.
/// The part's user data is lost.
/// Keeps:  mass, centre of mass, momentum and angular momentum of all pieces together, within 1e-5 (float), 1e-12
///         (double), 1e-3 (Q16.16) and 1e-8 (Q32.32) of the body's; tests/unit/effects/fracture_test.cpp measures them
///         in worlds.
/// Method: masses are shares of the body's by volume, rounded as running totals so that they add up. Rounding to the
///         grid moves the pieces' common centre by less than a step: all of them are shifted back. It changes their
///         common inertia as little, so they turn at w' = w + T'^-1 (T - T') w, where T and T' are the inertias over
///         mass of the body and of all pieces; a piece moves at v + w' x r. T is the body's own, also where a user
///         gave it an inertia that is not its shape's. With locks or an infinite inertia w' is w.
/// Frames: the solid of `pieces` is the body's one child, a box or a hull without a radius.
/// Errors: ErrorCode::invalid, whose place is "body" (no dynamic body of one child), "shapes" (not one for each piece),
///         "pieces" (none, or one that the scalar cannot hold) or "mass" (a piece below the scalar's resolution).
template <class S>
Result<std::vector<BodyDefinition<S>>> shatter(const Fracture& pieces, const BodyView<S>& body,
                                               std::span<const ShapeId> shapes);

/// A piece that is a box, in metres.
template <class S> ISO_INLINE Box<S> piece_box(const FracturePiece& piece, int exponent) {
  const GridPoint h = piece.half_extents;
  return {{from_lattice<S>(h.x, exponent + 1), from_lattice<S>(h.y, exponent + 1), from_lattice<S>(h.z, exponent + 1)}};
}
/// Adds the pieces' shapes to a world, in their order. A shape that the world refuses has a null id, and the world
/// tells the fault.
template <class S> std::vector<ShapeId> add_piece_shapes(World<S>& world, const Fracture& pieces);

#define ISO_SHATTER_OF(extern, S)                                                                     \
  extern template Result<std::vector<BodyDefinition<S>>> shatter(const Fracture&, const BodyView<S>&, \
                                                                 std::span<const ShapeId>);           \
  extern template std::vector<ShapeId> add_piece_shapes(World<S>&, const Fracture&);
ISO_EXTERN_FOR_EACH_SCALAR(ISO_SHATTER_OF)

}  // namespace isostep
