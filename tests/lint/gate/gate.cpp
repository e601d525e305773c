// The disassembly gate: what a compiler made of the simulation keeps to IEEE's single operations, on every target.
// SPDX-License-Identifier: MIT
//
// isostep_gate [--functions TEXT] [--finds CONCERN] OBJDUMP NM FILES...
//
// Reads every function of objects and archives and every symbol that they leave undefined; a line for each finding:
// file, function, concern, instruction; a line of sums last. --functions: of a linked program, only functions whose
// names contain TEXT; symbols all the same. --finds: a control, which must have a finding of that concern and none of
// another. Ends with 0 when nothing was found (or what --finds wants was), 1 when something was, 64 when it is called
// otherwise, 70 when a tool fails, nothing could be read or not all be said.

#include <cstdio>
#include <set>
#include <vector>

#include "calls.hpp"
#include "disassembly.hpp"

namespace isostep_lint {
namespace {

constexpr int kClean = 0, kFound = 1, kUsage = 64, kFailure = 70;
constexpr std::size_t kShown = 20;  // findings of a concern that are printed; all are counted

struct Task {
  std::string objdump, nm, functions;
  std::string finds;
  std::vector<std::string> files;
};

/// What one function does about the float environment.
struct Body {
  std::string file = {};
  std::string rounds = {};  // its last instruction that rounds
  bool sets = false;

  void take(const Instruction& instruction) {
    sets = sets || sets_environment(instruction.set, instruction.mnemonic);
    if (obeys_environment(instruction.set, instruction.mnemonic))
      rounds = std::string(instruction.mnemonic) + " " + std::string(instruction.operands);
  }
};

class Gate {
 public:
  explicit Gate(const Task& task) : task_(task) {}

  /// False when a tool fails or has nothing to say of the file.
  bool read(const std::string& file) { return read_instructions(file) && read_calls(file); }

  void print_sums() const {
    std::printf("%zu files, %zu functions, %zu instructions, %zu undefined symbols;", task_.files.size(),
                functions_.size(), instructions_, calls_);
    std::size_t all = 0;
    for (int i = 1; i < kConcerns; ++i) {
      all += found_[i];
      if (found_[i] != 0) std::printf(" %zu %s", found_[i], name_of(static_cast<Concern>(i)));
    }
    std::puts(all == 0 ? " nothing found" : "");
  }

  int found(Concern concern) const { return static_cast<int>(found_[static_cast<int>(concern)]); }

 private:
  void report(const std::string& file, const std::string& function, Concern concern, std::string_view what) {
    if (found_[static_cast<int>(concern)]++ >= kShown) return;
    std::printf("%s: %s: %s: %.*s\n", file.c_str(), function.c_str(), name_of(concern), static_cast<int>(what.size()),
                what.data());
  }

  bool read_instructions(const std::string& file) {
    Disassembly disassembly;
    bool known = true;
    const std::size_t before = instructions_;
    const std::string command = quoted(task_.objdump) + " -d -C --no-show-raw-insn " + quoted(file);
    const bool ok = run(command, [&](const std::string& line) {
      const bool read = disassembly.read(line, [&](const Instruction& instruction) {
        if (instruction.function.find(task_.functions) == std::string::npos) return;
        ++instructions_;
        if (instruction.function != last_) {
          report_unpinned();
          functions_.insert(last_ = instruction.function);
          body_ = {instruction.file};
        }
        body_.take(instruction);
        const Concern concern = concern_of(instruction.set, instruction.mnemonic, instruction.operands);
        if (concern == Concern::none) return;
        report(instruction.file, instruction.function, concern,
               std::string(instruction.mnemonic) + " " + std::string(instruction.operands));
      });
      known = known && read;
    });
    report_unpinned();
    last_.clear();
    if (!known) std::fprintf(stderr, "%s: an instruction set that the gate does not know\n", file.c_str());
    if (!ok) std::fprintf(stderr, "%s: %s fails\n", file.c_str(), task_.objdump.c_str());
    if (instructions_ == before) std::fprintf(stderr, "%s: no instruction could be read\n", file.c_str());
    return ok && known && instructions_ != before;
  }

  bool read_calls(const std::string& file) {
    std::string member = file;
    const bool ok = run(quoted(task_.nm) + " -u " + quoted(file), [&](const std::string& line) {
      if (!line.empty() && line.back() == ':') member = line.substr(0, line.size() - 1);
      const std::size_t at = line.rfind(' ');
      if (line.empty() || line.back() == ':' || at == std::string::npos) return;
      ++calls_;
      const std::string symbol = line.substr(at + 1);
      const Concern concern = concern_of_call(symbol);
      if (concern != Concern::none) report(member, "undefined", concern, symbol);
    });
    if (!ok) std::fprintf(stderr, "%s: %s fails\n", file.c_str(), task_.nm.c_str());
    return ok;
  }

  /// pin_floats() has its arithmetic in run_alone and in the lambda it is given, which may call it again. Any other
  /// function that changes the environment rounds nothing.
  void report_unpinned() {
    bool inside = false;
    for (const char* name : {"run_alone", "{lambda", "probe_environment"}) {
      inside = inside || last_.find(name) != std::string::npos;
    }
    if (!inside && body_.sets && !body_.rounds.empty()) report(body_.file, last_, Concern::unpinned, body_.rounds);
    body_ = {};
  }

  const Task& task_;
  std::size_t instructions_ = 0, calls_ = 0, found_[kConcerns] = {};
  std::set<std::string> functions_;
  std::string last_;
  Body body_;
};

bool parse(const std::vector<std::string>& words, Task& task) {
  std::size_t at = 0;
  for (; at + 1 < words.size() && words[at].rfind("--", 0) == 0; at += 2) {
    if (words[at] == "--functions") task.functions = words[at + 1];
    else if (words[at] == "--finds") task.finds = words[at + 1];
    else return false;
  }
  if (words.size() < at + 3) return false;
  task.objdump = words[at];
  task.nm = words[at + 1];
  task.files.assign(words.begin() + static_cast<std::ptrdiff_t>(at) + 2, words.end());
  bool known = task.finds.empty();
  for (int i = 1; i < kConcerns; ++i) known = known || task.finds == name_of(static_cast<Concern>(i));
  return known;
}

int verdict(const Gate& gate, const Task& task) {
  bool other = false, wanted = false;
  for (int i = 1; i < kConcerns; ++i) {
    const Concern concern = static_cast<Concern>(i);
    (task.finds == name_of(concern) ? wanted : other) |= gate.found(concern) != 0;
  }
  if (task.finds.empty()) return other ? kFound : kClean;
  if (!wanted) std::printf("the control has nothing %s, so the gate would see it nowhere\n", task.finds.c_str());
  return wanted && !other ? kClean : kFound;
}

int main_of(const std::vector<std::string>& words) {
  Task task;
  if (!parse(words, task)) {
    std::fputs("usage: isostep_gate [--functions TEXT] [--finds CONCERN] OBJDUMP NM FILES...\n", stderr);
    return kUsage;
  }
  Gate gate(task);
  bool ok = true;
  for (const std::string& file : task.files) ok = gate.read(file) && ok;
  gate.print_sums();
  if (!ok) std::puts("not everything could be read");
  if (std::fflush(stdout) != 0 || std::ferror(stdout) != 0) return kFailure;
  return ok ? verdict(gate, task) : kFailure;
}

}  // namespace
}  // namespace isostep_lint

int main(int count, char** arguments) { return isostep_lint::main_of({arguments + 1, arguments + count}); }
