// isostep_convex_bench: separating axes, GJK, EPA and V-Clip over the pairs of hulls of S10, in every scalar.
// SPDX-License-Identifier: MIT
#include <cstdio>
#include <fstream>

#include "measure.hpp"
#include "scene_bench/program.hpp"
#include "scene_bench/text.hpp"

namespace isostep::bench {
namespace {

struct Arguments {
  int frames = 600, rounds = 15;
  std::size_t pairs = 500;
  std::string results;
};

std::string micrometres(double error) { return error < 0 ? "-" : print("%.3g", 1e6 * error); }

std::string table_of(const std::vector<ConvexRow>& rows) {
  std::vector<std::vector<std::string>> cells = {
      {"pairs", "scalar", "algorithm", "of", "ns a pair", "worst um", "mean um", "wrong"}};
  for (const ConvexRow& row : rows) {
    cells.push_back({row.pairs, row.scalar, row.algorithm, print("%zu", row.count), print("%.0f", row.ns),
                     micrometres(row.worst), micrometres(row.mean), print("%d", row.wrong)});
  }
  return markdown(cells);
}

std::string tsv_of(const std::vector<ConvexRow>& rows) {
  std::string text = "pairs\tscalar\talgorithm\tcount\tns\tworst_m\tmean_m\twrong\n";
  for (const ConvexRow& row : rows) {
    text += print("%s\t%s\t%s\t%zu\t%.6g\t%.6g\t%.6g\t%d\n", row.pairs.c_str(), row.scalar.c_str(),
                  row.algorithm.c_str(), row.count, row.ns, row.worst, row.mean, row.wrong);
  }
  return text;
}

void write(const std::string& path, const std::string& text) {
  std::ofstream file(path, std::ios::binary);
  file << text;
  if (!file.flush()) throw std::runtime_error("cannot write " + path);
}

void run(const Arguments& arguments) {
  const PairSet set = pairs_of_pile(arguments.frames, arguments.pairs);
  const std::vector<ConvexRow> rows = measure_convex(set, arguments.rounds);
  std::fputs(table_of(rows).c_str(), stdout);
  if (!arguments.results.empty()) write(arguments.results + "/convex.tsv", tsv_of(rows));
}

}  // namespace
}  // namespace isostep::bench

int main(int count, char** words) {
  isostep::bench::Arguments arguments;
  CLI::App app("Separating axes, GJK, EPA and V-Clip over the pairs of hulls of S10, in every scalar");
  app.add_option("--frames", arguments.frames, "Of S10, before its pairs are taken")->check(CLI::Range(1, 100000));
  app.add_option("--pairs", arguments.pairs, "Most of each kind")->check(CLI::Range(1, 100000));
  app.add_option("--rounds", arguments.rounds, "Passes over the pairs; times are the lowest of them")
      ->check(CLI::Range(1, 1000));
  app.add_option("--results", arguments.results,
                 "Of a whole run, by none of the options above: convex.tsv in this directory, for the chart")
      ->check(CLI::ExistingDirectory);
  return isostep::bench::run_program(app, count, words, [&] {
    if (count != 3) arguments.results.clear();  // a part of a run draws nothing
    isostep::bench::run(arguments);
  });
}
