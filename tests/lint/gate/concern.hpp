// The concerns about a simulation's objects, and the instruction sets whose objects the gate can read.
// SPDX-License-Identifier: MIT
#pragma once

namespace isostep_lint {

enum class Concern {
  none,
  fused,     // multiplies and adds with one rounding, where another target rounds twice
  x87,       // rounds in the x87 stack, whose format and precision are not the operands'
  loose,     // the architecture leaves the result to the implementation: estimates, relaxed operations
  flushes,   // takes subnormal numbers for zero, whatever the environment says
  libm,      // a function of the C library's mathematics: another library, other bits
  soft,      // arithmetic by the compiler's library: of long double, complex numbers, or for want of a unit
  unpinned,  // beside a change of the float environment, of which the compiler knows nothing: on either side of it
  unknown    // the disassembler cannot read it, so nobody has seen what it does
};
inline constexpr int kConcerns = 9;

inline const char* name_of(Concern concern) {
  constexpr const char* kNames[kConcerns] = {"none", "fused", "x87",      "loose",  "flushes",
                                             "libm", "soft",  "unpinned", "unknown"};
  return kNames[static_cast<int>(concern)];
}

enum class InstructionSet { none, x86, aarch64, arm, riscv, s390, powerpc, wasm };

inline const char* name_of(InstructionSet set) {
  constexpr const char* kNames[8] = {"none", "x86", "aarch64", "arm", "riscv", "s390", "powerpc", "wasm"};
  return kNames[static_cast<int>(set)];
}

}  // namespace isostep_lint
