// The tree kernels over WebAssembly's 128-bit lanes, in builds with -msimd128. 64-bit fixed point has no use for two
// lanes: its wide products are faster one by one.
// SPDX-License-Identifier: MIT
#include "isostep/dynamics/joints/tree_kernel.inl"
#if defined(__wasm_simd128__)
#include "isostep/scalar/lanes_wasm.hpp"
#endif

namespace isostep {

#if defined(__wasm_simd128__)
#define ISO_DEFINE_WASM_KERNELS(S, W)                                                        \
  template <> const TreeKernels<S>* detail::wasm_tree_kernels<S>() {                         \
    static constexpr TreeKernels<S> kTable = make_tree_kernels<S, W, isa::WasmSimd>("wasm"); \
    return &kTable;                                                                          \
  }
#else
#define ISO_DEFINE_WASM_KERNELS(S, W) \
  template <> const TreeKernels<S>* detail::wasm_tree_kernels<S>() { return nullptr; }
#endif
#define ISO_NO_WASM_KERNELS(S) \
  template <> const TreeKernels<S>* detail::wasm_tree_kernels<S>() { return nullptr; }

#define ISO_WASM_NARROW(S) ISO_DEFINE_WASM_KERNELS(S, 4)
#define ISO_WASM_WIDE(S) ISO_DEFINE_WASM_KERNELS(S, 2)
ISO_IF_FLOAT(ISO_WASM_NARROW)
ISO_IF_DOUBLE(ISO_WASM_WIDE)
ISO_IF_Q16_16(ISO_WASM_NARROW)
ISO_IF_Q32_32(ISO_NO_WASM_KERNELS)

}  // namespace isostep
