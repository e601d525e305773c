// The families of the C interface: the scalars that it has names for, in the order of iso_scalar.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/core/instantiate.hpp"
#include "isostep/scalar/scalar.hpp"

/// X(P, S) has the prefix of the family in C, and its scalar. ISO_C_SCALARS of isostep.h is the same list.
#define ISO_C_FAMILIES(X) X(f32, float) X(f64, double) X(q16, ::isostep::Q16_16) X(q32, ::isostep::Q32_32)

namespace isostep::c {

enum class ScalarName : std::uint32_t { f32, f64, q16, q32 };

template <class S> inline constexpr ScalarName kScalarName = ScalarName::f32;
#define ISO_NAME(P, S) template <> inline constexpr ScalarName kScalarName<S> = ScalarName::P;
ISO_C_FAMILIES(ISO_NAME)
#undef ISO_NAME

/// True if this build of the library has the engine of S.
template <class S> inline constexpr bool kIsBuilt = false;
#define ISO_BUILT(S) template <> inline constexpr bool kIsBuilt<S> = true;
ISO_FOR_EACH_SCALAR(ISO_BUILT)
#undef ISO_BUILT

}  // namespace isostep::c
