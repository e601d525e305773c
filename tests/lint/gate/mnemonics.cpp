// The instructions of concern, set by set, from the architectures' manuals.
// SPDX-License-Identifier: MIT
//
// Every pattern is for a whole mnemonic. Multiply-adds of integers are exact and stay: x86 vpmadd52luq, pmaddwd;
// aarch64 madd, mla; arm mla, vmla.i32; s390x msr, vmlf; ppc maddld.

#include "mnemonics.hpp"

#include <cstdlib>
#include <map>
#include <regex>
#include <string>

namespace isostep_lint {

namespace {

struct Rules {
  const char *fused, *loose, *unknown;
};

/// Intel 64 and IA-32 Architectures Software Developer's Manual 2: VFMADD132PD to VFNMSUB231SS, VFMADDCPH, VFMULCPH,
/// VDPBF16PS, TDPBF16PS; AMD64 Architecture Programmer's Manual 4 for FMA4; 4FMAPS and ER of Xeon Phi. Loose: RCPPS and
/// RSQRTPS have a bound of error (1.5 2^-12) and no bits; 3DNow!'s alike.
constexpr Rules kX86 = {"v4?fn?m(add|sub)\\w*|vfm(addsub|subadd)\\w*|vfc?m(add|ul)c[ps]h|vdpbf16ps|tdp\\w*ps",
                        "v?r(cp|sqrt)(14|28)?[ps][sdh]|vexp2p[sd]|pf(rcp|rsq)\\w*", "\\(bad\\)|\\.byte|<unknown>"};

/// The x87 instructions that may stay. The i686 calling convention returns float and double in st(0), so objects that
/// calculate with SSE still move numbers there and back, and gcc converts 64-bit integers by fild and fistp. A load
/// widens to 80 bits, exact for float, double and 64-bit integers; a store rounds once, as SSE's one instruction would;
/// with no arithmetic between them nothing is rounded twice. The precision control, which systems set differently, is
/// for FADD, FSUB, FMUL, FDIV, FSQRT alone (Intel's manual 1, 8.1.5.2): where gcc adds 2^64 to an unsigned integer that
/// fild took for a negative one, the sum depends on it, and the gate says so. fldt and fstpt (long double) stay out.
constexpr const char* kX87Moves =
    "fld[slz1]?|fstp?[sl]?|fild(s|l|ll)?|fist(t?p)?(s|l|ll)?|fxch|ffreep?|fcmovn?(b|e|be|u)|"  // moves and conversions
    "fn?st[cs]w|fldcw|fn?init|fn?clex|fn?save|fn?stenv|fldenv|frstor|f?wait|fnop|f(inc|dec)stp";
/// Names that begin with f and are not of the x87.
constexpr const char* kNotX87 = "fx(save|rstor)(64)?|femms|fs";

/// Arm Architecture Reference Manual for A-profile (DDI 0487), C7: FMADD, FMLA, FMLAL, FCMLA, BFMLALB, FRECPS (its
/// FPRecipStepFused) and FRSQRTS; C8: FMAD, FNMSB, FTMAD, FMMLA, FMOPA. FRECPE and FRSQRTE are tables printed there.
constexpr Rules kAarch64 = {
    "b?fn?m(add|sub|la|ls|ad|sb|opa|ops)\\w*|b?fmmla|fcmla|ftmad|b?fv?dot[bt]?|fr(ecp|sqrt)s(\\.\\w+)?", "",
    "\\.inst|undefined|udf|<unknown>"};

/// Arm's manual, F6: VFMA, VFMS, VFNMA, VFNMS, VFMAL, VFMSL, VFMAB, VFMAT, VCMLA, VDOT and VMMLA of BF16. VMLA, VMLS,
/// VNMLA and VNMLS are not fused: their result is FPAdd(d, FPMul(n, m)), which rounds twice as two instructions do. UDF
/// is how gcc traps.
constexpr Rules kArm = {"vfn?m[as]\\S*|vcmla\\S*|v(dot|mmla)\\.bf16", "", "\\.inst\\S*|undefined|;|<unknown>"};
/// Advanced SIMD of 32-bit state calculates with the standard FPSCR value, which flushes subnormals; its floats are in
/// d and q registers, while VFP's, which obey the FPSCR, are in s registers.
constexpr const char* kArmFlushing =
    "v(add|sub|mul|mla|mls|abd|padd|p?max|p?min|maxnm|minnm|ac[gl][et]|c[gl][et]|ceq|recp[es]|rsqrt[es]|cvt|rint\\w)"
    "\\.([su]32\\.)?f32\\S*";

/// RISC-V Unprivileged ISA, "F" (FMADD.S to FNMSUB.S and of D, Q, H), "V" (vfmacc to vfnmsub, vfwmacc, vfwmaccbf16).
/// Loose: vfredusum adds in an order of the implementation's. vfrec7 and vfrsqrt7 are tables printed there.
constexpr Rules kRiscv = {"fn?m(add|sub)\\.\\w+|vfw?n?m(acc|sac|add|sub)(bf16)?\\.\\w+", "vfw?redusum\\.\\w+",
                          "\\.([248]byte|short|word|insn|long)|unimp|<unknown>"};

/// z/Architecture Principles of Operation (SA22-7832): hexadecimal MAE to MSDR, MAY, MAYH, MAYL (chapter 18), MAEB to
/// MSDBR (19), VFMA, VFMS, VFNMA, VFNMS and their w names (24).
constexpr Rules kS390 = {"m[as][ed]b?r?|may[hl]?r?|[vw]fn?m[as]([sdx]b)?", "", "\\.(insn|long|short|byte)|<unknown>"};

/// Power ISA 3.1, book I: FMADD to FNMSUBS, vmaddfp and vnmsubfp of Altivec, xsmaddadp to xvnmsubmsp of VSX, xsmaddqp,
/// the outer products of MMA. Loose: the estimates fre, frsqrte, vrefp, vexptefp and the like of VSX.
constexpr Rules kPowerpc = {"fn?m(add|sub)s?\\.?|v(madd|nmsub)fp|x[sv]n?m(add|sub)\\w+|(pm)?xvb?f(16|32|64)ger\\w*",
                            "fres?\\.?|frsqrtes?\\.?|x[sv](re|rsqrte)[sd]p|v(re|rsqrte|expte|loge)fp",
                            "\\.(long|short|byte)|<unknown>"};

/// WebAssembly 3.0's relaxed operations, of which relaxed_madd and relaxed_nmadd may fuse; LLVM 14 prints them as fma
/// and fms, earlier ones as qfma and qfms. WebAssembly 2.0 has neither.
constexpr Rules kWasm = {"f(32|64)x[24]\\.(relaxed_n?madd|q?fm[as])", "\\w+\\.(relaxed_|dot_i8x16_i7x16)\\w+",
                         "<unknown>"};

const Rules& rules_of(InstructionSet set) {
  static constexpr Rules kNone = {"", "", ""};
  switch (set) {
    case InstructionSet::x86: return kX86;
    case InstructionSet::aarch64: return kAarch64;
    case InstructionSet::arm: return kArm;
    case InstructionSet::riscv: return kRiscv;
    case InstructionSet::s390: return kS390;
    case InstructionSet::powerpc: return kPowerpc;
    case InstructionSet::wasm: return kWasm;
    case InstructionSet::none: break;
  }
  return kNone;
}

bool matches(const std::string& mnemonic, const char* pattern) {
  return std::regex_match(mnemonic, std::regex(pattern));
}

Concern look_up(InstructionSet set, const std::string& mnemonic) {
  const Rules& rules = rules_of(set);
  if (matches(mnemonic, rules.fused)) return Concern::fused;
  if (matches(mnemonic, rules.loose)) return Concern::loose;
  if (matches(mnemonic, rules.unknown)) return Concern::unknown;
  if (set == InstructionSet::x86 && mnemonic.front() == 'f' && !matches(mnemonic, kX87Moves) &&
      !matches(mnemonic, kNotX87)) {
    return Concern::x87;
  }
  if (set == InstructionSet::arm && matches(mnemonic, kArmFlushing)) return Concern::flushes;
  return Concern::none;
}

}  // namespace

InstructionSet instruction_set_of(std::string_view format) {
  struct Name {
    const char* part;
    InstructionSet set;
  };
  static constexpr Name kNames[] = {
      {"x86-64", InstructionSet::x86},    {"i386", InstructionSet::x86},        {"aarch64", InstructionSet::aarch64},
      {"arm64", InstructionSet::aarch64}, {"arm", InstructionSet::arm},         {"riscv", InstructionSet::riscv},
      {"s390", InstructionSet::s390},     {"powerpc", InstructionSet::powerpc}, {"wasm", InstructionSet::wasm}};
  for (const Name& name : kNames) {
    if (format.find(name.part) != std::string_view::npos) return name.set;
  }
  return InstructionSet::none;
}

Concern concern_of(InstructionSet set, std::string_view mnemonic, std::string_view operands) {
  if (mnemonic.empty()) return Concern::unknown;
  static std::map<std::pair<InstructionSet, std::string>, Concern> known;  // a few hundred names, millions of lines
  const std::pair<InstructionSet, std::string> key(set, mnemonic);
  const auto [at, fresh] = known.insert({key, Concern::none});
  if (fresh) at->second = look_up(set, key.second);
  const bool single = !operands.empty() && operands.front() == 's';
  return at->second == Concern::flushes && single ? Concern::none : at->second;
}

bool sets_environment(InstructionSet set, std::string_view mnemonic) {
  return set == InstructionSet::x86 && (mnemonic == "ldmxcsr" || mnemonic == "vldmxcsr");
}

/// Intel's manual 1, 10.2.3: arithmetic, square roots and conversions of SSE. Moves, comparisons and min round nothing.
bool obeys_environment(InstructionSet set, std::string_view mnemonic) {
  static const std::regex kRounds("v?(add|sub|addsub|hadd|hsub|mul|div|sqrt)[sp][sd]|v?cvt\\w+");
  static std::map<std::string, bool> known;
  if (set != InstructionSet::x86) return false;
  const auto [at, fresh] = known.insert({std::string(mnemonic), false});
  if (fresh) at->second = std::regex_match(at->first, kRounds);
  return at->second;
}

bool is_prefix(InstructionSet set, std::string_view mnemonic) {
  if (set != InstructionSet::x86) return false;
  for (const char* prefix : {"rep", "repz", "repnz", "lock", "data16", "addr32", "cs", "ds", "es", "ss", "fs", "gs",
                             "bnd", "notrack", "xacquire", "xrelease", "{vex}", "{evex}"}) {
    if (mnemonic == prefix) return true;
  }
  return mnemonic.substr(0, 3) == "rex";
}

bool is_data(InstructionSet set, std::string_view mnemonic, std::string_view operands) {
  // PowerPC's primary opcode, the first six bits, is never 0, but in a jump table's offsets it is; or all bits are set
  // down to those of a short way back, of which as an instruction no operand could be another register than the last.
  constexpr unsigned long kFirstInstruction = 0x04000000, kFarthestBack = 0xffff0000;
  if (set == InstructionSet::powerpc && mnemonic == ".long") {
    const unsigned long word = std::strtoul(std::string(operands).c_str(), nullptr, 16);
    return word < kFirstInstruction || word >= kFarthestBack;
  }
  const bool pools = set == InstructionSet::arm || set == InstructionSet::aarch64;
  return pools && (mnemonic == ".word" || mnemonic == ".short" || mnemonic == ".byte" || mnemonic == ".xword");
}

}  // namespace isostep_lint
