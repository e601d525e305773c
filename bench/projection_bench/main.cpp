// isostep_projection_bench: the book's ways to end overlaps, and to find the worst contact, beside each other.
// SPDX-License-Identifier: MIT
#include <cstdio>
#include <fstream>
#include <stdexcept>

#include "projection_bench/measure.hpp"
#include "scene_bench/program.hpp"
#include "scene_bench/text.hpp"

namespace isostep::bench {

namespace {

struct Arguments {
  std::vector<int> counts = {12, 25, 50, 100, 200, 400, 800};
  int rounds = 9;
  std::string results;
};

std::string table_of(const std::vector<ProjectionRow>& rows) {
  std::vector<std::vector<std::string>> cells = {{"scene", "scalar", "projection", "worst overlap mm", "mean mm",
                                                  "at the end mm", "energy kept %", "gained %", "ms a step",
                                                  "islands left"}};
  for (const ProjectionRow& row : rows) {
    cells.push_back({row.scene, row.scalar, row.projection, print("%.2f", 1e3 * row.worst),
                     print("%.2f", 1e3 * row.mean), print("%.2f", 1e3 * row.left), print("%.2f", 100 * row.kept),
                     print("%.3f", 100 * row.gained), print("%.2f", row.ms),
                     print("%llu", static_cast<unsigned long long>(row.cut))});
  }
  return markdown(cells);
}
/// Three rows, one a queue, are a line.
std::string table_of(const std::vector<QueueRow>& rows) {
  std::vector<std::vector<std::string>> cells = {{"bodies", "contacts", "points"}};
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const QueueRow& row = rows[i];
    if (i == 0 || row.bodies != rows[i - 1].bodies)
      cells.push_back({print("%d", row.bodies), print("%u", row.contacts), print("%u", row.points)});
    cells.back().push_back(print("%.0f", row.us));
    if (cells.size() == 2) cells[0].push_back(row.queue + " us");
  }
  return markdown(cells);
}
std::string tsv_of(const std::vector<QueueRow>& rows) {
  std::string text = "bodies\tcontacts\tpoints\tqueue\tus\n";
  for (const QueueRow& row : rows)
    text += print("%d\t%u\t%u\t%s\t%.6g\n", row.bodies, row.contacts, row.points, row.queue.c_str(), row.us);
  return text;
}

void run(const Arguments& arguments) {
  std::printf("%s\n", table_of(measure_projections()).c_str());
  std::vector<QueueRow> rows;
  for (const int count : arguments.counts) {
    const std::vector<QueueRow> more = measure_queues(count, arguments.rounds);
    rows.insert(rows.end(), more.begin(), more.end());
  }
  std::fputs(table_of(rows).c_str(), stdout);
  if (arguments.results.empty()) return;
  std::ofstream file(arguments.results + "/projection.tsv", std::ios::binary);
  file << tsv_of(rows);
  if (!file.flush()) throw std::runtime_error("cannot write " + arguments.results + "/projection.tsv");
}

}  // namespace
}  // namespace isostep::bench

int main(int count, char** words) {
  isostep::bench::Arguments arguments;
  CLI::App app("The book's ways to end overlaps, and to find the worst contact, beside each other");
  app.add_option("--counts", arguments.counts, "Bodies of a pile")->check(CLI::Range(1, 5000))->delimiter(',');
  app.add_option("--rounds", arguments.rounds, "Of each queue; times are their least")->check(CLI::Range(1, 1000));
  app.add_option("--results", arguments.results,
                 "Of a whole run, by none of the options above: projection.tsv in this directory, for the chart")
      ->check(CLI::ExistingDirectory);
  return isostep::bench::run_program(app, count, words, [&] {
    if (count != 3) arguments.results.clear();  // a part of a run draws nothing
    isostep::bench::run(arguments);
  });
}
