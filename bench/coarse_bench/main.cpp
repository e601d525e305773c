// isostep_coarse_bench: what the structures of the broad phase cost, and which to take for which scene.
// SPDX-License-Identifier: MIT
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <new>

#include "coarse_bench/measure.hpp"
#include "scene_bench/program.hpp"
#include "scene_bench/text.hpp"

namespace {
std::size_t in_use = 0;
constexpr std::size_t kHead = alignof(std::max_align_t) > 64 ? alignof(std::max_align_t) : 64;  // holds the size
}  // namespace

// One thread measures. The size stands before the block, which keeps any alignment up to 64.
void* operator new(std::size_t size) {
  void* const block = std::aligned_alloc(kHead, (size + 2 * kHead - 1) / kHead * kHead);
  if (block == nullptr) throw std::bad_alloc();
  *static_cast<std::size_t*>(block) = size;
  in_use += size;
  return static_cast<char*>(block) + kHead;
}
void operator delete(void* at) noexcept {
  if (at == nullptr) return;
  void* const block = static_cast<char*>(at) - kHead;
  in_use -= *static_cast<std::size_t*>(block);
  std::free(block);
}
void operator delete(void* at, std::size_t) noexcept { operator delete(at); }

namespace isostep::bench {

std::size_t bytes_in_use() { return in_use; }

namespace {

struct Arguments {
  std::vector<int> counts = {100, 1000, 10000};
  int rounds = 9;
  std::string results;
};

std::string table_of(const std::vector<CoarseRow>& rows) {
  std::vector<std::vector<std::string>> cells = {{"field", "boxes", "scalar", "structure", "build ns a box", "update",
                                                  "pairs", "query ns", "ray ns", "bytes a box", "pairs found"}};
  for (const CoarseRow& row : rows) {
    cells.push_back({row.field, print("%d", row.count), row.scalar, row.structure, print("%.0f", row.build),
                     print("%.0f", row.update), print("%.0f", row.find), print("%.0f", row.query),
                     print("%.0f", row.ray), print("%.0f", row.bytes), print("%zu", row.pairs)});
  }
  return markdown(cells);
}
std::string tsv_of(const std::vector<CoarseRow>& rows) {
  std::string text = "field\tcount\tscalar\tstructure\tbuild\tupdate\tpairs\tquery\tray\tbytes\tframe\n";
  for (const CoarseRow& row : rows) {
    text += print("%s\t%d\t%s\t%s\t%.6g\t%.6g\t%.6g\t%.6g\t%.6g\t%.6g\t%.6g\n", row.field.c_str(), row.count,
                  row.scalar.c_str(), row.structure.c_str(), row.build, row.update, row.find, row.query, row.ray,
                  row.bytes, row.update + row.find);
  }
  return text;
}

void run(const Arguments& arguments) {
  std::vector<CoarseRow> rows;
  for (const int count : arguments.counts) {
    const std::vector<CoarseRow> more = measure_coarse(count, arguments.rounds);
    rows.insert(rows.end(), more.begin(), more.end());
  }
  std::fputs(table_of(rows).c_str(), stdout);
  if (arguments.results.empty()) return;
  std::ofstream file(arguments.results + "/coarse.tsv", std::ios::binary);
  file << tsv_of(rows);
  if (!file.flush()) throw std::runtime_error("cannot write " + arguments.results + "/coarse.tsv");
}

}  // namespace
}  // namespace isostep::bench

int main(int count, char** words) {
  isostep::bench::Arguments arguments;
  CLI::App app("What the structures of the broad phase cost, and which to take for which scene");
  app.add_option("--counts", arguments.counts, "Boxes of a field")->check(CLI::Range(10, 1000000))->delimiter(',');
  app.add_option("--rounds", arguments.rounds, "Of everything; times are their medians")->check(CLI::Range(1, 1000));
  app.add_option("--results", arguments.results,
                 "Of a whole run, by none of the options above: coarse.tsv in this directory, for the chart")
      ->check(CLI::ExistingDirectory);
  return isostep::bench::run_program(app, count, words, [&] {
    if (count != 3) arguments.results.clear();  // a part of a run draws nothing
    isostep::bench::run(arguments);
  });
}
