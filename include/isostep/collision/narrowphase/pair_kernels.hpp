// Kernels that collide runs of pairs of one kind as a table: one for each instruction set, chosen at run time, all
// giving collide()'s own bits.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "isostep/collision/narrowphase/manifold.hpp"
#include "isostep/collision/narrowphase/polyhedra.hpp"
#include "isostep/core/fields.hpp"
#include "isostep/core/instantiate.hpp"
#include "isostep/core/simd.hpp"
#include "isostep/geometry/shape.hpp"

namespace isostep {

template <class S> class ChildTree;

/// The kind of part that selects a pair's kernel.
enum class PartKind : std::uint32_t { sphere, box, other };
ISO_INLINE constexpr PartKind part_kind_of(ShapeType type) {
  return type == ShapeType::sphere ? PartKind::sphere : type == ShapeType::box ? PartKind::box : PartKind::other;
}

/// Holds what the narrow phase needs of a body. Lanes read the numbers in runs of four and eight.
template <class S> struct BodyFrame {
  Vec3<S> half;         // [m] of the core of the only part
  S radius;             // [m] around it
  Vec3<S> centre;       // [m] of mass, world
  Transform<S> origin;  // the body's frame seen from its centre of mass, axes as the world's
  const Child<S>* children;
  Contents<S> contents;      // of their blobs
  const ChildTree<S>* tree;  // of many children; null: there are few
  std::uint32_t child_count;
  std::uint32_t slot;
  std::uint32_t row;  // of SolverBodies: 0 unless awake
  PartKind kind;      // of the only part, if plain
  bool plain;         // one part, not moved
  bool sensor;        // the whole body
  bool senses;        // the body, or a part of it
  bool asleep;
  bool surfaces;     // among its parts: those are counted by leaves, see surface_pairs.hpp
  bool traits;       // some part has some of its own: which pairs of parts meet is asked for each
  bool varied;       // the material is that of a leaf: it has surfaces or traits
  bool reports;      // the body, or a part of it, tells of its contacts
  bool mixes_alone;  // its material, see contact_friction.hpp

  ISO_FIELDS(half, radius, centre, origin, child_count, slot, row, kind, plain, sensor, senses, asleep, surfaces,
             traits, varied, reports, mixes_alone)
};

/// Two parts that might touch. Frames are indices. Parts are leaves, or children in a body without surfaces.
struct PartPair {
  std::uint32_t frame_a, frame_b;
  std::uint32_t child_a, child_b;

  ISO_FIELDS(frame_a, frame_b, child_a, child_b)
};

/// Returns b's frame for the narrow phase: relative to a's centre of mass, in world axes, so that distance from the
/// world's origin costs no precision.
template <class S> ISO_INLINE Transform<S> origin_beside(const BodyFrame<S>& a, const BodyFrame<S>& b) {
  return {b.centre - a.centre + b.origin.position, b.origin.rotation};
}

/// A run of pairs of one kind, both bodies plain. Pair order[i] fills counts[order[i]] and, if that is not zero,
/// manifolds[order[i]], begin <= i < end. Runs may be cut anywhere and collided in parallel.
template <class S> struct PairRun {
  const BodyFrame<S>* frames;
  const PartPair* pairs;
  const std::uint32_t* order;
  std::uint32_t begin, end;
  S margin;              // [m] as collide() has it
  std::uint8_t* counts;  // of points: most pairs of a heap have none, and cost no more memory than this
  Manifold<S>* manifolds;
};

template <class S> struct PairKernels {
  void (*spheres)(const PairRun<S>&);
  void (*boxes)(const PairRun<S>&);
  CollidePolyhedra<S> polyhedra;  // one pair
};

/// Returns the kernels for `simd`, or those of one lane if that instruction set has none, is missing or does not pay.
template <class S> const PairKernels<S>* pair_kernels(Simd simd);

#define ISO_DECLARE_PAIR_KERNELS(S)         \
  ISO_DECLARE_KERNEL_TABLES(PairKernels<S>) \
  template <> const PairKernels<S>* pair_kernels<S>(Simd simd);
ISO_FOR_EACH_SCALAR(ISO_DECLARE_PAIR_KERNELS)

}  // namespace isostep
