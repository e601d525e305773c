// isostep_maths_chart: Google Benchmark's JSON of isostep_math_bench to TSV, one row an operation and scalar.
// SPDX-License-Identifier: MIT
#include <cstdio>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace {

/// "cross_own<float>" taken apart.
struct Name {
  std::string operation, scalar;
  bool own;
};
Name parse(const std::string& name) {
  const std::size_t open = name.find('<'), close = name.find('>'), line = name.rfind('_', open);
  if (open == std::string::npos || close == std::string::npos || line == std::string::npos) {
    throw std::runtime_error("a name that is no operation_side<scalar>: " + name);
  }
  return {name.substr(0, line), name.substr(open + 1, close - open - 1),
          name.substr(line + 1, open - line - 1) == "own"};
}

struct Pair {
  std::string operation, scalar;
  double own = 0, eigen = 0;  // [ns] one operation
};

/// Medians when the run has them, single runs else. Order as measured.
std::vector<Pair> read(const nlohmann::json& json) {
  bool medians = false;
  for (const auto& run : json.at("benchmarks")) medians = medians || run.value("aggregate_name", "") == "median";
  std::vector<Pair> pairs;
  std::map<std::string, std::size_t> place;
  for (const auto& run : json.at("benchmarks")) {
    if (run.value("aggregate_name", "") != (medians ? "median" : "")) continue;
    const Name name = parse(run.at("run_name"));
    const auto [at, fresh] = place.emplace(name.operation + '<' + name.scalar, pairs.size());
    if (fresh) pairs.push_back({name.operation, name.scalar, 0, 0});
    // Items per second of CPU time; an aggregate of times keeps it as well.
    const double ns = 1e9 / run.at("items_per_second").get<double>();
    (name.own ? pairs[at->second].own : pairs[at->second].eigen) = ns;
  }
  return pairs;
}

}  // namespace

int main(int count, char** words) {
  if (count != 3) {
    std::fprintf(stderr, "usage: %s math_bench.json maths.tsv\n", words[0]);
    return 64;
  }
  std::FILE* file = nullptr;
  try {
    std::ifstream in(words[1]);
    if (!in) throw std::runtime_error(std::string("cannot read ") + words[1]);
    const std::vector<Pair> pairs = read(nlohmann::json::parse(in));
    file = std::fopen(words[2], "wb");
    if (file == nullptr) throw std::runtime_error(std::string("cannot write ") + words[2]);
    std::fputs("operation\tscalar\town_ns\teigen_ns\tratio\n", file);
    for (const Pair& p : pairs) {
      std::fprintf(file, "%s\t%s\t%.3f\t%.3f\t%.3f\n", p.operation.c_str(), p.scalar.c_str(), p.own, p.eigen,
                   p.own / p.eigen);
    }
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 70;
  }
  return std::fclose(file) == 0 ? 0 : 74;
}
