// The matrix of survival.
// SPDX-License-Identifier: MIT
#include "matrix.hpp"

#include <algorithm>
#include <set>
#include <tuple>

#include "engines.hpp"

namespace isostep::tool::lab {
namespace {

/// The order in which a cell prefers what it shows.
int rank_of(Fate fate) {
  switch (fate) {
    case Fate::survived: return 0;
    case Fate::failed: return 1;
    case Fate::open: return 2;
    case Fate::refused: return 3;
    default: return 4;
  }
}

bool is_preferred(const LabResult& a, const LabResult& b) {
  const Fate fate_a = fate_of(a), fate_b = fate_of(b);
  if (fate_a != fate_b) return rank_of(fate_a) < rank_of(fate_b);
  if (fate_a == Fate::survived && is_best(a.point.engine) != is_best(b.point.engine)) return is_best(b.point.engine);
  if (fate_a != Fate::failed) return is_cheaper(a, b);
  const auto sound = [](const LabResult& r) { return r.faults == 0 && r.figure == r.figure; };
  if (sound(a) != sound(b)) return sound(a);
  if (sound(a) && a.figure != b.figure) return a.figure < b.figure;
  return is_cheaper(a, b);
}

void add(MatrixCell& cell, const LabResult& result) {
  if (cell.fate != Fate::untried && !is_preferred(result, cell.result)) return;
  cell = {fate_of(result), result};
}

bool is_of(const MatrixColumn& column, const LabPoint& point) {
  return column.engine == engine_of(point.engine) && column.scalar == point.scalar && column.solver == point.solver;
}

}  // namespace

Fate fate_of(const LabResult& result) {
  if (result.state == kLeftOut || result.state == kHung) return Fate::open;
  if (result.state != kDone) return Fate::refused;
  return result.judged && result.survived ? Fate::survived : Fate::failed;
}

Fate fate_within(const std::vector<LabResult>& results, const LabPoint& setting) {
  Fate best = Fate::untried;
  for (const LabResult& result : results) {
    LabPoint point = result.point;
    point.substeps = std::max(point.substeps, setting.substeps);
    if (point == setting && rank_of(fate_of(result)) < rank_of(best)) best = fate_of(result);
  }
  return best;
}

std::string sign_of(const MatrixCell& cell) {
  switch (cell.fate) {
    case Fate::survived:
      if (cell.result.point.engine == kOwnEngine) return effort_of(cell.result.point);
      return is_best(cell.result.point.engine) ? "+" : "✓";
    case Fate::failed: return "×";
    case Fate::open: return "…";
    case Fate::refused: return "–";
    default: return "";
  }
}

std::string effort_of(const LabPoint& point) {
  constexpr int kRaised = 120;  // [1/s] no scene's own rate
  return std::to_string(point.hz >= kRaised ? point.hz : point.substeps);
}

bool is_cheaper(const LabResult& a, const LabResult& b) {
  return std::tie(a.ms, a.point.substeps) < std::tie(b.ms, b.point.substeps);
}

Matrix matrix_of(const std::vector<std::string>& trials, const std::vector<std::string>& scalars,
                 const std::vector<std::string>& solvers, const std::vector<LabResult>& results) {
  Matrix matrix;
  for (const std::string& scalar : scalars) {
    for (const std::string& solver : solvers) matrix.columns.push_back({scalar, solver, kOwnEngine});
  }
  std::set<std::string> peers;
  for (const LabResult& result : results) peers.insert(engine_of(result.point.engine));
  peers.erase(kOwnEngine);
  for (const std::string& peer : peers) matrix.columns.push_back({"", "", peer});
  for (const std::string& trial : trials) {
    MatrixRow row = {trial, std::vector<MatrixCell>(matrix.columns.size())};
    for (const LabResult& result : results) {
      if (result.point.scene != trial) continue;
      for (std::size_t i = 0; i < matrix.columns.size(); ++i) {
        if (is_of(matrix.columns[i], result.point)) add(row.cells[i], result);
      }
    }
    matrix.rows.push_back(std::move(row));
  }
  return matrix;
}

const LabResult* Matrix::recommended(std::size_t row, const std::string& scalar) const {
  constexpr double kNoise = 1.1;  // [1] of times
  std::vector<const LabResult*> survivors;
  for (std::size_t i = 0; i < columns.size(); ++i) {
    const MatrixCell& cell = rows[row].cells[i];
    if (!columns[i].is_ours() || (!scalar.empty() && columns[i].scalar != scalar)) continue;
    if (cell.fate == Fate::survived) survivors.push_back(&cell.result);
  }
  const auto cheaper = [](const LabResult* a, const LabResult* b) { return is_cheaper(*a, *b); };
  const auto cheapest = std::min_element(survivors.begin(), survivors.end(), cheaper);
  if (cheapest == survivors.end()) return nullptr;
  return *std::find_if(survivors.begin(), survivors.end(),
                       [&](const LabResult* r) { return r->ms <= kNoise * (*cheapest)->ms; });
}

}  // namespace isostep::tool::lab
