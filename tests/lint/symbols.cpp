// Looks into object files for weak symbols that a linker could take for those of files with other flags.
// SPDX-License-Identifier: MIT
//
// symbols consumer NM OBJDUMP OBJECT...   a user's files leave no weak function of ours behind
// symbols kernels NM OBJECT...            objects that are compiled for one instruction set have no weak function

#include <cxxabi.h>

#include <cstdio>
#include <cstdlib>
#include <regex>
#include <set>
#include <string>
#include <vector>

#include "command.hpp"

namespace {

using isostep_lint::quoted;
using isostep_lint::run;

int findings = 0;
void report(const std::string& where, const std::string& what) {
  std::printf("%s: %s\n", where.c_str(), what.c_str());
  ++findings;
}

struct Symbol {
  char kind;         // of nm: W weak function, V weak object, u unique object
  std::string raw;   // mangled
  std::string name;  // demangled

  bool is_weak() const { return kind == 'W' || kind == 'w' || kind == 'V' || kind == 'v' || kind == 'u'; }
};

std::string demangled(const std::string& raw) {
  int status = 0;
  char* text = abi::__cxa_demangle(raw.c_str(), nullptr, nullptr, &status);
  std::string name = status == 0 ? text : raw;
  std::free(text);
  return name;
}

std::vector<Symbol> defined_symbols(const std::string& nm, const std::string& object) {
  std::vector<Symbol> symbols;
  const bool ok = run(quoted(nm) + " --defined-only " + quoted(object), [&](const std::string& line) {
    const std::size_t at = line.find(' ');
    if (at != std::string::npos && at + 3 < line.size()) symbols.push_back({line[at + 1], line.substr(at + 3), {}});
  });
  for (Symbol& symbol : symbols) symbol.name = symbol.is_weak() ? demangled(symbol.raw) : symbol.raw;
  if (!ok || symbols.empty()) report(object, "nm tells nothing of it");
  return symbols;
}

/// The scope that ends at `end`: "isostep::f<int>(int)" of "std::g<isostep::f<int>(int)::{lambda()#1}>".
std::string scope_before(const std::string& name, std::size_t end) {
  int depth = 0;
  std::size_t begin = end;
  for (; begin > 0; --begin) {
    const char c = name[begin - 1];
    if (c == ')' || c == '>' || c == ']') ++depth;
    if (depth == 0 && (c == '<' || c == '(' || c == ',')) break;
    if (c == '(' || c == '<' || c == '[') --depth;
    if (depth == 0 && c == ' ' && name.compare(begin, 5, "const") != 0) break;
  }
  return name.substr(begin, end - begin);
}

/// The symbol is in our namespace, or something of the standard library that calls a lambda of ours.
bool is_ours(const Symbol& symbol) {
  static const std::regex own("^_Z(GV|GR|TV|TI|TS)?Z*N[VKRO]*7isostep.*");
  if (std::regex_match(symbol.raw, own)) return true;
  for (std::size_t at = symbol.name.find("::{lambda"); at != std::string::npos;
       at = symbol.name.find("::{lambda", at + 1)) {
    if (scope_before(symbol.name, at).rfind("isostep::", 0) == 0) return true;
  }
  return false;
}

/// "isostep::Settings<float>::~Settings()", or one that copies or moves: nobody wrote it, or it would be always_inline;
/// see `check_calculates_nothing`.
bool is_structor(const std::string& name) {
  static const std::regex pattern(
      "(?:^|::)~?(\\w+)(?:<.*>)?::~?\\1\\((?:[^()]*::\\1(?:<.*>)?(?: const&|&&))?\\)(?: \\[clone.*)?$");
  return std::regex_search(name, pattern);
}
/// A constexpr variable has the same bits in every build. Ours are called kName.
bool is_constant(const Symbol& symbol) {
  static const std::regex pattern("::k[A-Z]\\w*(?:<.*>)?$");
  return (symbol.kind == 'u' || symbol.kind == 'V') && std::regex_search(symbol.name, pattern);
}

/// Sections of the constructors and destructors that the compiler makes, one for each where functions can be replaced.
std::set<std::string> structor_sections(const std::string& objdump, const std::string& object) {
  std::set<std::string> sections;
  const bool ok = run(quoted(objdump) + " -t " + quoted(object), [&](const std::string& line) {
    // 0000000000000000  w    F .text._ZN1AC2Ev<tab>0000000000000018 _ZN1AC1Ev
    const std::size_t tab = line.find('\t');
    if (tab == std::string::npos) return;
    const std::string name = demangled(line.substr(line.rfind(' ') + 1));
    if (name.rfind("isostep::", 0) != 0 || !is_structor(name)) return;
    const std::size_t begin = line.rfind(' ', tab) + 1;
    const std::string section = line.substr(begin, tab - begin);
    if (section != "*UND*" && section != ".group") sections.insert(section);
  });
  if (!ok) report(object, "objdump fails");
  return sections;
}

/// Constructors and destructors that the compiler makes of a struct's members stay weak at -O0. They may store
/// constants, copy and free memory; that they calculate nothing is read from their instructions. Only their sections
/// are read: objdump needs as long for each as it has sections.
void check_calculates_nothing(const std::string& objdump, const std::string& object) {
  static const std::regex header("^[0-9a-f]+ <(.*)>:$");
  static const std::regex arithmetic(
      "\\t(v?(add|sub|mul|div|sqrt|fn?m(add|sub)[0-9]+)[sp][sd]|f(add|sub|mul|div|sqrt|n?madd|n?msub|mla|mls))\\b");
  constexpr std::size_t kAtOnce = 100;  // names of a few hundred letters each, and a command has 128 KiB
  std::string function;
  const auto read = [&](const std::string& line) {
    std::smatch match;
    if (!line.empty() && line.back() == ':' && std::regex_match(line, match, header)) {
      function = match[1];
      if (function.rfind("isostep::", 0) != 0 || !is_structor(function)) function.clear();
    } else if (!function.empty() && std::regex_search(line, arithmetic)) {
      report(object, function + " calculates: write ISO_INLINE before it");
      function.clear();
    }
  };
  const std::set<std::string> sections = structor_sections(objdump, object);
  for (auto at = sections.begin(); at != sections.end();) {
    std::string command = quoted(objdump) + " -d -C --no-show-raw-insn";
    for (std::size_t n = 0; n < kAtOnce && at != sections.end(); ++n, ++at) command += " -j " + quoted(*at);
    if (!run(command + " " + quoted(object), read)) report(object, "objdump fails");
  }
}

void check_consumer(const std::string& nm, const std::string& objdump, const std::vector<std::string>& objects) {
  for (const std::string& object : objects) {
    for (const Symbol& symbol : defined_symbols(nm, object)) {
      if (!symbol.is_weak() || !is_ours(symbol) || is_constant(symbol) || is_structor(symbol.name)) continue;
      report(object, std::string("weak ") + symbol.kind + " " + symbol.name);
    }
    check_calculates_nothing(objdump, object);
  }
}

void check_kernels(const std::string& nm, const std::vector<std::string>& objects) {
  for (const std::string& object : objects) {
    for (const Symbol& symbol : defined_symbols(nm, object)) {
      if (symbol.kind == 'W' && symbol.name.rfind("DW.ref.", 0) != 0)
        report(object, "compiled for one instruction set, has the weak " + symbol.name);
    }
  }
}

}  // namespace

int main(int count, char** arguments) {
  const std::vector<std::string> words(arguments + 1, arguments + count);
  const std::string mode = words.empty() ? "" : words[0];
  if (mode == "consumer" && count > 4) check_consumer(words[1], words[2], {words.begin() + 3, words.end()});
  else if (mode == "kernels" && count > 3) check_kernels(words[1], {words.begin() + 2, words.end()});
  else return std::fprintf(stderr, "symbols consumer|kernels TOOL... FILE...\n"), 64;
  return findings == 0 ? 0 : 1;
}
