// The list of shipped scalars, for explicit instantiation: one place says which engines the library holds.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/core/containers_tag.hpp"
#include "isostep/scalar/scalar.hpp"

/// ISO_FOR_EACH_SCALAR(X) expands X(S) for every scalar the library was built for. CMake's ISOSTEP_SCALARS trims it.
#if !defined(ISOSTEP_NO_FLOAT)
#define ISO_IF_FLOAT(X) X(float)
#else
#define ISO_IF_FLOAT(X)
#endif
#if !defined(ISOSTEP_NO_DOUBLE)
#define ISO_IF_DOUBLE(X) X(double)
#else
#define ISO_IF_DOUBLE(X)
#endif
#if !defined(ISOSTEP_NO_Q16_16)
#define ISO_IF_Q16_16(X) X(::isostep::Q16_16)
#else
#define ISO_IF_Q16_16(X)
#endif
#if !defined(ISOSTEP_NO_Q32_32)
#define ISO_IF_Q32_32(X) X(::isostep::Q32_32)
#else
#define ISO_IF_Q32_32(X)
#endif
#define ISO_FOR_EACH_SCALAR(X) ISO_IF_FLOAT(X) ISO_IF_DOUBLE(X) ISO_IF_Q16_16(X) ISO_IF_Q32_32(X)

namespace isostep {

/// The library holds the engine of S, or the program says that it brings engines of its own.
#if defined(ISOSTEP_OWN_SCALARS)
template <class S> inline constexpr bool kHasEngine = true;
#else
template <class S> inline constexpr bool kHasEngine = false;
#define ISO_HAS_ENGINE(S) template <> inline constexpr bool kHasEngine<S> = true;
ISO_FOR_EACH_SCALAR(ISO_HAS_ENGINE)
#undef ISO_HAS_ENGINE
#endif

}  // namespace isostep

/// Every class of worlds states this: one error here instead of dozens from the linker.
#define ISO_REQUIRE_ENGINE(S)                                                                              \
  static_assert(::isostep::kHasEngine<S>,                                                                  \
                "isostep: this build of the library has no engine for this scalar: name a shipped one in " \
                "ISOSTEP_SCALARS, or say isostep_add_scalar(target \"its type\") in CMake")
