// The matrix of survival: for every trial and method the cheapest setting that survives, and the one to recommend.
// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "tool/lab/result.hpp"

namespace isostep::tool::lab {

enum class Fate { untried, survived, failed, open, refused };
inline constexpr const char* kFateNames[] = {"not run", "survived", "failed", "too long", "refused"};

/// The outcome of one trial by one method: of several settings the cheapest that survived, of a peer's the defaults if
/// they did, else the one that came nearest to its bar. It is open where every run was too long or hung.
struct MatrixCell {
  Fate fate = Fate::untried;
  LabResult result;  // unless untried
};
struct MatrixColumn {
  std::string scalar, solver;  // of ours
  std::string engine;          // kOwnEngine, or a peer, be it by its defaults or at its best: engines.hpp

  bool is_ours() const { return engine == kOwnEngine; }
};
struct MatrixRow {
  std::string trial;
  std::vector<MatrixCell> cells;  // one a column
};
struct Matrix {
  std::vector<MatrixColumn> columns;
  std::vector<MatrixRow> rows;

  /// The cheapest of all cells of that scalar in a row that survived; null where none did. Empty: of every scalar. Of
  /// times that differ by less than a tenth the first column counts, so that a clock's noise recommends nothing.
  const LabResult* recommended(std::size_t row, const std::string& scalar) const;
};

/// Rows in the order of `trials`, columns in that of `scalars`, then `solvers`, then peers by name.
Matrix matrix_of(const std::vector<std::string>& trials, const std::vector<std::string>& scalars,
                 const std::vector<std::string>& solvers, const std::vector<LabResult>& results);

Fate fate_of(const LabResult& result);
/// Returns how a trial ends by a setting of ours: survived if it or the same with fewer sub-steps does, else failed if
/// one of them does, else why none of them ran.
Fate fate_within(const std::vector<LabResult>& results, const LabPoint& setting);
/// What a cell says: of ours the effort that survived, of a peer whether its defaults did or only its best settings.
std::string sign_of(const MatrixCell& cell);
/// "8" sub-steps, or where that did not do "240" steps a second.
std::string effort_of(const LabPoint& point);
/// Cheaper by time, then by sub-steps.
bool is_cheaper(const LabResult& a, const LabResult& b);

}  // namespace isostep::tool::lab
