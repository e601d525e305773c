// The pair kernels over WebAssembly's 128-bit lanes, in builds with -msimd128. Two lanes of 64 bits keep to one, as
// those of SSE2 do.
// SPDX-License-Identifier: MIT
#include "isostep/collision/narrowphase/pair_kernel.inl"
#if defined(__wasm_simd128__)
#include "isostep/scalar/lanes_wasm.hpp"
#endif

namespace isostep {

#define ISO_NO_WASM_PAIRS(S) \
  template <> const PairKernels<S>* detail::wasm_pair_kernels<S>() { return nullptr; }
#if defined(__wasm_simd128__)
#define ISO_DEFINE_WASM_PAIRS(S, BOXES)                                                                \
  template <> const PairKernels<S>* detail::wasm_pair_kernels<S>() {                                   \
    static constexpr PairKernels<S> kTable = make_pair_kernels<S, 4, isa::WasmSimd, BoxWork::BOXES>(); \
    return &kTable;                                                                                    \
  }
#else
#define ISO_DEFINE_WASM_PAIRS(S, BOXES) ISO_NO_WASM_PAIRS(S)
#endif
#define ISO_WASM_FLOAT_PAIRS(S) ISO_DEFINE_WASM_PAIRS(S, polygons)
#define ISO_WASM_Q16_16_PAIRS(S) ISO_DEFINE_WASM_PAIRS(S, axes)
ISO_IF_FLOAT(ISO_WASM_FLOAT_PAIRS)
ISO_IF_DOUBLE(ISO_NO_WASM_PAIRS)
ISO_IF_Q16_16(ISO_WASM_Q16_16_PAIRS)
ISO_IF_Q32_32(ISO_NO_WASM_PAIRS)

}  // namespace isostep
