// gnuplot as a program of its own.
// SPDX-License-Identifier: MIT
#include "gnuplot.hpp"

#include <cstdlib>
#include <filesystem>
#include <iostream>

#include "tool/common/tool.hpp"

namespace isostep::tool::lab {

std::string quoted(const std::string& word, const char* quote) {
  std::string text = "'";
  for (const char c : word) text += c == '\'' ? std::string(quote) : std::string(1, c);
  return text + "'";
}

bool rasterise(const std::string& svg, const std::string& png) {
  if (std::system("rsvg-convert --version >/dev/null 2>&1") != 0) {
    std::cerr << "isostep: rsvg-convert is not there: no " << png << "\n";
    return false;
  }
  const std::string shell = "rsvg-convert " + shell_quoted(svg) + " -o " + shell_quoted(png) + " >&2";
  if (std::system(shell.c_str()) != 0) throw ToolError(exit_status::kOutput, png + ": rsvg-convert failed");
  return true;
}

bool draw_chart(const std::string& directory, const std::string& name) {
  const std::string script = std::string(ISOSTEP_CHART_DIR) + "/" + name + ".gp";
  const std::string table = directory + "/" + name + ".tsv", chart = directory + "/" + name + ".svg";
  if (std::system("gnuplot --version >/dev/null 2>&1") != 0 || !std::filesystem::exists(script)) {
    std::cerr << "isostep: gnuplot or " << script << " is not there: no chart\n";
    return false;
  }
  const std::string variables = "data=" + quoted(table, "''") + "; out=" + quoted(chart, "''");
  const std::string shell = "gnuplot -e " + shell_quoted(variables) + " " + shell_quoted(script) + " >&2";
  if (std::system(shell.c_str()) != 0) throw ToolError(exit_status::kOutput, chart + ": gnuplot failed");
  std::cerr << "drawn: " << chart << "\n";
  return true;
}

}  // namespace isostep::tool::lab
