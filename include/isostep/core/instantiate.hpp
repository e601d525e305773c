// The list of shipped scalars, for explicit instantiation: one place says which engines the library holds.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/core/containers_tag.hpp"
#include "isostep/scalar/scalar.hpp"

/// ISO_FOR_EACH_SCALAR(X) expands X(S) for every scalar the library was built for. CMake's ISOSTEP_SCALARS trims it.
/// ISO_NAME_OF(keyword, S) lists what a header has to instantiate. With `extern` as the keyword, by
/// ISO_EXTERN_FOR_EACH_SCALAR in the header, a program takes it from the library; without one it is instantiated, by
/// the library's sources and by ISO_INSTANTIATE_ENGINE.
#if !defined(ISOSTEP_NO_FLOAT)
#define ISO_IF_FLOAT(X) X(float)
#define ISO_EXTERN_FLOAT(OF) OF(extern, float)
#else
#define ISO_IF_FLOAT(X)
#define ISO_EXTERN_FLOAT(OF)
#endif
#if !defined(ISOSTEP_NO_DOUBLE)
#define ISO_IF_DOUBLE(X) X(double)
#define ISO_EXTERN_DOUBLE(OF) OF(extern, double)
#else
#define ISO_IF_DOUBLE(X)
#define ISO_EXTERN_DOUBLE(OF)
#endif
#if !defined(ISOSTEP_NO_Q16_16)
#define ISO_IF_Q16_16(X) X(::isostep::Q16_16)
#define ISO_EXTERN_Q16_16(OF) OF(extern, ::isostep::Q16_16)
#else
#define ISO_IF_Q16_16(X)
#define ISO_EXTERN_Q16_16(OF)
#endif
#if !defined(ISOSTEP_NO_Q32_32)
#define ISO_IF_Q32_32(X) X(::isostep::Q32_32)
#define ISO_EXTERN_Q32_32(OF) OF(extern, ::isostep::Q32_32)
#else
#define ISO_IF_Q32_32(X)
#define ISO_EXTERN_Q32_32(OF)
#endif
#define ISO_FOR_EACH_SCALAR(X) ISO_IF_FLOAT(X) ISO_IF_DOUBLE(X) ISO_IF_Q16_16(X) ISO_IF_Q32_32(X)
#define ISO_EXTERN_FOR_EACH_SCALAR(OF) \
  ISO_EXTERN_FLOAT(OF) ISO_EXTERN_DOUBLE(OF) ISO_EXTERN_Q16_16(OF) ISO_EXTERN_Q32_32(OF)

namespace isostep {

/// True if the library holds the engine of S, or the program says that it brings its own engines.
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
