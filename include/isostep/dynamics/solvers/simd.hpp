// The names of the instruction sets that kernels exist for.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

namespace isostep {

/// Which lanes step the constraints. Never changes a bit. `scalar` is one lane, the reference, on any machine; sse2 has
/// four lanes of float or two of double, avx2 eight of 32 bits or four of 64, avx512 twice as many. `best` is the
/// widest that the processor has.
enum class Simd : std::uint32_t { best, scalar, sse2, avx2, avx512 };

}  // namespace isostep
