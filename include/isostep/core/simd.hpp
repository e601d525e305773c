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

namespace detail {
/// A table of kernels for one instruction set: a strong symbol of the one file that is compiled for it, null where this
/// build has none. Under ISOSTEP_NO_SIMD there are the files of one lane alone.
template <class Kernels, Simd simd> const Kernels* kernel_table();

template <class Kernels> ISO_INLINE const Kernels* kernel_table_of(Simd simd) {
  switch (simd) {
#if !defined(ISOSTEP_NO_SIMD)
    case Simd::sse2: return kernel_table<Kernels, Simd::sse2>();
    case Simd::avx2: return kernel_table<Kernels, Simd::avx2>();
    case Simd::avx512: return kernel_table<Kernels, Simd::avx512>();
    case Simd::neon: return kernel_table<Kernels, Simd::neon>();
    case Simd::wasm: return kernel_table<Kernels, Simd::wasm>();
#endif
    case Simd::best:
    case Simd::scalar: return kernel_table<Kernels, Simd::scalar>();
    default: return nullptr;
  }
}
}  // namespace detail

/// The kernels for `simd`: null where build or processor lack them. For `best` the widest there are; those of one lane
/// always are.
template <class Kernels> ISO_INLINE const Kernels* choose_kernels(Simd simd) {
  if (simd != Simd::best) return processor_has(simd) ? detail::kernel_table_of<Kernels>(simd) : nullptr;
  for (const Simd wide : {Simd::avx512, Simd::avx2, Simd::sse2, Simd::neon, Simd::wasm}) {
    const Kernels* const kernels = processor_has(wide) ? detail::kernel_table_of<Kernels>(wide) : nullptr;
    if (kernels != nullptr) return kernels;
  }
  return detail::kernel_table<Kernels, Simd::scalar>();
}

#define ISO_DECLARE_KERNEL_TABLE(KERNELS, SIMD) template <> const KERNELS* detail::kernel_table<KERNELS, SIMD>();
#define ISO_DECLARE_KERNEL_TABLES(KERNELS)        \
  ISO_DECLARE_KERNEL_TABLE(KERNELS, Simd::scalar) \
  ISO_DECLARE_KERNEL_TABLE(KERNELS, Simd::sse2)   \
  ISO_DECLARE_KERNEL_TABLE(KERNELS, Simd::avx2)   \
  ISO_DECLARE_KERNEL_TABLE(KERNELS, Simd::avx512) \
  ISO_DECLARE_KERNEL_TABLE(KERNELS, Simd::neon)   \
  ISO_DECLARE_KERNEL_TABLE(KERNELS, Simd::wasm)
/// For the files of one instruction set: the table, or that there is none.
#define ISO_DEFINE_KERNEL_TABLE(KERNELS, SIMD, ...)                  \
  template <> const KERNELS* detail::kernel_table<KERNELS, SIMD>() { \
    static constexpr KERNELS kTable = __VA_ARGS__;                   \
    return &kTable;                                                  \
  }
#define ISO_NO_KERNEL_TABLE(KERNELS, SIMD) \
  template <> const KERNELS* detail::kernel_table<KERNELS, SIMD>() { return nullptr; }

}  // namespace isostep
