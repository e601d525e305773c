// ListProbe: a copy of the engine's headers that a test may change, and what the compiler says of it.
// SPDX-License-Identifier: MIT
#pragma once

#include <gmock/gmock.h>

#include <sstream>

#include "lint/command.hpp"
#include "own_folder.hpp"

namespace isostep {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

/// Paths are relative to the project.
class ListProbe : public OwnFolder {
 protected:
  void SetUp() override {
    OwnFolder::SetUp();
    for (const char* folder : {"include", "scalar/include", "src/scenes"}) copy_folder(folder);
  }

  void copy_folder(const std::string& folder) {
    std::filesystem::create_directories(folder_ / folder);
    std::filesystem::copy(source(folder), folder_ / folder, std::filesystem::copy_options::recursive);
  }
  void copy(const std::string& from, const std::string& to) { std::filesystem::copy(source(from), folder_ / to); }
  /// Copies the first piece of C++ on a page.
  void copy_code(const std::string& page, const std::string& to) {
    const std::string text = read(source(page)), begin = "```cpp\n";
    const std::size_t at = text.find(begin), end = text.find("```", at + begin.size());
    ASSERT_TRUE(at != std::string::npos && end != std::string::npos) << "no code in " << page;
    std::ofstream(folder_ / to) << text.substr(at + begin.size(), end - at - begin.size());
  }
  /// `before` has to be there, once.
  void edit(const std::string& file, const std::string& before, const std::string& after) {
    std::string text = read(folder_ / file);
    const std::size_t at = text.find(before);
    ASSERT_NE(at, std::string::npos) << before << " is not in " << file;
    ASSERT_EQ(text.find(before, at + 1), std::string::npos) << before << " is twice in " << file;
    std::ofstream(folder_ / file) << text.replace(at, before.size(), after);
  }

  /// The errors of a file that includes `header` and goes on with `code`: "" where it compiles.
  std::string errors_of(const std::string& header, const std::string& code = "") {
    std::ofstream(folder_ / "probe.cpp") << "#include \"" << header << "\"\n" << code << "\n";
    return failure("-fsyntax-only " + quoted(folder_ / "probe.cpp"));
  }
  /// The output of a program of the tests, which takes from the library what no list has a part in.
  std::string output_of(const std::string& program) {
    const std::string failed = failure("-O0 -o " + quoted(folder_ / "probe") + " " + quoted(source(program)) + " " +
                                       isostep_lint::quoted(ISOSTEP_LIBRARY) + " " +
                                       isostep_lint::quoted(ISOSTEP_SCALAR_LIBRARY) + " " + ISOSTEP_CXX_FLAGS);
    if (!failed.empty()) return failed;
    std::string output;
    const bool ended =
        isostep_lint::run(quoted(folder_ / "probe"), [&](const std::string& line) { output += line + "\n"; });
    return ended ? output : "the program failed";
  }

 private:
  static std::filesystem::path source(const std::string& path) {
    return std::filesystem::path(ISOSTEP_SOURCE_DIR) / path;
  }
  static std::string quoted(const std::filesystem::path& path) { return isostep_lint::quoted(path.string()); }
  static std::string read(const std::filesystem::path& path) {
    std::ostringstream text;
    text << std::ifstream(path).rdbuf();
    return text.str();
  }
  /// The compiler's words where it fails. No scalar counts as shipped: templates are instantiated where they are used.
  std::string failure(const std::string& arguments) {
    std::string command = quoted(ISOSTEP_CXX) + " -std=c++20 -ffp-contract=off";
    for (const char* scalar : {"FLOAT", "DOUBLE", "Q16_16", "Q32_32"})
      command += std::string(" -DISOSTEP_NO_") + scalar;
    for (const char* folder : {"include", "scalar/include", "src", "src/scenes"})
      command += " -I" + quoted(folder_ / folder);
    std::string said;
    const bool compiled =
        isostep_lint::run(command + " " + arguments + " 2>&1", [&](const std::string& line) { said += line + "\n"; });
    return compiled ? "" : said.empty() ? "the compiler did not run" : said;
  }
};

}  // namespace isostep
