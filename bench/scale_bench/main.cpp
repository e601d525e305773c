// isostep_scale_bench: what a body costs among 100 and among 500 000, and what sleepers cost those who are awake.
// SPDX-License-Identifier: MIT
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>

#include "isostep/core/scalar_names.hpp"
#include "scale.hpp"

namespace isostep::bench {
namespace {

struct Arguments {
  std::vector<std::string> parts = {"scale", "sleepers", "crowds"};
  std::string tsv;
  ScaleOptions options;
};

void run_crowds(const ScaleOptions& options) {
  const char* scalar = options.scalar.c_str();
  std::printf("\nA crowd of which some move, %s:\n\n%s", scalar, table_of(measure_crowds(options)).c_str());
  std::fflush(stdout);
  std::printf("\nA player in a field of sleepers, %s:\n\n%s", scalar, table_of(measure_player(options)).c_str());
  std::fflush(stdout);
  std::printf("\nRows of boxes that fall, %s:\n\n%s", scalar, table_of(measure_most(options)).c_str());
}

int run(const Arguments& arguments) {
  const auto wants = [&](const char* part) {
    return std::count(arguments.parts.begin(), arguments.parts.end(), std::string(part)) != 0;
  };
  if (wants("scale")) {
    const std::vector<ScaleRow> rows = measure_scale(arguments.options);
    std::printf("Nanoseconds a body and step, %s:\n\n%s\n", arguments.options.scalar.c_str(), table_of(rows).c_str());
    std::fflush(stdout);
    if (!arguments.tsv.empty()) {
      std::FILE* file = std::fopen(arguments.tsv.c_str(), "wb");
      const bool written = file != nullptr && std::fputs(tsv_of(rows).c_str(), file) >= 0;
      if (file == nullptr || std::fclose(file) != 0 || !written) {
        std::fprintf(stderr, "cannot write %s\n", arguments.tsv.c_str());
        return 74;
      }
    }
  }
  if (wants("sleepers")) {
    const std::vector<SleeperRow> rows = measure_sleepers(arguments.options);
    std::printf("Sleepers, %s:\n\n%s", arguments.options.scalar.c_str(), table_of(rows).c_str());
    std::fflush(stdout);
  }
  if (wants("crowds")) run_crowds(arguments.options);
  return 0;
}

}  // namespace
}  // namespace isostep::bench

int main(int count, char** words) {
  isostep::bench::Arguments arguments;
  isostep::bench::ScaleOptions& options = arguments.options;
  CLI::App app("What a body costs among 100 and among 500 000, and what sleepers cost those who are awake");
  app.add_option("--parts", arguments.parts, "scale, sleepers, crowds, separated by commas")
      ->delimiter(',')
      ->check(CLI::IsMember({"scale", "sleepers", "crowds"}));
  app.add_option("--scalar", options.scalar, "The number type")->check(CLI::IsMember(isostep::scalar_names()));
  app.add_option("--scenes", options.scenes, "pyramid, pile, separated by commas")
      ->delimiter(',')
      ->check(CLI::IsMember({"pyramid", "pile"}));
  app.add_option("--sizes", options.sizes, "Bodies, separated by commas")->delimiter(',')->check(CLI::Range(1, 200000));
  app.add_option("--settle", options.settle, "Frames before the first that counts")->check(CLI::Range(0, 100000));
  app.add_option("--frames", options.frames, "Frames that count; times are medians over them")
      ->check(CLI::Range(1, 100000));
  app.add_option("--sleeping", options.sleeping, "Sleepers, separated by commas")
      ->delimiter(',')
      ->check(CLI::Range(0, 1000000));
  app.add_option("--column", options.column, "Sleepers an island")->check(CLI::Range(1, 20));
  app.add_option("--crowd", options.crowd, "Boxes of which some move")->check(CLI::Range(1000, 1000000));
  app.add_option("--moving", options.moving, "Of the crowd, separated by commas")
      ->delimiter(',')
      ->check(CLI::Range(100, 1000000));
  app.add_option("--field", options.field, "Boxes around the player")->check(CLI::Range(1000, 1000000));
  app.add_option("--most", options.most, "Boxes that fall in rows, separated by commas")
      ->delimiter(',')
      ->check(CLI::Range(1, 1000000));
  app.add_option("--tsv", arguments.tsv, "Write the stages' times to this file, for the chart");
  std::string results;
  app.add_option("--results", results, "Of a whole run, by none of the options above: scale.tsv in this directory");
  CLI11_PARSE(app, count, words);
  const bool whole = count == 3 && !results.empty();
  if (whole) arguments.tsv = results + "/scale.tsv";
  try {
    return isostep::bench::run(arguments);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 70;
  }
}
