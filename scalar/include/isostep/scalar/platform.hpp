// What every header needs to know of the compiler: inlining, and the flags that would break bit-exactness.
// SPDX-License-Identifier: MIT
#pragma once

#include <cfloat>

#if defined(__FAST_MATH__) || defined(__ASSOCIATIVE_MATH__) || defined(__RECIPROCAL_MATH__) || \
    (defined(__FINITE_MATH_ONLY__) && __FINITE_MATH_ONLY__)
#error "isostep: -ffast-math changes results between builds; compile without it"
#endif
#if defined(FLT_EVAL_METHOD) && FLT_EVAL_METHOD != 0
#error "isostep: floating point must be evaluated in its own precision; on i686 add -msse2 -mfpmath=sse"
#endif

/// A function that touches a scalar must never leave a weak copy of itself in a user's object: that copy may have been
/// compiled with -mfma and the linker may keep it for the whole program. Always inlining leaves nothing to keep.
#if defined(_MSC_VER) && !defined(__clang__)
#define ISO_INLINE __forceinline
#define ISO_INLINE_LAMBDA
#else
#define ISO_INLINE inline __attribute__((always_inline))
/// For a lambda in such a function, whose call operator is a function too: `[&](S x) ISO_INLINE_LAMBDA { ... }`.
#define ISO_INLINE_LAMBDA __attribute__((always_inline))
#endif

/// Caller's bug: checked in builds that define ISOSTEP_ASSERTS, free elsewhere.
#if defined(ISOSTEP_ASSERTS)
#define ISO_ASSERT(condition) ((condition) ? void(0) : __builtin_trap())
#else
#define ISO_ASSERT(condition) void(0)
#endif
