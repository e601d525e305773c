// isostep_csharp: makes those files of the C# package that follow from the library, and Unity's .meta files.
// SPDX-License-Identifier: MIT
//
// isostep_csharp files SOURCE [--check]: in SOURCE, the repository. With --check it only says what differs.
// isostep_csharp metas PACKAGE: of a copy of the package, to which libraries were added.
#include <cstdio>
#include <string>

#include "functions.hpp"
#include "metas.hpp"
#include "numbers.hpp"
#include "output.hpp"
#include "structs.hpp"

using namespace isostep::csharp;

namespace {

Files made_files(const std::filesystem::path& source) {
  Files files;
  add_numbers(source, files);
  const Schema schema = read_schema(source);
  add_enums(schema, files);
  add_structs(schema, files);
  add_functions(schema, files);
  add_methods(schema, files);
  return files;
}

/// Writes or checks `files` and their metas, and what they leave behind.
int finish(const std::filesystem::path& package, Files files, bool check) {
  int differ = 0;
  for (const std::filesystem::path& orphan : orphans_of(package, files)) {
    if (orphan.extension() == ".meta") continue;
    std::fprintf(stderr, "%s: is no longer made\n", orphan.string().c_str());
    ++differ;
    if (!check) std::filesystem::remove(orphan);
  }
  add_metas(package, files);
  differ += write_or_check(package, files, check);
  for (const std::filesystem::path& orphan : orphans_of(package, files)) {
    if (orphan.extension() != ".meta") continue;
    std::fprintf(stderr, "%s: belongs to nothing\n", orphan.string().c_str());
    ++differ;
    if (!check) std::filesystem::remove(orphan);
  }
  std::printf("%d of %zu files %s\n", differ, files.size(), check ? "differ" : "written");
  return check && differ > 0 ? 1 : 0;
}

}  // namespace

int main(int argc, char** argv) {
  const std::string mode = argc > 1 ? argv[1] : "";
  const bool check = argc == 4 && std::string(argv[3]) == "--check";
  if (mode == "files" && (argc == 3 || check)) {
    const std::filesystem::path source = argv[2];
    const Schema schema = read_schema(source);
    const Files tests = {{"LayoutTable.cs", layout_table(schema)}, {"layout.c", layout_assertions(schema)}};
    const int differ = write_or_check(source / "tests/csharp", tests, check);
    return finish(source / "src/csharp/package", made_files(source), check) + (check ? differ : 0);
  }
  if (mode == "metas" && argc == 3) {
    Files metas;
    add_metas(argv[2], metas);
    write_or_check(argv[2], metas, false);
    return 0;
  }
  std::fprintf(stderr, "usage: isostep_csharp files SOURCE [--check] | metas PACKAGE\n");
  return 64;
}
