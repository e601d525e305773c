// The instruction sets that kernels exist for, and the choice among them.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <initializer_list>

#include "isostep/scalar/platform.hpp"

/// ISO_FOR_EACH_SIMD(X, with) expands X(name, with) for every instruction set: in Simd and on the command line.
#define ISO_FOR_EACH_SIMD(X, with) \
  X(scalar, with) X(sse2, with) X(avx2, with) X(avx512, with) X(neon, with) X(wasm, with)

namespace isostep {

/// The lanes that a step takes. They never change a bit. `scalar` is one lane, the reference, on any machine; sse2 has
/// four lanes of float or two of double, avx2 eight of 32 bits or four of 64, avx512 twice as many; neon (64-bit Arm)
/// and wasm (WebAssembly's SIMD128) have four of 32 bits or two of double. `best` is the widest there is.
#define ISO_ENUMERATOR(name, unused) name,
enum class Simd : std::uint32_t { best, ISO_FOR_EACH_SIMD(ISO_ENUMERATOR, ) };
#undef ISO_ENUMERATOR

#define ISO_NAME(name, unused) #name,
inline constexpr const char* kSimdNames[] = {"best", ISO_FOR_EACH_SIMD(ISO_NAME, )};
#undef ISO_NAME
inline constexpr std::uint32_t kSimds = sizeof kSimdNames / sizeof kSimdNames[0];

/// Returns true if the processor, as its operating system runs it, has the instructions that kernels for `simd` use.
bool processor_has(Simd simd);

namespace detail {
/// A table of kernels for one instruction set: a strong symbol of the one file that is compiled for it, null where this
/// build has none. Under ISOSTEP_NO_SIMD there are the files of one lane alone.
template <class Kernels, Simd simd> const Kernels* kernel_table();

template <class Kernels> ISO_INLINE const Kernels* kernel_table_of(Simd simd) {
  if (simd == Simd::best) return kernel_table<Kernels, Simd::scalar>();
#if defined(ISOSTEP_NO_SIMD)
  return simd == Simd::scalar ? kernel_table<Kernels, Simd::scalar>() : nullptr;
#else
#define ISO_RETURN_TABLE(name, unused) \
  if (simd == Simd::name) return kernel_table<Kernels, Simd::name>();
  ISO_FOR_EACH_SIMD(ISO_RETURN_TABLE, )
#undef ISO_RETURN_TABLE
  return nullptr;
#endif
}
}  // namespace detail

/// Returns the kernels for `simd`, or null if the build or the processor lacks them. For `best` the widest there are:
/// those of one lane always are.
template <class Kernels> ISO_INLINE const Kernels* choose_kernels(Simd simd) {
  if (simd != Simd::best) return processor_has(simd) ? detail::kernel_table_of<Kernels>(simd) : nullptr;
  for (const Simd wide : {Simd::avx512, Simd::avx2, Simd::sse2, Simd::neon, Simd::wasm}) {
    const Kernels* const kernels = processor_has(wide) ? detail::kernel_table_of<Kernels>(wide) : nullptr;
    if (kernels != nullptr) return kernels;
  }
  return detail::kernel_table<Kernels, Simd::scalar>();
}

#define ISO_DECLARE_KERNEL_TABLE(name, KERNELS) template <> const KERNELS* detail::kernel_table<KERNELS, Simd::name>();
#define ISO_DECLARE_KERNEL_TABLES(KERNELS) ISO_FOR_EACH_SIMD(ISO_DECLARE_KERNEL_TABLE, KERNELS)
/// These define the kernel table in the file of one instruction set, or that there is none.
#define ISO_DEFINE_KERNEL_TABLE(KERNELS, SIMD, ...)                  \
  template <> const KERNELS* detail::kernel_table<KERNELS, SIMD>() { \
    static constexpr KERNELS kTable = __VA_ARGS__;                   \
    return &kTable;                                                  \
  }
#define ISO_NO_KERNEL_TABLE(KERNELS, SIMD) \
  template <> const KERNELS* detail::kernel_table<KERNELS, SIMD>() { return nullptr; }

}  // namespace isostep
