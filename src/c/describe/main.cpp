// isostep_interface: writes the generated part of the C interface from the C++ headers.
// SPDX-License-Identifier: MIT
//
// isostep_interface header ROOT HEADER CHECKS: HEADER, a copy of isostep.h with the structs of now, and CHECKS.
// isostep_interface json ROOT HEADER EXPANDED JSON ABI CALLS: JSON, ABI and CALLS, from those and HEADER as the
// preprocessor leaves it, EXPANDED.

#include <cstdio>
#include <fstream>
#include <iterator>
#include <string>

#include "abi_text.hpp"
#include "calls_text.hpp"
#include "comments.hpp"
#include "header_text.hpp"
#include "json_text.hpp"
#include "section_text.hpp"

namespace {

using namespace isostep::c_header;

std::string read(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}
bool write(const std::string& path, const std::string& text) {
  std::ofstream out(path, std::ios::binary);
  out << text;
  out.close();
  if (!out) std::fprintf(stderr, "isostep_interface: cannot write %s\n", path.c_str());
  return static_cast<bool>(out);
}

int write_header(const Schema& schema, const std::string& root, const std::string& to, const std::string& checks) {
  const std::string header = with_region(read(root + "/src/c/include/isostep.h"), region_text(schema));
  if (header.empty()) return std::fprintf(stderr, "isostep_interface: isostep.h lacks the marks of its structs\n"), 1;
  return write(to, header) && write(checks, checks_text(schema)) ? 0 : 1;
}

int write_json(Schema schema, char** paths) {
  const std::string problem = add_section(read(paths[0]), schema);
  if (!problem.empty()) return std::fprintf(stderr, "isostep_interface: sessions: %s\n", problem.c_str()), 1;
  const std::vector<Function> functions = read_functions(read(paths[1]), read(paths[0]));
  if (functions.empty()) return std::fprintf(stderr, "isostep_interface: %s has no functions\n", paths[1]), 1;
  const bool written = write(paths[2], json_text(schema, functions)) && write(paths[3], abi_text(schema, functions)) &&
                       write(paths[4], calls_text(schema, functions));
  return written ? 0 : 1;
}

}  // namespace

int main(int count, char** arguments) {
  const std::string mode = count > 1 ? arguments[1] : "";
  if (!(mode == "header" && count == 5) && !(mode == "json" && count == 8)) {
    return std::fprintf(stderr,
                        "isostep_interface header ROOT HEADER CHECKS | json ROOT HEADER EXPANDED JSON ABI CALLS\n"),
           64;
  }
  const std::string root = arguments[2];
  Schema schema = make_schema();
  read_comments(root, schema);
  if (mode == "header") return write_header(schema, root, arguments[3], arguments[4]);
  return write_json(schema, arguments + 3);
}
