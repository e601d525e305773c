// The pair kernels over WebAssembly's 128-bit lanes, in builds with -msimd128. Two lanes of 64 bits keep to one, as
// those of SSE2 do.
// SPDX-License-Identifier: MIT
#include "isostep/collision/narrowphase/pair_kernel.inl"
#if defined(__wasm_simd128__)
#include "isostep/scalar/lanes_wasm.hpp"
#define ISO_WASM_TABLE(S, BOXES)                      \
  ISO_DEFINE_KERNEL_TABLE(PairKernels<S>, Simd::wasm, \
                          make_pair_kernels<S, kRegisterLanes<S, isa::WasmSimd>, isa::WasmSimd, BoxWork::BOXES>())
#else
#define ISO_WASM_TABLE(S, BOXES) ISO_NO_KERNEL_TABLE(PairKernels<S>, Simd::wasm)
#endif
#define ISO_WASM_POLYGONS(S) ISO_WASM_TABLE(S, polygons)
#define ISO_WASM_AXES(S) ISO_WASM_TABLE(S, axes)
#define ISO_NO_WASM_TABLE(S) ISO_NO_KERNEL_TABLE(PairKernels<S>, Simd::wasm)

namespace isostep {

ISO_IF_FLOAT(ISO_WASM_POLYGONS)
ISO_IF_DOUBLE(ISO_NO_WASM_TABLE)
ISO_IF_Q16_16(ISO_WASM_AXES)
ISO_IF_Q32_32(ISO_NO_WASM_TABLE)

}  // namespace isostep
