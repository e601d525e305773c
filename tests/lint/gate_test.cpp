// The gate's names: instructions from the architectures' manuals, symbols from <math.h> and the compilers' libraries.
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "lint/gate/calls.hpp"
#include "lint/gate/disassembly.hpp"

namespace isostep_lint {
namespace gate_test {

std::vector<std::string> words(const std::string& text) {
  std::vector<std::string> result;
  std::size_t begin = 0;
  for (std::size_t end; begin < text.size(); begin = end + 1) {
    end = text.find(' ', begin);
    if (end == std::string::npos) end = text.size();
    if (end > begin) result.push_back(text.substr(begin, end - begin));
  }
  return result;
}

void expect_all(InstructionSet set, Concern concern, const std::string& mnemonics, const std::string& operands = "") {
  for (const std::string& mnemonic : words(mnemonics)) {
    EXPECT_STREQ(name_of(concern_of(set, mnemonic, operands)), name_of(concern)) << name_of(set) << " " << mnemonic;
  }
}

TEST(GateNames, FusedInstructionsOfEverySetAreSeen) {
  expect_all(InstructionSet::x86, Concern::fused,
             "vfmadd132sd vfmadd213ps vfmadd231ss vfmsub231pd vfnmadd213ss vfnmsub132ps vfmaddsub231pd vfmsubadd132ps "
             "vfmaddpd vfnmsubss v4fmaddps v4fnmaddss vfmadd231ph vfmaddcph vfcmaddcsh vdpbf16ps");
  expect_all(InstructionSet::aarch64, Concern::fused,
             "fmadd fmsub fnmadd fnmsub fmla fmls fmlal fmlsl2 fcmla fmad fmsb fnmad fnmla fnmls fnmsb fmlalb ftmad "
             "bfmlalb bfmlalt bfmmla fmmla bfdot fmopa fmops bfmopa frecps frsqrts");
  expect_all(InstructionSet::arm, Concern::fused,
             "vfma.f32 vfma.f64 vfms.f32 vfnma.f64 vfnms.f32 vfmaeq.f32 vfmal.f16 vfmab.bf16 vcmla.f32 vdot.bf16");
  expect_all(InstructionSet::riscv, Concern::fused,
             "fmadd.s fmadd.d fmsub.s fnmadd.d fnmsub.s fmadd.q fmadd.h vfmacc.vv vfnmacc.vf vfmsac.vv vfnmsac.vv "
             "vfmadd.vv vfnmsub.vf vfwmacc.vv vfwnmsac.vf");
  expect_all(InstructionSet::s390, Concern::fused,
             "maeb maebr madb madbr mseb msebr msdb msdbr mae maer mad madr mse mser msd msdr may mayr mayh maylr vfma "
             "vfmasb vfmadb wfmadb wfmasb wfmaxb vfmsdb wfmssb vfnmadb wfnmssb");
  expect_all(InstructionSet::powerpc, Concern::fused,
             "fmadd fmadds fmadd. fmsub fmsubs fnmadd fnmadds fnmsub fnmsubs. vmaddfp vnmsubfp xsmaddadp xsmaddmsp "
             "xsmsubadp xsnmaddadp xsnmsubmdp xsmaddqp xvmaddasp xvmsubmdp xvnmsubadp xvf32gerpp xvf64ger pmxvf32ger "
             "xvbf16ger2pp");
  expect_all(InstructionSet::wasm, Concern::fused,
             "f32x4.relaxed_madd f64x2.relaxed_nmadd f32x4.fma f64x2.fms f32x4.qfma");
}

TEST(GateNames, ExactIntegersAndSeparateRoundingsPass) {
  expect_all(InstructionSet::x86, Concern::none,
             "mulsd addsd vmulps vaddps sqrtss pmaddwd vpmadd52luq vpmulld imul vfixupimmss vminps cvtsi2ss fxsave");
  expect_all(InstructionSet::aarch64, Concern::none,
             "madd msub mla mls smaddl umlal fmul fadd fsub fnmul fmax fminnm fmov fsqrt fcvtzs frecpe fmulx");
  // VMLA of VFP is FPAdd(d, FPMul(n, m)): two roundings.
  expect_all(InstructionSet::arm, Concern::none, "mla mls vmla.f32 vmls.f32 vnmla.f32 vadd.f32 vcvt.f32.s32",
             "s0, s1, s2");
  expect_all(InstructionSet::arm, Concern::none, "vmla.f64 vmla.i32 vadd.f64 vcvt.f64.f32", "d0, d1, d2");
  expect_all(InstructionSet::riscv, Concern::none,
             "fmul.s fadd.d fsqrt.s vmacc.vv vfmul.vv vfredosum.vs fmin.d fmv.x.w");
  expect_all(InstructionSet::s390, Concern::none,
             "msr msgr msrkc ms msy msfi vmlf vmal vmae meebr mdbr aebr sqdbr vfmdb wfmdb");
  expect_all(InstructionSet::powerpc, Concern::none,
             "maddld maddhd maddhdu vmladduhm vmsumshm fmul fmuls fadd fsub fsqrts xsmuldp xvaddsp xsmaxdp fmr");
  expect_all(InstructionSet::wasm, Concern::none, "f32.mul f64.add f32x4.mul i32x4.dot_i16x8_s f64.sqrt f32x4.pmin");
}

TEST(GateNames, TheX87StackMayMoveAndConvertAndNothingElse) {
  expect_all(InstructionSet::x86, Concern::none,
             "fld flds fldl fld1 fldz fst fsts fstl fstp fstps fstpl fxch fcmovbe fcmovnu filds fildl fildll fistpll "
             "fisttpll fnstcw "
             "fldcw");
  expect_all(InstructionSet::x86, Concern::x87,
             "fadd fadds faddl faddp fsub fsubrp fmul fmulp fdiv fdivrp fsqrt fiadd fimull frndint fscale fprem fsin "
             "fyl2x fchs fabs fucomip fldt fstpt fldpi");
}

TEST(GateNames, EstimatesAndFlushingOperationsAreSeen) {
  expect_all(InstructionSet::x86, Concern::loose, "rcpps rsqrtss vrcpps vrsqrtps vrcp14pd vrsqrt14ss vrsqrt28pd");
  expect_all(InstructionSet::powerpc, Concern::loose, "fre fres frsqrte frsqrtes xsredp xvrsqrtesp vrefp vrsqrtefp");
  expect_all(InstructionSet::riscv, Concern::loose, "vfredusum.vs vfwredusum.vs");
  expect_all(InstructionSet::wasm, Concern::loose, "f32x4.relaxed_min i32x4.relaxed_trunc_f32x4_s");
  expect_all(InstructionSet::arm, Concern::flushes, "vadd.f32 vmla.f32 vmul.f32 vmax.f32 vcgt.f32 vrecpe.f32",
             "q0, q1");
  expect_all(InstructionSet::x86, Concern::unknown, "(bad)");
  expect_all(InstructionSet::aarch64, Concern::unknown, ".inst");
}

TEST(GateNames, WhatSetsTheEnvironmentAndWhatObeysItAreToldApart) {
  for (const std::string& name : words("ldmxcsr vldmxcsr")) {
    EXPECT_TRUE(sets_environment(InstructionSet::x86, name)) << name;
  }
  for (const std::string& name : words("stmxcsr fldcw mov")) {
    EXPECT_FALSE(sets_environment(InstructionSet::x86, name)) << name;
  }
  for (const std::string& name :
       words("addss subsd mulps divss vdivpd vaddps sqrtss cvtsi2ss cvttsd2si vcvtdq2ps cvtsd2ss haddps")) {
    EXPECT_TRUE(obeys_environment(InstructionSet::x86, name)) << name;
  }
  for (const std::string& name : words("movss maxps ucomiss cmpltps andps add mul imul paddd unpcklps vpaddq")) {
    EXPECT_FALSE(obeys_environment(InstructionSet::x86, name)) << name;
  }
}

TEST(GateNames, CallsOfTheCLibraryAreSeenHoweverTheyAreDecorated) {
  for (const std::string& name : words(
           "sin sinf sinl sinf128 cosf atan2 pow powf exp2f fma fmaf fmin fmaxf floor rintf sqrt sqrtf lrint llroundl "
           "hypotf sincos sincosf __sin_finite __exp2f_finite __pow_finite lgamma_r lgammaf_r _ZGVdN4v_sin "
           "_ZGVbN4vv_powf .sin sin@GLIBC_2.2.5 __imp_sin csqrtf j0 ynf")) {
    EXPECT_EQ(concern_of_call(name), Concern::libm) << name;
  }
}

TEST(GateNames, ArithmeticOfTheCompilersLibraryIsSeenAndItsIntegersAndConversionsPass) {
  for (const std::string& name :
       words("__addsf3 __muldf3 __divtf3 __subxf3 __eqtf2 __extenddftf2 __trunctfdf2 __floatditf "
             "__fixtfdi __aeabi_fadd __aeabi_dmul __aeabi_dcmplt __gcc_qadd __muldc3 __powidf2")) {
    EXPECT_EQ(concern_of_call(name), Concern::soft) << name;
  }
  for (const std::string& name :
       words("__divti3 __udivmodti4 __multi3 __muldi3 __divdi3 __ashlti3 __popcountdi2 __clzdi2 __aeabi_ldivmod "
             "__floatdisf __floatundidf __floattidf __fixdfdi __fixunssfdi __aeabi_l2f __aeabi_d2lz memcpy strlen "
             "_ZN7isostep5WorldIfE4stepEf _ZGVZN7isostep4nameEvE4text expand single fmaxima _Znwm snprintf")) {
    EXPECT_EQ(concern_of_call(name), Concern::none) << name;
  }
}

/// "file|function|mnemonic|operands" of each instruction in lines.
std::vector<std::string> read(const std::vector<std::string>& lines) {
  Disassembly disassembly;
  std::vector<std::string> found;
  for (const std::string& line : lines) {
    EXPECT_TRUE(disassembly.read(line, [&](const Instruction& i) {
      found.push_back(i.file + "|" + i.function + "|" + std::string(i.mnemonic) + "|" + std::string(i.operands));
    })) << line;
  }
  return found;
}

TEST(Disassembly, LinesOfBothDisassemblersAreRead) {
  EXPECT_EQ(read({"world.cpp.o:     file format elf64-x86-64", "", "Disassembly of section .text:", "",
                  "0000000000000000 <isostep::step(float)>:", "   0:\tlock xadd %eax,(%rdi)", "   4:\tret", "\t..."}),
            (std::vector<std::string>{"world.cpp.o|isostep::step(float)|xadd|%eax,(%rdi)",
                                      "world.cpp.o|isostep::step(float)|ret|"}));
  EXPECT_EQ(read({"lib.a(world.cpp.obj):\tfile format wasm", "00000000 <CODE>:", "        # 9 functions in section.",
                  "00000001 <step>:", "       3:      \tlocal.get\t0", "       7:      \tf64.mul "}),
            (std::vector<std::string>{"lib.a(world.cpp.obj)|step|local.get|0", "lib.a(world.cpp.obj)|step|f64.mul|"}));
}

TEST(Disassembly, ConstantPoolsAndTablesAreNotInstructions) {
  EXPECT_EQ(
      read({"a.o:     file format elf32-littlearm", "00000000 <f>:", "   0:\tbx\tlr", "   4:\t.word\t0x3f800000"}),
      (std::vector<std::string>{"a.o|f|bx|lr"}));
  EXPECT_EQ(read({"a.o:     file format elf64-powerpc", "0000000000000000 <.f>:", "   0:\tblr", "   4:\t.long 0x0",
                  "   8:\t.long 0x90000", "   c:\t.long 0xffffff40", "0000000000000010 <.g>:", "  10:\tbctr",
                  "  14:\t.long 0x3ec", "  18:\t.long 0x10000384"}),
            (std::vector<std::string>{"a.o|.f|blr|", "a.o|.g|bctr|", "a.o|.g|.long|0x10000384"}));
}

TEST(Disassembly, AnUnknownInstructionSetIsAnError) {
  Disassembly disassembly;
  EXPECT_FALSE(disassembly.read("a.o:     file format elf64-loongarch", [](const Instruction&) {}));
}

}  // namespace gate_test
}  // namespace isostep_lint
