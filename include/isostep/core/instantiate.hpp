// The list of shipped scalars, for explicit instantiation: one place says which engines the library holds.
// SPDX-License-Identifier: MIT
#pragma once

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
