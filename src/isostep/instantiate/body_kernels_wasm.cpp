// The body kernels over WebAssembly's 128-bit lanes, in builds with -msimd128. 64-bit fixed point has no use for two
// lanes: its wide products are faster one by one.
// SPDX-License-Identifier: MIT
#include "isostep/dynamics/solvers/body_kernel.inl"
#if defined(__wasm_simd128__)
#include "isostep/scalar/lanes_wasm.hpp"
#define ISO_WASM_TABLE(S)                             \
  ISO_DEFINE_KERNEL_TABLE(BodyKernels<S>, Simd::wasm, \
                          make_body_kernels<S, kRegisterLanes<S, isa::WasmSimd>, isa::WasmSimd>("wasm"))
#else
#define ISO_WASM_TABLE(S) ISO_NO_KERNEL_TABLE(BodyKernels<S>, Simd::wasm)
#endif
#define ISO_NO_WASM_TABLE(S) ISO_NO_KERNEL_TABLE(BodyKernels<S>, Simd::wasm)

namespace isostep {

ISO_IF_FLOAT(ISO_WASM_TABLE)
ISO_IF_DOUBLE(ISO_WASM_TABLE)
ISO_IF_Q16_16(ISO_WASM_TABLE)
ISO_IF_Q32_32(ISO_NO_WASM_TABLE)

}  // namespace isostep
