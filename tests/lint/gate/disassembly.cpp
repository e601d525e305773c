// The kinds of a disassembler's lines.
// SPDX-License-Identifier: MIT
#include "disassembly.hpp"

namespace isostep_lint {

/// "world.cpp.o:     file format elf64-x86-64", "libisostep.a(world.cpp.obj):\tfile format wasm".
bool Disassembly::is_format(const std::string& line) {
  const std::size_t at = line.find("file format ");
  const std::size_t colon = line.rfind(':', at);
  if (at == std::string::npos || colon == std::string::npos) return false;
  file_ = line.substr(0, colon);
  set_ = instruction_set_of(std::string_view(line).substr(at));
  return true;
}

/// "0000000000000010 <isostep::step(float)>:". Labels within a function (".L4") do not begin another.
bool Disassembly::is_function(const std::string& line) {
  const std::size_t open = line.find(" <");
  if (open == std::string::npos || open == 0 || line.size() < open + 5) return false;
  if (line.compare(line.size() - 2, 2, ">:") != 0) return false;
  if (line.find_first_not_of("0123456789abcdef") != open) return false;
  if (line.compare(open + 2, 2, ".L") == 0) return true;
  function_ = line.substr(open + 2, line.size() - open - 4);
  behind_code_ = false;
  return true;
}

/// The instruction stands behind "   1a:\t", and behind the blanks that LLVM leaves for bytes.
std::string_view Disassembly::instruction_text(const std::string& line) const {
  const std::size_t colon = line.find(':'), tab = line.find('\t');
  const std::size_t digits = line.find_first_not_of(' ');
  if (colon == std::string::npos || tab == std::string::npos || tab < colon) return {};
  if (line.find_first_not_of("0123456789abcdef", digits) != colon) return {};
  return std::string_view(line).substr(tab + 1);
}

std::string_view Disassembly::next_word(std::string_view& text) {
  const std::size_t end = text.find_first_of(" \t");
  const std::string_view word = text.substr(0, end);
  const std::size_t next = text.find_first_not_of(" \t", end == std::string_view::npos ? text.size() : end);
  text = next == std::string_view::npos ? std::string_view() : text.substr(next);
  return word;
}

}  // namespace isostep_lint
