// keep_finite: records that a step writes have only finite numbers, as BodyFinisher keeps it of bodies.
// SPDX-License-Identifier: MIT
#pragma once

#include <type_traits>

#include "isostep/core/fields.hpp"

namespace isostep::detail {

/// Returns the finite number nearest to `a`: 0 for a NaN, the end of the format for an infinity.
template <class S> ISO_INLINE constexpr S finite_of(S a) {
  if (is_finite(a)) return a;
  return S(0) < a ? highest<S>() : a < S(0) ? -highest<S>() : S(0);
}

struct FiniteGuard {
  template <class T> ISO_INLINE constexpr void operator()(const char*, T& value) const {
    if constexpr (std::is_bounded_array_v<T>) {
      for (auto& each : value) (*this)("", each);
    } else if constexpr (HasFields<T>) {
      T::fields(*this, value);
    } else if constexpr (Scalar<T>) {
      value = finite_of(value);
    }
  }
};
/// Makes all fields of a record finite. No NaN may get into a record: its sign bit depends on the lanes that made it,
/// and so would the hash. A state with a NaN is refused when it is read.
template <class Record> ISO_INLINE constexpr void keep_finite(Record& record) { Record::fields(FiniteGuard{}, record); }

}  // namespace isostep::detail
