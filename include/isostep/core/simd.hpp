// The instruction sets that kernels exist for, and the choice among them.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <initializer_list>

#include "isostep/scalar/platform.hpp"

namespace isostep {

/// Which lanes step the constraints. Never changes a bit. `scalar` is one lane, the reference, on any machine; sse2 has
/// four lanes of float or two of double, avx2 eight of 32 bits or four of 64, avx512 twice as many; neon (64-bit Arm)
/// and wasm (WebAssembly's SIMD128) have four of 32 bits or two of double. `best` is the widest there is.
enum class Simd : std::uint32_t { best, scalar, sse2, avx2, avx512, neon, wasm };

/// Whether the processor, as its operating system runs it, has what kernels for `simd` use.
bool processor_has(Simd simd);

/// The kernels for `simd`, of(simd) being what this build has: null where build or processor lack them. For `best` the
/// widest there are; those of one lane always are.
template <class Kernels> ISO_INLINE const Kernels* choose_kernels(Simd simd, const Kernels* (*of)(Simd)) {
  if (simd != Simd::best) return processor_has(simd) ? of(simd) : nullptr;
  for (const Simd wide : {Simd::avx512, Simd::avx2, Simd::sse2, Simd::neon, Simd::wasm}) {
    const Kernels* const kernels = processor_has(wide) ? of(wide) : nullptr;
    if (kernels != nullptr) return kernels;
  }
  return of(Simd::scalar);
}

}  // namespace isostep
