// isostep selfcheck: the library's answer to whether this build and machine are sound, as a line, a table or JSON.
// SPDX-License-Identifier: MIT
#include <cstdio>
#include <nlohmann/json.hpp>

#include "commands.hpp"
#include "isostep/core/version.hpp"
#include "isostep/replay/selfcheck.hpp"
#include "tool/common/tool.hpp"

namespace isostep::tool {
namespace {

using nlohmann::ordered_json;

void print_table(const SelfcheckResult& result) {
  const auto arithmetic = [](const char* whose, std::uint32_t deviations) {
    std::printf("%-14s %s\n", whose, deviations == 0 ? "as IEEE 754 has it" : deviation_names(deviations).c_str());
  };
  arithmetic("engine", result.engine);
  arithmetic("this program", result.caller);
  for (const SelfcheckPart& part : result.parts) {
    std::printf("%-7s %-6s %u of %u recordings, %llu frames", part.scalar, part.lanes, part.recordings - part.failed,
                part.recordings, static_cast<unsigned long long>(part.frames));
    if (part.skipped > 0) std::printf(", %u skipped", part.skipped);
    std::printf("\n");
  }
}

ordered_json json_of(const SelfcheckFailure& failure) {
  ordered_json json = {{"recording", failure.recording},
                       {"scalar", failure.scalar},
                       {"lanes", failure.lanes},
                       {"result", describe(failure.result)}};
  if (failure.result.outcome == VerifyOutcome::diverged) {
    json["frame"] = failure.result.frames;
    json["expected"] = hex(failure.result.expected);
    json["actual"] = hex(failure.result.actual);
  }
  return json;
}
ordered_json json_of(const SelfcheckResult& result, double milliseconds) {
  ordered_json parts = ordered_json::array();
  for (const SelfcheckPart& part : result.parts)
    parts.push_back({{"scalar", part.scalar},
                     {"lanes", part.lanes},
                     {"recordings", part.recordings},
                     {"failed", part.failed},
                     {"skipped", part.skipped},
                     {"frames", part.frames}});
  return {{"sound", result.sound()},
          {"version", kVersionText},
          {"compiler", compiler_name()},
          {"architecture", architecture_name()},
          {"behaviour", hex(behaviour_version())},
          {"engine", deviation_names(result.engine)},
          {"caller", deviation_names(result.caller)},
          {"frames", result.frames()},
          {"parts", parts},
          {"left_out", result.left_out != nullptr ? ordered_json(result.left_out) : ordered_json()},
          {"failure", result.failure ? json_of(*result.failure) : ordered_json()},
          {"milliseconds", milliseconds}};
}

}  // namespace

int command_selfcheck(const SelfcheckOptions& options) {
  const double before = real_milliseconds();
  const SelfcheckResult result = selfcheck();
  const double milliseconds = real_milliseconds() - before;
  if (options.json) {
    std::printf("%s\n", json_of(result, milliseconds).dump().c_str());
  } else {
    if (options.verbose) print_table(result);
    std::printf("%s; %.0f ms\n", describe(result).c_str(), milliseconds);
  }
  return result.sound() ? exit_status::kOk : exit_status::kDifferent;
}

}  // namespace isostep::tool
