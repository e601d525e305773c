// isostep_csharp: makes those files of the C# package that follow from the library.
// SPDX-License-Identifier: MIT
#include <cstdio>
#include <string>

#include "functions.hpp"
#include "numbers.hpp"
#include "output.hpp"
#include "structs.hpp"

using namespace isostep::csharp;

int main(int argc, char** argv) {
  const bool check = argc == 4 && std::string(argv[3]) == "--check";
  if (argc != 3 && !check) {
    std::fprintf(stderr, "usage: isostep_csharp SOURCE PACKAGE [--check]\n");
    return 64;
  }
  const std::filesystem::path source = argv[1];
  const std::filesystem::path package = argv[2];
  Files files;
  add_numbers(source, files);
  const Schema schema = read_schema(source);
  add_enums(schema, files);
  add_structs(schema, files);
  add_functions(schema, files);
  add_methods(schema, files);
  const int differ = write_or_check(package, files, check);
  std::printf("%d of %zu files %s\n", differ, files.size(), check ? "differ" : "written");
  return check && differ > 0 ? 1 : 0;
}
