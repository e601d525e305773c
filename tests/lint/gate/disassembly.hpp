// Instructions as a disassembler prints them, one at a time.
// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>

#include "../command.hpp"
#include "mnemonics.hpp"

namespace isostep_lint {

struct Instruction {
  InstructionSet set;
  const std::string& file;      // an archive's member by its own name
  const std::string& function;  // demangled
  std::string_view mnemonic, operands;
};

/// Reads the lines of `objdump -d -C --no-show-raw-insn`.
class Disassembly {
 public:
  /// Calls `each(instruction)` where the line is one. False: the object is of an instruction set that nobody knows.
  template <class Each> bool read(const std::string& line, Each&& each) {
    if (is_format(line)) return set_ != InstructionSet::none;
    if (is_function(line)) return true;
    std::string_view text = instruction_text(line);
    if (text.empty()) return true;
    std::string_view mnemonic = next_word(text);
    while (is_prefix(set_, mnemonic) && !text.empty()) mnemonic = next_word(text);
    // PowerPC: a zero word ends the code; behind it is the table by which debuggers walk the stack.
    if (set_ == InstructionSet::powerpc && mnemonic == ".long" && text == "0x0") behind_code_ = true;
    if (!behind_code_ && !is_data(set_, mnemonic, text)) each(Instruction{set_, file_, function_, mnemonic, text});
    return true;
  }

 private:
  bool is_format(const std::string& line);
  bool is_function(const std::string& line);
  std::string_view instruction_text(const std::string& line) const;
  static std::string_view next_word(std::string_view& text);

  InstructionSet set_ = InstructionSet::none;
  std::string file_, function_;
  bool behind_code_ = false;
};

}  // namespace isostep_lint
