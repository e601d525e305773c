// The facts about the compiler that every header needs: inlining, and the flags that would break bit-exactness.
// SPDX-License-Identifier: MIT
#pragma once

// Every header leads here before anything that an older standard does not know.
#if defined(_MSVC_LANG)
#if _MSVC_LANG < 202002L
#error "isostep needs C++20: compile with /std:c++20"
#endif
#elif __cplusplus < 202002L
// This file is not there, which ends gcc and clang in one line: after #error they would go on through two thousand
// more.
#include "isostep needs C++20: compile with -std=c++20"
#endif

#include <cfloat>

#if defined(_MSC_VER) && !defined(__clang__)
#include <intrin.h>
#endif

#if defined(__FAST_MATH__) || defined(__ASSOCIATIVE_MATH__) || defined(__RECIPROCAL_MATH__) || \
    (defined(__FINITE_MATH_ONLY__) && __FINITE_MATH_ONLY__)
#error "isostep: -ffast-math changes results between builds; compile without it"
#endif
#if defined(FLT_EVAL_METHOD) && FLT_EVAL_METHOD != 0
#error "isostep: floating point must be evaluated in its own precision; on i686 add -msse2 -mfpmath=sse"
#endif
// x = *p, *p = y, then x in every lane: clang 14 makes one v128.load32_splat of the first and the last and puts it
// behind the store, so that y is in the lanes, at every level of optimisation but -O0.
#if defined(__wasm_simd128__) && defined(__clang_major__) && __clang_major__ < 16
#error "isostep: clang before 16 reorders loads and stores of WebAssembly's SIMD; leave -msimd128 out, or take clang 16"
#endif

#if defined(min) || defined(max)
#error "isostep: min and max are macros; define NOMINMAX before <windows.h>"
#endif
// No macro tells of gcc's -fsingle-precision-constant, which rounds our defaults to float.
static_assert(sizeof(1.0) == sizeof(double), "isostep: compile without -fsingle-precision-constant");

/// A function that touches a scalar must never leave a weak copy of itself in a user's object: that copy may have been
/// compiled with -mfma, and the linker may keep it for the whole program. Always inlining leaves nothing to keep. With
/// ISOSTEP_OUR_FLAGS this file is compiled with our flags, as the library is, and for no instruction set that another
/// lacks: its copies are as good as any. Then the compiler chooses, which builds sooner and smaller.
#if defined(ISOSTEP_OUR_FLAGS)
#define ISO_INLINE inline
#define ISO_INLINE_LAMBDA
#elif defined(_MSC_VER) && !defined(__clang__)
#define ISO_INLINE __forceinline
#define ISO_INLINE_LAMBDA
#else
#define ISO_INLINE inline __attribute__((always_inline))
/// Marks a lambda in such a function, whose call operator is a function too: `[&](S x) ISO_INLINE_LAMBDA { ... }`.
#define ISO_INLINE_LAMBDA __attribute__((always_inline))
#endif

#if defined(_MSC_VER) && !defined(__clang__)
#define ISO_NOINLINE __declspec(noinline)
#else
#define ISO_NOINLINE __attribute__((noinline))
#endif

/// Ends the program: to go on would be to compute nonsense.
#if defined(_MSC_VER) && !defined(__clang__)
#define ISO_TRAP() __debugbreak()
#else
#define ISO_TRAP() __builtin_trap()
#endif

/// Checks for a caller's bug in builds that define ISOSTEP_ASSERTS; free elsewhere.
#if defined(ISOSTEP_ASSERTS)
#define ISO_ASSERT(condition) ((condition) ? void(0) : ISO_TRAP())
#else
#define ISO_ASSERT(condition) void(0)
#endif
