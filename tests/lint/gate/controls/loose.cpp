// A control that the gate must see: an estimate whose bits are the processor's own. x86 has one that C++ can name.
// SPDX-License-Identifier: MIT
#include <immintrin.h>
__m128 estimate(__m128 a) { return _mm_rsqrt_ps(a); }
