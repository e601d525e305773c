// The processor's floating-point state: pinned for a call, restored after; and a probe of what is not as it must be.
// SPDX-License-Identifier: MIT
#pragma once

#include <bit>
#include <cstdint>
#include <optional>
#include <type_traits>
#include <utility>

#include "isostep/scalar/platform.hpp"

#if defined(_MSC_VER) && !defined(__clang__)
#include <intrin.h>
#endif

namespace isostep {

namespace detail {
/// The control and status bits of this thread's floating-point unit, as one word. `kForced` are the bits that decide
/// results, traps included; all of them are zero in IEEE 754's default state but the masks of x86, `kMasks`. Those of
/// `kTraps` enable a trap when they are set.
/// Registers, not <fenv.h>: that is part of the C mathematics library, and knows nothing of denormals.
struct FloatState {
#if defined(__SSE2__) || defined(_M_X64) || (defined(_M_IX86_FP) && _M_IX86_FP == 2)
  // Intel SDM vol. 1, 10.2.3: DAZ 6, exception masks 7-12, rounding 13-14, FTZ 15; flags 0-5.
#if defined(__GNUC__) && defined(__i386__)
  // Vol. 1, 8.1.5, in the high half: the x87 control word, by which 32-bit code converts 64-bit integers though it
  // calculates with SSE. Masks 0-5, rounding 10-11; the precision is for sums, of which we have none there. Above it,
  // from bit 48, the flags of the x87 status word (8.1.3): one that a conversion raised would trap in a caller who does
  // not mask it.
  static constexpr std::uint64_t kForced = 0x0c3f'0000'ffc0, kMasks = 0x003f'0000'1f80, kTraps = 0;
#else
  static constexpr std::uint64_t kForced = 0xffc0, kMasks = 0x1f80, kTraps = 0;
#endif
  static ISO_INLINE std::uint64_t read() {
#if defined(_MSC_VER) && !defined(__clang__)
    return _mm_getcsr();
#else
    std::uint32_t word;
    __asm__ volatile("stmxcsr %0" : "=m"(word) : : "memory");
#if defined(__i386__)
    std::uint16_t control, status;
    __asm__ volatile("fnstcw %0\n\tfnstsw %1" : "=m"(control), "=m"(status) : : "memory");
    return word | std::uint64_t(control) << 32 | std::uint64_t(status & kFlags) << 48;
#else
    return word;
#endif
#endif
  }
  static ISO_INLINE void write(std::uint64_t state) {
    const auto word = static_cast<std::uint32_t>(state);
#if defined(_MSC_VER) && !defined(__clang__)
    _mm_setcsr(word);
#else
    __asm__ volatile("ldmxcsr %0" : : "m"(word) : "memory");
#if defined(__i386__)
    write_x87(static_cast<std::uint32_t>(state >> 32 & 0xffff), static_cast<std::uint32_t>(state >> 48));
#endif
#endif
  }
#if defined(__GNUC__) && defined(__i386__)
  // Flags are written only with the whole environment of 28 bytes (8.1.10): control in its first word, status in its
  // second, where bits 7 and 15 say that a flag has no mask. The stack of registers stays.
  static constexpr std::uint32_t kFlags = 0x7f, kPending = 0x8080;
  static ISO_INLINE void write_x87(std::uint32_t control, std::uint32_t flags) {
    std::uint32_t environment[7];
    __asm__ volatile("fnstenv %0" : "=m"(environment) : : "memory");
    environment[0] = (environment[0] & 0xffff0000u) | control;
    const std::uint32_t pending = (flags & ~control & 0x3fu) != 0 ? kPending : 0;
    environment[1] = (environment[1] & ~(kFlags | kPending)) | flags | pending;
    __asm__ volatile("fldenv %0" : : "m"(environment) : "memory");
  }
#endif
#elif defined(__GNUC__) && defined(__aarch64__)
  // Arm ARM, FPCR: FIZ 0, AH 1, NEP 2, traps 8-12 and 15, FZ16 19, rounding 22-23, FZ 24, DN 25. FPSR in the high half.
  static constexpr std::uint64_t kForced = 0x03c89f07, kMasks = 0, kTraps = 0x9f00;
  static ISO_INLINE std::uint64_t read() {
    std::uint64_t control, status;
    __asm__ volatile("mrs %0, fpcr\n\tmrs %1, fpsr" : "=r"(control), "=r"(status) : : "memory");
    return status << 32 | (control & 0xffffffffu);
  }
  static ISO_INLINE void write(std::uint64_t state) {
    const std::uint64_t control = state & 0xffffffffu;
    const std::uint64_t status = state >> 32;
    __asm__ volatile("msr fpcr, %0\n\tmsr fpsr, %1" : : "r"(control), "r"(status) : "memory");
  }
#elif defined(__GNUC__) && defined(__arm__) && defined(__ARM_FP)
  // Arm ARM, FPSCR: flags 0-7, traps 8-12 and 15, rounding 22-23, FZ 24, DN 25.
  static constexpr std::uint64_t kForced = 0x03c09f00, kMasks = 0, kTraps = 0x9f00;
  static ISO_INLINE std::uint64_t read() {
    std::uint32_t word;
    __asm__ volatile("vmrs %0, fpscr" : "=r"(word) : : "memory");
    return word;
  }
  static ISO_INLINE void write(std::uint64_t state) {
    __asm__ volatile("vmsr fpscr, %0" : : "r"(static_cast<std::uint32_t>(state)) : "memory");
  }
#elif defined(__GNUC__) && defined(__riscv_flen)
  // RISC-V unprivileged ISA, fcsr: flags 0-4, rounding 5-7. Always denormals, never traps.
  static constexpr std::uint64_t kForced = 0xe0, kMasks = 0, kTraps = 0;
  static ISO_INLINE std::uint64_t read() {
    std::uintptr_t word;
    __asm__ volatile("frcsr %0" : "=r"(word) : : "memory");
    return word;
  }
  static ISO_INLINE void write(std::uint64_t state) {
    __asm__ volatile("fscsr %0" : : "r"(static_cast<std::uintptr_t>(state)) : "memory");
  }
#elif defined(__GNUC__) && defined(__s390x__)
  // z/Architecture Principles of Operation, FPC: trap masks in the top byte, binary rounding in the low three bits.
  static constexpr std::uint64_t kForced = 0xfc000007, kMasks = 0, kTraps = 0xfc000000;
  static ISO_INLINE std::uint64_t read() {
    std::uint32_t word;
    __asm__ volatile("stfpc %0" : "=Q"(word) : : "memory");
    return word;
  }
  static ISO_INLINE void write(std::uint64_t state) {
    const auto word = static_cast<std::uint32_t>(state);
    __asm__ volatile("lfpc %0" : : "Q"(word) : "memory");
  }
#elif defined(__GNUC__) && defined(__powerpc__) && !defined(_SOFT_FLOAT)
  // Power ISA, FPSCR, counted from the right: rounding 0-1, NI 2 (denormals to zero), enables of exceptions 3-7; all
  // else are flags. It comes and goes through a floating-point register.
  static constexpr std::uint64_t kForced = 0xff, kMasks = 0, kTraps = 0xf8;
  static ISO_INLINE std::uint64_t read() {
    double word;
    __asm__ volatile("mffs %0" : "=f"(word) : : "memory");
    return std::bit_cast<std::uint64_t>(word) & 0xffffffffu;
  }
  static ISO_INLINE void write(std::uint64_t state) {
    __asm__ volatile("mtfsf 255,%0" : : "f"(std::bit_cast<double>(state)) : "memory");
  }
#else
  static constexpr std::uint64_t kForced = 0, kMasks = 0,
                                 kTraps = 0;  // wasm has no such state; elsewhere the probe must do
  static ISO_INLINE std::uint64_t read() { return 0; }
  static ISO_INLINE void write(std::uint64_t) {}
#endif

  static ISO_INLINE constexpr std::uint64_t pinned(std::uint64_t state) { return (state & ~kForced) | kMasks; }
  static ISO_INLINE constexpr std::uint64_t without_traps(std::uint64_t state) { return (state & ~kTraps) | kMasks; }
};
}  // namespace detail

namespace detail {
/// A guard: while it lives, this thread computes in IEEE 754's default state: to nearest, denormals kept, no traps.
/// Then the caller's state, sticky flags included, returns bit for bit. It costs a read or two if nothing is amiss, for
/// a write stalls the pipeline. Only pin_floats() holds one: compilers know nothing of it, and move arithmetic over it.
class FloatEnvironment {
 public:
  ISO_INLINE FloatEnvironment() : caller_(FloatState::read()) {
    const std::uint64_t pinned = FloatState::pinned(caller_);
    if (pinned != caller_) FloatState::write(pinned);
  }
  ISO_INLINE ~FloatEnvironment() {
    if (FloatState::read() != caller_) FloatState::write(caller_);
  }
  FloatEnvironment(const FloatEnvironment&) = delete;
  FloatEnvironment& operator=(const FloatEnvironment&) = delete;

 private:
  std::uint64_t caller_;
};

/// A barrier for the compiler: no read or write of what `of` refers to moves across this line.
template <class T> ISO_INLINE void hold_in_memory(const T& of) {
#if defined(__GNUC__)
  __asm__ volatile("" : : "r"(&of) : "memory");
#else
  static_cast<void>(of);  // a call that is not inlined suffices where the compiler does not analyse it
#endif
}
template <class Work> ISO_NOINLINE void run_alone(const Work& work) { work(); }
}  // namespace detail

/// Runs work() in IEEE 754's default state (to nearest, denormals kept, no traps) and returns its result. A library
/// linked with -ffast-math, a driver or a game may have changed the state; the caller's returns afterwards. `work`
/// takes numbers by reference: then its operands are read from memory after the environment is set, its result is there
/// before the caller's state returns, and none of its arithmetic lies outside.
template <class Work> ISO_INLINE auto pin_floats(const Work& work) -> decltype(work()) {
  if constexpr (std::is_void_v<decltype(work())>) {
    const detail::FloatEnvironment environment;
    detail::hold_in_memory(work);
    detail::run_alone(work);
  } else {
    std::optional<decltype(work())> result;
    const auto keep = [&] { result.emplace(work()); };
    {
      const detail::FloatEnvironment environment;
      detail::hold_in_memory(keep);
      detail::run_alone(keep);
      detail::hold_in_memory(result);
    }
    return *std::move(result);
  }
}

namespace detail {
/// Returns the number that a call returns, taken through memory. For functions that call several: on i386 a number
/// comes back in an x87 register, and a compiler may keep it there, 80 bits wide, over the calls that follow.
template <class Call> ISO_INLINE auto stored(const Call& call) -> decltype(call()) {
  decltype(call()) result = {};
  run_alone([&] { result = call(); });
  return result;
}
}  // namespace detail

/// The findings of the probe: bit n of its result is the n-th of these. One cause may set several: rounding upwards
/// looks like contraction too.
enum class Deviation : std::uint8_t {
  flush_float,  // a denormal result became zero
  flush_double,
  zero_float,  // a denormal operand counted as zero
  zero_double,
  rounding,        // not to nearest
  contract_float,  // a * b + c was fused
  contract_double,
  contract_pair,  // a vectoriser fused the rows of a rotation, which it does in spite of -ffp-contract=off
  excess_float,   // a sum kept more bits than its type, or was reassociated
  excess_double,
  double_rounding,  // rounded to 64 bits first and to 53 after
  reciprocal,       // a quotient is not to nearest: multiplied by an estimate
  nan_equal,        // NaN == NaN
  zero_sign,        // -0 + 0 is -0
};
inline constexpr int kDeviationCount = 14;
inline constexpr const char* kDeviationNames[kDeviationCount] = {
    "flush-float",     "flush-double",    "zero-float",    "zero-double",  "rounding",
    "contract-float",  "contract-double", "contract-pair", "excess-float", "excess-double",
    "double-rounding", "reciprocal",      "nan-equal",     "zero-sign"};
ISO_INLINE constexpr std::uint32_t bit_of(Deviation deviation) { return 1u << static_cast<unsigned>(deviation); }

namespace detail {
/// x cos - y sin and x sin + y cos, in the form that gcc's vectorisers turn into one fused instruction; for x = y = s,
/// sin = cos = s the first is exactly 0, the second twice the rounded square.
ISO_INLINE bool pair_is_fused() {
  volatile double input[2] = {1 + 0x1p-30, 1 + 0x1p-30};
  const double x = input[0], y = input[1], c = input[1], s = input[0];
  double out[2] = {x * c - y * s, x * s + y * c};
#if defined(__GNUC__)
  __asm__ volatile("" : : "r"(out) : "memory");
#endif
  volatile double kept[2] = {out[0], out[1]};
  return kept[0] != 0 || kept[1] != 2 + 0x1p-28;
}

ISO_INLINE std::uint32_t when(bool deviates, Deviation deviation) { return deviates ? bit_of(deviation) : 0u; }
// The bits are compared: a comparison of numbers takes denormals for zero as well.
ISO_INLINE bool is_zero(float x) { return (std::bit_cast<std::uint32_t>(x) << 1) == 0; }
ISO_INLINE bool is_zero(double x) { return (std::bit_cast<std::uint64_t>(x) << 1) == 0; }

ISO_INLINE std::uint32_t probe_denormals() {
  volatile float quarter = 0.25f, least = 0x1p-126f, tiny = 0x1p-149f, large = 0x1p100f;
  volatile double dquarter = 0.25, dsmall = 0x1p-1022, dtiny = 0x1p-1074, dlarge = 0x1p1000;
  volatile float made = least * quarter, taken = tiny * large;
  volatile double dmade = dsmall * dquarter, dtaken = dtiny * dlarge;
  return when(is_zero(float(made)), Deviation::flush_float) | when(is_zero(double(dmade)), Deviation::flush_double) |
         when(is_zero(float(taken)), Deviation::zero_float) | when(is_zero(double(dtaken)), Deviation::zero_double);
}

ISO_INLINE std::uint32_t probe_rounding() {
  // Upwards spoils the first, downwards the second, towards zero the third.
  volatile float one = 1, bit = 0x1p-25f, more = 0x1.8p-24f, next = 1 + 0x1p-23f;
  volatile float up = one + bit, down = -one - bit, zero = one + more;
  std::uint32_t found = when(up != 1 || down != -1 || zero != next, Deviation::rounding);
  // Conversions, which i686 does in another unit.
  volatile std::int64_t odd = (std::int64_t(1) << 40) + 1, most = (std::int64_t(1) << 40) + (3 << 15);
  const float over = static_cast<float>(odd), under = static_cast<float>(-odd), cut = static_cast<float>(most);
  found |= when(over != 0x1p40f || under != -0x1p40f || cut != 0x1.000002p40f, Deviation::rounding);
  volatile float three = 3, third = one / three;
  return found | when(std::bit_cast<std::uint32_t>(float(third)) != 0x3eaaaaabu, Deviation::reciprocal);
}

ISO_INLINE std::uint32_t probe_contraction() {
  volatile float va = 1 + 0x1p-12f, vc = -(1 + 0x1p-11f);
  const float a = va, c = vc;
  volatile float left = a * a + c;
  volatile double vda = 1 + 0x1p-30, vdc = -(1 + 0x1p-29);
  const double da = vda, dc = vdc;
  volatile double dleft = da * da + dc;
  return when(left != 0, Deviation::contract_float) | when(dleft != 0, Deviation::contract_double) |
         when(pair_is_fused(), Deviation::contract_pair);
}

ISO_INLINE std::uint32_t probe_excess() {
  volatile float vg = 0x1p24f, one = 1;
  const float g = vg, h = one;
  volatile float left = (g + h) - g;  // 2^24 + 1 is a tie
  volatile double vdg = 0x1p53, done = 1;
  const double dg = vdg, dh = done;
  volatile double dleft = (dg + dh) - dg;
  volatile double above_tie = 0x1.002p-53;  // 64 bits make it a tie, which then goes to even
  volatile double twice = done + above_tie;
  return when(left != 0, Deviation::excess_float) | when(dleft != 0, Deviation::excess_double) |
         when(twice != 1 + 0x1p-52, Deviation::double_rounding);
}

ISO_INLINE std::uint32_t probe_specials() {
  volatile std::uint32_t nan_bits = 0x7fc00000u;
  const float nan = std::bit_cast<float>(std::uint32_t(nan_bits));
  volatile float negative_zero = -0.0f;
  const float n = negative_zero;
  volatile float sum = n + 0.0f;
  return when(nan == nan, Deviation::nan_equal) |
         when(std::bit_cast<std::uint32_t>(float(sum)) != 0, Deviation::zero_sign);
}
}  // namespace detail

/// Runs a dozen operations whose results IEEE 754 fixes and returns the deviations, 0 on a sound build and thread.
/// Inlined, so it tells of the flags of the file that calls it; `probe_environment` tells of the library's. Exceptions
/// do not trap meanwhile, and leave no flags.
ISO_INLINE std::uint32_t probe_environment_here() {
  const std::uint64_t caller = detail::FloatState::read();
  detail::FloatState::write(detail::FloatState::without_traps(caller));
  std::uint32_t found = detail::probe_denormals();
  found |= detail::probe_rounding();
  found |= detail::probe_contraction();
  found |= detail::probe_excess();
  found |= detail::probe_specials();
  detail::FloatState::write(caller);
  return found;
}

/// The probe, compiled in the library.
std::uint32_t probe_environment();

}  // namespace isostep
