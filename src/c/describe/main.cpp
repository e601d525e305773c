// isostep_interface: writes the generated part of the C interface from the C++ headers.
// SPDX-License-Identifier: MIT
//
// isostep_interface header ROOT HEADER CHECKS: HEADER, a copy of isostep.h with the structs of now, and CHECKS.
// isostep_interface json ROOT HEADER EXPANDED JSON: JSON, from those and HEADER as the preprocessor leaves it.

#include <cstdio>
#include <fstream>
#include <iterator>
#include <string>

#include "comments.hpp"
#include "header_text.hpp"
#include "json_text.hpp"

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

int write_json(const Schema& schema, const std::string& header, const std::string& expanded, const std::string& to) {
  const std::vector<Function> functions = read_functions(read(expanded), read(header));
  if (functions.empty()) return std::fprintf(stderr, "isostep_interface: %s has no functions\n", expanded.c_str()), 1;
  return write(to, json_text(schema, functions)) ? 0 : 1;
}

}  // namespace

int main(int count, char** arguments) {
  const std::string mode = count > 1 ? arguments[1] : "";
  if (!(mode == "header" && count == 5) && !(mode == "json" && count == 6)) {
    return std::fprintf(stderr, "isostep_interface header ROOT HEADER CHECKS | json ROOT HEADER EXPANDED JSON\n"), 64;
  }
  const std::string root = arguments[2];
  Schema schema = make_schema();
  read_comments(root, schema);
  if (mode == "header") return write_header(schema, root, arguments[3], arguments[4]);
  return write_json(schema, arguments[3], arguments[4], arguments[5]);
}
