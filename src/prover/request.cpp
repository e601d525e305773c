// The reader of the prover's words.
// SPDX-License-Identifier: MIT
#include "request.hpp"

#include <cstdio>
#include <optional>
#include <string>

#include "isostep/core/number_text.hpp"
#include "isostep/core/simd_choice.hpp"

namespace isostep::prover {
namespace {

bool read_option(std::string_view name, std::string_view value, Request& request) {
  if (name == "--frames") return read_number(value, request.frames) && request.frames != 0;
  if (name == "--fault") return read_stage_fault(value, request.fault.emplace());
  const std::optional<Simd> simd = simd_named(value);
  request.simd = simd.value_or(Simd::best);
  return simd.has_value();
}

}  // namespace

int refuse(int status, std::string_view what, std::string_view detail) {
  std::string line = "isostep_prover: ";
  line += what;
  if (!detail.empty()) line.append(" (").append(detail).append(")");
  line += '\n';
  std::fwrite(line.data(), 1, line.size(), stderr);
  return status;
}

int read_request(int count, const char* const* words, Request& request) {
  for (int i = 1; i < count; ++i) {
    const std::string_view word = words[i];
    if (word.substr(0, 2) != "--") {
      if (request.command.empty()) request.command = word;
      else request.operands.push_back(word);
      continue;
    }
    if (word != "--simd" && word != "--frames" && word != "--fault")
      return refuse(exit_status::kUsage, "no such option", word);
    if (++i == count) return refuse(exit_status::kUsage, "a value is missing", word);
    if (!read_option(word, words[i], request)) return refuse(exit_status::kUsage, "not a value of that option", word);
  }
  return exit_status::kOk;
}

}  // namespace isostep::prover
