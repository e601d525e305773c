// isostep_csharp: makes those files of the C# package that follow from the library, and Unity's .meta files.
// SPDX-License-Identifier: MIT
//
// isostep_csharp package SOURCE OUT: into OUT, anew, the package of SOURCE, the repository, with all that is made.
// isostep_csharp layouts SOURCE OUT: into OUT what tests compare layouts by: LayoutTable.cs for C#, layout.c for C.
// isostep_csharp metas PACKAGE: the .meta files of a package to which libraries were added.
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

void write_package(const std::filesystem::path& source, const std::filesystem::path& out) {
  std::filesystem::remove_all(out);
  std::filesystem::create_directories(out.parent_path());
  std::filesystem::copy(source / "src/csharp/package", out, std::filesystem::copy_options::recursive);
  write_files(out, made_files(source));
  write_metas(out);
}

}  // namespace

int main(int argc, char** argv) {
  const std::string mode = argc > 1 ? argv[1] : "";
  if (mode == "package" && argc == 4) {
    write_package(argv[2], argv[3]);
  } else if (mode == "layouts" && argc == 4) {
    const Schema schema = read_schema(argv[2]);
    write_files(argv[3], {{"LayoutTable.cs", layout_table(schema)}, {"layout.c", layout_assertions(schema)}});
  } else if (mode == "metas" && argc == 3) {
    write_metas(argv[2]);
  } else {
    std::fprintf(stderr, "usage: isostep_csharp package SOURCE OUT | layouts SOURCE OUT | metas PACKAGE\n");
    return 64;
  }
  return 0;
}
