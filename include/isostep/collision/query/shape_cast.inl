// Body of shape_cast.hpp.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/collision/narrowphase/epa.inl"
#include "isostep/collision/query/core_cast.hpp"

namespace isostep {
namespace detail {

/// A search for CoreCast, in a's own frame: GJK, warm started from its last simplex, and EPA.
template <class F> class GjkSearch {
 public:
  ISO_INLINE GjkSearch(ArrayView<Vec3<F>> a, ArrayView<Vec3<F>> b, const Mat3<Unit<F>>& b_in_a)
      : b_in_a_{Vec3<F>::zero(), b_in_a}, search_(a, b, b_in_a_) {}
  GjkSearch(const GjkSearch&) = delete;
  GjkSearch& operator=(const GjkSearch&) = delete;

  template <class Enough> ISO_INLINE GjkDistance<F> nearest(Vec3<F> at, const Enough& enough) {
    b_in_a_.position = at;
    simplex_ = simplex_.count == 0 ? search_.begin() : search_.begin(simplex_);
    return search_.run(simplex_, enough);
  }
  ISO_INLINE std::optional<CoreWayOut<F>> way_out(F size) const {
    const typename Epa<F>::Axis axis = Epa<F>(search_, size).run(simplex_);
    return CoreWayOut<F>{axis.depth, axis.normal, search_.witnesses(axis.face, axis.rounds).on_b};
  }

 private:
  Transform<F> b_in_a_;
  Gjk<F> search_;
  Simplex<F> simplex_ = {};
};

}  // namespace detail

template <class S>
bool cast_convex(const ConvexCore<S>& a, const Transform<S>& ta, const ConvexCore<S>& b, const Transform<S>& tb,
                 const CastMotion<S>& motion, CastHit<S>& hit) {
  using namespace detail;
  using F = Finer<S>;
  const FineCore<S> fine_a(a), fine_b(b);
  const Mat3<Unit<F>> turn = finer_of(ta).rotation;
  const CoreCast<S> cast({fine_a.radius, fine_a.extent}, ta.position, {fine_b.radius, fine_b.extent}, tb.position, turn,
                         motion);
  GjkSearch<F> search(fine_a.vertices, fine_b.vertices, fine_relative(ta, tb).rotation);
  return cast.tell(cast.run(search), hit);
}

}  // namespace isostep
