// Times and errors of the convex algorithms.
// SPDX-License-Identifier: MIT
#include "measure.hpp"

#include <algorithm>
#include <cstdio>

#include "isostep/core/scalars.hpp"
#include "scalar_pairs.hpp"
#include "scene_bench/clock.hpp"

namespace isostep::bench {
namespace {

/// [m] Nearer to touching than this, either verdict is right: q16.16 has 1/65536 m, of which distances may lose a few.
constexpr double kTouch = 0.00025;

template <class S> bool is_wrong(const ScalarPair<S>& pair, const Said& said, Algorithm algorithm) {
  if (!said.answered) return true;
  const bool by_axis = algorithm == Algorithm::sat || algorithm == Algorithm::sat_one_lane;
  if (by_axis) return false;  // its points are cut to a face, and may all be above the other where the solids overlap
  return std::abs(pair.exact.gap) > kTouch && said.apart != (pair.exact.gap > 0);
}

/// [m] Less than 0: there is none to tell.
template <class S> double error_of(const ScalarPair<S>& pair, const Said& said, Algorithm algorithm) {
  const bool overlap = pair.exact.gap <= 0;
  switch (algorithm) {
    case Algorithm::sat:
    case Algorithm::sat_one_lane:
      if (dot(said.axis, said.axis) == 0) return -1;
      return std::abs(pair.exact.gap - gap_along(pair.exact_a, pair.exact_b, said.axis));
    case Algorithm::epa: return std::abs(said.value - (overlap ? pair.exact.gap : pair.exact.distance));
    default: return overlap ? -1 : std::abs(said.value - pair.exact.distance);
  }
}

template <class S> void note_errors(const std::vector<ScalarPair<S>>& pairs, Algorithm algorithm, ConvexRow& row) {
  double sum = 0;
  int told = 0;
  for (const ScalarPair<S>& pair : pairs) {
    const Said said = ask(pair, algorithm);
    if (is_wrong(pair, said, algorithm)) {
      ++row.wrong;
      continue;
    }
    const double error = error_of(pair, said, algorithm);
    if (error < 0) continue;
    row.worst = std::max(row.worst, error);
    sum += error;
    ++told;
  }
  if (told > 0) row.mean = sum / told;
}

/// [ns] a pair, of one pass over all.
template <class S> double time_of(const std::vector<ScalarPair<S>>& pairs, Algorithm algorithm) {
  double sum = 0;
  const double start = thread_milliseconds();
  for (const ScalarPair<S>& pair : pairs) sum += ask(pair, algorithm).value;
  const double ms = thread_milliseconds() - start;
  if (sum == 1e300) std::fputs("", stderr);  // the answers are used
  return 1e6 * ms / static_cast<double>(pairs.size());
}

template <class S> void measure_scalar(const PairSet& set, int rounds, std::vector<ConvexRow>& rows) {
  std::fprintf(stderr, "%s\n", ScalarTraits<S>::kName);
  const std::vector<HullSolid<S>> solids = solids_of<S>(set);
  for (std::size_t kind = 0; kind < std::size(kClosenessNames); ++kind) {
    const auto pairs = scalar_pairs<S>(set, solids, static_cast<Closeness>(kind));
    if (pairs.empty()) continue;
    const std::size_t first = rows.size();
    for (std::size_t k = 0; k < std::size(kAlgorithmNames); ++k) {
      ConvexRow& row = rows.emplace_back();
      row.scalar = ScalarTraits<S>::kName;
      row.algorithm = kAlgorithmNames[k];
      row.pairs = kClosenessNames[kind];
      row.count = pairs.size();
      note_errors(pairs, static_cast<Algorithm>(k), row);
    }
    for (int round = 0; round < rounds; ++round) {
      for (std::size_t k = 0; k < std::size(kAlgorithmNames); ++k) {
        const double ns = time_of(pairs, static_cast<Algorithm>(k));
        double& least = rows[first + k].ns;
        least = round == 0 ? ns : std::min(least, ns);
      }
    }
  }
}

}  // namespace

std::vector<ConvexRow> measure_convex(const PairSet& set, int rounds) {
  std::vector<ConvexRow> rows;
#define ISO_MEASURE(S) measure_scalar<S>(set, rounds, rows);
  ISO_FOR_EACH_SCALAR(ISO_MEASURE)
#undef ISO_MEASURE
  return rows;
}

}  // namespace isostep::bench
