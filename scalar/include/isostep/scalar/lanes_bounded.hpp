// Exact sums of lanes held within a bound before they are rounded: what would not fit its format ends at the bound.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/scalar/headroom.hpp"
#include "isostep/scalar/lanes.hpp"

namespace isostep {

namespace detail {
/// A sum of the plain version, which keeps its sums one by one.
template <class SumL>
concept PlainSum = requires(SumL sum) {
  sum.v[0];
};
template <class Out, class SumS, int W, class Isa>
requires PlainSum<LaneSum<SumS, W, Isa>> ISO_INLINE Out bounded_sum(LaneSum<SumS, W, Isa> sum,
                                                                    typename Out::Scalar most) {
  const SumS limit = widen<SumS>(most);
  ISO_UNROLL for (int i = 0; i < W; ++i) sum.v[i] = clamp(sum.v[i], -limit, limit);
  return round_to<Out>(sum);
}
/// Registers cannot compare sums, but can compare them rounded to a format of one fraction bit, which has room for
/// every sum. Within the bound the rounded number has room too, and rounding keeps order, so it is clamped afterwards.
template <class Out, class SumS, int W, class Isa>
requires(!PlainSum<LaneSum<SumS, W, Isa>>) ISO_INLINE Out
    bounded_sum(LaneSum<SumS, W, Isa> sum, typename Out::Scalar most) {
  using Coarse = Fixed<typename Out::Scalar::Raw, 1, Out::Scalar::kPolicy>;
  using C = Lanes<Coarse, W, Isa>;
  const C coarse = round_to<C>(sum), bound = C::broadcast(convert<Coarse>(most));
  const Out limit = Out::broadcast(most), fine = clamp(round_to<Out>(sum), -limit, limit);
  return select(less(bound, coarse), limit, select(less(coarse, -bound), -limit, fine));
}
template <class Out, class S, int W, class Isa> ISO_INLINE Out bounded_sum(Lanes<S, W, Isa> sum, S most) {
  const Out limit = Out::broadcast(most);
  return clamp(sum, -limit, limit);
}

/// The largest whole number of a format.
template <class S> ISO_INLINE constexpr S highest_whole() {
  return S::from_raw(static_cast<typename S::Raw>(highest<S>().raw() >> S::kFracBits << S::kFracBits));
}
}  // namespace detail

/// round_to<Out>(clamp(sum, -most, most)), lane by lane. Out is a Lanes type; `most` > 0 is a whole number.
template <class Out, class SumL> ISO_INLINE Out round_within(SumL sum, typename Out::Scalar most) {
  return detail::bounded_sum<Out>(sum, most);
}
/// round_to<Out>(sum), where what is beyond the largest whole number of a fixed-point format ends there.
template <class Out, class SumS, int W, class Isa> ISO_INLINE Out round_saturated(LaneSum<SumS, W, Isa> sum) {
  return detail::bounded_sum<Out>(sum, detail::highest_whole<typename Out::Scalar>());
}
template <class Out, class S, int W, class Isa> ISO_INLINE Out round_saturated(Lanes<S, W, Isa> sum) { return sum; }
/// with_headroom() and round_with_headroom(), lane by lane.
template <class S, int W, class Isa> ISO_INLINE Lanes<S, W, Isa> with_headroom(Lanes<S, W, Isa> x) {
  if constexpr (kIsFixed<S>) {
    const auto half = Lanes<S, W, Isa>::broadcast(detail::half_of_range<S>());
    return clamp(x, -half, half);
  } else {
    return x;
  }
}
template <class Out, class SumS, int W, class Isa> ISO_INLINE Out round_with_headroom(LaneSum<SumS, W, Isa> sum) {
  return detail::bounded_sum<Out>(sum, detail::half_of_range<typename Out::Scalar>());
}
template <class Out, class S, int W, class Isa> ISO_INLINE Out round_with_headroom(Lanes<S, W, Isa> sum) { return sum; }

}  // namespace isostep
