// Body of rounded_revolved.hpp.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/collision/narrowphase/rounded.inl"
#include "isostep/collision/narrowphase/rounded_revolved.hpp"

namespace isostep {
namespace detail {

template <class S> ISO_INLINE Revolved<Finer<S>> finer_of(const Revolved<S>& solid) {
  using F = Finer<S>;
  using U = Unit<F>;
  return {finer<F>(solid.half),
          {finer<F>(solid.radii[0]), finer<F>(solid.radii[1])},
          finer<U>(solid.out),
          finer<U>(solid.up),
          finer<F>(solid.slant)};
}

/// As gap_between: `reach` is how far the solid's own support is beyond the points that stand for it, so the distance
/// told is that of two planes that part the cores.
template <class S>
ISO_INLINE CoreGap<S> gap_between(const Revolved<S>& of_a, const Transform<S>& ta, const Polyhedron<S>& b,
                                  const Transform<S>& tb, S enough) {
  using F = Finer<S>;
  constexpr std::uint32_t kRounds = 16;
  const Revolved<F> solid = finer_of(of_a);
  const PolyhedronCore<S> core_b(b);
  const FineCore<S> fine_b(core_b.core());
  const Transform<F> b_in_a = fine_relative(ta, tb);
  Vec3<F> points[kRounds + 1];
  const auto support = [&](Vec3<Unit<F>> n) ISO_INLINE_LAMBDA {
    const Reach<F> reach = solid.reach(n);
    return solid.rim(reach.end(), reach.radial);
  };
  points[0] = support(normalise(b_in_a.position));
  Simplex<F> simplex = {};
  GjkDistance<F> found = {};
  for (std::uint32_t count = 1;; ++count) {
    const Gjk<F> search({points, count}, fine_b.vertices, b_in_a);
    simplex = count == 1 ? search.begin() : search.begin(simplex);
    found = search.run(simplex);
    if (!(found.distance > F(0))) break;
    const Vec3<F> next = support(found.normal);
    const F beyond = max(dot(found.normal, next - found.on_a), F(0)), all = found.distance;
    found.distance = all - beyond;
    if (beyond <= finer<F>(enough) || count > kRounds) break;
    points[count] = next;
  }
  return gap_of<S>(found, simplex);
}

}  // namespace detail

template <class S>
void collide_rounded_revolved(const detail::Revolved<S>& solid, const Transform<S>& ta, const RoundedPolyhedron<S>& b,
                              const Transform<S>& tb, S margin, Manifold<S>& out) {
  using namespace detail;
  out.clear();
  const S size = min(solid.half, solid.radii[0]);
  const S tolerance = axis_tolerance(size, b.core.inner_radius, tb.position - ta.position);
  collide_revolved_polyhedron(solid, ta, b.core, tb, margin + b.radius, out);
  const CoreGap<S> gap = gap_between(solid, ta, b.core, tb, tolerance * S(0.125));
  if (!gap.is_apart || gap.is_told_by(out, transposed_times(ta.rotation, out.normal), tolerance))
    return grow_cores(out, S(0), b.radius, margin);
  out.clear();
  if (gap.distance - b.radius <= margin) gap.touch(ta, S(0), b.radius, out);
}

}  // namespace isostep
