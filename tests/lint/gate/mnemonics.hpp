// The instructions of concern, by the names that GNU's and LLVM's objdump print.
// SPDX-License-Identifier: MIT
#pragma once

#include <string_view>

#include "concern.hpp"

namespace isostep_lint {

/// The set of a disassembler's "file format" line: "elf64-x86-64", "pe-x86-64", "elf64-littleaarch64", "wasm", ...
InstructionSet instruction_set_of(std::string_view format);

/// The concern about an instruction; `operands` as the disassembler prints them (x86: AT&T's order and suffixes).
Concern concern_of(InstructionSet set, std::string_view mnemonic, std::string_view operands);

/// It changes how later instructions round or trap, or what they take subnormal numbers for. Of x86.
bool sets_environment(InstructionSet set, std::string_view mnemonic);

/// It rounds as the environment says. Of x86.
bool obeys_environment(InstructionSet set, std::string_view mnemonic);

/// A part of the instruction that follows it: "rep", "lock".
bool is_prefix(InstructionSet set, std::string_view mnemonic);

/// Data that a compiler keeps between instructions: a constant pool's word, the offsets of a jump table.
bool is_data(InstructionSet set, std::string_view mnemonic, std::string_view operands);

}  // namespace isostep_lint
